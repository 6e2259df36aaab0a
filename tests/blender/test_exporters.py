"""What Blender's exporters write is read as what Blender shows: scene by scene, pixel by pixel.

`exporters.py` has the table and says what is compared.
"""

from __future__ import annotations

import pytest

from ..sampled import daily
from .exporter_scenes import SCENES
from .exporters import CELLS, FORMATS, judge

SEEN = 150  # pixels of a scene that show something, at least


@pytest.mark.parametrize("name", SCENES)
def test_every_format_is_read_as_it_was_written(name, build, tmp_path):
    rows = list(judge(name, tmp_path, build))
    assert [row.format for row in rows] == [kind.name for kind in FORMATS]
    assert all(row.seen >= SEEN for row in rows)
    assert [row for row in rows if not row.is_right] == []


@pytest.mark.torture
@pytest.mark.parametrize("seed", range(1, 50))
@pytest.mark.parametrize("name", SCENES)
def test_other_seeds(name, seed, build, tmp_path):
    assert [row for row in judge(name, tmp_path, build, seed=seed) if not row.is_right] == []


@pytest.mark.parametrize(("name", "suffix"), daily(CELLS))
def test_what_an_exporter_leaves_out_it_does(name, suffix, build, tmp_path):
    """Without what is stated of a cell, it is wrong: no statement is there in vain."""
    kind = next(kind for kind in FORMATS if kind.suffix == suffix)
    (row,) = judge(name, tmp_path, build, [kind], stated=False)
    assert row.elsewhere > 0, row
