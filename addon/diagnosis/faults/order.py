"""Faults of the order in which surfaces are drawn, and of the picture's orientation."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from ...arrays import Colors, Floats
from ...causes.case import Case
from ...causes.checks.probe import SOUND, Probe
from ...scene import Scene
from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import plan
from ...tracer.progress import Work, result_of
from ...tracer.render import tiles
from ...tracer.shading import colors as colors_of
from ..evidence import Evidence
from .fault import AnyFault, Effort, Example, Fault, Option, always, unchanged, with_option

LAYERS = 64  # surfaces along a ray, at most
MOST = 2  # guesses, at most


def _quarter_turned(case: Case, quarters: int) -> Case | None:
    """Rotate the picture of a case anticlockwise; None if its size would change."""
    height, width = case.picture.color.shape[:2]
    if quarters % 2 and height != width:
        return None
    # The lowest row is the first: anticlockwise is clockwise in the array.
    where = np.rot90(np.indices((height, width)), -quarters, axes=(1, 2))
    return replace(case, picture=case.picture.moved(tuple(where)))


# Quarters of a turn anticlockwise.
_QUARTERS = {1: "90 degrees anticlockwise", 2: "180 degrees", 3: "90 degrees clockwise"}


# Orders of drawing (painter's algorithm), each instance over those before.
ORDERS = (
    "the farthest surface is seen, not the nearest",
    "objects are drawn one over the other, as they are listed",
    "objects are drawn one over the other, the last that is listed first",
)


def _ranks(scene: Scene, order: int, layer: int, hits: Hits) -> Floats:
    """Return the rank of n hits, some layers behind the nearest: what has a higher one is seen.

    Planes and the background are drawn first.
    """
    if order == 0:
        return np.full(len(hits), float(layer))
    listed = np.arange(len(scene.instances)) * (1.0 if order == 1 else -1.0)
    return np.append(listed, np.full(len(scene.planes) + 1, -np.inf))[hits.instance]


def _seen(probe: Probe, orders: Iterable[int]) -> Work[list[Colors]]:
    """Return the colours of n pixels in some orders."""
    scene = probe.scene
    hits = yield from probe.trace()
    colors = colors_of(scene, hits)
    out = [(colors.copy(), _ranks(scene, order, 0, hits), order) for order in orders]
    for layer in range(1, LAYERS + 1):
        hits = yield from probe.trace(after=hits)
        is_hit = hits.instance != NOTHING
        if not is_hit.any():
            break
        colors = colors_of(scene, hits)
        for seen, best, order in out:
            rank = _ranks(scene, order, layer, hits)
            over = is_hit & (rank > best)
            best[over], seen[over] = rank[over], colors[over]
    return [seen for seen, *_ in out]


def _orders(evidence: Evidence) -> Work[list[Option]]:
    """Guess the orders with which unexplained pixels of the sample have the right colours."""
    scene = evidence.case.scene
    probe = yield from evidence.probe(scene)
    every = yield from _seen(probe, range(len(ORDERS)))
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
    made = result_of(plan(scene, SOUND, 0.0))
    out = []
    for tile in tiles(scene.camera):
        probe = result_of(Probe.of(made, tile, np.ones(tile.width * tile.height, bool)))
        [colors] = result_of(_seen(probe, [guess.number]))
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
