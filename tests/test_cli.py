"""The command line on files that need no Blender."""

from __future__ import annotations

import json

import numpy as np
import OpenEXR
import pytest
import trimesh
from PIL import Image
from reference_tracer import __version__
from reference_tracer.arguments import AGREE, INPUT_ERROR
from reference_tracer.cli import main
from reference_tracer.scene_files import save_scene

SMALL = ["--width", "24", "--height", "16"]


@pytest.fixture
def ball(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(2, radius=1.0).export(path)
    return path


def channels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: c.pixels[::-1] for name, c in file.channels().items()}


def trace(path, out, *options):
    return main(["trace", str(path), "--out", str(out), *SMALL, *options])


def test_mesh_to_png(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "new" / "ball.png") == AGREE
    picture = np.asarray(Image.open(tmp_path / "new" / "ball.png"))
    assert picture.shape == (16, 24, 4)
    assert picture[8, 12, 3] == 255 and picture[0, 0, 3] == 0
    assert "24 x 16 pixels, 320 triangles" in capsys.readouterr().out


@pytest.mark.parametrize("suffix", ["obj", "stl", "glb"])
def test_other_meshes(suffix, tmp_path):
    trimesh.creation.box().export(tmp_path / f"box.{suffix}")
    assert trace(tmp_path / f"box.{suffix}", tmp_path / "box.png") == AGREE
    assert np.asarray(Image.open(tmp_path / "box.png"))[8, 12, 3] == 255


def test_eye_target_angle(ball, tmp_path):
    """Seen from 2 radii, a sphere fills the cone of 30 degrees around the axis."""
    half = np.degrees(np.arctan(np.tan(np.radians(30)) * 1.25))
    assert (
        trace(ball, tmp_path / "b.exr", "--eye", "0", "-2", "0", "--angle", str(2 * half)) == AGREE
    )
    depth = channels(tmp_path / "b.exr")["depth.V"]
    assert depth[7:9, 11:13].min() == pytest.approx(1, abs=0.03)
    rows = np.flatnonzero(np.isfinite(depth).any(axis=1))
    assert (rows.min(), rows.max()) in ((1, 14), (2, 13))  # 16 rows / 1.25, less the corners cut


def test_target_and_up(ball, tmp_path):
    """Looking past the ball to its right and above, one sees it at the left and below."""
    assert (
        trace(ball, tmp_path / "b.exr", "--eye", "0", "-5", "0", "--target", "1", "0", "0.7")
        == AGREE
    )
    y, x = np.nonzero(np.isfinite(channels(tmp_path / "b.exr")["depth.V"]))
    assert x.mean() < 11 and y.mean() < 7


def test_ortho_scale(ball, tmp_path):
    assert trace(ball, tmp_path / "b.exr", "--eye", "0", "0", "5", "--ortho-scale", "4") == AGREE
    found = channels(tmp_path / "b.exr")
    seen = np.isfinite(found["depth.V"])
    assert seen.any(axis=0).sum() == seen.any(axis=1).sum() == 8  # the height, 4 m, is 16 pixels
    assert found["position.Z"][seen] == pytest.approx(5 - found["depth.V"][seen], abs=1e-5)


def test_exr_holds_the_passes(ball, tmp_path):
    assert (
        trace(ball, tmp_path / "b.exr", "--method", "moller_trumbore", "--precision", "float32")
        == 0
    )
    found = channels(tmp_path / "b.exr")
    seen = found["object_index.V"] == 0
    assert seen.any() and not seen.all()
    assert (found["triangle_index.V"][seen] >= 0).all() and (
        found["triangle_index.V"][~seen] == -1
    ).all()
    weights = sum(found[f"barycentrics.{x}"] for x in "XYZ")
    assert weights[seen] == pytest.approx(1, abs=1e-5)
    assert np.isinf(found["depth.V"][~seen]).all()


def test_npz_keeps_its_camera(make, tmp_path):
    scene = make.scene(make.camera(10, 6), make.quad(-9, 0, -9, 9, -2))
    save_scene(tmp_path / "s.npz", scene)
    assert main(["trace", str(tmp_path / "s.npz"), "--out", str(tmp_path / "s.png")]) == AGREE
    alpha = np.asarray(Image.open(tmp_path / "s.png"))[..., 3]
    assert alpha.shape == (6, 10)
    assert (alpha[:, :5] == 255).all() and (alpha[:, 5:] == 0).all()


def test_samples_are_shown(ball, tmp_path):
    assert trace(ball, tmp_path / "b.png", "--samples", "3") == AGREE
    alpha = np.asarray(Image.open(tmp_path / "b.png"))[..., 3]
    assert set(np.unique(alpha)) - {0, 255}


