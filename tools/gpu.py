"""How well a rasteriser agrees with the tracer, for each of Blender's backends: one table.

    make test-gpu                            the bpy module, which draws with OpenGL
    make test-gpu BLENDER=/path/to/blender   that Blender, with OpenGL and with Vulkan

No window is needed. That Blender gets the extension, in a folder for this run alone. The exit code
is 1 if a pixel is unexplained, or nothing could be drawn.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from matrix import table

PROJECT = Path(__file__).resolve().parents[1]
CHILD = PROJECT / "tools" / "gpu_child.py"
HEAD = (
    "Blender",
    "backend",
    "device",
    "driver",
    "snapping",
    "pixels",
    "differ",
    "differ drawn twice",
    "unexplained",
)
LONGEST = 1800  # seconds
INSTALL = "--command", "extension", "install-file", "-r", "user_default", "--enable"


def ran(command: list[str], user: str) -> str:
    """Run a Blender with a folder for what is a user's; return what it prints."""
    environment = os.environ | {"BLENDER_USER_RESOURCES": user}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=LONGEST, env=environment
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    return done.stdout + done.stderr


def found_by(command: list[str], user: str) -> dict[str, Any] | str:
    """Return what a Blender has found, or the end of what it says instead."""
    lines = ran(command, user).strip().splitlines()
    rows = [line[4:] for line in lines if line.startswith("ROW ")]
    return json.loads(rows[0]) if rows else "\n".join(lines[-5:])


def words(found: dict[str, Any]) -> list[str]:
    """Return the table's words of it."""
    return [
        *(found[name] for name in ("blender", "backend", "device", "driver")),
        f"1/{1 / found['snapping']:g} px",
        *(f"{found[name]:,}" for name in ("pixels", "differ")),
        *(
            ", ".join(f"{n} in {name}" for name, n in found[kind].items() if n) or "0"
            for kind in ("unsteady", "unexplained")
        ),
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--blender", default="", help="a Blender; by default the bpy module")
    parser.add_argument("scenes", nargs="*", help="names of sample scenes; by default all")
    options = parser.parse_args()
    scenes = options.scenes or sorted(p.stem for p in (PROJECT / "sample_scenes").glob("*.blend"))
    commands = {"OPENGL": [sys.executable, str(CHILD), "--", *scenes]}
    rows, well = [], True
    with tempfile.TemporaryDirectory() as user:
        if options.blender:
            [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
            ran([options.blender, *INSTALL, str(package)], user)
            child = "--python", str(CHILD), "--", *scenes
            commands = {
                name: [options.blender, "-b", "--gpu-backend", name.lower(), *child]
                for name in ("OPENGL", "VULKAN")
            }
        for backend, command in commands.items():
            found = found_by(command, user)
            if isinstance(found, str):
                print(f"{backend}: not drawn:\n{found}", file=sys.stderr)
            elif found["backend"] != backend:
                print(f"{backend} is not there: Blender took {found['backend']}", file=sys.stderr)
            else:
                rows.append(words(found))
                well &= not any(found["unexplained"].values())
    print(f"\n{platform.system()} {platform.release()}, {platform.machine()}\n")
    print(table(rows, HEAD), end="")
    return not (rows and well)


if __name__ == "__main__":
    sys.exit(main())
