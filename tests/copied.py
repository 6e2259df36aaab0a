"""A copy of the add-on that a test may change, and a Python of its own that sees nothing else."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

ADDON = Path(__file__).parent.parent / "addon"
CHECKER = ADDON.parent / "packages" / "verify"
TOOLS = str(ADDON.parent / "tools")


def copied(folder: Path) -> Path:
    """Copy the add-on into a folder; return the copy, the package `reference_tracer`.

    Beside it is the checker of certificates, which is recorded, too.
    """
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(CHECKER, folder / "reference_tracer_verify", ignore=ignored)
    return shutil.copytree(ADDON, folder / "reference_tracer", ignore=ignored)


def run(folder: Path, script: str) -> subprocess.CompletedProcess[str]:
    """Run a script in a folder with a copy: it imports the copy, never what is installed."""
    check = f"import reference_tracer\nassert {str(folder)!r} in reference_tracer.__file__\n"
    return subprocess.run(
        [sys.executable, "-c", check + script],
        cwd=folder,
        env={"PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
        check=False,
    )
