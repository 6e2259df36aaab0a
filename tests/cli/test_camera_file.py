"""`--camera FILE`: a mesh seen by the camera of another program's file, or of its own .glb."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import WRITTEN, texts
from reference_tracer.cli.camera_options import choice_from
from reference_tracer.cli.main import parser
from reference_tracer.cli.opening import open_file
from reference_tracer.files.scenes import save_scene
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import film_of

from ..camera_files.cameras import camera
from ..camera_files.test_conventions import on_disk, rays_of


def seen(mesh, *words):
    """The scene's camera that a command line chooses."""
    argv = ["trace", str(mesh), "--out", "out.png", *map(str, words)]
    given = parser(argv).parse_args(argv)
    return open_file(given.scene, choice_from(given, given.scene)).scene.camera


def apart(first, second):
    film, points = rays_of(first, np.random.default_rng(2))
    x, y, _ = film_of(second, points)
    return np.abs(np.stack((x, second.height - y)) - film).max()


@pytest.fixture
def own():
    return camera(np.random.default_rng(12))


def written(own, name, folder, count=1):
    views = [View(own, f"{n:04d}.png", n) for n in range(1, 1 + count)]
    return on_disk(texts(views, WRITTEN[name]), folder)


@pytest.mark.parametrize("name", WRITTEN)
def test_a_mesh_is_seen_as_the_file_says(name, own, ball, tmp_path):
    path = written(own, name, tmp_path / "written")
    path = path if path.is_dir() else path.rename(path.with_suffix(Path(WRITTEN[name].file).suffix))
    # MVSNet's files say no size.
    size = ["--set", f"width={own.width}", f"height={own.height}"] if name == "mvsnet" else []
    found = seen(ball, "--camera", path, *size)
    assert (found.width, found.height) == (own.width, own.height) and apart(own, found) < 1e-9
    assert (
        apart(own, seen(ball, "--camera", path, "--set", f"camera-convention={name}", *size)) < 1e-9
    )


def test_a_size_is_the_files_or_asked_for(own, ball, tmp_path):
    path = written(own, "nerf", tmp_path / "written").rename(tmp_path / "transforms.json")
    assert apart(own, seen(ball, "--camera", path, "--set", f"width={640}")) < 1e-9
    with pytest.raises(SceneError, match=r"for files that say no size: .* has 640 x 360"):
        seen(ball, "--camera", path, "--set", f"width={320}")
    file = json.loads(path.read_text(encoding="utf-8"))
    del file["w"], file["h"]
    path.write_text(json.dumps(file), encoding="utf-8")
    with pytest.raises(SceneError, match="add --set width="):
        seen(ball, "--camera", path)
    assert apart(own, seen(ball, "--camera", path, "--set", f"width={640}", f"height={360}")) < 1e-9


@pytest.fixture
def glb(own, tmp_path):
    """A .glb with two cameras, one of which says neither a size nor an aspect ratio."""
    path = tmp_path / "ball.gltf"
    trimesh.Scene(trimesh.creation.icosphere(1)).export(str(path))
    file = json.loads(path.read_text(encoding="utf-8"))
    more = json.loads(texts([View(own, "Side", None)], WRITTEN["gltf"])[""])
    more["nodes"][0]["camera"] = 0
    del more["cameras"][0]["extras"]
    free = json.loads(json.dumps(more["cameras"][0]))
    del free["perspective"]["aspectRatio"]
    first = len(file["nodes"])
    file["cameras"] = [*more["cameras"], free]
    file["nodes"] += [more["nodes"][0], more["nodes"][0] | {"name": "Free", "camera": 1}]
    file["scenes"][0]["nodes"] += [first, first + 1]
    path.write_text(json.dumps(file), encoding="utf-8")
    return path


def test_a_glbs_own_camera_is_chosen_by_name(own, glb):
    assert apart(own, seen(glb, "--camera", "Side", "--set", f"width={640}")) < 1e-9
    assert apart(own, seen(glb, "--camera", "Side", "--set", f"height={360}")) < 1e-9
    assert (
        apart(own, seen(glb, "--camera", "Free", "--set", f"width={640}", f"height={360}")) < 1e-9
    )
    free = seen(glb, "--camera", "Free")
    assert (free.width, free.height) == (960, 540) and free.window.top == own.window.top
    with pytest.raises(SceneError, match="no camera 'Other'; there are Side, Free"):
        seen(glb, "--camera", "Other", "--set", f"width={640}")
    with pytest.raises(SceneError, match=r"aspect ratio 1.77778, not that of 640 x 480"):
        seen(glb, "--camera", "Side", "--set", f"width={640}", f"height={480}")
    with pytest.raises(SceneError, match="--set up=z is for the meshes alone"):
        seen(glb, "--camera", "Side", "--set", f"width={640}", "up=z")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--camera", "Side"], "--camera Side is no file of cameras .*, and .* has no cameras"),
        (["--camera", "missing.json"], "missing.json"),
        (["--camera", __file__], r"test_camera_file.py is no file of cameras \(\.json, "),
        (["--set", "camera-view=3"], "--set camera-view is for a file of --camera"),
        (["--set", "camera-convention=bop"], "--set camera-convention is for a file of --camera"),
    ],
)
def test_what_names_no_camera_is_refused(options, said, ball):
    with pytest.raises((SceneError, OSError), match=said):
        seen(ball, *options)


def test_what_of_a_file_is_not_applied_is_said(own, ball, tmp_path, capsys):
    path = written(own, "nerf", tmp_path / "written").rename(tmp_path / "transforms.json")
    file = json.loads(path.read_text(encoding="utf-8")) | {"applied_transform": [[1, 0, 0, 0]]}
    path.write_text(json.dumps(file), encoding="utf-8")
    seen(ball, "--camera", path)
    assert "applied_transform is not undone" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "changed", "code", "said"),
    [
        ("opencv", {}, 0, None),
        ("opencv", {"clip_start": 0.5}, 2, "differ: its clip range is 0.5 to "),
        ("opencv", {"clip_start": None, "clip_end": None}, 0, None),
        ("nerf", {}, 0, None),
        ("nerf", {"w": 320, "h": 180, "cx": 160, "cy": 90}, 2, "differ: its picture has 320 x 180"),
    ],
)
def test_a_check_is_also_of_the_size_and_the_clip_range(
    name, changed, code, said, own, tmp_path, exit_code, capsys
):
    """What a file does not say is no difference."""
    window = own.window.moved(*(-n for n in own.window.centre))
    own = replace(own, window=window)
    save_scene(tmp_path / "scene.npz", Scene(own))
    path = written(own, name, tmp_path / "written")
    file = json.loads(path.read_text(encoding="utf-8")) | changed
    if "w" in changed:
        file |= {key: file[key] / 2 for key in ("fl_x", "fl_y")}
    file = {key: value for key, value in file.items() if value is not None}
    path.write_text(json.dumps(file), encoding="utf-8")
    assert exit_code(["camera", str(tmp_path / "scene.npz"), "--check", str(path)]) == code
    first, *rest = capsys.readouterr().out.splitlines()
    assert "agree: points lie at most" in first
    assert len(rest) == (said is not None) and all(said in line for line in rest)
