"""*Difference*: Blender is given to draw what is traced. (The drawing itself needs a window.)"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing import drawings
from reference_tracer.blender.live import like_for_like, shows, view
from reference_tracer.blender.live.scene import ViewScene
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.scene import Region, SceneError
from reference_tracer.tracer.settings import Settings

from .live import space


@pytest.fixture
def difference(build, monkeypatch):
    """Give what has the case of a small view made, and says what is traced and drawn for it."""
    build.far_camera()
    drawn = []

    def picture(scene, judge, camera, depsgraph, *_):
        items = bpy.context.evaluated_depsgraph_get().object_instances
        drawn.extend(i.object.name for i in items if i.object.type == "MESH" and i.show_self)
        yield from ()  # nothing is drawn
        return np.zeros((camera.region.height, camera.region.width, 4), np.float32)

    monkeypatch.setattr(drawings, "picture", picture)
    monkeypatch.setattr(like_for_like, "snapping_of", lambda judge: 1 / 256)

    def make():
        drawn.clear()
        bpy.context.view_layer.update()
        kept = ViewScene()
        kept.update(bpy.context.evaluated_depsgraph_get(), space())
        camera = export_camera(bpy.context.scene)
        camera = replace(camera, width=64, height=48, region=Region(0, 0, 64, 48))
        scene = kept.scene(camera)
        like_for_like.case_of(space().as_pointer(), scene, Settings())
        return sorted(scene.objects[i.object] for i in scene.instances), sorted(drawn)

    yield make
    for name in ("mesh", "empty", "light"):
        setattr(space(), f"show_object_viewport_{name}", True)


def test_instances_by_an_object_of_a_type_that_is_left_out(build, difference):
    build.cube("Beside")
    build.instances("Empty", build.collection("Kit", build.cube("In Kit", link=False)))
    for shown in (True, False):
        space().show_object_viewport_empty = space().show_object_viewport_light = shown
        assert difference() == (["Beside", "In Kit"],) * 2


def test_types_with_surfaces_that_are_left_out_are_refused(build, difference):
    build.cube()
    build.text()
    space().show_object_viewport_mesh = False
    with pytest.raises(SceneError, match="leaves out types of objects that have surfaces"):
        difference()


def test_a_hidden_object_is_drawn_by_no_one(build, difference):
    build.cube("Hidden").hide_set(True)
    build.cube("Shown")
    assert difference() == (["Shown"],) * 2


def test_a_border_of_the_cameras_picture_is_not_the_views(build, difference):
    build.cube("Cube")
    render = bpy.context.scene.render
    render.use_border, render.border_min_x, render.border_max_x = True, 0.5, 0.5001
    render.resolution_x = 40_000  # a pixel there, none in the view
    assert difference() == (["Cube"],) * 2


def test_while_others_are_busy_it_is_asked_now_and_then(make, monkeypatch):
    asked = []
    monkeypatch.setattr(like_for_like, "is_busy", lambda: not asked.append(1))
    scene = make.scene(make.camera(32, 24), make.quad(-1, 1, -1, 1, -3))
    show = shows.SHOWS["DIFFERENCE"]
    kept = SimpleNamespace(scene=lambda camera: scene)
    live, engine = view.LiveView(), SimpleNamespace(tag_redraw=lambda: None)
    live._job = view.Job(view.Wanted(scene.camera, 0, Settings(), show, 0), kept, 1)
    while not asked:
        live.tick(engine)
    before = len(asked)
    assert [live.tick(engine) for _ in range(5)] == [view.PAUSE] * 5
    assert len(asked) <= before + 5
