"""What is chosen of an open file: its scene, view layer, frame and camera, or one that is made."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.choice import chosen
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.cli import in_blender
from reference_tracer.comparison.comparing import compared
from reference_tracer.framing import FILLED, Choice, shown_points
from reference_tracer.scene import SceneError
from reference_tracer.tracer.camera import film_of
from reference_tracer.tracer.progress import result_of

from . import hard_cases as hard
from .scenes import save
from .test_unchanged import snapshot


@pytest.fixture
def solids(build, tmp_path):
    """An open file with a small scene and no camera; something in it is hidden, far away."""
    scene = build.scene(64, 36)
    build.solids()
    hidden = build.cube("Hidden", location=(500, 0, 0))
    hidden.hide_render = True
    save(tmp_path / "scene.blend")
    return scene


def compare(**choice):
    with chosen(Choice(**choice)):
        return result_of(compared(gather_case(bpy.context)))


def span(scene):
    """The width and height of what is exported, in shares of the picture."""
    points = np.concatenate(list(shown_points(scene.meshes, scene.instances)))
    x, y, depth = film_of(scene.camera, points.T)
    assert (depth > scene.camera.clip_start).all() and (depth < scene.camera.clip_end).all()
    return np.ptp(x) / scene.camera.width, np.ptp(y) / scene.camera.height


@pytest.mark.parametrize("aspect", [1.0, 1.5])
def test_all_is_framed_and_agrees_with_blender(aspect, solids, build):
    solids.render.pixel_aspect_y = aspect
    build.instances(
        "Empty", build.collection("Kit", build.cube("Child", 0.3, link=False)), location=(0, 0, 5)
    )
    found = compare(frame_all=True, width=96)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    camera = found.scene.camera
    assert (camera.width, camera.height, camera.name) == (96, 54, "framing")
    assert "Child" in found.scene.objects and "Hidden" not in found.scene.objects
    assert max(span(found.scene)) == pytest.approx(FILLED, abs=1e-4)


@pytest.mark.parametrize("kind", [{}, {"angle": 20.0}, {"ortho_scale": 5.0}], ids=str)
def test_a_placed_camera_agrees_with_blender(kind, solids):
    """Held to Blender's own projection by the certificate, and to its picture."""
    found = compare(eye=(3, -4, 3), target=(0, 0, -0.2), **kind)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert found.case.certificate.points > 1000 and found.manifest.camera == "eye"
    camera = found.scene.camera
    assert camera.origin == pytest.approx((3, -4, 3))
    half = kind.get("ortho_scale", 2 * np.tan(np.radians(kind.get("angle", 50) / 2))) / 2
    assert camera.window.top == pytest.approx(half)
    assert camera.projection.shares_direction == ("ortho_scale" in kind)


@pytest.fixture
def two(solids, build):
    """Another scene beside it, with two layers, cameras of which one is hidden, and a movement."""
    scene = bpy.data.scenes.new("Other")
    scene.render.resolution_x, scene.render.resolution_y = 48, 32
    cube, ball = build.cube("Moving", link=False), build.cube("Resting", 1, link=False)
    for obj in (cube, ball):
        layer = bpy.data.collections.new(obj.name)
        layer.objects.link(obj)
        scene.collection.children.link(layer)
    cube.keyframe_insert("location", frame=1)
    cube.location.x = 10
    cube.keyframe_insert("location", frame=11)
    second = scene.view_layers.new("Second")
    second.layer_collection.children["Resting"].exclude = True
    for name, x in (("Near", 0.0), ("Hidden Camera", 1.0)):
        obj = bpy.data.objects.new(name, bpy.data.cameras.new(name))
        obj.location = x, 0, 30
        scene.collection.objects.link(obj)
    obj.hide_render = obj.hide_viewport = True
    scene.camera = scene.objects["Near"]
    bpy.ops.wm.save_mainfile()
    return scene


def test_scene_layer_frame_and_camera_are_those_that_are_named(two, tmp_path, capsys):
    """By the command, in what it writes, and in the picture."""
    options = ["--set", "scene=Other", "view-layer=Second", "frame=6"]
    options += ["--camera", "Hidden Camera", "--set", "height=64"]
    out = tmp_path / "out"
    assert in_blender.run(["compare", "--out", str(out), *options]) == 0, capsys.readouterr().err
    found = json.loads((out / "comparison.json").read_text(encoding="utf-8"))
    said = {k: found["scene"][k] for k in ("scene", "view_layer", "frame", "camera")}
    assert list(said.values()) == ["Other", "Second", 6, "Hidden Camera"]
    assert "camera 'Hidden Camera'" in capsys.readouterr().out
    assert [o["name"] for o in found["scene"]["objects"] if o["exported"]] == ["Moving"]
    choice = Choice("Other", "Second", 6, "Hidden Camera", height=64)
    with chosen(choice):
        scene, _, _ = export_open_file(bpy.context)
    assert (scene.camera.width, scene.camera.height) == (96, 64)
    assert scene.camera.origin == pytest.approx((1, 0, 30))
    assert scene.instances[0].world_from_object[0, 3] == pytest.approx(5)


def test_a_marker_does_not_take_the_camera_away(two):
    """Blender makes a marker's camera the active one as it renders."""
    two.timeline_markers.new("Cut", frame=1).camera = two.objects["Near"]
    found = compare(scene_name="Other", camera="Hidden Camera")
    assert found.manifest.camera == "Hidden Camera" and found.verdict == "agree"
    two.timeline_markers.new("Cut", frame=5).camera = two.objects["Near"]
    with chosen(Choice("Other", frame=6)):
        _, manifest, _ = export_open_file(bpy.context)
    assert manifest.camera == "Near"


