"""Measures in Blender's window, where a whole Blender is set up with the extension.

`tools/whole_blender.sh` runs `window_child.py` in it; out come CPU seconds of Blender's process.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

from .peers import MissingPeerError

COMPARE = "Trace and Compare in the window"
FIRST, COARSE, REST = (
    f"viewport, {what}" for what in ("the first picture", "a coarse one", "the whole after a move")
)
WINDOW = COMPARE, FIRST, COARSE, REST
_PROJECT = Path(__file__).resolve().parents[2]
_TOOL = _PROJECT / "tools" / "whole_blender.sh"
_OUT = _PROJECT / "out" / "bench_window"
_INSIDE = "/project/out/bench_window"  # the same, as that Blender sees it
_LONGEST = 1200  # seconds


def in_the_window() -> dict[str, list[tuple[float, float]]]:
    """Return the seconds of each round, of CPU and of waiting, by their names in WINDOW.

    Raises
    ------
    MissingPeerError
        If there is no whole Blender, or no extension to install in it, or it fails.
    """
    packages = sorted((_PROJECT / "dist").glob("reference_tracer-*.zip"))
    if not _TOOL.is_file() or not packages:
        raise MissingPeerError("there is no extension in dist/: make extension")
    check = subprocess.run([_TOOL, "ready"], capture_output=True, text=True)
    if check.returncode:
        raise MissingPeerError(check.stdout.strip())
    shutil.rmtree(_OUT, ignore_errors=True)
    _OUT.mkdir(parents=True)
    package = f"/project/dist/{packages[-1].name}"
    _blender("--command", "extension", "install-file", "-r", "user_default", "--enable", package)
    log = _blender(
        "--python", "/project/packages/benchmarks/window_child.py", "--", f"{_INSIDE}/found.json"
    )
    try:
        found = json.loads((_OUT / "found.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise MissingPeerError(f"it failed ({log.strip().splitlines()[-1]})") from None
    if not found:
        raise MissingPeerError(f"it failed ({log.strip().splitlines()[-1]})")
    return {name: [tuple(pair) for pair in found[name]] for name in WINDOW if found.get(name)}


def _blender(*arguments: str) -> str:
    user = f"BLENDER_USER_RESOURCES={_INSIDE}/user"
    command = [_TOOL, "run", "env", user, "blender", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=_LONGEST)
    return f"{done.stdout}{done.stderr}" or "no message"
