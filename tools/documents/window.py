"""The tutorial's pictures, taken in a real Blender window: docs/images/tutorial.

`tour.py` is played in the whole Blender that `tools/whole_blender.sh` makes, with the extension of
dist/ installed by Blender itself; what it shows is cut out and made small. The page that it writes
is then opened in Chromium.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from reference_tracer.files.images import to_display

from . import browser

PROJECT = Path(__file__).resolve().parents[2]
OUT = PROJECT / "out" / "tutorial"
WINDOW, WIDTH = 1600, 1000  # pixels across the whole window, and what they are made
NAMES = "traced", "blender", "difference"
FRAME = 120  # milliseconds
AROUND, ZOOM, GAP = (8, 7), 19, 12  # pixels around the one that is enlarged, and how much


def write(folder: Path) -> None:
    """Play the tour, and write its pictures.

    Raises
    ------
    RuntimeError
        If there is no whole Blender here, or a step of the tour fails.
    """
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    install = "--command extension install-file -r user_default --enable"
    blender(*install.split(), f"/project/dist/{package.name}")
    script = "/project/tools/documents/tour.py"
    blender("--python-exit-code", "9", "--python", script, "--", "/project/out/tutorial")
    failed = OUT / "error.txt"
    if failed.exists():
        raise RuntimeError(failed.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    save(near(OUT), folder / "near.png")
    found = json.loads((OUT / "comparison.json").read_text(encoding="utf-8"))
    kept = {name: found[name] for name in ("pixels", "metrics", "verdict", "blender", "largest")}
    (folder / "comparison.json").write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    for shot in sorted(OUT.glob("*.png")):
        picture = Image.open(shot).convert("RGB")
        if picture.width == WINDOW:
            height = picture.height * WIDTH // picture.width
            picture = picture.resize((WIDTH, height), Image.Resampling.LANCZOS)
        save(picture, folder / shot.name)
    turning(sorted((OUT / "orbit").glob("*.png")), folder / "wrong_pixels.gif")
    x, y = found["metrics"]["largest_difference"]["pixel"]
    browser.save(OUT / "page.html", folder / "page.png", 1240, 960, f"#x={x}&y={y}", "pair")


def save(picture: Image.Image, path: Path) -> None:
    """Write a small PNG."""
    picture.quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)


def turning(shots: list[Path], path: Path) -> None:
    """Write an animation of some shots: their upper part, which has the words in its corner."""
    whole = [Image.open(shot).convert("RGB") for shot in shots]
    size = whole[0].width, whole[0].width
    frames = [p.crop((0, 0, *size)).quantize(32, dither=Image.Dither.NONE) for p in whole]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=FRAME, loop=0)


def near(folder: Path) -> Image.Image:
    """Return the pixels around the one that differs most: traced, as Blender shows them, why."""
    found = json.loads((folder / "comparison.json").read_text(encoding="utf-8"))
    x, y = found["metrics"]["largest_difference"]["pixel"]
    with np.load(folder / "images.npz") as images:
        height, width = images["traced"].shape[:2]
        left = min(max(x - AROUND[0], 0), width - 2 * AROUND[0] - 1)
        low = min(max(y - AROUND[1], 0), height - 2 * AROUND[1] - 1)
        rows = slice(low, low + 2 * AROUND[1] + 1)
        cuts = [images[n][rows, left : left + 2 * AROUND[0] + 1] for n in NAMES]
    out = Image.new("RGB", (len(cuts) * (cuts[0].shape[1] * ZOOM + GAP) - GAP, 15 * ZOOM), "white")
    for k, cut in enumerate(cuts):
        shown = to_display(cut)[::-1]
        # On black: a pixel that sees nothing may have a trace of its neighbour's colour.
        pixels = np.rint(shown[..., :3] * (shown[..., 3:] / 255)).astype(np.uint8)
        size = pixels.shape[1] * ZOOM, pixels.shape[0] * ZOOM
        part = Image.fromarray(pixels).resize(size, Image.Resampling.NEAREST)
        corner = (x - left) * ZOOM, size[1] - (y - low + 1) * ZOOM
        ImageDraw.Draw(part).rectangle(
            [*corner, corner[0] + ZOOM - 1, corner[1] + ZOOM - 1], outline=(255, 190, 60), width=3
        )
        out.paste(part, (k * (size[0] + GAP), 0))
    return out


def blender(*arguments: str, variables: Sequence[str] = ()) -> None:
    """Run the whole Blender, with variables in its environment, until it ends.

    Raises
    ------
    RuntimeError
        If it fails.
    """
    environment = "env", "BLENDER_USER_RESOURCES=/project/out/tutorial/user", *variables
    command = [PROJECT / "tools" / "whole_blender.sh", "run", *environment, "blender", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)}\n{done.stdout}{done.stderr}")
