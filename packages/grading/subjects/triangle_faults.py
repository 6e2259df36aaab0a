"""Why a ray/triangle test is wrong, where no wrong program gives all of its answers.

Hits, t and barycentrics are looked at apart: one may be wrong where the others are right. A test
yields a name and a sentence only where the cases say so beyond chance: those that the fault would
spoil are wrong, nearly all, and others, which it would leave alone, are not.
"""

from __future__ import annotations

from functools import partial
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np
from reference_tracer.arrays import Bools

from ..group_faults import FEW, FLOAT32, LOSSY, MOST, Found, Tests, always, never, single
from ..mutations import mutations
from .triangle_cases import normals

if TYPE_CHECKING:
    from ..cases import TableAnswers

ORDINARY = "front", "back", "whole"  # hits with nothing difficult about them
RANDOM = 0.1, 0.9  # share of ordinary hits that an equality of floats loses


def of_conditions(a: TableAnswers) -> Found:
    """See whether what is hit is what the textbook hits with a condition too many, or too few."""
    right, whole = a.cases.subject.programs[0], a.cases.among("whole")
    for mutation in mutations(right):
        # An opposite condition spoils every hit: other faults look the same.
        if not mutation.conditions or mutation.name == "condition_opposite":
            continue
        theirs = np.isfinite(mutation.of(right).answers(a.cases.letters)[:, 0])
        spoiled, alike = (theirs != a.to_hit) & a.cases.counts, theirs == a.hit
        lost = spoiled & whole  # that the others are seen tells one side from nearly nothing
        if alike[spoiled].mean() > MOST and (not lost.any() or alike[whole].mean() > MOST):
            yield mutation.name, mutation.sentence, spoiled & alike


def sum_equals_one(a: TableAnswers) -> Found:
    """See whether ordinary hits are lost by chance, but none where nothing is rounded."""
    seen = np.ones(len(a.hit), bool)
    if a.hit[a.cases.among("back")].mean() < FEW:
        _, directions, p = a.cases.given
        seen = (normals(p) * directions).sum(axis=1) < 0
    lost = (~a.hit)[seen & a.cases.among("front", "back")].mean()
    if RANDOM[0] < lost < RANDOM[1] and a.hit[seen & a.cases.among("whole")].mean() > 1 - FEW / 10:
        text = (
            f"{100 * lost:.0f} % of ordinary hits are lost by chance, and none where nothing is "
            "rounded: floats are asked to be equal, as in s1 + s2 + s3 == 1"
        )
        rounded = a.cases.among("front", "back", "beside", "scaled")
        yield "sum_equals_one", text, rounded & ~a.hit


def absolute_epsilon(a: TableAnswers) -> Found:
    """See whether the same pair, a power of two smaller or larger, is missed."""
    scaled, front = a.cases.among("scaled"), a.hit[a.cases.among("front")]
    lost = scaled & ~a.hit
    lost[scaled] &= np.resize(front, scaled.sum())
    if lost[scaled].mean() > 0.01:
        text = (
            "a triangle that is hit is missed when it and the ray's origin are 2^20 times larger, "
            "or 2^20 or 2^30 times smaller, though floats scale by powers of two without any "
            "rounding: a constant (an epsilon, a largest t) is not relative to the scene; "
            "0 is, at every scale"
        )
        yield "absolute_epsilon", text, lost


def beside_edges(a: TableAnswers) -> Found:
    """See whether edges are blurred as far as float32 does, or moved a little, out- or inward."""
    beside, s = a.cases.among("beside"), a.cases.right[:, 1:]
    if any(single(a, "t")):
        text = "closely beside an edge float32 cannot tell the side: it keeps 7 digits of 16"
        yield "float32", text, beside & (np.abs(s).min(axis=1) < LOSSY * FLOAT32)
    least = s.min(axis=1)
    wide, narrow = beside & a.hit & (least < 0), beside & ~a.hit & (least > 0)
    if wide.any() and a.hit[a.cases.among("outside")].mean() < FEW:
        text = (
            f"rays that pass beside a triangle, by up to {-np.min(least[wide]):.0e} of its height, "
            "hit it: the tolerance of the barycentrics is too wide"
        )
        yield "tolerance_too_wide", text, wide
    if narrow.any() and a.hit[a.cases.among(*ORDINARY)].mean() > MOST:
        text = (
            f"rays within {np.max(least[narrow]):.0e} of the triangle's height from its edge miss "
            "it: neighbours that share an edge leave a gap"
        )
        yield "tolerance_too_narrow", text, narrow


