"""The folder that a comparison leaves: pictures the right way up, arrays whole, strict JSON."""

from __future__ import annotations

import json

import numpy as np
import pytest
from PIL import Image
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import compare
from reference_tracer.files.images import to_display
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import render
from reference_tracer.report.comparison import (
    failure_written,
    write,
)
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

NAMES = ["blender.png", "comparison.json", "difference.png", "frame.npz", "page.html", "traced.png"]


@pytest.fixture
def compared(make):
    """Return what compares a square at the lower left with what `change` makes of it."""
    camera = make.camera(12, 9, half=4.5, orthographic=True, eye=(6, 4.5, 0))
    scene = make.scene(camera, make.quad(0, 4, 0, 2, -2), background=(0, 0, 0, 1))
    manifest = Manifest("a.blend", "Scene", "ViewLayer", 1, "RENDER", "Camera")
    source = Source("workbench", "5.2.3")

    def made(change):
        frame = render(scene)
        picture = frame.color.copy()
        change(picture)
        return result_of(
            compare(Case(scene, manifest, Settings(), Picture(picture, source)), frame)
        )

    return made


@pytest.fixture
def comparison(compared):
    """Return one of which Blender shows another square at the upper right."""

    def change(picture):
        picture[7:, 9:] = (0, 1, 0, 1)

    return compared(change)


@pytest.fixture
def folder(comparison, tmp_path):
    result_of(write(tmp_path / "new" / "out", comparison))
    return tmp_path / "new" / "out"


def png(folder, name):
    """Return a picture with row 0 at the bottom."""
    return np.asarray(Image.open(folder / name))[::-1]


def test_pictures_are_the_right_way_up(folder, comparison):
    traced, blender, causes = (
        png(folder, n) for n in ("traced.png", "blender.png", "difference.png")
    )
    assert np.array_equal(traced, to_display(comparison.frame.color))
    lit = traced[..., :3].any(axis=-1)
    assert lit[:2, :4].all() and lit.sum() == 8
    assert (blender[7:, 9:] == (0, 255, 0, 255)).all()
    assert (causes[7:, 9:] == (255, 0, 0, 255)).all()  # unexplained
    assert (causes[2:7, :, 0] == 0).all() and (causes[..., 3] == 255).all()
    assert 0 < causes[0, 0, 0] < traced[0, 0, 0]  # what agrees is dimmed


def test_arrays_are_whole(folder, comparison):
    with np.load(folder / "frame.npz", allow_pickle=False) as stored:
        held = dict(stored)
    for name, values in comparison.frame.passes().items():
        assert held[name].dtype == values.dtype and np.array_equal(held[name], values), name
    assert np.array_equal(held["blender"], comparison.picture)
    assert np.array_equal(held["cause"], comparison.causes.cause)
    assert np.array_equal(held["cause_figure"], comparison.causes.figure, equal_nan=True)
    assert np.array_equal(held["cause_allowed"], comparison.causes.allowed, equal_nan=True)


def strict(folder):
    def refuse(name):
        pytest.fail(f"{name} is no JSON")

    text = (folder / "comparison.json").read_text(encoding="utf-8")
    return json.loads(text, parse_constant=refuse)


def test_json_of_a_picture_that_is_not_finite(compared, tmp_path):
    def change(picture):
        picture[0, 0], picture[0, 1] = np.nan, np.inf

    result_of(write(tmp_path, compared(change)))
    assert strict(tmp_path)["metrics"]["largest_difference"]["value"] > 0
    assert sorted(p.name for p in tmp_path.iterdir()) == NAMES


def test_what_json_cannot_hold_is_an_error(comparison, tmp_path):
    """Rather than a file that other readers refuse."""
    comparison.case.picture.source.settings["gamma"] = float("nan")
    with pytest.raises(ValueError, match="JSON"):
        result_of(write(tmp_path, comparison))
    assert not (tmp_path / "comparison.json").exists()


def test_writing_again_replaces(folder, compared):
    result_of(write(folder, compared(lambda picture: None)))
    assert strict(folder)["verdict"] == "agree"
    assert np.array_equal(png(folder, "blender.png"), png(folder, "traced.png"))
    assert sorted(p.name for p in folder.iterdir()) == NAMES


def test_a_failure_leaves_the_results_that_are_there(folder):
    """A misspelt name must not cost yesterday's comparison."""
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    with pytest.raises(SceneError), failure_written(folder):
        raise SceneError("no camera")
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == before


def test_a_failure_leaves_what_is_no_result(tmp_path):
    for name in NAMES[:-1]:
        (tmp_path / name).write_text("the user's own")
    (tmp_path / "comparison.json").unlink(missing_ok=True)
    before = {p.name for p in tmp_path.iterdir()}
    with pytest.raises(SceneError), failure_written(tmp_path):
        raise SceneError("no camera")
    assert {p.name for p in tmp_path.iterdir()} == before | {"comparison.json"}
