"""What is wrong with a student's function, by name, from what it makes of the checks.

First it is looked for among wrong programs (`matching.py`): one that gives the same answers names
what is wrong, in one place or in two. Of other faults, as of an epsilon or of float32, each is a
hypothesis with a test that can fail: it says which of the wrong answers it would explain, and is
only given where nearly all such pairs are wrong in just this way. What no fault explains is said to
be unrecognised.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from .answers import Answers, Mask
from .checks import Checks, Group
from .hit_faults import HIT_TESTS
from .known import Ask
from .matching import Match, with_one, with_two
from .value_faults import S_TESTS, T_TESTS

ALONE = 3, 1  # sizes of the calls in which some pairs are asked about again
# Relative: libraries sum in another order when there are fewer rows, in float32, too. What mixes up
# rows is farther off.
ALIKE = 1e-4


MOST_WAYS = 4  # in which two mistakes may give the same answers: with more, they say nothing
OTHERS = 2  # mistakes with the same answers that are mentioned
_UNRECOGNISED = {f"unrecognised_{what}" for what in ("hits", "t", "barycentrics")}
_UNEXPLAINED = {"no_hits", "all_hits", *_UNRECOGNISED}


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong: its name, a sentence for the student, how many checks show it."""

    name: str
    sentence: str
    pairs: int

    def to_dict(self) -> dict[str, Any]:
        """Return the fault as JSON can hold it."""
        return asdict(self)


def find_faults(answers: Answers) -> tuple[list[Fault], Match | None]:
    """Return what is wrong with a function, and the wrong program of which that is all, if any."""
    if not answers.wrong.any():
        return [], None
    if ways := with_one(answers):
        return _matched(answers, ways)
    faults = _tested(answers, answers.wrong)
    if any(f.name in _UNEXPLAINED for f in faults):
        ways = with_two(answers)
        if 0 < len(ways) <= MOST_WAYS:
            return _matched(answers, ways)
    return faults, None


def _matched(answers: Answers, ways: Sequence[Match]) -> tuple[list[Fault], Match | None]:
    """Return the faults of a wrong program that answers alike, and of what it does not explain."""
    checks = answers.checks
    rays = checks.origins, checks.directions, checks.triangles
    theirs = Answers(checks, *ways[0].program.answers(*rays))
    left = answers.wrong & ~theirs.wrong  # that program is right there
    faults = _named(answers, ways)
    return (faults + _tested(answers, left), None) if left.any() else (faults, ways[0])


def _named(answers: Answers, ways: Sequence[Match]) -> list[Fault]:
    """Return what is wrong with the first of some programs that no pair tells apart."""
    wrong = int(answers.wrong.sum())
    others = dict.fromkeys(m.sentence for way in ways[1:] for m in way.wrong if len(way.wrong) == 1)
    text = "".join(f"; or {other}" for other in list(others)[:OTHERS])
    if text and len(others) > OTHERS:
        text += f"; or one of {len(others) - OTHERS} others"
    rest = f" (no ray tells this from others{text})" if text else ""
    return [Fault(m.name, m.sentence + rest, wrong) for m in ways[0].wrong]


def _tested(answers: Answers, among: Mask) -> list[Fault]:
    """Return the faults of some wrong answers that pass their tests, and what is unrecognised."""
    faults: list[Fault] = []
    for wrong, tests, what in (
        (answers.wrong_hit, HIT_TESTS, "hits"),
        (answers.wrong_t, T_TESTS, "values of t"),
        (answers.wrong_s, S_TESTS, "barycentrics"),
    ):
        left = wrong & among
        for test in tests:
            for name, sentence, explained in test(answers):
                if pairs := int((explained & left).sum()):
                    left &= ~explained
                    _enter(faults, Fault(name, sentence, pairs))
        if left.any():
            faults.append(_unrecognised(answers, left, what))
    return faults


def _enter(faults: list[Fault], new: Fault) -> None:
    """Add a fault; of one that is there by this name, the later sentence says more."""
    for k, old in enumerate(faults):
        if old.name == new.name:
            faults[k] = replace(new, pairs=old.pairs + new.pairs)
            return
    faults.append(new)


def _unrecognised(answers: Answers, left: Mask, what: str) -> Fault:
    where = [g.name.lower() for g in Group if (left & answers.checks.of(g)).any()]
    text = f"some {what} are wrong for a reason that is not recognised: {', '.join(where)}"
    return Fault(f"unrecognised_{what.split()[-1]}", text, int(left.sum()))


def dependence(checks: Checks, answers: Answers, ask: Ask) -> list[Fault]:
    """Return what is wrong if the same pairs are answered otherwise when asked again.

    Some are asked about again three at a time, where (3,) and (n, 3) are easily mixed up, and one
    at a time. Where rounding may have it either way, it may have it otherwise in each call.
    """
    unsure = checks.known.doubt | checks.of(Group.BESIDE)
    for size in ALONE:
        some = np.concatenate([np.flatnonzero(checks.of(g))[:size] for g in Group])
        for first in range(0, len(some), size):
            rows = some[first : first + size]
            t, s = ask(checks.origins[rows], checks.directions[rows], checks.triangles[rows])
            before = answers.hit[rows]
            both = np.isfinite(t) & before
            with np.errstate(all="ignore"):
                off = np.abs(t - answers.t[rows]) > ALIKE * np.abs(t)
                off |= (np.abs(s - answers.s[rows]) > ALIKE * np.maximum(1, np.abs(s))).any(axis=1)
            same = np.where(both, ~off, np.isfinite(t) == before) | unsure[rows]
            if not same.all():
                text = (
                    f"a pair is answered otherwise in a call of {len(rows)} than in one of "
                    f"{len(checks.group):,}: ray k is to be tested with triangle k, whatever else "
                    "is in the call"
                )
                return [Fault("depends_on_the_call", text, int((~same).sum()))]
    return []
