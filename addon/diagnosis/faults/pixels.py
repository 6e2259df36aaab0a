"""Faults of a picture's file, and of what is laid over it.

No ray is asked: what is traced goes through the same, and is held against the picture.
"""

from __future__ import annotations

import io
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Colors
from ...causes.case import Case
from ...images import curve_undone, encoded
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Fault, Guess, Values
from .laid_over import LAID_OVER

QUALITIES = (95, 90, 85, 80, 75, 70, 60, 50, 40, 30)
FAINT = 0.1  # of an encoded channel: most of what a JPEG makes of a flat colour is off by less
JPEG_LEVELS = 8.0  # by how much two writers' pixels may differ: each rounds its own way


@dataclass(frozen=True, eq=False)
class Jpeg(Guess):
    """How a JPEG was written."""

    quality: int
    sampling: int  # of its colours, as Pillow has it: 0 is 4:4:4, 2 is 4:2:0

    @property
    def values(self) -> Values:
        """The quality."""
        return (float(self.quality),)


def _jpeg(colors: Colors, guess: Jpeg, evidence: Evidence) -> Colors:
    """Store a picture (h, w, 4) as a JPEG and read it again; its alpha is the given picture's."""
    from PIL import Image

    levels = np.rint(255 * encoded(colors)[::-1, :, :3]).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(levels).save(file, "JPEG", quality=guess.quality, subsampling=guess.sampling)
    read = np.asarray(Image.open(file), np.float64)[::-1] / 255
    alpha = evidence.picture.color[..., 3:]
    return np.concatenate((curve_undone(read) * alpha, alpha), axis=-1, dtype=np.float32)


def _find_jpeg(evidence: Evidence) -> Work[list[Jpeg]]:
    """Guess the quality whose errors come nearest to the picture's, if it has 8 bits."""
    try:
        import PIL.Image  # noqa: F401
    except ImportError:  # the extra `jpeg`, which Blender lacks
        return []
    if evidence.picture.storage.levels not in (0, 255):
        return []
    shown = encoded(evidence.picture.color)[..., :3]
    traced = encoded(evidence.frame.color)[..., :3]
    if np.median(np.abs(traced - shown).max(axis=-1)[evidence.unexplained]) > FAINT:
        return []  # other surfaces are shown

    def off(quality: int, sampling: int) -> tuple[float, Jpeg]:
        guess = Jpeg(quality, sampling)
        made = encoded(_jpeg(evidence.frame.color, guess, evidence))[..., :3]
        return float(np.abs(made - shown).mean()), guess

    found: list[tuple[float, Jpeg]] = []
    for sampling in (2, 0):
        for quality in QUALITIES:
            found.append(off(quality, sampling))
            yield 0.0
    near = min(found, key=lambda pair: pair[0])[1]
    for quality in range(near.quality - 4, near.quality + 5):
        found.append(off(quality, near.sampling))
        yield 0.0
    plain = float(np.abs(traced - shown).mean())
    error, best = min(found, key=lambda pair: pair[0])
    return [best] if error < plain / 2 else []


def _as_jpeg(case: Case, guess: Jpeg) -> Case:
    """Allow the tolerance between two writers of JPEGs."""
    storage = replace(case.picture.storage, levels=255, dither=JPEG_LEVELS, opaque=True)
    return replace(case, picture=replace(case.picture, storage=storage))


PIXEL_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "jpeg",
        "the picture was stored as a JPEG of about quality {quality:.0f}",
        "Programs that send or show pictures store them as JPEG, which changes all blocks of 8 "
        "x 8 pixels.",
        "store it as PNG or EXR",
        _as_jpeg,
        _find_jpeg,
        ("quality",),
        everywhere=True,
        sampled=False,
        after=_jpeg,
    ),
    LAID_OVER,
)
