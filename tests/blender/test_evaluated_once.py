"""A comparison costs one evaluation of the modifiers, counted as Blender itself reports it."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import bpy
import numpy as np
import pytest
from reference_tracer.blender import slowest
from reference_tracer.blender.jobs.animation import compare_frames
from reference_tracer.blender.jobs.variants import variants
from reference_tracer.blender.reading import opened
from reference_tracer.pictures.palette import By
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import Progress

from ..evaluations import DONE, counted
from .scenes import save


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
@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_all_pictures_come_of_one_evaluation(judge, colors, heavy, compare):
    with counted() as found:
        comparison = compare(judge=judge, colors=colors)
    assert comparison.verdict == "agree"
    assert comparison.identity.shows().not_known == 0
    assert found == [1]


def test_a_file_is_not_evaluated_as_it_is_opened(heavy, compare, tmp_path):
    """Not in another scene, in which Blender would not leave objects in Edit Mode."""
    path = tmp_path / "heavy.blend"
    other = heavy.view_layers.new("Other").name
    bpy.context.window.view_layer = heavy.view_layers[other]
    save(path)
    with counted() as found:
        opened.open_file(path)
        assert bpy.context.view_layer.name == other
        assert list(bpy.data.scenes) == [bpy.context.scene]
        compare(judge="WORKBENCH")
    assert found == [1]
    bpy.context.view_layer.objects.active = bpy.data.objects["Heavy"]
    bpy.ops.object.mode_set(mode="EDIT")
    save(path)
    opened.open_file(path)
    assert bpy.data.objects["Heavy"].mode == "EDIT"


def test_a_diagnosis_is_the_same_of_a_file_that_is_not_evaluated(heavy, tmp_path):
    above = bpy.data.objects.new("Above", None)
    bpy.context.collection.objects.link(above)
    above.location = 0.3, 0.2, 0.1
    above.scale = 1.0, 1.5, 2.0
    bpy.data.objects["Light"].parent = above
    heavy.camera.parent = above
    path = tmp_path / "heavy.blend"
    save(path)

    def matrices():
        made = variants(bpy.context.scene.name_full, bpy.context.view_layer.name, None)
        assert len({v.fault for v in made}) > 5
        placed = [[i.world_from_object for i in v.scene.instances] for v in made]
        return [[v.scene.camera.world_from_camera, *m] for v, m in zip(made, placed, strict=True)]

    opened.open_file(path)
    unevaluated = matrices()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    np.testing.assert_equal(unevaluated, matrices())


def test_what_takes_long_is_known_before(heavy, monkeypatch):
    layer = bpy.context.view_layer
    monkeypatch.setattr(slowest, "LONG", 60.0)  # a slow machine's
    assert slowest.slowest(layer) == ""
    monkeypatch.setattr(slowest, "LONG", 0.01)  # a fast machine's
    bpy.data.objects["Heavy"].modifiers["Subdivision"].levels = 5
    layer.update()
    with counted() as found:
        assert slowest.slowest(layer) == "Heavy"
    assert found == [0]
    for _ in range(7):  # on a busy machine one of three may well take half of the time
        bpy.context.collection.objects.link(bpy.data.objects["Heavy"].copy())
        layer.update()
    assert slowest.slowest(layer) == ""  # none of the eight is the one


def test_what_takes_long_is_said_before_each_frame(heavy, monkeypatch, tmp_path):
    """By its name from when Blender has evaluated it once on."""
    heavy.frame_end = 2
    wave = bpy.data.objects["Heavy"].modifiers["Subdivision"]
    wave.levels = 5
    wave.keyframe_insert("show_on_cage", frame=1)  # so that each frame evaluates it anew
    monkeypatch.setattr(slowest, "LONG", 0.01)
    events = compare_frames(tmp_path, range(1, 3))
    said = [e.words for e in events if isinstance(e, Progress) and "Blender" in e.words]
    assert said[1:] == [
        "frame 1: Blender evaluates 'Heavy'",
        *2 * ["frame 2: Blender evaluates 'Heavy'"],
    ]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_is_heard_once_blender_lets_go(number, heavy, tmp_path):
    """It is sent while the first of two pictures is evaluated: nothing is evaluated any more."""
    subdivision = bpy.data.objects["Heavy"].modifiers["Subdivision"]
    subdivision.render_levels = 7
    save(tmp_path / "heavy.blend")
    code = (
        "import bpy, sys\n"
        "from reference_tracer.cli.main import main\n"
        "@bpy.app.handlers.persistent\n"
        "def begins(scene, *_):\n"
        "    if scene.objects:\n"
        "        print('evaluating', file=sys.stderr)\n"
        "bpy.app.handlers.frame_change_pre.append(begins)\n"
        "bpy.app.debug_depsgraph_eval = True\n"
        "sys.exit(main())\n"
    )
    out = tmp_path / "new" / "out"
    argv = ["compare", tmp_path / "heavy.blend", "--self-check", "--out", out]
    command = [sys.executable, "-c", code, *argv]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    lines = []
    for line in process.stderr:
        lines.append(line)
        if line.startswith("evaluating"):
            time.sleep(0.3)
            process.send_signal(number)
    assert process.wait() == 128 + number
    said = "".join(lines)
    assert said.count(DONE) <= 1, said  # not interrupted: 2
    assert "Traceback" not in said and "KeyboardInterrupt" not in said, said
    assert not (tmp_path / "new").exists()


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


def test_no_picture_is_written_over_the_users(build, compare, tmp_path):
    """Blender goes on with a render whose scene is refused."""
    scene = build.scene(color_type="RANDOM")
    square = build.square()
    build.instances_on_points(square, build.cube("Small", 0.2))
    build.corner_camera(lens=40)
    scene.render.filepath = str(tmp_path / "own_")
    with pytest.raises(SceneError, match="random colours of instances"):
        compare(judge="CYCLES", colors=By.VIEWPORT)
    assert not list(tmp_path.iterdir())