def parallel(a: TableAnswers) -> Found:
    """See whether a ray along the plane is said to meet it."""
    own = a.cases.among("parallel")
    if a.hit[own].mean() > 0.01:
        text = "rays that are parallel to the triangle's plane hit it: d . n = 0 is no hit"
        yield "parallel", text, own & a.hit


def of_t(a: TableAnswers) -> Found:
    """See whether t is right but for a length, or a sign."""
    t, length = a.table[:, :1], np.linalg.norm(a.cases.given[1], axis=1, keepdims=True)
    for name, text, mended in (
        (
            "t_is_distance",
            "t is the distance from the origin, in metres: x = o + t d wants it in lengths of d "
            "(has d been normalised?)",
            t / length,
        ),
        (
            "t_times_length",
            "t is divided by the length of d once too often: x = o + t d wants it in lengths of d",
            t * length,
        ),
        ("t_sign", "t has the wrong sign: a hit before the origin has t > 0", -t),
    ):
        right = a.cases.near(mended, slice(1))
        if _fits(a, "t", right):
            yield name, text, right


def no_barycentrics(a: TableAnswers) -> Found:
    """See whether hits have barycentrics that are no numbers, or 0 alone, as no point has them."""
    s = a.table[:, 1:]
    broken, none = ~np.isfinite(s).all(axis=1), ~s.any(axis=1)
    if (broken & a.wrong_numbers("barycentrics")).any():
        yield "barycentrics_not_finite", "barycentrics of a hit are NaN or infinite", broken
    if _fits(a, "barycentrics", none):
        text = (
            "the barycentrics of hits are all 0, as the file that --template writes has them at "
            "first: return s_i = (n . n_si) / |n|^2, whose sum is 1"
        )
        yield "barycentrics_zero", text, none


def order_and_scale(a: TableAnswers) -> Found:
    """See whether they are those of other corners, or are right but for a factor."""
    s, wrong = a.table[:, 1:], a.wrong_numbers("barycentrics")
    if not wrong.any():
        return
    with np.errstate(all="ignore"):
        total = s.sum(axis=1, keepdims=True)
        unit = s / total
    swapped = (
        "s2 and s3 are swapped: the textbook's erratum. n_s2 = (p1 - p2) x (x - p2) is zero on the "
        "edge p1 p2, so what it gives weighs p3, and n_s3's weighs p2; constant shading never "
        "shows it, interpolation does"
    )
    others = "the barycentrics are in another order: the corners' own are your {}"
    sums = f"{np.median(total[wrong]):.3g}"
    scale = (
        f"the barycentrics do not sum to 1 (to {sums}, in the median), but are right in "
        "proportion: divide by |n|^2, or by the sum"
    )
    for name, text, mended in (
        ("s2_s3_swapped", swapped, s[:, [0, 2, 1]]),
        *(
            ("barycentrics_order", others.format(", ".join(f"s{k + 1}" for k in turn)), s[:, turn])
            for turn in permutations(range(3))
            if turn not in ((0, 1, 2), (0, 2, 1))
        ),
        ("barycentrics_scale", scale, unit),
        ("barycentrics_scale_and_order", f"{scale}; and s2 and s3 are swapped", unit[:, [0, 2, 1]]),
    ):
        right = a.cases.near(mended, slice(1, 4))
        if _fits(a, "barycentrics", right):
            yield name, text, right
            return


def _fits(a: TableAnswers, share: str, explained: Bools) -> bool:
    """Whether a fault explains nearly all of the wrong numbers of ordinary hits."""
    ordinary = a.wrong_numbers(share) & a.cases.among(*ORDINARY)
    return bool(ordinary.any() and explained[ordinary].mean() > MOST)


TESTS = (
    Tests(
        "hits",
        (
            never,
            always,
            of_conditions,
            sum_equals_one,
            absolute_epsilon,
            beside_edges,
            parallel,
        ),
    ),
    Tests("values of t", (of_t, partial(single, share="t")), "t"),
    Tests(
        "barycentrics",
        (no_barycentrics, order_and_scale, partial(single, share="barycentrics")),
        "barycentrics",
    ),
)
