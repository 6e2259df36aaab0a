"""Makes the pictures of docs/speed.md, and counts what its table says.

    python tools/draw_culling.py [SCENE.npz ...] [--width 1920] [--detail 8] [--out docs/images]

Writes culling.svg and depth_bins.svg: small scenes that the tracer's own sweep goes through. Prints
the table, as Markdown, of the scenes that are given (`reftrace export` makes them) and of two that
are built here.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from culling import cells, depth_bins, scenes
from culling.watched import count
from reference_tracer.scene import Scene
from reference_tracer.scene_files import load_scene
from reference_tracer.study.tradeoff import at_width

PROJECT = Path(__file__).resolve().parents[1]
COLUMNS = (
    "scene",
    "triangles",
    "with a pixel in their box",
    "not dropped whole",
    "pixels computed",
    "pairs tested",
    "bound (median)",
    "pixels decided",
    "pixels left",
    "by integers",
)


def row(name: str, scene: Scene) -> str:
    statistics, bounds = count(scene)
    culling, region = statistics.culling, scene.camera.region
    before = statistics.triangles, *(culling[k] for k in ("boxed", "reached", "computed"))
    after = region.width * region.height - culling["left"], culling["left"], culling["by_integers"]
    numbers = [f"{n:,}" for n in (*before, statistics.pairs_tested)]
    values = name, *numbers, f"{np.median(bounds):.0e}", *(f"{n:,}" for n in after)
    return f"| {' | '.join(values)} |"


def counted(files: list[Path], width: int, detail: int) -> Iterator[tuple[str, Scene]]:
    for file in files:
        yield f"`{file.stem}`", at_width(load_scene(file), width)
    height = max(1, width * 9 // 16)
    yield "a sphere", scenes.fine_sphere(width, height, detail)
    yield "64 spheres, one inside the other", scenes.nested_spheres(width, height, detail)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw and count what the sweep drops.")
    parser.add_argument("scenes", nargs="*", type=Path, metavar="SCENE.npz")
    parser.add_argument("--width", type=int, default=1920, metavar="PIXELS")
    parser.add_argument(
        "--detail", type=int, default=8, metavar="N", help="a sphere has 20 * 4^N triangles; >= 3"
    )
    parser.add_argument("--out", type=Path, default=PROJECT / "docs" / "images", metavar="DIR")
    options = parser.parse_args()
    (options.out / "culling.svg").write_text(cells.picture(), encoding="utf-8")
    (options.out / "depth_bins.svg").write_text(depth_bins.picture(), encoding="utf-8")
    print("|", " | ".join(COLUMNS), "|")
    print("|" + "---|" * len(COLUMNS))
    for name, scene in counted(options.scenes, options.width, options.detail):
        print(row(name, scene), flush=True)


if __name__ == "__main__":
    main()
