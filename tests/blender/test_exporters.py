"""What Blender's exporters write is read as what Blender shows: scene by scene, pixel by pixel.

`exporters.py` has the table and says what is compared.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ..sampled import daily
from . import exporters
from .exporter_scenes import SCENES
from .exporters import CELLS, FORMATS, judge

GLB = next(kind for kind in FORMATS if kind.name == "glb")
SEEN = 150  # pixels of a scene that show something, at least


@pytest.mark.parametrize("name", SCENES)
def test_every_format_is_read_as_it_was_written(name, build, tmp_path):
    rows = list(judge(name, tmp_path, build))
    assert [row.format for row in rows] == [kind.name for kind in FORMATS]
    assert all(row.seen >= SEEN for row in rows)
    wrong = [row.line() for row in rows if not row.is_right]
    assert not wrong, "\n".join((exporters.HEAD, *wrong))


@pytest.mark.torture
@pytest.mark.parametrize("seed", range(1, 50))
@pytest.mark.parametrize("name", SCENES)
def test_other_seeds(name, seed, build, tmp_path):
    wrong = [row.line() for row in judge(name, tmp_path, build, seed=seed) if not row.is_right]
    assert not wrong, "\n".join((exporters.HEAD, *wrong))


@pytest.mark.parametrize(("name", "suffix"), daily(CELLS))
def test_what_an_exporter_leaves_out_it_does(name, suffix, build, tmp_path):
    """Without what is stated of a cell, it is wrong: no statement is there in vain."""
    kind = next(kind for kind in FORMATS if kind.suffix == suffix)
    (row,) = judge(name, tmp_path, build, [kind], stated=False)
    assert row.elsewhere > 0, row.line()


def left_out(placed):
    return placed[1:]


def mirrored(placed):
    return tuple(
        p._replace(world_from_object=np.diag([-1.0, 1, 1, 1]) @ p.world_from_object) for p in placed
    )


def moved(placed):
    """By half a pixel, one of them."""
    matrix = placed[0].world_from_object.copy()
    matrix[0, 3] += 0.05
    return (placed[0]._replace(world_from_object=matrix), *placed[1:])


def under_another_name(placed):
    return (placed[0]._replace(object=placed[1].object), *placed[1:])


@pytest.mark.parametrize("fault", [left_out, mirrored, moved, under_another_name])
def test_a_wrong_reading_is_found(fault, build, tmp_path, monkeypatch):
    real = exporters.load_meshes

    def wrong(*args):
        found = real(*args)
        return replace(found, placed=fault(found.placed))

    monkeypatch.setattr(exporters, "load_meshes", wrong)
    (row,) = judge("scales", tmp_path, build, [GLB])
    assert row.elsewhere > 0 and not row.is_right
