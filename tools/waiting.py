"""Measures what a user waits for: CPU seconds and memory of commands, beside another checkout.

    .venv/bin/python tools/waiting.py OTHER [--rounds N] [--only WORD...]

OTHER is a checkout with a `.venv` of its own, as an older commit in a worktree. The commands run
in turns there and here; each one's least CPU seconds (user and system) of N rounds count, so that
ratios hold on a machine that others use, too. Prints a table.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
REGISTER = "import bpy; from reference_tracer.blender import registration; registration.register()"
SCENE = "sample_scenes/suzanne.blend"
COMPARE = ["compare", SCENE]
# What a comparison has Blender do: open the scene, draw a small picture to see how its rasteriser
# rounds, one of the colours and one of the objects; like for like, as floats that are not packed.
BLENDER = """
import sys, bpy
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
render = bpy.context.scene.render
height, width = render.resolution_y, render.resolution_x
display = bpy.context.scene.display
display.render_aa, display.shading.light = "OFF", "FLAT"
display.shading.show_shadows = display.shading.show_cavity = False
render.engine = "BLENDER_WORKBENCH"
render.film_transparent = True
output = render.image_settings
output.file_format, output.color_mode, output.color_depth = "OPEN_EXR", "RGBA", "32"
output.exr_codec = "NONE"
render.filepath = sys.argv[-1] + "/picture"
for size in (48, int(sys.argv[2]), int(sys.argv[2])):
    render.resolution_x, render.resolution_y = size, height * size // width
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(render.filepath + ".exr")
    image.pixels[0]
    bpy.data.images.remove(image)
"""
COMMANDS: dict[str, list[str]] = {
    "Blender alone: `import bpy`": ["-c", "import bpy"],
    "the add-on registered": ["-c", REGISTER],
    "Blender alone: `compare`'s pictures": ["-c", BLENDER, SCENE, "960"],
    "`compare`": COMPARE,
    "Blender alone: `compare --set width=1920`'s pictures": ["-c", BLENDER, SCENE, "1920"],
    "`compare --set width=1920`": [*COMPARE, "--set", "width=1920"],
    "`compare --self-check`": [*COMPARE, "--self-check"],
    "`compare --frames 1`": [*COMPARE, "--frames", "1"],
    "`compare --frames 1-2`": [*COMPARE, "--frames", "1-2"],
    "`trade`": ["trade", SCENE],
    "`extremes`": ["extremes"],
}


def used(checkout: Path, command: list[str]) -> tuple[float, float]:
    """Return a command's CPU seconds and its peak memory in MB."""
    with tempfile.TemporaryDirectory() as out:
        run = ["-m", "reference_tracer.cli", *command, "--out", out]
        process = subprocess.Popen(
            [checkout / ".venv/bin/python", *([*command, out] if command[0] == "-c" else run)],
            cwd=checkout,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"},
        )
        _, status, usage = os.wait4(process.pid, 0)
        if os.waitstatus_to_exitcode(status) not in (0, 1):  # 1: it agrees, with warnings
            raise SystemExit(f"{checkout}: {' '.join(command)} fails")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main() -> None:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("other", type=Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", nargs="*", default=[""])
    given = parser.parse_args()
    checkouts = given.other.resolve(), HERE
    print("| command | CPU s before | now | ratio | MB before | now |\n|---|---|---|---|---|---|")
    for name, command in COMMANDS.items():
        if not any(word in name for word in given.only):
            continue
        rounds = [[used(c, command) for c in checkouts] for _ in range(given.rounds)]
        (old, old_mb), (new, new_mb) = (
            [min(values) for values in zip(*of, strict=True)] for of in zip(*rounds, strict=True)
        )
        print(f"| {name} | {old:.2f} | {new:.2f} | {new / old:.2f} | {old_mb:.0f} | {new_mb:.0f} |")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
