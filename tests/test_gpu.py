"""`make test-gpu`: the row of what draws here, and the exit code."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.blender

PROJECT = Path(__file__).parent.parent


def test_the_module_has_a_row():
    command = [sys.executable, PROJECT / "tools" / "gpu.py", "exercise_triangle"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    head, _, row = (
        [word.strip() for word in line.split("|")[1:-1]] for line in done.stdout.splitlines()[-3:]
    )
    found = dict(zip(head, row, strict=True))
    assert found["backend"] == "OPENGL" and found["device"] and found["driver"]
    assert found["snapping"].startswith("1/")
    assert found["differ drawn twice"] == found["unexplained"] == "0"


def test_nothing_drawn_is_no_success():
    command = [sys.executable, PROJECT / "tools" / "gpu.py", "--blender", "/no/such", "suzanne"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1
    assert "VULKAN: not drawn:" in done.stderr and "/no/such" in done.stderr
