"""A comparison costs one evaluation of the modifiers, counted as Blender itself reports it."""

from __future__ import annotations

import ctypes
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import pytest
from reference_tracer.pictures.palette import By

DONE = "BKE_object_handle_data_update on OBHeavy"  # once for each evaluation of its modifiers


@contextmanager
def counted() -> Iterator[list[int]]:
    """Give a list that has, in the end, how often the modifiers of 'Heavy' were evaluated."""
    found: list[int] = []
    flush = ctypes.CDLL(None).fflush
    flush(None)
    stdout = os.dup(1)
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        bpy.app.debug_depsgraph_eval = True
        try:
            yield found
        finally:
            bpy.app.debug_depsgraph_eval = False
            flush(None)
            os.dup2(stdout, 1)
            os.close(stdout)
        file.seek(0)
        found.append(file.read().decode(errors="replace").count(DONE))


@pytest.fixture
def heavy(build):
    scene = build.scene()
    obj = build.cube("Heavy", 1.5)
    obj.modifiers.new("Subdivision", "SUBSURF").render_levels = 3
    obj.modifiers.new("Wireframe", "WIREFRAME")
    build.cube("Light", 0.5, location=(2, 0, 0))
    build.corner_camera(lens=40)
    bpy.context.view_layer.update()
    return scene


@pytest.mark.parametrize("colors", [By.AUTOMATIC, By.VIEWPORT, By.OBJECT])
def test_all_pictures_come_of_one_evaluation(colors, heavy, compare):
    with counted() as found:
        comparison = compare(judge="WORKBENCH", colors=colors)
    assert comparison.verdict == "agree"
    assert comparison.identity.shows().not_known == 0
    assert found == [1]


def test_each_picture_of_a_ray_tracer_is_one_evaluation(heavy, compare):
    with counted() as found:
        assert compare(judge="CYCLES").verdict == "agree"
    assert found == [2]


def test_a_frame_is_the_scenes_own(heavy, compare):
    """Also between two frames, and before the first that a range may have."""
    obj = bpy.data.objects["Light"]
    for frame, x in ((-20, 2.0), (20, 2.4)):
        obj.location.x = x
        obj.keyframe_insert("location", frame=frame)
    for frame, subframe in ((-5, 0.0), (7, 0.5), (0, 0.0)):
        heavy.frame_set(frame, subframe=subframe)
        found = compare(judge="WORKBENCH")
        assert found.counts.unexplained == 0
        light = found.scene.objects.index("Light")
        (own,) = (i for i in found.scene.instances if i.object == light)
        assert abs(own.world_from_object[0, 3] - obj.matrix_world[0][3]) < 1e-6
        assert (heavy.frame_current, heavy.frame_subframe) == (frame, subframe)
