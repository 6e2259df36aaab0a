"""What certainty costs: certified against the plain methods, whole frames of sample scenes.

    python benchmarks/certified.py [SCENE ...] [--repeats N] [--width PIXELS] [--out DIR]

Each round renders every method once, in turn, so that a slow moment of the machine is shared; a
ratio is that of two frames of one round. Prints their median with the smallest and the largest,
and writes certified.json.
"""

from __future__ import annotations

import argparse
import json
import platform
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

import numpy as np
from reference_tracer.scene import Scene
from reference_tracer.scene_files import load_scene
from reference_tracer.study.tradeoff import at_width
from reference_tracer.tracer.render import render
from reference_tracer.tracer.settings import Method, Settings

PROJECT = Path(__file__).resolve().parent.parent
SCENES = "suzanne", "forest", "far_away"
BASE = Settings(Method.MOLLER_TRUMBORE)
CHOICES = (BASE, Settings(Method.TEXTBOOK), Settings(Method.WATERTIGHT), Settings(Method.CERTIFIED))


def exported(name: str, out: Path) -> Scene:
    """A sample scene, exported anew where its .blend has changed."""
    source, target = PROJECT / "sample_scenes" / f"{name}.blend", out / f"{name}.npz"
    if not target.is_file() or target.stat().st_mtime < source.stat().st_mtime:
        command = [sys.executable, "-m", "reference_tracer.cli", "export", source, "--out", target]
        subprocess.run(command, check=True, capture_output=True)
    return load_scene(target)


def measured(name: str, scene: Scene, repeats: int) -> dict:
    seconds: dict[str, list[float]] = {c.method.value: [] for c in CHOICES}
    required: list[str] = []
    for settings in CHOICES:  # once in vain, to warm up
        frame = render(scene, settings)
        if settings.method == Method.CERTIFIED:
            required = frame.statistics.required()
    for number in range(repeats):
        for settings in CHOICES if number % 2 == 0 else CHOICES[::-1]:
            began = time.perf_counter()
            render(scene, settings)
            seconds[settings.method.value].append(time.perf_counter() - began)
    base = seconds[BASE.method.value]
    rows = {}
    for method, taken in seconds.items():
        ratios = [t / b for t, b in zip(taken, base, strict=True)]
        rows[method] = {
            "seconds": median(taken),
            "ratio": median(ratios),
            "ratio_least": min(ratios),
            "ratio_most": max(ratios),
        }
    camera = scene.camera
    return {
        "scene": name,
        "width": camera.width,
        "height": camera.height,
        "triangles": scene.triangle_count,
        "required": required,
        "methods": rows,
    }


def show(found: dict) -> None:
    print(
        f"\n{found['scene']}, {found['width']} x {found['height']} pixels, "
        f"{found['triangles']:,} triangles"
    )
    for method, row in found["methods"].items():
        print(
            f"  {method:<17}{row['seconds']:>8.3f} s   x {row['ratio']:.2f}  "
            f"({row['ratio_least']:.2f} - {row['ratio_most']:.2f})"
        )
    for line in found["required"]:
        print(f"  {line}")


def main() -> None:
    parser = argparse.ArgumentParser(description="What certainty costs, on whole frames.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"default {' '.join(SCENES)}")
    parser.add_argument("--repeats", type=int, default=5, metavar="N")
    parser.add_argument("--width", type=int, metavar="PIXELS", help="default the scene's own")
    parser.add_argument("--out", type=Path, default=PROJECT / "out" / "bench", metavar="DIR")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    print(f"all in float64, against {BASE.method.value}; {options.repeats} rounds")
    scenes = []
    for name in options.scenes or SCENES:
        scene = exported(name, options.out)
        scene = at_width(scene, options.width or scene.camera.width)
        scenes.append(measured(name, scene, options.repeats))
        show(scenes[-1])
    result = {
        "schema": "reference_tracer.bench.certified/1",
        "python": platform.python_version(),
        "numpy": np.__version__,
        "machine": platform.machine(),
        "rounds": options.repeats,
        "scenes": scenes,
    }
    target = options.out / "certified.json"
    target.write_text(json.dumps(result, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    print(f"\nwritten to {target}")


if __name__ == "__main__":
    main()
