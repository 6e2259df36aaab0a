"""The fast tests pass, whichever of a processor's instructions numpy and its OpenBLAS choose."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

PROJECT = Path(__file__).parents[1]
KERNELS = "Prescott", "Haswell"  # without AVX, and with AVX2 alone
FOUND = np.show_config("dicts")["SIMD Extensions"].get("found", [])
# Sets of instructions that numpy leaves out, the newest ones first, and OpenBLAS's kernel.
LEVELS = [(" ".join(FOUND[k:]), kernel) for k in range(len(FOUND) + 1) for kernel in KERNELS]
SAMPLE = [
    "tests/tracer",
    "tests/derivation",
    "tests/certified/test_order.py",
    "tests/certified/test_definition.py",
    "tests/certified/test_dropped.py",
]
ALL = ["tests", "--ignore=tests/blender", "--ignore=tests/test_instructions.py"]
FAST = "-m", "not blender and not browser and not gui and not slow and not torture"


def run(disabled: str, kernel: str, *what: str) -> None:
    """Run tests in a process of its own: numpy chooses once."""
    chosen = {"NPY_DISABLE_CPU_FEATURES": disabled, "OPENBLAS_CORETYPE": kernel}
    command = [sys.executable, "-m", "pytest", "-q", *what]
    ran = subprocess.run(command, cwd=PROJECT, env=os.environ | chosen, capture_output=True)
    assert ran.returncode == 0, ran.stdout.decode()[-4000:]


@pytest.mark.slow
@pytest.mark.parametrize("path", SAMPLE)
def test_the_lowest_level_passes_a_sample(path):
    run(*LEVELS[0], path, *FAST)


@pytest.mark.torture
@pytest.mark.parametrize("level", LEVELS, ids=" ".join)
def test_every_level_passes(level):
    run(*level, *ALL, *FAST)
