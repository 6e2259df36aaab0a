"""Other programs' own code reads the files: theirs, not what the tests make of their documents."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

TOOL = Path(__file__).resolve().parents[2] / "tools" / "cameras.py"


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
