"""Other programs' own code reads the files: theirs, not what the tests make of their documents."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pygltflib
import pytest
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import CONVENTIONS, texts

from .cameras import camera
from .test_conventions import on_disk

TOOL = Path(__file__).resolve().parents[2] / "tools" / "cameras.py"


def test_pygltflib_reads_the_camera(tmp_path):
    own = camera(np.random.default_rng(7))
    path = on_disk(texts([View(own, "Cam", 1)], CONVENTIONS["gltf"]), tmp_path / "files")
    file = pygltflib.GLTF2().load(str(path.rename(path.with_suffix(".gltf"))))
    node = file.nodes[file.scenes[file.scene].nodes[0]]
    lens = file.cameras[node.camera].perspective
    matrix = np.reshape(node.matrix, (4, 4)).T
    assert np.allclose(matrix[:3, 3], own.origin[[0, 2, 1]] * (1, 1, -1))
    assert np.allclose(-matrix[:3, 2], own.forward[[0, 2, 1]] * (1, 1, -1))
    assert np.tan(lens.yfov / 2) == pytest.approx(own.window.top)
    assert lens.aspectRatio == pytest.approx(640 / 360)
    assert (lens.znear, lens.zfar) == (own.clip_start, own.clip_end)


@pytest.mark.torture
def test_each_programs_code_has_points_where_blender_has_them():
    """COLMAP's, Mitsuba's, OpenCV's and pyrender's, from their wheels: it downloads 200 MB."""
    done = subprocess.run([sys.executable, TOOL], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    for program in ("COLMAP", "Mitsuba", "OpenCV", "pyrender"):
        (row,) = (line for line in done.stdout.splitlines() if line.startswith(f"| {program} "))
        cells = [word.strip() for word in row.split("|")[2:-1]]
        assert max(float(cell) for cell in cells if cell != "refused") < 1e-3
        assert len([cell for cell in cells if cell != "refused"]) >= 8
