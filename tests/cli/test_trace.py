"""`reftrace trace` on files that need no Blender."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from reference_tracer.certified import arithmetic
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR
from reference_tracer.files.scenes import save_scene
from reference_tracer.scene import Region

from .parts import channels, trace


def test_mesh_to_png(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "new" / "ball.png") == AGREE
    picture = np.asarray(Image.open(tmp_path / "new" / "ball.png"))
    assert picture.shape == (16, 24, 4)
    assert picture[8, 12, 3] == 255 and picture[0, 0, 3] == 0
    assert "24 x 16 pixels, 320 triangles" in capsys.readouterr().out


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


def test_plain_methods_require_nothing(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.exr", "--method", "watertight") == AGREE
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 1 and "(watertight, float64)" in said[0]


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
