"""Names what is wrong with a student's function, from its answers to the cases.

First it is looked for among wrong programs (`matching.py`): one that gives the same answers names
what is wrong, in one place or in two. Of other faults, as of an epsilon or of float32, each is a
hypothesis with a test that can fail: it says which of the wrong answers it would explain, and is
only given where nearly all such pairs are wrong in just this way. What no fault explains is said to
be unrecognised.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Bools, Floats, Places

from .cases import TableAnswers, TableCases
from .known import Ask
from .matching import Match, differs, doubles, matches, singles
from .submission import Submission

ALONE = 3, 1  # sizes of the calls in which some cases are asked about again
CALLS = 4  # of each size: a program is started for each
# Relative: libraries sum in another order when there are fewer rows, in float32, too. What mixes up
# rows is farther off.
ALIKE = 1e-4


MOST_WAYS = 4  # in which two mistakes may give the same answers: with more, they say nothing
OTHERS = 2  # mistakes with the same answers that are mentioned
UNRECOGNISED = "unrecognised_"
UNEXPLAINED = "all_hits"  # of what never hits, two mistakes would say too little


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong: its name, a sentence for the student, how many checks show it."""

    name: str
    sentence: str
    pairs: int


def find_faults(answers: TableAnswers) -> tuple[list[Fault], Match | None]:
    """Return what is wrong with a function, and a wrong program that answers as it does, if any."""
    if not answers.wrong.any():
        return [], None
    if ways := matches(answers.cases, answers.table, singles):
        return _matched(answers, ways)
    faults = _tested(answers, answers.wrong)
    if any(f.name == UNEXPLAINED or f.name.startswith(UNRECOGNISED) for f in faults):
        ways = matches(answers.cases, answers.table, doubles)
        if 0 < len(ways) <= MOST_WAYS:
            return _matched(answers, ways)
    return faults, None


def _matched(answers: TableAnswers, ways: Sequence[Match]) -> tuple[list[Fault], Match | None]:
    """Return the faults of a wrong program that answers alike, and of what it does not explain."""
    theirs = answers.cases.answers(ways[0].program.answers(answers.cases.letters))
    left = answers.wrong & ~theirs.wrong  # that program is right there
    faults = _named(answers, ways)
    return faults + _tested(answers, left), ways[0]


def _named(answers: TableAnswers, ways: Sequence[Match]) -> list[Fault]:
    """Return what is wrong with the first of some programs that no pair tells apart."""
    wrong = int(answers.wrong.sum())
    alone = dict.fromkeys(way.wrong[0].sentence for way in ways if len(way.wrong) == 1)
    others = [sentence for sentence in alone if sentence != ways[0].wrong[0].sentence]
    named = OTHERS + (len(others) == OTHERS + 1)  # "one of 1 others" says less than its name
    text = "".join(f"; or {other}" for other in others[:named])
    if len(others) > named:
        text += f"; or one of {len(others) - named} others"
    rest = f" (no ray tells this from others{text})" if text else ""
    return [Fault(m.name, m.sentence + rest, wrong) for m in ways[0].wrong]


def raising(student: Submission) -> list[Fault]:
    """Return the fault that a function raises in some cases, with the first of them."""
    if student.first is None:
        return []
    error, case = student.first
    numbers = [
        f"{given.name} = {array.tolist()}"
        for given, array in zip(student.form.given, case, strict=True)
    ]
    where = f" in line {error.line}" * (error.line is not None)
    what = error.message if error.kind == "ended" else f"it raises {error.message}{where}"
    text = f"{what}, as it does with {', '.join(numbers)}"
    if student.unasked:
        text += f" ({student.unasked:,} of these in groups: so many are not tried one by one)"
    return [Fault("raises", text, student.raises)]


def _tested(answers: TableAnswers, among: Bools) -> list[Fault]:
    """Return the faults of some wrong answers that pass their tests, and what is unrecognised."""
    faults: dict[str, Fault] = {}
    groups = list(answers.cases.subject.groups)
    for what, tests, share in answers.cases.subject.tests:
        wrong = answers.wrong_hits if what == "hits" else answers.wrong_numbers(share)
        left = wrong & among
        for test in tests:
            for name, sentence, explained in test(answers):
                if pairs := int((explained & left).sum()):
                    left &= ~explained
                    if name in faults:  # the later sentence says more
                        pairs += faults[name].pairs
                    faults[name] = Fault(name, sentence, pairs)
        if left.any():
            where = [groups[g] for g in np.unique(answers.cases.group[left])]
            text = f"some {what} are wrong for a reason that is not recognised: {', '.join(where)}"
            name = f"{UNRECOGNISED}{what.split()[-1]}"
            faults[name] = Fault(name, text, int(left.sum()))
    return list(faults.values())


def dependence(answers: TableAnswers, ask: Ask) -> list[Fault]:
    """Return what is wrong if the same cases are answered otherwise when asked again.

    Some are asked about again three at a time, where (3,) and (n, 3) are easily mixed up, and one
    at a time. Where rounding may have it either way, it may have it otherwise in each call.
    """
    cases = answers.cases
    for size in ALONE:
        some = np.concatenate(
            [np.flatnonzero(cases.group == g)[:size] for g in np.unique(cases.group)]
        )
        last = len(some) // size - 1
        for first in np.unique(np.arange(CALLS) * last // (CALLS - 1)) * size:  # evenly spread
            rows = some[first : first + size]
            off = differs(
                answers.table[rows],
                _again(cases, ask, rows),
                cases.subject.parts,
                ALIKE,
                strictly=False,
            )
            if count := int((off & cases.firm[rows]).sum()):
                text = (
                    f"a case is answered otherwise in a call of {len(rows)} than in one of "
                    f"{len(cases.given[0]):,}: an answer is to depend on its own case, whatever "
                    "else is in the call"
                )
                return [Fault("depends_on_the_call", text, count)]
    return []


def _again(cases: TableCases, ask: Ask, rows: Places) -> Floats:
    """Return what is answered of some rows of the answers, (k, m); a case may have several."""
    own, within = np.divmod(rows, cases.each)
    again = cases.subject.rows(*ask(*(array[own] for array in cases.given)))
    return again[np.arange(len(rows)) * cases.each + within]
