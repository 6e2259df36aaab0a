"""Faults of the order in which surfaces are drawn, and of the picture's orientation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...arrays import Colors, Floats
from ...causes.case import Case
from ...causes.checks.probe import SOUND, Probe
from ...scene import Scene
from ...tracer.hits import NOTHING
from ...tracer.nearest import plan
from ...tracer.progress import Work, result_of
from ...tracer.shading import colors as colors_of
from ..evidence import Evidence
from .fault import AnyFault, Effort, Example, Fault, Option, always, unchanged, with_option

LAYERS = 64  # surfaces along a ray, at most
MOST = 2  # guesses, at most
BLOCK = 1 << 14  # pixels that are drawn together


def _quarter_turned(case: Case, quarters: int) -> Case | None:
    """Rotate the picture of a case anticlockwise; None if its size would change."""
    height, width = case.picture.color.shape[:2]
    if quarters % 2 and height != width:
        return None
    rows, columns = np.mgrid[:height, :width]
    # The lowest row is the first: anticlockwise is clockwise in the array.
    where = np.rot90(rows, -quarters), np.rot90(columns, -quarters)
    return replace(case, picture=case.picture.moved(where))


# Quarters of a turn anticlockwise.
_QUARTERS = {1: "90 degrees anticlockwise", 2: "180 degrees", 3: "90 degrees clockwise"}


# Orders of drawing (painter's algorithm), each instance over those before; the first has no ranks.
ORDERS = (
    "the farthest surface is seen, not the nearest",
    "objects are drawn one over the other, as they are listed",
    "objects are drawn one over the other, the last that is listed first",
)


def _ranks(scene: Scene, order: int) -> Floats | None:
    """Return the rank of each instance, then of planes and background, which are drawn first."""
    if order == 0:
        return None
    listed = np.arange(len(scene.instances), dtype=np.float64)
    of = listed if order == 1 else -listed
    return np.concatenate((of, np.full(len(scene.planes) + 1, -np.inf)))


def _seen(probe: Probe, ranks: Sequence[Floats | None]) -> Work[list[Colors]]:
    """Return the colours of n pixels in some orders; without ranks, of the farthest surface."""
    scene = probe.scene
    hits = yield from probe.trace()
    colors = colors_of(scene, hits)
    out = [colors.copy() for _ in ranks]
    best = [None if of is None else of[hits.instance] for of in ranks]
    for _ in range(LAYERS):
        hits = yield from probe.trace(after=hits)
        if not (hits.instance != NOTHING).any():
            break
        colors = colors_of(scene, hits)
        for seen, rank, of in zip(out, best, ranks, strict=True):
            over = hits.instance != NOTHING
            if rank is not None and of is not None:
                over &= of[hits.instance] > rank
                rank[over] = of[hits.instance[over]]
            seen[over] = colors[over]
    return out


def _orders(evidence: Evidence) -> Work[list[Option]]:
    """Guess the orders with which unexplained pixels of the sample have the right colours."""
    scene = evidence.case.scene
    probe = yield from evidence.probe(scene)
    every = yield from _seen(probe, [_ranks(scene, n) for n in range(len(ORDERS))])
    out = []
    for number, colors in enumerate(every):
        right = ~evidence.shown.other_color(colors)
        if right.sum() >= evidence.least_right():
            score = evidence.scored(right)
            out.append((score.gain, Option(number, words=ORDERS[number])))
    return [guess for _, guess in sorted(out, key=lambda pair: -pair[0])[:MOST]]


def _drawn(traced: Colors, guess: Option, evidence: Evidence) -> Colors:
    """Draw the whole picture in another order, (h, w, 4)."""
    scene = evidence.case.scene
    region, ranks = scene.camera.region, _ranks(scene, guess.number)
    made = result_of(plan(scene, SOUND, 0.0))
    rows = max(1, BLOCK // region.width)
    out = []
    for y in range(region.y0, region.y1, rows):
        tile = replace(region, y0=y, y1=min(y + rows, region.y1))
        probe = result_of(Probe.of(made, tile, np.ones(tile.width * tile.height, bool)))
        [colors] = result_of(_seen(probe, [ranks]))
        out.append(colors.reshape(tile.height, tile.width, 4))
    return np.concatenate(out)


ORDER_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "picture_turned",
        "the picture is turned by {words}",
        "Arrays are indexed by row and column, pictures by x and y. Some viewers apply "
        "the orientation that a photo stores, others don't.",
        "check the order of its rows and columns: both are reversed, or one is taken for the other",
        lambda case, guess: _quarter_turned(case, -guess.number),
        always(*(Option(n, words=words) for n, words in _QUARTERS.items())),
        effort=Effort.VIEW,  # with turned rows, which show the same of what is symmetric
        turns=True,
        examples=(
            Example(
                "turned_picture",
                "the picture upside down",
                with_option(2),
                lambda case, guess: _quarter_turned(case, guess.number),
            ),
        ),
        words="90 or 180 degrees",
        witness="alan-turing-institute/monitoring-ecosystem-resilience#459",
    ),
    Fault(
        "depth_order",
        "{words}",
        "The depth test is off or reversed, or objects are sorted and drawn over one another, "
        "as transparent ones are.",
        "keep the nearest depth of every pixel: what is nearer than that is drawn, nothing else",
        unchanged,
        _orders,
        after=_drawn,
        sampled=False,
        effort=Effort.ANYTHING,
        words="the farthest surface is seen, or objects are drawn one over the other in some order",
        witness="mrdoob/three.js#12737",
    ),
)
