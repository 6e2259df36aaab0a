"""`reftrace trace` on files that need no Blender."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from PIL import Image
from reference_tracer.certified import arithmetic
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR
from reference_tracer.files.scenes import save_scene
from reference_tracer.scene import Region

from .parts import SMALL, channels, trace


def test_mesh_to_png(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "new" / "ball.png") == AGREE
    picture = np.asarray(Image.open(tmp_path / "new" / "ball.png"))
    assert picture.shape == (16, 24, 4)
    assert picture[8, 12, 3] == 255 and picture[0, 0, 3] == 0
    assert "24 x 16 pixels, 320 triangles" in capsys.readouterr().out


@pytest.mark.parametrize("suffix", ["obj", "off", "stl", "glb"])
def test_other_meshes(suffix, tmp_path):
    trimesh.creation.box().export(tmp_path / f"box.{suffix}")
    assert trace(tmp_path / f"box.{suffix}", tmp_path / "box.png") == AGREE
    assert np.asarray(Image.open(tmp_path / "box.png"))[8, 12, 3] == 255


def test_eye_target_angle(ball, tmp_path):
    """Seen from 2 radii, a sphere fills the cone of 30 degrees around the axis."""
    half = np.degrees(np.arctan(np.tan(np.radians(30)) * 1.25))
    assert trace(ball, tmp_path / "b.exr", "--set", "eye=0,-2,0", f"angle={2 * half}") == AGREE
    depth = channels(tmp_path / "b.exr")["Z"]
    assert depth[7:9, 11:13].min() == pytest.approx(1, abs=0.03)
    rows = np.flatnonzero(np.isfinite(depth).any(axis=1))
    assert (rows.min(), rows.max()) in ((1, 14), (2, 13))  # 16 rows / 1.25, less the corners cut


def test_target_and_up(ball, tmp_path):
    """Looking past the ball to its right and above, one sees it at the left and below."""
    assert trace(ball, tmp_path / "b.exr", "--set", "eye=0,-5,0", "target=1,0,0.7") == AGREE
    y, x = np.nonzero(np.isfinite(channels(tmp_path / "b.exr")["Z"]))
    assert x.mean() < 11 and y.mean() < 7


def test_ortho_scale(ball, tmp_path):
    assert trace(ball, tmp_path / "b.exr", "--set", "eye=0,0,5", "ortho-scale=4") == AGREE
    found = channels(tmp_path / "b.exr")
    seen = np.isfinite(found["Z"])
    assert seen.any(axis=0).sum() == seen.any(axis=1).sum() == 8  # the height, 4 m, is 16 pixels
    assert found["P.Z"][seen] == pytest.approx(5 - found["Z"][seen], abs=1e-5)


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
    assert np.isinf(found["Z"][~seen]).all()


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


@pytest.mark.parametrize("method, came_to", [("auto", "certified"), ("certified", "certified")])
def test_certified_says_what_the_scene_required(method, came_to, ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.exr", "--method", method) == AGREE
    said = capsys.readouterr().out.splitlines()
    assert f"({came_to}, float64)" in said[0]
    assert len(said) > 1 and "pairs" in said[1]
    found = channels(tmp_path / "b.exr")["certainty.V"]
    assert (found > 0).all()


def test_plain_methods_require_nothing(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.exr", "--method", "watertight") == AGREE
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 1 and "(watertight, float64)" in said[0]


@pytest.mark.parametrize("method", ["certified", "auto"])
def test_certified_in_float32_is_refused(method, ball, tmp_path, capsys):
    options = ["--method", method, "--precision", "float32"]
    assert trace(ball, tmp_path / "b.png", *options) == INPUT_ERROR
    said = capsys.readouterr().err
    assert "float64 only" in said and "watertight" in said and "Traceback" not in said
    assert not (tmp_path / "b.png").exists()


@pytest.fixture
def broken_arithmetic(monkeypatch):
    monkeypatch.setattr(arithmetic, "broken_assumptions", lambda: ["subnormal results"])


@pytest.mark.slow
@pytest.mark.usefixtures("broken_arithmetic")
def test_a_machine_that_cannot_certify_says_so(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png", "--method", "certified") == INPUT_ERROR
    assert main(["trade", str(ball)]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert said.count("subnormal results") == 2 and "Traceback" not in said
    assert not (tmp_path / "b.png").exists()


@pytest.mark.usefixtures("broken_arithmetic")
def test_auto_falls_back_and_says_so(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png") == AGREE
    said = capsys.readouterr().out
    assert "(watertight, float64)" in said and "subnormal results" in said


def test_up_turns_a_mesh_and_nothing_else(tmp_path, capsys, make):
    shape = trimesh.creation.cone(1, 3)
    shape.export(tmp_path / "y.ply")
    shape.vertices = shape.vertices[:, [0, 2, 1]] * (1, -1, 1)
    shape.export(tmp_path / "z.ply")
    assert trace(tmp_path / "y.ply", tmp_path / "y.png", "--set", "up=y") == AGREE
    assert trace(tmp_path / "z.ply", tmp_path / "z.png") == AGREE
    assert (tmp_path / "y.png").read_bytes() == (tmp_path / "z.png").read_bytes()
    assert trace(tmp_path / "z.ply", tmp_path / "wide.png", "--set", "eye=all", "angle=90") == AGREE
    assert (tmp_path / "wide.png").read_bytes() != (tmp_path / "z.png").read_bytes()
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6)))
    options = ["--out", str(tmp_path / "s.png"), "--set", "up=y"]
    assert main(["trace", str(tmp_path / "s.npz"), *options]) == INPUT_ERROR
    assert "--set up is for meshes" in capsys.readouterr().err


def test_color_shows_the_shape_and_a_flat_mesh_says_so(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "a.png") == AGREE
    assert "--color facing shows its shape" in capsys.readouterr().out
    assert trace(ball, tmp_path / "b.png", "--color", "facing") == AGREE
    assert "--color" not in capsys.readouterr().out
    flat, shape = (np.asarray(Image.open(tmp_path / n)) for n in ("a.png", "b.png"))
    hit = flat[..., 3] == 255
    assert np.array_equal(hit, shape[..., 3] == 255)
    assert len(np.unique(flat[hit, 0])) == 1 and len(np.unique(shape[hit, 0])) > 20


def test_a_comparison_has_no_color_and_agrees_with_what_trace_gives(ball, tmp_path, capsys):
    """So the default stays the object's own: it is the picture that a comparison is about."""
    assert trace(ball, tmp_path / "a.png") == AGREE
    options = ["--against", str(tmp_path / "a.png"), "--out", str(tmp_path / "out"), *SMALL]
    assert main(["compare", str(ball), *options]) == AGREE
    with pytest.raises(SystemExit) as stopped:
        main(["compare", str(ball), *options, "--color", "facing"])
    assert stopped.value.code == INPUT_ERROR and "--color" in capsys.readouterr().err


