"""A .blend's camera in every convention, against Blender's own matrix, and the command around it.

The judge is `Object.calc_matrix_camera`, float32, read by each convention's published formula as
`tests/camera_files/formulas.py` has it.
"""

from __future__ import annotations

import json
from itertools import islice

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.cameras import cameras
from reference_tracer.camera_files.files import CONVENTIONS, texts

from ..camera_files.formulas import FORMULAS
from .test_camera import (
    film_of_blender,
    mirrored,
    parented,
    plain,
    scaled,
    settings_matrix,  # noqa: F401  # a fixture
    sheared,
)

BLENDERS = 1e-3  # pixels: Blender's matrix is float32
EVERY = 13  # of the combinations one is tried: no number of settings is a multiple of it


@pytest.mark.parametrize("place", [plain, parented, scaled, mirrored, sheared])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_each_formula_agrees_with_blenders_matrix(kind, place, settings_matrix):  # noqa: F811
    written = dict.fromkeys(CONVENTIONS, 0)
    for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
        for obj in islice(settings_matrix(kind, fit, place), 0, None, EVERY):
            (own,) = cameras()
            camera, render = own.view.camera, bpy.context.scene.render
            size = tuple(
                n * render.resolution_percentage // 100
                for n in (render.resolution_x, render.resolution_y)
            )
            x, y = film_of_blender(obj, *size, own.points)
            if render.use_border and render.use_crop_to_border:
                left, low = (
                    int(np.float32(share) * np.float32(n))
                    for share, n in zip(
                        (render.border_min_x, render.border_min_y), size, strict=True
                    )
                )
                high = int(np.float32(render.border_max_y) * np.float32(size[1]))
                assert camera.height == high - low < size[1]
                x, y = x - left, y - low
            expected = np.stack((x, camera.height - y))
            for name, convention in CONVENTIONS.items():
                if convention.lacks(camera):
                    continue
                found = FORMULAS[name](texts([own.view], convention), own.points)
                assert np.abs(found - expected).max() < BLENDERS, name
                written[name] += 1
    assert written["opengl"] == 3 * -(-216 // EVERY)
    lacking = {name for name, count in written.items() if not count}
    assert ("opencv" in lacking) == (kind == "ORTHO" or place is sheared)


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
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
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


@pytest.mark.parametrize("name", CONVENTIONS)
def test_frames_are_written_and_checked(name, scene, tmp_path, reftrace):
    out = tmp_path / name
    if CONVENTIONS[name].lacks(next(cameras()).view.camera):
        done = reftrace("camera", scene, "--out", out, "--convention", name)
        assert done.returncode == 4 and "cannot say" in done.stderr and not out.exists()
        return
    done = reftrace("camera", scene, "--out", out, "--convention", name, "--frames", "1-5:2")
    assert done.returncode == 0, done.stderr
    assert "3 cameras" in done.stdout
    done = reftrace("camera", scene, "--check", out)
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("agree") == 3
    one = reftrace("camera", scene, "--check", out, "--view", "3", "--frame", "3")
    assert one.returncode == 0 and one.stdout.count("agree") == 1
    other = reftrace("camera", scene, "--check", out, "--view", "3", "--frame", "5")
    assert other.returncode == 2 and "the camera is moved by" in other.stdout


def test_a_file_that_is_off_is_told_how_far_and_why(scene, tmp_path, reftrace):
    """The shift left out, as one public exporter of transforms.json has it."""
    out = tmp_path / "transforms.json"
    reftrace("camera", scene, "--out", out, "--convention", "nerf")
    file = json.loads(out.read_text(encoding="utf-8"))
    file["cx"], file["cy"] = file["w"] / 2, file["h"] / 2
    out.write_text(json.dumps(file), encoding="utf-8")
    done = reftrace("camera", scene, "--check", out)
    assert done.returncode == 2
    assert f"up to {0.2 * 96:.4g} px" in done.stdout
    assert "the camera's shift is left out" in done.stdout and "add shift X and Y" in done.stdout


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "name one"),
        (["--out", "a.json", "--check", "b.json"], "name one"),
        (["--out", "a.json", "--view", "3"], "--view is for --check"),
        (["--check", "a.json", "--centers", "half"], "--centers is for --out"),
        (["--out", "a.json", "--frames", "5-1"], "ends before it begins"),
        (["--out", "a.json", "--frames", "1-5", "--frame", "3"], "not for --frames"),
        (["--check", "missing.json"], "missing.json"),
    ],
)
def test_what_contradicts_itself_is_refused(options, said, scene, reftrace):
    done = reftrace("camera", scene, *options)
    assert done.returncode == 4 and said in done.stderr
