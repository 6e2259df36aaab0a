"""Why a function misses what it should hit, or hits what it should not: one test for each reason.

A test yields a name and a sentence only where the pairs say so beyond chance: those that the fault
would spoil are wrong, nearly all, and others, which it would leave alone, are not.
"""

from __future__ import annotations

import numpy as np

from .answers import FEW, MOST, Answers
from .checks import ORDINARY, Group
from .faults import Found
from .group_faults import always, never
from .value_faults import FLOAT32, LOSSY, is_single

RANDOM = 0.1, 0.9  # share of ordinary hits that an equality of floats loses


def sign_of_t(a: Answers) -> Found:
    """See whether what lies behind is hit in front, and what lies in front is not."""
    behind = a.checks.of(Group.BEHIND)
    turned = a.hit & np.isclose(a.t, -a.checks.known.t)
    if a.share(turned, Group.BEHIND) > MOST and a.share(a.hit, *ORDINARY) < FEW:
        text = "t has the wrong sign: what is behind the ray's origin is hit, what is before it not"
        yield "t_sign", text, behind | ~a.hit


def culling(a: Answers) -> Found:
    """See whether triangles are seen from one side only."""
    for name, side in (("back_faces_culled", False), ("front_faces_culled", True)):
        lost, seen = (a.facing if side else ~a.facing), (~a.facing if side else a.facing)
        if (
            a.share(a.hit, *ORDINARY, where=lost) < 0.01
            and a.share(a.hit, Group.WHOLE, where=seen) > MOST
        ):
            winding = "counter-clockwise" if side else "clockwise"
            text = (
                f"triangles whose corners the ray sees {winding} are missed: d . n may have either "
                "sign, a triangle has two sides"
            )
            yield name, text, lost & ~a.hit


def sum_equals_one(a: Answers) -> Found:
    """See whether ordinary hits are lost by chance, but none where nothing is rounded."""
    rounded = a.checks.of(Group.FRONT, Group.BACK, Group.BESIDE, Group.SCALED)
    seen = a.facing if a.share(a.hit, Group.BACK) < FEW else np.ones(len(a.hit), bool)
    lost = a.share(~a.hit, Group.FRONT, Group.BACK, where=seen)
    if RANDOM[0] < lost < RANDOM[1] and a.share(a.hit, Group.WHOLE, where=seen) > 1 - FEW / 10:
        text = (
            f"{100 * lost:.0f} % of ordinary hits are lost by chance, and none where nothing is "
            "rounded: floats are asked to be equal, as in s1 + s2 + s3 == 1"
        )
        yield "sum_equals_one", text, rounded & ~a.hit


def absolute_epsilon(a: Answers) -> Found:
    """See whether the same pair, a power of two smaller or larger, is missed."""
    scaled = a.checks.of(Group.SCALED)
    lost = np.zeros(len(a.hit), bool)
    lost[scaled] = a.hit[a.checks.twin[scaled]] & ~a.hit[scaled]
    if a.share(lost, Group.SCALED) > 0.01:
        text = (
            "a triangle that is hit is missed when it and the ray's origin are 2^20 times larger, "
            "or 2^20 or 2^30 times smaller, though floats scale by powers of two without any "
            "rounding: a constant (an epsilon, a largest t) is not relative to the scene; "
            "0 is, at every scale"
        )
        yield "absolute_epsilon", text, lost


def single_precision(a: Answers) -> Found:
    """See whether edges are blurred as far as float32 does, by which t was computed, too."""
    if is_single(a):
        least = np.abs(a.checks.known.s).min(axis=1)
        text = "closely beside an edge float32 cannot tell the side: it keeps 7 digits of 16"
        yield "float32", text, a.checks.of(Group.BESIDE) & (least < LOSSY * FLOAT32)


def edges_not_tested(a: Answers) -> Found:
    """See whether what lies beyond an edge is hit."""
    outside = a.checks.of(Group.OUTSIDE)
    negative = a.checks.known.s < 0
    open_ = [
        k
        for k in range(3)
        if a.share(a.hit, Group.OUTSIDE, where=negative[:, k] & (negative.sum(axis=1) == 1)) > MOST
    ]
    # Beyond two edges both tests have to be missing.
    explained = outside & a.hit & ~np.delete(negative, open_, axis=1).any(axis=1)
    if len(open_) == 3:
        text = "the whole plane of the triangle is hit: the barycentrics are not tested"
        yield "inside_not_tested", text, explained | (a.checks.of(Group.BESIDE) & a.hit)
    elif open_:
        names = " and ".join(f"s{k + 1}" for k in open_)
        text = f"rays that pass beyond an edge are hit: {names} >= 0 is not tested"
        if 0 in open_:
            text += " (with Möller and Trumbore's u and v, that is u + v <= 1)"
        near = a.checks.of(Group.BESIDE) & a.hit & negative[:, open_].any(axis=1)
        yield "edge_not_tested", text, explained | near


def tolerance(a: Answers) -> Found:
    """See whether edges are moved a little, outward or inward."""
    beside = a.checks.of(Group.BESIDE)
    least = a.checks.known.s.min(axis=1)
    wide = beside & a.hit & (least < 0)
    if wide.any() and a.share(a.hit, Group.OUTSIDE) < FEW:
        text = (
            f"rays that pass beside a triangle, by up to {-np.min(least[wide]):.0e} of its height, "
            "hit it: the tolerance of the barycentrics is too wide"
        )
        yield "tolerance_too_wide", text, wide
    narrow = beside & ~a.hit & (least > 0)
    if narrow.any() and a.share(a.hit, *ORDINARY) > MOST:
        text = (
            f"rays within {np.max(least[narrow]):.0e} of the triangle's height from its edge miss "
            "it: neighbours that share an edge leave a gap"
        )
        yield "tolerance_too_narrow", text, narrow


def behind(a: Answers) -> Found:
    """See whether what lies behind the origin counts."""
    if a.share(a.hit, Group.BEHIND) > MOST:
        text = "triangles behind the ray's origin are hit: only t > 0 is a hit"
        yield "hits_behind", text, a.checks.of(Group.BEHIND) & a.hit


def parallel(a: Answers) -> Found:
    """See whether a ray along the plane is said to meet it."""
    if a.share(a.hit, Group.PARALLEL) > 0.01:
        text = "rays that are parallel to the triangle's plane hit it: d . n = 0 is no hit"
        yield "parallel", text, a.checks.of(Group.PARALLEL) & a.hit


HIT_TESTS = (
    never,
    always,
    sign_of_t,
    culling,
    sum_equals_one,
    absolute_epsilon,
    edges_not_tested,
    single_precision,
    tolerance,
    behind,
    parallel,
)