def test_rows_are_those_of_the_whole_picture(make, tmp_path, capsys):
    """Every output of every pixel, to the bit, also where the camera has a border."""
    camera = make.camera(10, 9, region=Region(2, 1, 9, 8))
    save_scene(tmp_path / "s.npz", make.scene(camera, make.quad(-9, 0.1, -9, 0.2, -2)))

    def traced(name, *options):
        out = ["--out", str(tmp_path / name)]
        return main(["trace", str(tmp_path / "s.npz"), *out, *options])

    parts = ["0", "2"], ["3", "3"], ["4", "6"]
    assert traced("whole.exr") == AGREE
    assert [traced(f"{p[0]}.exr", "--rows", *p) for p in parts] == [AGREE] * 3
    whole = channels(tmp_path / "whole.exr")
    found = [channels(tmp_path / f"{p[0]}.exr") for p in parts]
    assert len(whole) > 10 and whole["Z"].shape == (7, 7)
    for name, values in whole.items():
        np.testing.assert_array_equal(np.concatenate([f[name] for f in found]), values)
    for wrong in (["3", "7"], ["-1", "2"], ["3", "2"], ["0", "2", "--color", "depth"]):
        assert traced("wrong.exr", "--rows", *wrong) == INPUT_ERROR
        assert "--rows" in capsys.readouterr().err and not (tmp_path / "wrong.exr").exists()
