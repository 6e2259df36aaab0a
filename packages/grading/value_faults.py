"""Why t or the barycentrics of right hits are wrong: one test for each reason.

Each computes what the fault would answer, and compares that with the answer, pair by pair.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np
from reference_tracer.arrays import Floats

from .answers import MOST, Answers
from .checks import ORDINARY
from .faults import Found
from .programs import Mask

FLOAT32 = 2.0**-24  # its rounding unit
LOSSY = 300  # of those: as far as ordinary pairs may be off that were computed in float32
LEAST = FLOAT32 / 64  # and as far as half of them are off at least
NAMES = "s1", "s2", "s3"


def _fits(a: Answers, wrong: Mask, as_fault: Mask) -> bool:
    """Whether a fault explains nearly all of the wrong answers of ordinary pairs."""
    ordinary = wrong & a.checks.of(*ORDINARY)
    return bool(ordinary.any() and as_fault[ordinary].mean() > MOST)


def distance(a: Answers) -> Found:
    """See whether t is a length, as if the direction had been normalised."""
    length = np.linalg.norm(a.checks.directions, axis=1)
    for name, t, text in (
        (
            "t_is_distance",
            a.t / length,
            "t is the distance from the origin, in metres: x = o + t d wants it in lengths of d "
            "(has d been normalised?)",
        ),
        (
            "t_times_length",
            a.t * length,
            "t is divided by the length of d once too often: x = o + t d wants it in lengths of d",
        ),
    ):
        if _fits(a, a.wrong_t, a.is_t(t)):
            yield name, text, a.is_t(t)


def negative_t(a: Answers) -> Found:
    """See whether t has the other sign, and nobody asks for t > 0."""
    if _fits(a, a.wrong_t, a.is_t(-a.t)):
        yield "t_sign", "t has the wrong sign: a hit before the origin has t > 0", a.is_t(-a.t)


def _off(a: Answers) -> Floats:
    with np.errstate(all="ignore"):
        return np.abs(a.t / a.checks.known.t - 1)


def is_single(a: Answers) -> bool:
    """Return whether t has the digits of float32."""
    off = _off(a)
    fits = _fits(a, a.wrong_t, off < LOSSY * FLOAT32)
    return fits and bool(np.median(off[a.wrong_t]) > LEAST)


def single_t(a: Answers) -> Found:
    """See whether t has the digits of float32."""
    off = _off(a)
    single = off < LOSSY * FLOAT32
    if is_single(a):
        yield "float32", _SINGLE.format("t", np.median(off[a.wrong_t & single])), single


def not_numbers(a: Answers) -> Found:
    """See whether hits have no barycentrics."""
    broken = ~np.isfinite(a.s).all(axis=1)
    if (broken & a.wrong_s).any():
        yield "barycentrics_not_finite", "barycentrics of a hit are NaN or infinite", broken


def zeros(a: Answers) -> Found:
    """See whether hits have barycentrics of 0 alone, which no point of the plane has."""
    none = ~a.s.any(axis=1)
    if _fits(a, a.wrong_s, none):
        text = (
            "the barycentrics of hits are all 0, as the file that --template writes has them at "
            "first: return s_i = (n . n_si) / |n|^2, whose sum is 1"
        )
        yield "barycentrics_zero", text, none


def order(a: Answers) -> Found:
    """See whether they are those of other corners, as the textbook prints them."""
    for turn in permutations(range(3)):
        if turn == (0, 1, 2) or not _fits(a, a.wrong_s, a.are_s(a.s[:, turn])):
            continue
        if turn == (0, 2, 1):
            text = (
                "s2 and s3 are swapped: the textbook's erratum. n_s2 = (p1 - p2) x (x - p2) is zero"
                " on the edge p1 p2, so what it gives weighs p3, and n_s3's weighs p2; constant "
                "shading never shows it, interpolation does"
            )
            yield "s2_s3_swapped", text, a.are_s(a.s[:, turn])
        else:
            names = ", ".join(NAMES[k] for k in turn)
            text = f"the barycentrics are in another order: the corners' own are your {names}"
            yield "barycentrics_order", text, a.are_s(a.s[:, turn])


def scale(a: Answers) -> Found:
    """See whether they are right but for a factor: not divided by the area."""
    with np.errstate(all="ignore"):
        total = a.s.sum(axis=1)
        unit = a.s / total[:, None]
    for s, name, rest in (
        (unit, "barycentrics_scale", ""),
        (unit[:, [0, 2, 1]], "barycentrics_scale_and_order", "; and s2 and s3 are swapped"),
    ):
        if _fits(a, a.wrong_s, a.are_s(s)):
            sums = f"{np.median(total[a.wrong_s]):.3g}"
            text = (
                f"the barycentrics do not sum to 1 (to {sums}, in the median), but are right in "
                f"proportion: divide by |n|^2, or by the sum{rest}"
            )
            yield name, text, a.are_s(s)
            return


def single_s(a: Answers) -> Found:
    """See whether barycentrics have the digits of float32."""
    off: Floats = np.abs(a.s - a.checks.known.s).max(axis=1)
    single = off < LOSSY * FLOAT32
    if _fits(a, a.wrong_s, single) and np.median(off[a.wrong_s]) > LEAST:
        yield "float32", _SINGLE.format("s", np.median(off[a.wrong_s & single])), single


_SINGLE = (
    "{} is off by {:.0e}: computed in float32, which keeps 7 digits of the 16 that float64 has"
)
T_TESTS = distance, negative_t, single_t
S_TESTS = not_numbers, zeros, order, scale, single_s
