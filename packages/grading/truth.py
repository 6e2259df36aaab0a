"""Finds the truth about cases: a bound decides, and fractions where the bound does not.

A right program is computed in float64, each number with a bound on how far any sound order of its
operations may take it (`bounded.py`). Nobody chose a tolerance: an answer may be off by ROUNDINGS
times that, which also stands for formulas that are somewhat worse. What a condition compares is
certain where it is farther from its limit than that. All else is computed anew in fractions, where
nothing is rounded; it is *in doubt*, as sound float64 may have it either way, but for cases in
which float64 rounds nothing.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from reference_tracer.arrays import Bools, Floats
from reference_tracer.certified.bounds import U
from reference_tracer.derivation.expressions import evaluate

from .bounded import Bounded
from .programs import COMPARISONS, CONSTANTS, Letters, Named, Program, chosen, columns, unit

ROUNDINGS = 16  # how far a sound formula may be off, for each of those of a right program


@np.errstate(all="ignore")
def truth(program: Program, letters: Letters, whole: Bools) -> tuple[Floats, Floats, Bools]:
    """Return right answers (n, m), how far others may be off, and where it is in doubt, (n,).

    Parameters
    ----------
    program : Program
        A right one.
    letters : Letters
    whole : (n,) bool
        Cases of a program without a choice in which float64 rounds nothing.
    """
    names = bounded(program, letters)
    doubt = np.zeros(letters.shape, bool)
    if program.conditions:
        hit, doubt = _hits(program, letters, names)
        if program.choice:
            doubt = _take(program.choice, names, hit, doubt)
        else:
            names["t"] = Bounded(np.where(hit, names["t"].value, np.inf), names["t"].error)
    count = letters.shape[0]
    numbers = [n for part in program.parts for label in part.labels for n in np.ravel(names[label])]
    right, error = (
        np.stack([np.broadcast_to(getattr(n, kind), count) for n in numbers], axis=1)
        for kind in ("value", "error")
    )
    allowed = ROUNDINGS * U * error
    for part, place in columns(program.parts):
        if part.unit:
            size = np.linalg.norm(right[:, place], axis=1, keepdims=True)
            right[:, place] = unit(right[:, place])
            allowed[:, place] = 2 * allowed[:, place].max(axis=1, keepdims=True) / size
    is_unbounded = ~np.isfinite(allowed).all(axis=1) & np.isfinite(right[:, 0])
    return right, allowed, doubt & ~whole | is_unbounded


def bounded(program: Program, letters: Letters) -> Named:
    """Return all of a program's numbers as `Bounded`, vectors as arrays of three."""
    return program.computed(letters.each(Bounded.of))


def _hits(program: Program, letters: Letters, names: Named) -> tuple[Bools, Bools]:
    """Return where all conditions hold, and where that is in doubt, in the letters' shape."""
    hit = np.isfinite(names["t"].value)
    missed, unsure = np.zeros((2, *letters.shape), bool)  # missed for certain
    for left, comparison, limit in program.conditions:
        found = evaluate(left, names)
        holds = COMPARISONS[comparison](found.value, CONSTANTS[limit])
        far = np.abs(found.value - CONSTANTS[limit]) > ROUNDINGS * U * found.error
        missed |= ~holds & far
        unsure |= ~far
        hit = hit & holds
    unsure &= ~missed
    for where in np.argwhere(unsure):
        hit[tuple(where)] = exact_hit(program, letters, tuple(where))
    return hit, unsure


def _take(choice: str, names: Named, hit: Bools, doubt: Bools) -> Bools:
    """Take one of the objects that are hit, and return where that is in doubt, (n,).

    An object that is missed by a rounding is a rival, too, by the t at which it would be hit.
    """
    t = names["t"].value
    allowed = ROUNDINGS * U * names["t"].error
    taken = chosen(choice, t, hit)
    which = taken["owner"].astype(int)[:, None]
    most = taken["t"][:, None] + np.take_along_axis(allowed, which, axis=1)
    rivals = (hit & (t - allowed <= most)) | (doubt & ~(t - allowed > most))
    error = np.take_along_axis(names["t"].error, which, axis=1)[:, 0]
    names |= {name: Bounded(value, np.zeros(1)) for name, value in taken.items()}
    names["t"] = Bounded(taken["t"], error)
    unsure: Bools = (rivals.sum(axis=1) > 1) | (doubt & rivals).any(axis=1)
    return unsure


def exact_hit(program: Program, letters: Letters, where: tuple[int, ...]) -> bool:
    """Return whether all conditions hold of one case, or object of a case, in fractions."""
    try:
        names = exactly(program, letters, where)
        return all(each.holds(names) for each in program.conditions)
    except ZeroDivisionError:
        return False  # there is no plane, or it is not met


def exactly(program: Program, letters: Letters, where: tuple[int, ...]) -> Named:
    """Return all of a program's numbers of one case as fractions, vectors as arrays of three.

    Raises
    ------
    ZeroDivisionError
        If something is divided by 0.
    """

    def fraction(numbers: Floats) -> Fraction:
        return Fraction(float(np.broadcast_to(numbers, letters.shape)[where]))

    return program.computed(letters.each(fraction))
