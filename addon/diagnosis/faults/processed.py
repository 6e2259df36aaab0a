"""The fault of a picture that was processed after rendering, as a photograph is.

JPEG, dithering, a white balance, a saturation, a look: what each has done is not asked. The colours
of all surfaces are off by a little, and each surface is where it is traced.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Array, Colors, Floats
from ...causes.checks.color import groups
from ...files.images import encoded
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import AnyFault, Effort, Fault, Numbers, unchanged
from .surfaces import Surfaces, surfaces

RECOLORED = 0.3  # of white, coded: a surface that is off by more has another colour
GREY = 0.01  # of white, coded: between the channels of a picture without hues
ALIKE = 0.8  # the least correlation of the surfaces' colours with the traced ones
# Of white, coded: by how much most pixels, and nearly all, may differ from their surface's colour.
# (A JPEG of quality 75 has 0.05 and 0.15, as it blurs edges.)
GRAIN = {0.9: 0.06, 0.98: 0.2}


@dataclass(frozen=True, eq=False)
class Processed(Numbers):
    """A picture with processed colours."""

    made: Colors = None  # type: ignore[assignment]


@at_once
def _find(evidence: Evidence) -> list[Processed]:
    """Guess by how much colours are off, if nearly all surfaces are, each by its own amount."""
    found = surfaces(evidence)
    if found is None or not found.nearly_all_wrong:
        return []
    apart = shades_apart(found.traced, found.shown)
    if apart is None:
        return []
    made, color = _mapped(evidence.frame.color, found), evidence.picture.color
    off = _off(made, color)
    size = float(np.quantile(off, max(GRAIN)))
    if not all(np.quantile(off, share) <= most for share, most in GRAIN.items()):
        return []
    made[off <= size] = color[off <= size]
    return [Processed((100 * max(apart, size),), made=made)]


def shades_apart(traced: Colors, shown: Colors) -> float | None:
    """Return how far k colours are apart as a file codes them; None if some are other colours."""
    first, second = (encoded(v.astype(np.float64))[:, :3] for v in (traced, shown))
    apart = float(np.abs(first - second).max())
    if float(np.max(np.ptp(second, axis=1))) <= GREY:
        # Without hues, brightness is compared (Rec. 709).
        first = np.repeat(first @ np.array((0.2126, 0.7152, 0.0722))[:, None], 3, axis=1)
    vary = np.ptp(first) and np.ptp(second)
    like = np.corrcoef(first.ravel(), second.ravel())[0, 1] if vary else 0.0
    return apart if np.abs(first - second).max() <= RECOLORED and like >= ALIKE else None


def _mapped(colors: Colors, found: Surfaces) -> Colors:
    """Return traced colours (h, w, 4) as the surfaces that have them are shown."""
    flat = np.concatenate((found.traced, colors.reshape(-1, 4)))
    number, count = groups(flat), len(found.traced)
    table: Array = np.zeros((int(np.max(number)) + 1, 4), colors.dtype)
    table[number] = flat
    table[number[:count]] = found.shown
    return table[number[count:]].reshape(colors.shape)


def _off(made: Colors, shown: Colors) -> Floats:
    """Return by how much colours (h, w, 4) differ as a file codes them, (h, w)."""
    first, second = (encoded(v.astype(np.float64))[..., :3] for v in (made, shown))
    return np.abs(first - second).max(axis=-1)


PROCESSED: tuple[AnyFault, ...] = (
    Fault(
        "processed",
        "the picture was processed after rendering: colours are up to {percent:.3g} % of white off",
        "A JPEG, dithering, a white balance, a saturation or a look, by Blender's color "
        "management or another program, which changed the colour of nearly every surface.",
        "store it as PNG or EXR as it was rendered; switch off color management's look and white "
        "balance, dithering, and what a viewer does to photographs",
        unchanged,
        _find,
        ("percent",),
        everywhere=True,
        sampled=False,
        vague=True,
        after=lambda colors, guess, evidence: guess.made,
        effort=Effort.ANYTHING,
        witness="tonyyxliu/CUHKSZ-CSC4005#71",
    ),
)
