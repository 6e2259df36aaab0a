"""Finds what a page shows beside the comparison.

These are the literal textbook's picture, the derivations of the examples, and the studies that were
asked for. If one would take too long, it is left out, and a sentence says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..arrays import Colors
from ..derivation.derivation import Derivation, derive
from ..methods import Method
from ..rendering import frame_of
from ..study import extremes, tradeoff
from ..study.trade import Trade
from ..tracer.progress import Progress, Work, scaled
from ..tracer.settings import Settings
from .comparison import Comparison

LITERAL_SECONDS = 10.0  # of the textbook's picture: a literal one takes as long again
DERIVED = 3  # examples of each cause that are derived
DERIVED_TRIANGLES = 3_000_000  # in the scene: each derivation looks at all of them


@dataclass(frozen=True, eq=False)
class Extras:
    """Studies that a page shows beside a comparison; None where they were not made."""

    trade: Trade | None = None
    extremes: Sequence[extremes.ExtremesRow] | None = None
    literal: Colors | None = None  # (h, w, 4) by the textbook's test as printed
    derivations: dict[tuple[int, int], Derivation] = field(default_factory=dict)  # by pixel (x, y)
    left_out: tuple[str, ...] = ()  # sentences: what the page does not have, and why


# The words for the work on a field, where the work has none of its own.
MEANWHILE = {
    "literal": "tracing by the textbook, literally",
    "derivations": "deriving examples",
}


def extras(
    comparison: Comparison,
    measure_trade: bool = False,
    measure_extremes: bool = False,
    literal: bool = True,
) -> Work[Extras]:
    """Find out what a page shows beside a comparison.

    Without `literal`, as in an animation, the literal textbook's picture is left out.
    """
    left_out: list[str] = []
    works: dict[str, tuple[Work[object], float]] = {}  # each field's, and its share, roughly
    if literal:
        works["literal"] = _literal(comparison, left_out), 1.0
    else:
        left_out.append("The literal textbook's picture: the pages of frames do without it.")
    works["derivations"] = _derivations(comparison, left_out), 0.5
    if measure_trade:
        measuring = tradeoff.measure(comparison.scene, name=comparison.manifest.file)
        works["trade"] = measuring, 6.0
    if measure_extremes:
        works["extremes"] = extremes.measure(), 12.0
    total = sum(share for _, share in works.values())
    done = 0.0
    found: dict[str, Any] = {}
    for name, (work, share) in works.items():
        words = MEANWHILE.get(name, "")
        found[name] = yield from scaled(work, done / total, share / total, words)
        done += share
    return Extras(**found, left_out=tuple(left_out))


def _literal(comparison: Comparison, left_out: list[str]) -> Work[Colors | None]:
    """Return the colours that the textbook taken literally sees, unless that takes long."""
    if (known := comparison.literal) is not None:  # the background may be another since
        return np.where(np.isnan(known), comparison.scene.background, known)
    row = next((r for r in comparison.methods if r.method == Method.TEXTBOOK.value), None)
    if row and row.seconds > LITERAL_SECONDS:
        left_out.append(
            f"The literal textbook's picture: the textbook takes {row.seconds:.0f} s here, and "
            f"it would take as long again (more than {LITERAL_SECONDS:.0f} s)."
        )
        return None
    frame = yield from frame_of(comparison.scene, Settings(Method.TEXTBOOK_LITERAL))
    return frame.color


def _derivations(
    comparison: Comparison, left_out: list[str]
) -> Work[dict[tuple[int, int], Derivation]]:
    """Derive the first examples of each cause, exactly too."""
    scene = comparison.scene
    found: dict[tuple[int, int], Derivation] = {}
    if scene.triangle_count > DERIVED_TRIANGLES:
        left_out.append(
            f"The exact derivations of examples: the scene has {scene.triangle_count:,} triangles. "
            "reftrace explain writes that of any pixel."
        )
        return found
    wanted = [p for some in comparison.counts.examples.values() for p in some[:DERIVED]]
    for number, (x, y) in enumerate(wanted):
        found[x, y] = derive(scene, x, y, source=comparison.manifest.file)
        yield Progress(number / len(wanted))
    return found
