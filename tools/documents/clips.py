"""The lessons' clips: each step that a plan tells, played in a real Blender window.

`tests/gui/lesson_stories.py` has the clicks; docs/images/lessons/clips gets a file a step, in which
a ring shows where the next click is.
"""

from __future__ import annotations

import json
import shutil
from itertools import groupby
from pathlib import Path

from PIL import Image, ImageDraw

from . import window

LESSONS = 4
SHOTS = window.PROJECT / "out" / "gui"
SIZE, RING = (880, 495), 14  # pixels
SHOWN, LAST = 1500, 3000  # milliseconds


def write(folder: Path) -> None:
    """Play the lessons, and write their clips.

    Raises
    ------
    RuntimeError
        If there is no whole Blender here, or a step fails.
    """
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    SHOTS.mkdir(parents=True, exist_ok=True)
    stories = [f"lesson_{number + 1}" for number in range(LESSONS)]
    script = "/project/tests/gui/play.py"
    window.blender("--python", script, "--", *stories, variables=["LESSON_CLIPS=1"])
    for story in stories:
        noted = json.loads((SHOTS / f"{story}.json").read_text(encoding="utf-8"))
        if "error" in noted:
            raise RuntimeError(noted["error"])
        for step, shots in groupby(noted["shots"], key=lambda shot: shot[1]):
            frames = [frame(SHOTS / f"{name}.png", place) for name, _, place in shots]
            last = {"duration": [*[SHOWN] * (len(frames) - 1), LAST], "loop": 0, "quality": 60}
            path = folder / f"{noted['lesson']}_{step}.webp"
            frames[0].save(path, save_all=True, append_images=frames[1:], **last)


def frame(shot: Path, place: tuple[int, int] | None) -> Image.Image:
    """Return a picture of the window, made small, with a ring around the next click."""
    whole = Image.open(shot).convert("RGB")
    small = whole.resize(SIZE, Image.Resampling.LANCZOS)
    if place:
        x, y = (part * SIZE[0] / whole.width for part in place)
        box = x - RING, y - RING, x + RING, y + RING
        ImageDraw.Draw(small).ellipse(box, outline=(255, 150, 30), width=3)
    return small
