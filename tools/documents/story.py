"""The README's moving picture: a renderer's picture with a wrong camera, and what is said of it.

The picture is traced with another focal length than the scene has. The words and counts are those
of the comparison and its diagnosis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from reference_tracer import Comparison, Scene, ViewWindow, compare, render
from reference_tracer.cli.opening import load
from reference_tracer.files.images import to_display

SCENE = Path(__file__).resolve().parents[2] / "sample_scenes" / "suzanne.blend"
ANGLES = 38, 40  # degrees: the picture's angle of view, and the scene's
WIDTH = 640  # pixels
CAPTION = 44  # pixels, below the picture
SECONDS = (2.0, 2.5, 4.0, 3.0)  # that each picture is shown
RED, GREEN = (230, 30, 30), (40, 160, 70)
DARK, WHITE = (24, 26, 30), (240, 240, 240)


def write(path: Path) -> None:
    """Write the animation, a GIF."""
    scene, _ = load(SCENE)
    found = compare(scene, render(_with_angle(scene)).color)
    frames = [_captioned(*shown) for shown in _pictures(found)]
    made = [frame.quantize(64, dither=Image.Dither.NONE) for frame in frames]
    length = [round(1000 * seconds) for seconds in SECONDS]
    made[0].save(path, save_all=True, append_images=made[1:], duration=length, loop=0)


def _with_angle(scene: Scene) -> Scene:
    """Return the scene with the camera of the wrong angle of view."""
    wrong, right = (np.tan(np.radians(angle) / 2) for angle in ANGLES)
    w, factor = scene.camera.window, wrong / right
    sides = (side * factor for side in (w.left, w.right, w.bottom, w.top))
    return scene.seen_by(replace(scene.camera, window=ViewWindow(*sides)))


def _pictures(found: Comparison) -> Sequence[tuple[NDArray[np.uint8], str, tuple[int, ...]]]:
    """Return the pictures, (h, w, 3) uint8 with row 0 on top, the words below, and their colour."""
    shown, traced = (_on_grey(c) for c in (found.picture, found.frame.color))
    wrong = (found.picture != found.frame.color).any(axis=-1)[::-1]
    assert found.diagnosis is not None
    [told] = found.diagnosis.told
    count, words = found.counts.unexplained, told.sentence.partition(";")[0]  # what fits
    return [
        (shown, "A renderer's picture of your scene. Is it right?", WHITE),
        (_tinted(shown, wrong, RED), f"No: {count:,} pixels show something else.", RED),
        (_tinted(shown, wrong, RED), f"{words[0].upper()}{words[1:]}.", RED),
        (
            _tinted(traced, wrong, GREEN),
            f"Put right: {told.settled:,} of {told.unexplained:,} agree, pixel by pixel.",
            GREEN,
        ),
    ]


def _on_grey(color: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Return linear RGBA as it is shown on a dark ground."""
    shown = to_display(color)[::-1].astype(float)
    alpha = shown[..., 3:] / 255
    return np.rint(shown[..., :3] * alpha + np.array(DARK) * (1 - alpha)).astype(np.uint8)


def _tinted(
    picture: NDArray[np.uint8], where: NDArray[np.bool_], color: tuple[int, ...]
) -> NDArray[np.uint8]:
    """Return a picture, paler, with some pixels in a colour."""
    out = picture // 2 + 40
    out[where] = color
    return out


def _captioned(picture: NDArray[np.uint8], words: str, color: tuple[int, ...]) -> Image.Image:
    """Return a picture with words below it."""
    own = Image.fromarray(picture)
    height = own.height * WIDTH // own.width
    out = Image.new("RGB", (WIDTH, height + CAPTION), DARK)
    out.paste(own.resize((WIDTH, height), Image.Resampling.LANCZOS), (0, 0))
    font = ImageFont.load_default(18)
    ImageDraw.Draw(out).text((14, height + 11), words, font=font, fill=color)
    return out


if __name__ == "__main__":
    write(Path(__file__).resolve().parents[2] / "docs" / "images" / "diagnosis.gif")
