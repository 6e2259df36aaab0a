"""The folder `sweep/` may be deleted, with its line in the table: the picture is the same."""

from __future__ import annotations

import shutil

import numpy as np
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings

from ..copied import copied, run

SCRIPT = """
import numpy as np
from reference_tracer.files.scenes import load_scene
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings
frame = render(load_scene("scene.npz"), Settings("certified", samples=2))
ties = [(k, *name) for k, names in frame.ties.items() for name in sorted(names)]
np.savez("frame.npz", **frame.passes(), ties=np.array(ties))
"""


# The table of methods, with the definition's own way in place of the sweep.
WITH = "from .certified.sweep.sweep import sweep\n"
WITHOUT = "from .certified.plain import plain as sweep\n"


def test_without_the_sweep_the_picture_is_the_same(make, tmp_path):
    quads = make.quad(-1, 1, -1, 1, -2), make.quad(-9, 0.3, -9, 9, -3), make.quad(-1, 1, -1, 1, -2)
    scene = make.scene(make.camera(), *quads)
    save_scene(tmp_path / "scene.npz", scene)
    addon = copied(tmp_path)
    shutil.rmtree(addon / "certified" / "sweep")
    table = addon / "rendering.py"
    source = table.read_text(encoding="utf-8")
    assert source.count(WITH) == 1
    table.write_text(source.replace(WITH, WITHOUT), encoding="utf-8")
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
