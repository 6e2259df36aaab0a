"""Other Pythons with other numpys and trimeshes, which tools/others.sh makes."""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]
_FOLDER = PROJECT / ".venv" / "others"
_LIST = (PROJECT / "tools" / "others.sh").read_text("utf-8").partition("\nothers=(")[2]
# Each as Python-numpy-trimesh.
NAMES = _LIST.partition(")")[0].split()
OWN = "-".join(("{}.{}".format(*sys.version_info), version("numpy"), version("trimesh")))


def python(name: str) -> Path:
    """Return the Python of an environment, which may be the tests' own; skip where it is not."""
    if name == OWN:
        return Path(sys.executable)
    if not (_FOLDER / name / ".ready").exists():
        pytest.skip(f"no environment {name}: tools/others.sh setup makes it where such a Python is")
    return _FOLDER / name / "bin" / "python"