@pytest.mark.parametrize("of_window", [True, False])
@pytest.mark.parametrize(
    "make",
    [hard.particles, hard.simulation_zone, hard.soft_body],
    ids=lambda m: m.__name__,
)
def test_a_simulation_is_stepped_through(make, of_window, build, monkeypatch):
    """Its frame is the one that comes after all those before; a new camera does not reset it."""
    make(build)
    frame = bpy.context.scene.frame_current
    expected = places(Choice(frame_all=True))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    monkeypatch.setattr(hard.simulated, "step_to", lambda frame: None)
    make(build)
    assert places(Choice(frame_all=True)) != expected
    if not of_window:
        bpy.context.window.scene = bpy.data.scenes.new("Other")
    assert places(Choice("Scene", frame=frame, frame_all=True)) == expected


def test_rigid_bodies_are_baked_up_to_the_frame(build):
    hard.rigid_body(build)
    layer = bpy.context.view_layer
    fallen = layer.objects["Body 0"].matrix_world.copy()
    bpy.context.scene.frame_set(1)
    with chosen(Choice(frame=16)):
        scene, manifest, _ = export_open_file(bpy.context)
    own = scene.instances[manifest.owners.index("Body 0")].world_from_object
    np.testing.assert_array_equal(own, fallen)
    assert not manifest.unmodelled


def places(choice):
    """All corners that are exported, and how the camera sees them."""
    with chosen(choice):
        scene, _, _ = export_open_file(bpy.context)
    points = list(shown_points(scene.meshes, scene.instances))
    return np.concatenate(points).tolist(), scene.camera.world_from_camera.tolist()


@pytest.mark.parametrize(
    ("choice", "words"),
    [
        ({"scene_name": "X"}, "there is no scene 'X'; there is 'Other', 'Scene"),
        (
            {"scene_name": "Other", "view_layer": "X"},
            "no view layer 'X'; there is 'ViewLayer', 'Second",
        ),
        ({"camera": "Moving"}, "there is no camera 'Moving'; there is 'Hidden Camera', 'Near"),
        ({"width": 3}, "3 x 2 pixels"),
    ],
    ids=str,
)
def test_what_is_not_there_is_said_with_what_is(choice, words, two):
    with pytest.raises(SceneError, match=words), chosen(Choice(**choice)):
        pass


def test_the_files_own_camera_comes_before_a_librarys(solids, tmp_path):
    own = bpy.data.objects.new("Eye", bpy.data.cameras.new("Eye"))
    bpy.context.scene.collection.objects.link(own)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"), copy=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, to):
        to.objects = ["Eye"]
    bpy.context.scene.collection.objects.link(to.objects[0])
    with chosen(Choice(camera="Eye")):
        assert bpy.context.scene.camera == own


def test_without_a_camera_the_command_says_how_to_get_one(solids, tmp_path, capsys):
    out = str(tmp_path / "out")
    compare, explain = ["compare", "--out", out], ["explain", "--pixel", "3", "3"]
    trade = ["trade", "--out", out, "--set", "width=8", "--samples", "1"]
    for command in (compare, explain, trade):
        assert in_blender.run(command) == 4
        said = capsys.readouterr().err
        assert all(option in said for option in ("eye=all", "eye=X,Y,Z", "--camera NAME"))
    for command in (compare, explain):
        assert in_blender.run([*command, "--set", "eye=all"]) == 0


@pytest.mark.parametrize(
    ("width", "height", "words"),
    [(65536, 4, "workbench draws no picture"), (32767, 32767, "choose a smaller size")],
)
def test_a_picture_that_blender_cannot_draw(width, height, words, solids, tmp_path, capsys):
    """One line says it; memory is asked for before Blender takes minutes to fail."""
    size = ["--set", f"width={width}", f"height={height}", "eye=all"]
    assert in_blender.run(["compare", "--out", str(tmp_path / "out"), *size]) == 4
    said = capsys.readouterr().err
    assert words in said.splitlines()[-1] and "Traceback" not in said


def test_the_button_frames_all_and_the_others_say_what_is_missing(solids):
    buttons = [getattr(bpy.ops.reference_tracer, n) for n in ("compare", "compare_all", "trade")]
    for button in buttons:
        with pytest.raises(RuntimeError, match="has no camera: add one"):
            button()
    assert not bpy.ops.reference_tracer.inspect.poll()
    assert bpy.ops.reference_tracer.extremes.poll()  # which has cameras of its own
    render = solids.render
    render.resolution_percentage, render.pixel_aspect_x, render.pixel_aspect_y = 50, 2, 3
    before = snapshot(render)
    assert bpy.ops.reference_tracer.frame_all() == {"FINISHED"}
    assert snapshot(render) == before
    assert solids.camera.name == "Camera" and solids.camera.name in solids.collection.objects
    assert len(bpy.data.cameras) == len(bpy.data.scenes) == 1
    assert max(span(export_open_file(bpy.context)[0])) == pytest.approx(FILLED, abs=1e-4)
    assert all(button.poll() for button in buttons)


def test_the_button_says_that_there_is_nothing_to_frame(build):
    with pytest.raises(RuntimeError, match="nothing to frame"):
        bpy.ops.reference_tracer.frame_all()
    assert not bpy.data.cameras
