"""The folder `sweep/` may be deleted: the picture is the same. What else is missing is an error."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.scene_files import save_scene
from reference_tracer.tracer.render import render
from reference_tracer.tracer.settings import Settings

from ..copied import copied, run

SCRIPT = """
import numpy as np
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer import render
from reference_tracer.tracer.settings import Settings
assert render.certified.__name__ == "plain"
frame = render.render(load_scene("scene.npz"), Settings("certified", samples=2))
ties = [(k, *name) for k, names in frame.ties.items() for name in sorted(names)]
np.savez("frame.npz", **frame.passes(), ties=np.array(ties))
"""


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    """The folder `sweep/` of a copy of the add-on."""
    return copied(tmp_path) / "tracer" / "certified" / "sweep"


@pytest.mark.parametrize("leftovers", [False, True], ids=["deleted", "emptied"])
def test_without_the_sweep_the_picture_is_the_same(make, sweep, tmp_path, leftovers):
    quads = make.quad(-1, 1, -1, 1, -2), make.quad(-9, 0.3, -9, 9, -3), make.quad(-1, 1, -1, 1, -2)
    scene = make.scene(make.camera(), *quads)
    save_scene(tmp_path / "scene.npz", scene)
    shutil.rmtree(sweep)
    if leftovers:
        (sweep / "__pycache__").mkdir(parents=True)
    done = run(tmp_path, SCRIPT)
    assert done.returncode == 0, done.stderr
    frame = render(scene, Settings("certified", samples=2))
    ties = [(k, *name) for k, names in frame.ties.items() for name in sorted(names)]
    expected = frame.passes() | {"ties": np.array(ties)}
    with np.load(tmp_path / "frame.npz") as found:
        assert found.keys() == expected.keys()
        for name, values in expected.items():
            assert found[name].tobytes() == values.tobytes(), name
    assert len(frame.ties) > 20 and (frame.instance_index == 1).any()


def test_a_file_that_the_sweep_misses_is_an_error(sweep, tmp_path):
    (sweep / "film.py").unlink()
    done = run(tmp_path, SCRIPT)
    assert done.returncode and "No module named 'reference_tracer.certified.sweep.film'" in (
        done.stderr
    )
