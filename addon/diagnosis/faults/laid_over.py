"""The fault of something that is laid over a picture: a stamp, a watermark, a cursor, lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Colors, Floats, Index
from ...pictures.picture import straight
from ...tracer.progress import Work
from ..evidence import NEAR, Evidence, spread
from .fault import Effort, Fault, Numbers, Values, unchanged
from .filters import SRGB, Coding
from .recolor import alpha_divided, alpha_multiplied

# In which values it is laid over: straight linear ones, those of a file, or premultiplied ones,
# with an alpha of its own (Porter and Duff's "over").
CODINGS = (
    Coding(alpha_divided, alpha_multiplied, ", linear"),
    SRGB,
    Coding(np.asarray, np.asarray, ", premultiplied"),
)

LEAST_SURFACES = 2  # that an ink must cover: else it may be an object's colour
LEAST_COVERED = 0.02  # share of the covered pixels, for a surface to count
OPACITIES = np.arange(2, 101) / 100  # that are tried
MOST_INKS = 2  # colours that are laid over
INK_STEPS = 50  # quantisation of a channel, to count equal inks
FAR = 2.0  # the largest absolute value of a channel of an ink
COVERED = 0.9  # the least share of the unexplained pixels that the inks must explain
TOGETHER = 0.75  # the least share of pixels with neighbours: salt noise is no overlay
MOST_BLENDED = 4096  # sampled pixels


@dataclass(frozen=True, eq=False, kw_only=True)
class Overlay(Numbers):
    """What is laid over a picture; its numbers are the opacity and the first colour."""

    inks: Floats  # (k, 3) its colours
    where: Bools  # (h, w)
    coding: Coding


def _laid_over(colors: Colors, guess: Overlay, evidence: Evidence) -> Colors:
    """Lay the colours over a picture, in each pixel the one that comes nearest."""
    opacity, where = guess.values[0], guess.where
    into, back, _ = guess.coding
    shown = into(evidence.picture.color[where].astype(np.float64))
    under = into(colors[where].astype(np.float64))[:, None, :3]
    made = (1 - opacity) * under + opacity * guess.inks
    best = np.abs(made - shown[:, None, :3]).max(axis=-1).argmin(axis=1)
    out = colors.copy()
    mixed = made[np.arange(len(best)), best]
    out[where] = back(np.concatenate((mixed, shown[:, 3:]), axis=1))
    return out


def _find_overlay(evidence: Evidence) -> Work[list[Overlay]]:
    """Guess an opacity and few colours that make the unexplained pixels.

    They lie over several surfaces, or two of them fill a box, as a stamp's do. They may be mixed in
    linear values, or in those of a file.
    """
    if not _hangs_together(evidence.unexplained):
        return []
    found = []
    for coding in CODINGS:
        found += _in_values(evidence, coding)
        yield 0.0
    return found


def _in_values(evidence: Evidence, coding: Coding) -> list[Overlay]:
    rows, columns = np.nonzero(evidence.unexplained)
    (left, right), (bottom, top) = ((int(np.min(v)), int(np.max(v)) + 1) for v in (columns, rows))
    some = spread(np.ones(len(rows), bool), MOST_BLENDED)
    at = rows[some], columns[some]
    into, back, words = coding
    pictures = evidence.frame.color, evidence.picture.color
    traced, shown = (into(v[at].astype(np.float64))[:, :3] for v in pictures)
    if not np.isfinite(shown).all():
        return []
    under = np.unique(traced, axis=0, return_inverse=True)[1].reshape(-1)

    def linear(inks: Floats) -> Floats:
        return back(np.pad(inks, ((0, 0), (0, 1)), constant_values=1.0))[:, :3]

    best = max((_inks(traced, shown, under, o) for o in OPACITIES), key=lambda found: found[0])
    covered, opacity, inks = best
    boxed = len(rows) >= COVERED * (right - left) * (top - bottom)
    if covered < COVERED and boxed:
        covered, opacity, inks = _inks(traced, shown, under, 1.0, surfaces=1)
        own = _of_scene(evidence, linear(inks)).all() or len(inks) < MOST_INKS
    else:
        own = opacity > 1 - NEAR and _of_scene(evidence, linear(inks)).any()
    if covered < COVERED or own:
        return []
    numbers = (opacity, *inks[0].tolist())
    low, high = _as_likely(traced, shown, numbers)
    made = Overlay(
        numbers, low, high, inks=inks, where=evidence.unexplained, coding=coding, words=words
    )
    return [made]


def _as_likely(traced: Floats, shown: Floats, values: Values) -> tuple[Values, Values]:
    """Return the range of the opacity and of the first colour.

    Over one surface, an ink is as likely to be a stronger one that covers less.
    """
    if len(np.unique(traced, axis=0)) > 1:
        return values, values
    under, ink = traced[0], np.array(values[1:])
    darker = 1 - shown / np.maximum(under, 1e-12)
    brighter = (shown - under) / np.maximum(1 - under, 1e-12)
    least = float(np.clip(np.maximum(darker, brighter).max(), NEAR, 1.0))
    strong = (ink - (1 - least) * under) / least
    low, high = np.sort((ink, strong), axis=0).tolist()
    return (least, *low), (1.0, *high)


def _hangs_together(where: Bools) -> bool:
    """Return whether most pixels of a mask (h, w) have two neighbours, as in a drawing."""
    beside = -where.astype(np.int32)
    padded = np.pad(where, 1).astype(np.int32)
    for y in range(3):
        for x in range(3):
            beside += padded[y : y + where.shape[0], x : x + where.shape[1]]
    return bool((beside[where] >= 2).mean() > TOGETHER)


def _inks(
    traced: Floats, shown: Floats, under: Index, opacity: float, surfaces: int = LEAST_SURFACES
) -> tuple[float, float, Floats]:
    """Return the share of n pixels that few inks explain if laid over with an opacity.

    Also return the fitted opacity, and the inks (k, 3). Each must cover several surfaces; `under`
    (n,) numbers the surface beneath each pixel.
    """
    ink = (shown - (1 - opacity) * traced) / opacity
    step = np.rint(INK_STEPS * np.clip(ink, -FAR, FAR))
    number = step @ (4.0 * INK_STEPS * FAR) ** np.arange(3)  # one for each colour
    left = np.ones(len(ink), bool)
    owned: list[Bools] = []  # which pixels have the first ink, the second
    for _ in range(MOST_INKS):
        if not left.any():
            break
        _, first, count = np.unique(number[left], return_index=True, return_counts=True)
        common = step[left][first[np.argmax(count)]]
        own = left & (np.abs(ink - common / INK_STEPS).max(axis=1) <= 1 / INK_STEPS)
        left &= ~own
        several = (np.bincount(under[own]) >= LEAST_COVERED * len(traced)).sum() >= surfaces
        if several and common.min() >= -1 and common.max() <= INK_STEPS + 1:
            owned.append(own)
    if not owned:
        return 0.0, opacity, np.empty((0, 3))
    # The transparency, by least squares: how much of the surfaces beneath shows through.
    below, above = (
        np.concatenate([v[o] - v[o].mean(axis=0) for o in owned]) for v in (traced, shown)
    )
    apart = float((below * below).sum())
    if apart > NEAR:
        opacity = 1 - float((below * above).sum() / apart)
    if opacity <= 0:
        return 0.0, opacity, np.empty((0, 3))
    ink = (shown - (1 - opacity) * traced) / opacity
    covered = sum(int(own.sum()) for own in owned) / len(traced)
    return covered, opacity, np.array([np.median(ink[own], axis=0) for own in owned])


def _of_scene(evidence: Evidence, inks: Floats) -> Bools:
    """Return which of k colours (k, 3) occur in the scene, (k,)."""
    table = straight(evidence.case.scene.color_table)[:, None]
    return (np.abs(table - inks).max(axis=-1) <= NEAR).any(axis=0)


LAID_OVER = Fault(
    "overlay",
    "something is laid over the picture: opacity {opacity:.2f}, "
    "colour ({red:.3f}, {green:.3f}, {blue:.3f}){words}",
    "Blender can burn metadata into pictures, viewports draw overlays, and trial versions "
    "of programs a watermark.",
    "switch off stamps, overlays, watermarks and cursors",
    unchanged,
    _find_overlay,
    ("opacity", "red", "green", "blue"),
    effort=Effort.ANYTHING,
    sampled=False,
    vague=True,
    after=_laid_over,
)
