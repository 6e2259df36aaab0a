"""What Blender's exporters write is read as what Blender shows: scene by scene, pixel by pixel.

`exporters.py` has the table and says what is compared.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from . import exporters
from .exporter_scenes import SCENES
from .exporters import CELLS, FORMATS, judge

GLB = next(kind for kind in FORMATS if kind.name == "glb")
SEEN = 300  # pixels of a scene that show something, at least


@pytest.mark.parametrize("name", SCENES)
def test_every_format_is_read_as_it_was_written(name, build, tmp_path):
    rows = list(judge(name, tmp_path, build))
    assert [row.format for row in rows] == [kind.name for kind in FORMATS]
    assert all(row.seen >= SEEN for row in rows)
    wrong = [row.line() for row in rows if not row.is_right]
    assert not wrong, "\n".join((exporters.HEAD, *wrong))


@pytest.mark.parametrize(("name", "suffix"), CELLS)
def test_what_an_exporter_leaves_out_it_does(name, suffix, build, tmp_path):
    """Without what is stated of a cell, it is wrong: no statement is there in vain."""
    kind = next(kind for kind in FORMATS if kind.suffix == suffix)
    (row,) = judge(name, tmp_path, build, [kind], stated=False)
    assert row.elsewhere > 0, row.line()


def test_a_wrong_reading_is_found(build, tmp_path, monkeypatch):
    """A mesh left out, mirrored, moved by half a pixel, under another name; and two in one."""
    real = exporters.load_meshes

    def judged(fault):
        monkeypatch.setattr(exporters, "load_meshes", lambda *args: fault(real(*args)))
        return judge("scales", tmp_path, build, [GLB])

    def moved(meshes, by):
        (mesh, matrix), *others = meshes
        matrix = matrix.copy()
        matrix[0, 3] += by
        return [(mesh, matrix), *others]

    def named(meshes, name):
        return [(replace(meshes[0][0], name=name), meshes[0][1]), *meshes[1:]]

    faults = {
        "left out": lambda meshes: meshes[1:],
        "mirrored": lambda meshes: [(m, np.diag([-1.0, 1, 1, 1]) @ t) for m, t in meshes],
        "moved": lambda meshes: moved(meshes, 0.05),
        "under another name": lambda meshes: named(meshes, meshes[1][0].name),
    }
    for fault, make in faults.items():
        (row,) = judged(make)
        assert row.elsewhere and not row.is_right, fault
    (row,) = judged(lambda meshes: meshes)
    assert row.is_right
