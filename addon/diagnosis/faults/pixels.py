"""Faults of a picture's file, and of what is laid over it.

No ray is asked: what is traced goes through the same, and is held against the picture.
"""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np

from ...arrays import Colors
from ...causes.case import Case
from ...images import curve_undone, encoded
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Fault, Guess
from .laid_over import LAID_OVER

QUALITIES = (95, 90, 85, 80, 75, 70, 60, 50, 40, 30)
FAINT = 0.1  # of an encoded channel: most of what a JPEG makes of a flat colour is off by less
JPEG_LEVELS = 8.0  # by how much two writers' pixels may differ: each rounds its own way


def _jpeg(colors: Colors, guess: Guess, evidence: Evidence) -> Colors:
    """Return a picture (h, w, 4) after it was stored as a JPEG, its alpha in another file."""
    from PIL import Image

    levels = np.rint(255 * encoded(colors)[::-1, :, :3]).astype(np.uint8)
    file = io.BytesIO()
    quality, sampling = (int(v) for v in guess.values)
    Image.fromarray(levels).save(file, "JPEG", quality=quality, subsampling=sampling)
    read = np.asarray(Image.open(file), np.float64)[::-1] / 255
    alpha = evidence.picture.color[..., 3:]
    return np.concatenate((curve_undone(read) * alpha, alpha), axis=-1, dtype=np.float32)


def _find_jpeg(evidence: Evidence) -> Work[list[Guess]]:
    """Return the quality whose errors are the nearest to the picture's, if it has 8 bits."""
    try:
        import PIL.Image  # noqa: F401
    except ImportError:  # an extra, which Blender lacks: nobody stores a reference as a JPEG
        return []
    if evidence.picture.levels not in (0, 255):
        return []
    shown = encoded(evidence.picture.color)[..., :3]
    traced = encoded(evidence.frame.color)[..., :3]
    if np.median(np.abs(traced - shown).max(axis=-1)[evidence.open]) > FAINT:
        return []  # other surfaces are shown

    def off(quality: int, sampling: int) -> tuple[float, Guess]:
        guess = Guess((float(quality), float(sampling)))
        made = encoded(_jpeg(evidence.frame.color, guess, evidence))[..., :3]
        return float(np.abs(made - shown).mean()), guess

    found: list[tuple[float, Guess]] = []
    for sampling in (2, 0):  # 4:2:0, 4:4:4
        for quality in QUALITIES:
            found.append(off(quality, sampling))
            yield 0.0
    near, sampling = (int(v) for v in min(found, key=lambda pair: pair[0])[1].values)
    for quality in range(near - 4, near + 5):
        found.append(off(quality, sampling))
        yield 0.0
    plain = float(np.abs(traced - shown).mean())
    error, best = min(found, key=lambda pair: pair[0])
    return [best] if error < plain / 2 else []


def _as_jpeg(case: Case, frame: Frame, guess: Guess) -> Case:
    """Allow for what two writers of a JPEG may differ by."""
    picture = replace(case.picture, levels=255, dither=JPEG_LEVELS, opaque=True)
    return replace(case, picture=picture)


PIXEL_FAULTS = (
    Fault(
        "jpeg",
        "the picture was stored as a JPEG of about quality {quality:.0f}",
        "store it as PNG or EXR",
        _as_jpeg,
        _find_jpeg,
        ("quality",),
        put_right=_as_jpeg,
        everywhere=True,
        sampled=False,
        after=_jpeg,
    ),
    LAID_OVER,
)
