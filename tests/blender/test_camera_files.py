"""A .blend's camera in every convention: the command around it, and the button.

That each formula has points where the tracer's rays pass is held by
`tests/camera_files/test_conventions.py`; that these pass where Blender's matrix has them, by
`test_camera.py` and by the certificate of each file.
"""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.cameras import cameras
from reference_tracer.blender.jobs.choice import chosen
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.blender.ui.scene_operators import REFERENCE_TRACER_OT_export_camera
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import WRITTEN, read
from reference_tracer.camera_files.files import chosen as named
from reference_tracer.framing import Choice
from reference_tracer.scene import Region, SceneError
from reference_tracer.tracer.camera import film_of

from .scenes import save

BLENDERS = 1e-3  # pixels: Blender's matrix is float32


@pytest.fixture
def scene(build, tmp_path):
    """A saved scene with a camera that moves, and has a shift and oblong pixels."""
    scene = build.scene(96, 54)
    build.solids()
    camera = build.corner_camera(lens=40)
    camera.data.shift_x, scene.render.pixel_aspect_y = 0.2, 1.5
    camera.keyframe_insert("location", frame=1)
    camera.location.x += 2
    camera.keyframe_insert("location", frame=5)
    scene.frame_end = 5
    scene.frame_set(1)
    path = tmp_path / "scene.blend"
    save(path)
    return path


def test_the_file_says_what_it_means_and_is_certified(scene, tmp_path, reftrace):
    done = reftrace("camera", scene, "--out", tmp_path / "new" / "camera.json")
    assert done.returncode == 0, done.stderr
    assert "from where Blender's own matrix has them" in done.stdout
    file = json.loads((tmp_path / "new" / "camera.json").read_text(encoding="utf-8"))
    assert (file["width"], file["height"], file["pixel_centers"]) == (96, 54, "half")
    assert file["certificate"]["passed"] and file["certificate"]["largest"] < BLENDERS
    assert file["certificate"]["points"] > 1000
    assert (file["frame"], file["name"]) == (1, "0001.png")
    done = reftrace("camera", scene, "--check", tmp_path / "new" / "camera.json")
    assert done.returncode == 0 and "agree" in done.stdout
    done = reftrace(
        "camera", scene, "--set", "frame=3", "--check", tmp_path / "new" / "camera.json"
    )
    assert "it is the camera of frame 1, and the scene is at 3" in done.stdout


def test_a_frame_that_blender_has_not_is_refused(scene, tmp_path, reftrace):
    out = tmp_path / "transforms.json"
    done = reftrace("camera", scene, "--out", out, "--convention", "nerf", "--frames", "1-2")
    assert done.returncode == 0, done.stderr
    text = out.read_text(encoding="utf-8").replace("0001.png", "20240101123456.png")
    out.write_text(text, encoding="utf-8")
    done = reftrace("camera", scene, "--check", out)
    assert done.returncode == 4 and "Blender has no frame 20240101123456" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("name", WRITTEN)
def test_frames_are_written_and_checked(name, scene, tmp_path, reftrace):
    out = tmp_path / name
    if WRITTEN[name].lacks(next(cameras()).view.camera):
        done = reftrace("camera", scene, "--out", out, "--convention", name)
        assert done.returncode == 4 and "cannot say" in done.stderr and not out.exists()
        return
    done = reftrace("camera", scene, "--out", out, "--convention", name, "--frames", "1-5:2")
    assert done.returncode == 0, done.stderr
    assert "3 cameras" in done.stdout
    done = reftrace("camera", scene, "--check", out)
    assert done.returncode == 0, done.stdout
    assert ": 3 cameras agree: " in done.stdout


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "name one"),
        (["--out", "a.json", "--check", "b.json"], "name one"),
        (["--out", "a.json", "--view", "3"], "--view is for --check"),
        (["--check", "a.json", "--centers", "half"], "--centers is for --out"),
        (["--out", "a.json", "--frames", "5-1"], "ends before it begins"),
        (["--out", "a.json", "--frames", "1-5", "--set", "frame=3"], "not for --frames"),
        (["--check", "missing.json"], "missing.json"),
    ],
)
def test_what_contradicts_itself_is_refused(options, said, scene, reftrace):
    done = reftrace("camera", scene, *options)
    assert done.returncode == 4 and said in done.stderr


def seen_by(view):
    """The camera, and its certificate, that an export has with a file's camera chosen."""
    with chosen(Choice(seen_by=view)):
        return gather_case(bpy.context)


