"""Faults that mix neighbouring colours: several samples a pixel, and any filter.

A mean of samples is what it is: it is traced, and held against the picture. Of any other filter no
more is known than how far it reaches, so it is reported if no mean does as well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from ...arrays import Colors
from ...causes.case import Case
from ...causes.cause import UNEXPLAINED
from ...causes.explain import explain
from ...tracer import shading
from ...tracer.progress import Work
from ..evidence import NOISE, Evidence, shows_colors
from .fault import AnyFault, Effort, Fault, Guess, Numbers
from .matching import touched_parts
from .sizes import CODINGS, Coding, at_size, sampled_right

RADII = (0.5, 0.75, 1.0, 1.5, 2.0)  # of filters that are tried, in pixels
PARTS = 0.8  # of the picture's parts with edges: in as many must some be mixed
MOST_COLORS = 64  # of a scene: of more, a mix has one
MIXED = 0.5  # the least share of unexplained pixels that must show no colour of the scene
ASKED = 48  # differing pixels: a filter is tried if it explains nearly all of these
MEANS = (2, 3, 4)  # samples each way
MOST_SAMPLES = 1 << 24  # of a picture that is traced with several a pixel


def _shows_mixes(evidence: Evidence) -> bool:
    """Return whether most unexplained pixels show no colour of the scene, or it has very many."""
    colors = np.unique(evidence.case.scene.color_table, axis=0)
    pure = shows_colors(evidence.shown, colors[:MOST_COLORS])[evidence.unexplained_sampled]
    return bool(len(colors) > MOST_COLORS or pure.mean() <= 1 - MIXED)


# ---- several samples a pixel


@dataclass(frozen=True, eq=False)
class Mean(Guess):
    """A mean of n x n samples, and in which values it is taken."""

    n: int
    coding: Coding


def _supersampled(case: Case, guess: Mean) -> Case | None:
    """Return the case traced at n times its size."""
    n, region = guess.n, case.scene.camera.region
    return None if n * n * region.width * region.height > MOST_SAMPLES else at_size(case, n)


def _mean_of_samples(colors: Colors, guess: Mean, evidence: Evidence) -> Colors:
    """Return the mean of n x n pixels, (h, w, 4), of a picture that is n times as large."""
    n, (height, width) = guess.n, evidence.unexplained.shape
    coded = guess.coding.into(colors).astype(np.float64).reshape(height, n, width, n, 4)
    return guess.coding.back(coded.mean(axis=(1, 3))).astype(np.float32)


def _find_samples(evidence: Evidence) -> Work[list[Mean]]:
    """Guess of how many samples each pixel is the mean, by the sampled pixels."""
    if not _shows_mixes(evidence):
        return []
    scene, out = evidence.case.scene, []
    probe = yield from evidence.probe(scene, reach=0.75)
    for n in MEANS:
        places = [((i + 0.5) / n - 0.5) for i in range(n)]
        seen = []
        for dx, dy in product(places, repeat=2):
            hits = yield from probe.trace(dx, dy)
            seen.append(shading.colors(scene, hits).astype(np.float64))
        for coding in CODINGS:
            mean = np.mean([coding.into(colors) for colors in seen], axis=0)
            if sampled_right(evidence, coding.back(mean)):
                out.append(Mean(n, coding, words=coding.words, values=(float(n),)))
    return out


# ---- any filter


def _filtered(case: Case, guess: Numbers) -> Case:
    sampling = replace(case.picture.sampling, filter_radius=guess.values[0])
    return replace(case, picture=replace(case.picture, sampling=sampling))


def _find_filter(evidence: Evidence) -> Work[list[Numbers]]:
    """Guess the least radius beyond the picture's own that explains some pixels, and the next."""
    own = evidence.picture.sampling.filter_radius  # by which most are mixed already
    # A picture that is blurred in a part has crisp edges in the others.
    if not (_shows_mixes(evidence) and (own or touched_parts(evidence) >= PARTS)):
        return []
    larger = [r for r in RADII if r > own]
    fits: list[float] = []
    for r in reversed(larger):
        case = _filtered(evidence.case, Numbers((r,)))
        found = yield from explain(case, evidence.frame, ASKED)
        if (found.causes.cause == UNEXPLAINED).sum() > NOISE * ASKED:
            break
        fits = [r, *fits]
    return [Numbers((r,), (r,), (r,)) for r in fits[:2]]


FILTER_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "supersampled",
        "each pixel is the mean of {n:.0f} x {n:.0f} samples within it{words}",
        "The renderer smooths edges by a grid of samples in each pixel.",
        "render one sample in each pixel's centre, or compare with --excuse filter=0.75",
        _supersampled,
        _find_samples,
        ("n",),
        everywhere=True,
        sampled=False,
        after=_mean_of_samples,
        effort=Effort.PIXELS,
        witness="Unity-Technologies/com.unity.perception#441",
    ),
    Fault(
        "filter_radius",
        "the picture is filtered: its pixels mix what is within {radius:g} px",
        "Renderers weight samples by a filter that reaches beyond the pixel: Cycles' is "
        "1.5 px wide by default.",
        "render one sample in each pixel's centre, or compare with --excuse filter={radius:g}",
        _filtered,
        _find_filter,
        ("radius",),
        everywhere=True,
        sampled=False,
        effort=Effort.ANYTHING,
        vague=True,
        witness="GPUOpen-LibrariesAndSDKs/RadeonProRenderBlenderAddon#17",
    ),
)
