"""`reftrace explain`."""

from __future__ import annotations

import json

import pytest
import trimesh
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR
from reference_tracer.derivation import reproducer, writers

SMALL = ["--set", "width=24", "height=16"]


@pytest.fixture
def ball(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(2, radius=1.0).export(path)
    return str(path)


def explain(*arguments):
    return main(["explain", *map(str, arguments)])


def test_files_by_their_endings(ball, tmp_path, capsys):
    out = tmp_path / "new"
    for suffix, begins in ((".md", "# The ray"), (".html", "<!doctype html>"), (".JSON", "{")):
        path = out / f"pixel{suffix}"
        assert explain(ball, "--pixel", 12, 8, "--out", path, *SMALL) == AGREE
        assert path.read_text(encoding="utf-8").startswith(begins)
        printed = capsys.readouterr().out
        assert printed.startswith("The pixel sees ball, triangle") and str(path) in printed
    assert json.loads((out / "pixel.JSON").read_text())["schema"] == writers.SCHEMA


def test_reproducer_reruns_without_the_scene(ball, tmp_path, capsys):
    pixel = tmp_path / "pixel.json"
    assert explain(ball, "--pixel", 12, 8, "--reproducer", pixel, "--limit", 3, *SMALL) == AGREE
    first = capsys.readouterr().out
    assert first.startswith("# The ray through pixel (12, 8) of ball.ply\n")
    assert "ball, triangle" in first and first.rstrip().endswith("change it.**")
    assert json.loads(pixel.read_text())["schema"] == reproducer.SCHEMA
    (tmp_path / "ball.ply").unlink()
    assert explain(pixel) == AGREE
    assert capsys.readouterr().out == first


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ([], "--pixel X Y says which pixel"),
        (["--pixel", "24", "0"], "x must be between 0 and 23"),
        (["--pixel", "0", "-1"], "y must be between 0 and 15"),
        (["--pixel", "0", "0", "--limit", "0"], "--limit: 0 is not an integer"),
        (["--pixel", "0", "0", "--out", "pixel.pdf"], "must end in .md or .html or .json"),
        (["--pixel", "0", "0", "--reproducer", "pixel.npz"], "must end in .json"),
        (["--pixel", "0", "0", "--reproducer", "p.json", "--out", "./p.json"], "the same file"),
        (["--pixel", "0", "0", "--reproducer", "p.json", "--out", "P.json"], "the same file"),
    ],
)
def test_what_is_wrong_is_said(ball, capsys, exit_code, options, says):
    assert exit_code(["explain", ball, *SMALL, *options]) == INPUT_ERROR
    assert says in capsys.readouterr().err


@pytest.mark.parametrize("option", [["--pixel", "1", "1"], ["--limit", "3"], ["--set", "width=9"]])
def test_a_pixel_takes_no_option_of_a_scene(tmp_path, capsys, option):
    assert explain(tmp_path / "pixel.json", *option) == INPUT_ERROR
    assert "which is one pixel by itself" in capsys.readouterr().err