def test_a_file_without_a_clip_range_leaves_the_scenes(scene):
    bpy.context.scene.camera.data.clip_start = 0.25
    own = next(cameras()).view.camera
    found = seen_by(View(own, "a", is_clipped=False)).scene.camera
    assert (found.clip_start, found.clip_end) == (0.25, own.clip_end)
    found = seen_by(View(replace(own, clip_start=0.5), "a")).scene.camera
    assert found.clip_start == 0.5


def test_a_camera_that_blender_cannot_have_is_refused(scene):
    own = next(cameras()).view.camera
    sheared = own.world_from_camera.copy()
    sheared[:3, 0] = (sheared[:3, 0] + 0.3 * sheared[:3, 1]) / np.hypot(1, 0.3)
    with pytest.raises(SceneError, match="Blender has no camera like 'a' of 96 x 54 pixels"):
        seen_by(View(replace(own, world_from_camera=sheared, name="a"), "a"))
    tiny = replace(own, width=2, height=1, region=Region(0, 0, 2, 1))
    with pytest.raises(SceneError, match=r"2 x 1 pixels: .* pictures of 4 to 65536 pixels"):
        seen_by(View(tiny, "a"))


def test_a_command_takes_the_file(scene, tmp_path, reftrace):
    """A camera is written at one frame, and the file at another is seen through it."""
    path = tmp_path / "there.json"
    assert reftrace("camera", scene, "--set", "frame=5", "--out", path).returncode == 0
    again = tmp_path / "again.json"
    assert reftrace("camera", scene, "--camera", path, "--out", again).returncode == 0
    done = reftrace("camera", scene, "--set", "frame=5", "--check", again)
    assert done.returncode == 0, done.stdout
    assert reftrace("camera", scene, "--set", "frame=1", "--check", again).returncode == 2


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_the_camera_that_blender_writes_into_a_glb_is_its_own(kind, build, tmp_path):
    """An independent writer of glTF cameras; it writes float32."""
    build.scene(160, 90)
    camera = build.camera((1, -4, 2), (1.1, 0.2, 0.3), type=kind, ortho_scale=5.0, lens=35)
    path = tmp_path / "scene.glb"
    bpy.ops.export_scene.gltf(filepath=str(path), export_cameras=True)
    (own,) = cameras()
    view = named(read(path, size=(160, None)), camera.name)
    x, y, _ = film_of(view.camera, own.points)
    assert np.abs(np.stack((x, y)) - own.film).max() < 10 * BLENDERS
    assert view.camera.clip_end == pytest.approx(own.view.camera.clip_end)


@pytest.mark.parametrize(("name", "written"), [("opencv", "a.json"), ("colmap", "a")])
def test_the_button_writes_what_the_command_does(name, written, scene, tmp_path, reftrace):
    ours, theirs = tmp_path / "ours" / written, tmp_path / "theirs" / written
    button = bpy.ops.reference_tracer.export_camera
    assert button(filepath=str(ours), convention=name, animation=True) == {"FINISHED"}
    done = reftrace("camera", scene, "--frames", "all", "--convention", name, "--out", theirs)
    assert done.returncode == 0
    for file in sorted(ours.iterdir()) if ours.is_dir() else [ours]:
        other = theirs / file.name if ours.is_dir() else theirs
        assert file.read_bytes() == other.read_bytes()
    assert bpy.context.scene.frame_current == 1


@pytest.mark.parametrize(
    ("convention", "typed", "file"),
    [("gltf", "a.json", "a.gltf"), ("colmap", "a.xml", "a"), ("nerf", "a.v2", "a.v2")],
)
def test_the_file_takes_the_ending_of_its_convention(convention, typed, file, tmp_path):
    """A folder has none; what is no convention's ending is part of the name."""
    button = SimpleNamespace(convention=convention, filepath=str(tmp_path / typed))
    is_other = REFERENCE_TRACER_OT_export_camera.check(button, None)
    assert (button.filepath, is_other) == (str(tmp_path / file), typed != file)


def test_the_button_says_what_cannot_be_said(scene, tmp_path):
    with pytest.raises(RuntimeError, match=r"a lens shift and a pixel aspect .* glTF cannot say"):
        bpy.ops.reference_tracer.export_camera(filepath=str(tmp_path / "a.gltf"), convention="gltf")
    assert not (tmp_path / "a.gltf").exists()
