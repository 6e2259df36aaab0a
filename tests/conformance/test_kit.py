"""The kit: its files hold the same scenes, whoever reads them."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference_tracer.camera_files.files import read
from reference_tracer.camera_files.frame import Y_UP_FROM_Z_UP
from reference_tracer.files.scenes import load_scene
from reference_tracer.projections import PERSPECTIVE
from reference_tracer.rendering import render
from reference_tracer.tracer.camera import camera_rays
from reference_tracer_conformance.kit import CAMERA_Y_UP, opencv, write_kit
from reference_tracer_conformance.scenes import PALETTE, kit_scenes
from reference_tracer_meshes.load import load_meshes, scene_of_meshes

SCENES = kit_scenes()
# Whose camera glTF cannot say; of a parallel one the shift is in its place.
SILENT = {f"camera-{n}" for n in ("shift-x", "shift-y", "shift-portrait", "tall-pixels")}


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    folder = tmp_path_factory.mktemp("kit")
    write_kit(folder, SCENES, blends=False)
    return folder


def owners(scene):
    names = np.array([*scene.objects, ""])
    return names[render(scene).object_index]


def test_no_colour_is_the_same_without_srgbs_curve():
    """Else a picture that lacks the curve would agree."""
    assert not any(np.isin(color, (0, 1)).all() for color in PALETTE)


def test_there_are_forty_small_ones(kit):
    assert len(SCENES) == len({k.name for k in SCENES}) == 40
    assert all(k.sentence.endswith(".") for k in SCENES)
    assert sum(path.stat().st_size for path in kit.rglob("*.*")) < 1e6
    assert set(json.loads((kit / "kit.json").read_text("utf-8"))) == {k.name for k in SCENES}


def test_every_format_holds_every_scene(kit):
    for k in SCENES:
        wanted = owners(k.scene)
        assert 0.02 < (wanted != "").mean(), k.name
        assert (owners(load_scene(kit / k.name / "scene.npz")) == wanted).all(), k.name
        for name in ("scene.glb", "scene.obj"):
            size = k.camera.width, k.camera.height
            scene = scene_of_meshes(load_meshes(kit / k.name / name), k.camera, *size)
            assert (owners(scene) == wanted).all(), (k.name, name)


@pytest.mark.parametrize("y_up", [False, True])
def test_the_cameras_formula_gives_back_the_pixels_of_the_rays(y_up):
    """OpenCV's own formula, of points on the tracer's rays: pixel centres at 0.5, row 0 on top."""
    turn = Y_UP_FROM_Z_UP[:3, :3] if y_up else np.eye(3)
    for k in SCENES:
        camera, said = k.camera, opencv(k.camera, y_up)
        K, R, t = (np.array(said[key]) for key in "KRt")  # noqa: N806
        x, y = np.array([0, 3, camera.width - 1]), np.array([0, 7, camera.height - 1])
        rays = camera_rays(camera, x + 0.5, y + 0.5)
        points = turn @ (rays.origins + 3.0 * rays.directions)
        seen = R @ points + t[:, None]
        assert np.allclose(seen[2], 3.0)
        if camera.projection == PERSPECTIVE:
            seen = seen / seen[2]
        else:
            seen[2] = 1
        u, v, _ = K @ seen
        assert np.allclose(u, x + 0.5, atol=1e-8), k.name
        assert np.allclose(v, camera.height - (y + 0.5), atol=1e-8), k.name


def test_its_cameras_are_read_as_they_are_meant(kit):
    """Parallel ones too, and of a world with Y up: by `--camera FILE`."""
    for k in SCENES:
        own = k.camera
        for name in ("camera.json", CAMERA_Y_UP, "scene.glb"):
            if name == "scene.glb" and k.name in SILENT:
                continue
            (view,) = read(kit / k.name / name)
            found = view.camera
            assert found.projection is own.projection, (k.name, name)
            assert (found.width, found.height) == (own.width, own.height), (k.name, name)
            ends = found.clip_start, found.clip_end
            assert np.allclose(ends, (own.clip_start, own.clip_end)), (k.name, name)
            rays = [camera_rays(c, np.array([0.5, 30]), np.array([2.5, 40])) for c in (own, found)]
            for part in ("origins", "directions"):
                first, second = (getattr(r, part) for r in rays)
                assert np.allclose(first, second, atol=1e-9), (k.name, name)


def test_gltf_says_only_cameras_that_it_can(kit):
    """What is shifted, or has pixels that are not square, is left to the JSON."""
    files = {k.name: json.loads(glb_json(kit / k.name / "scene.glb")) for k in SCENES}
    silent = {name for name, held in files.items() if not held.get("cameras")}
    assert silent == SILENT


def glb_json(path):
    """The first chunk of a .glb."""
    held = path.read_bytes()
    return held[20 : 20 + int.from_bytes(held[12:16], "little")]