def test_trade(tmp_path, capsys):
    trimesh.creation.icosphere(1).export(tmp_path / "ball.ply")
    assert main(["trade", str(tmp_path / "ball.ply"), "--width", "12", "--height", "8"]) == AGREE
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 7 and "wrong pixels" in lines[0]


BAD = {
    "no file": (["none.ply"], "none.ply"),
    "other suffix": (["words.txt"], "words.txt"),
    "empty mesh": (["empty.obj"], "empty.obj"),
    "no scene": (["empty.npz"], "empty.npz"),
    "same point": (["ball.ply", "--eye", "1", "2", "3", "--target", "1", "2", "3"], "--target"),
    "angle 180": (["ball.ply", "--eye", "0", "0", "5", "--angle", "180"], "--angle"),
    "angle not a number": (["ball.ply", "--eye", "0", "0", "5", "--angle", "nan"], "--angle"),
    "no eye": (["ball.ply", "--eye", "nan", "0", "5"], "--eye"),
    "ortho scale 0": (["ball.ply", "--eye", "0", "0", "5", "--ortho-scale", "0"], "--ortho-scale"),
    "ortho scale below 0": (
        ["ball.ply", "--eye", "0", "0", "5", "--ortho-scale", "-1"],
        "orthographic scale",
    ),
    "width 0": (["ball.ply", "--width", "0"], "0 x 16"),
    "height below 0": (["ball.ply", "--height", "-5"], "24 x -5"),
    "samples": (["ball.ply", "--samples", "0"], "samples"),
    "unknown method": (["ball.ply", "--method", "magic"], "--method"),
    "not a number": (["ball.ply", "--width", "many"], "--width"),
    "out suffix": (["ball.ply", "--out", "x.jpg"], "x.jpg"),
    "out is a folder, PNG": (["ball.ply", "--out", "folder.png"], "folder.png"),
    "out is a folder, EXR": (["ball.ply", "--out", "folder.exr"], "folder.exr"),
    "out under a file": (["ball.ply", "--out", "words.txt/x.png"], "words.txt"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_and_nothing_is_written(case, ball, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("empty.obj", "empty.npz", "words.txt"):
        (tmp_path / name).touch()
    for name in ("folder.png", "folder.exr"):
        (tmp_path / name).mkdir()
    before = sorted(tmp_path.rglob("*"))
    options, words = BAD[case]
    try:
        code = main(["trace", "--out", "x.png", *SMALL, *options])
    except SystemExit as stop:
        code = stop.code
    assert code == INPUT_ERROR
    assert words in capsys.readouterr().err
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("command", ["compare", "export"])
def test_only_a_blend_is_compared_or_exported(command, ball, tmp_path, capsys, monkeypatch):
    """A comparison that fails says so in its folder, too."""
    monkeypatch.chdir(tmp_path)
    assert main([command, "ball.ply", "--out", "out.npz"]) == INPUT_ERROR
    assert "ball.ply" in capsys.readouterr().err
    written = [p for p in tmp_path.rglob("*") if p.is_file() and p != ball]
    assert [p.name for p in written] == (["comparison.json"] if command == "compare" else [])
    for path in written:
        held = json.loads(path.read_text(encoding="utf-8"))
        assert held["verdict"] == "failed" and "ball.ply" in held["error"]["message"]


@pytest.mark.parametrize(
    "options, word",
    [
        (["--width", "40"], "--width"),
        (["--eye", "0", "0", "9"], "--eye"),
        (["--angle", "9"], "--angle"),
    ],
)
def test_options_that_would_not_be_heard_are_refused(options, word, make, tmp_path, capsys):
    """A scene has a camera of its own."""
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6)))
    trace = ["trace", str(tmp_path / "s.npz"), "--out", str(tmp_path / "s.png"), *options]
    assert main(trace) == INPUT_ERROR
    assert word in capsys.readouterr().err and not (tmp_path / "s.png").exists()


@pytest.mark.parametrize("command", ["", "compare", "trace", "trade", "export"])
def test_help_names_the_exit_codes(command, capsys):
    with pytest.raises(SystemExit) as stop:
        main([*command.split(), "--help"])
    text = capsys.readouterr().out
    assert stop.value.code == 0
    for words in ("0  the pictures agree", "2  differences", "4  the input is wrong"):
        assert words in text
    assert ("example:" in text) == bool(command)


def test_version_and_no_command(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0 and __version__ in capsys.readouterr().out
    with pytest.raises(SystemExit) as stop:
        main([])
    assert stop.value.code == INPUT_ERROR and "--help" in capsys.readouterr().err
