"""How long the installed extension takes to register, its imports included.

    .venv/bin/python tools/register_time.py    (after `make extension`)

In the bpy module and, where it is set up, in the whole Blender (tools/whole_blender.sh): each in a
process of its own, the first of which also compiles the files, as after an installation.
"""

import json
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
OUT = PROJECT / "out" / "register"
STARTS = 7  # after the first

PROBE = """
import json, sys, time
import bpy
before = set(sys.modules)
began, cpu = time.perf_counter(), time.process_time()
import bl_ext.user_default.reference_tracer as extension
extension.register()
seconds, cpu = time.perf_counter() - began, time.process_time() - cpu
new = set(sys.modules) - before
found = 1000 * seconds, 1000 * cpu, len(new), "numpy" in new
print("PROBE", json.dumps([bpy.app.version_string, *found]))
"""
INSTALL = """
import bpy
bpy.ops.extensions.package_install_files(
    filepath="{zip}", repo="user_default", enable_on_install=False
)
"""


def in_module(code: str) -> list[str]:
    """The command that runs code in the bpy module."""
    return ["env", f"BLENDER_USER_RESOURCES={OUT}/module", sys.executable, "-c", code]


def in_whole(code: str) -> list[str]:
    """The command that runs code in the whole Blender, which sees the project at /project."""
    user = f"BLENDER_USER_RESOURCES=/project/{OUT.relative_to(PROJECT)}/whole"
    run = [PROJECT / "tools" / "whole_blender.sh", "run", "env", "-u", "PYTHONDONTWRITEBYTECODE"]
    return [*run, user, "blender", "-b", "--factory-startup", "--python-expr", code]


def said(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, cwd="/")
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    return done.stdout


def measure(command_of, project: str) -> str:
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    said(command_of(INSTALL.format(zip=f"{project}/dist/{package.name}")))
    found = []
    for _ in range(1 + STARTS):
        line = next(s for s in said(command_of(PROBE)).splitlines() if s.startswith("PROBE"))
        found.append(json.loads(line.removeprefix("PROBE")))
    version, first, _, modules, numpy = found[0]
    wall, cpu = zip(*((ms, own) for _, ms, own, *_ in found[1:]), strict=True)
    return (
        f"Blender {version}: {statistics.median(wall):.0f} ms ({min(wall):.0f} to "
        f"{max(wall):.0f}; of the processor {statistics.median(cpu):.0f}; the first time "
        f"{first:.0f}), {modules} modules, {'with' if numpy else 'without'} numpy"
    )


if __name__ == "__main__":
    shutil.rmtree(OUT, ignore_errors=True)
    print(measure(in_module, str(PROJECT)), flush=True)
    if subprocess.run([PROJECT / "tools" / "whole_blender.sh", "ready"]).returncode == 0:
        print(measure(in_whole, "/project"))
