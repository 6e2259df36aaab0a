"""Finds how an object is changed in a picture, in the fewest numbers that explain it."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from ...causes.case import Case
from ...scene import Scene
from ...tracer.progress import Work
from ..evidence import Evidence, least_with
from .changes import CHANGES, MOVED, Change
from .fault import Numbers, SearchEndedError, Values, instances_named
from .fitting import FINER, MORE, NEARLY
from .looked import Looked
from .search import values_of

FIRST = 1 / 4  # of the object's width: the first step
TRIED = 2  # objects that are fitted
NEAR_STEP = 0.5  # pixels: the first step from where edges are found
KEPT = 4  # starts that are followed
ALL = 0.995  # of the pixels: with as many right, nothing more is tried
PROMISING = 1.1  # times as many pixels are right as without a change: a start is followed
CLEAR = 0.9  # of the edges: where one explains as many, what explains fewer comes last


@dataclass(frozen=True, eq=False)
class Posed(Numbers):
    """An object that is changed in some way."""

    change: Change = MOVED[0]

    @classmethod
    def of(cls, found: Numbers, looked: Looked, change: Change) -> Posed:
        """Return the numbers that were found of a change, in words."""
        numbers = found.values, found.low, found.high
        words = change.words(*found.values)
        return cls(*numbers, object=looked.name, words=words, change=change)


Starts = dict[Change, list[Values]]  # where numbers are looked for


def _climbed(
    looked: Looked, change: Change, starts: Sequence[Values], step: float
) -> Work[tuple[Posed | None, bool]]:
    """Return the best numbers near some starts, and whether nearly all is right with them."""
    search = change.search(looked, looked.least_right)
    found = yield from search.guess(starts, step, enclose=False)
    if found is None:
        return None, False
    right = yield from search.count(found.values)
    return Posed.of(found, looked, change), right >= ALL * len(looked.at[0])


def _far(looked: Looked, changes: Sequence[Change]) -> Work[Starts]:
    """Return the starts that are right in the most pixels, the smallest changes first.

    One that is hardly better than no change is none.
    """
    out: list[tuple[int, float, Change, Values]] = []
    for change in changes:
        search = change.search(looked)
        least = PROMISING * (yield from search.count(change.none))
        for start in change.starts(looked):
            right = yield from search.count(start)
            size = float(np.abs(np.subtract(start, change.none)).sum())
            out += [(-right, size, change, start)] if right >= least else []
    starts: Starts = {}
    for *_, change, start in sorted(out, key=lambda one: one[:2])[:KEPT]:
        starts.setdefault(change, []).append(start)
    return starts


def _near(looked: Looked, changes: Sequence[Change], is_some: bool) -> Starts:
    """Return the starts where edges are found; that of a move where it is, too."""
    matched = {c: f for c in CHANGES if (f := c.matched(looked))}
    most = max((f.share for f in matched.values()), default=0.0)
    least = most - MORE if is_some or most >= CLEAR else NEARLY * most
    starts: Starts = {c: [c.none] for c in changes if c in MOVED}
    for c in (c for c in changes if c in matched and matched[c].share >= least):
        there = values_of(c.none + c.axes(looked) @ matched[c].units)
        starts[c] = [there, *starts.get(c, ())]
    return starts


def _found(
    evidence: Evidence, name: str, far: bool, counts: Sequence[int], out: list[Posed]
) -> Work[set[str]]:
    """Add how an object may be changed; return the kinds with which nearly all is right.

    What has more numbers is left out where fewer of the same kind are enough.
    """
    enough: set[str] = set()
    looked = yield from Looked.of(evidence, name)
    few = yield from Looked.of(evidence.few, name)
    if not (looked and few):
        return enough
    for count in counts:
        some = [c for c in CHANGES if len(c.none) == count and c.kind not in enough]
        if far:
            tries = yield from _far(few, some)
            step = FIRST * looked.width / (4 if count == 1 else 1)
        else:
            tries, step = _near(looked, some, bool(enough)), NEAR_STEP
        for change, starts in tries.items():
            guess, is_all = yield from _climbed(looked, change, starts, step)
            out += [guess] if guess else []
            enough |= {change.kind} if is_all else set()
        if far and enough:
            break
    return enough


def _changed(evidence: Evidence) -> Work[None]:
    """Guess how the suspects are changed, once: several faults share what one has work for.

    Each is looked for near where it is, or where edges are found; and only then far away.
    """
    if "changed" not in evidence.known:
        out = evidence.known["changed"] = []
        counts = [n for n in (1, 3) if evidence.unexplained.sum() >= least_with(n)]
        for far, name in product((False, True), evidence.suspects[:TRIED]):
            enough = yield from _found(evidence, name, far, counts, out)
            if enough and not far and "moved" not in enough:  # one number may do, far away
                yield from _found(evidence, name, True, (1,), out)
            if enough:
                break


def posing(*changes: Change, exact: Values = (), kept: bool = False) -> dict[str, Any]:
    """Return how some changes of a suspect are made, found and refined, as fields of a fault.

    `exact` numbers of the first are guessed, too. If it is `kept`, a second copy is changed.
    """

    def assume(case: Case, guess: Posed) -> Case | None:
        if not instances_named(case.scene, guess.object):
            return None

        def made(scene: Scene) -> Scene:
            other = guess.change.of(scene, guess.object, guess.values)
            own = [scene.instances[n] for n in instances_named(scene, guess.object)]
            return replace(other, instances=(*other.instances, *own)) if kept else other

        return case.with_scenes(made)

    def refine(evidence: Evidence, guess: Posed) -> Work[Posed | None]:
        """Return the numbers found near a guess; with their ranges if it was fitted before."""
        looked = yield from Looked.of(evidence, guess.object, kept)
        if looked is None:
            return None
        change, fine = guess.change, bool(guess.low)
        starts, step = [guess.values], FINER if fine else 1.0
        found = yield from change.search(looked).guess(starts, step, enclose=fine)
        return Posed.of(found, looked, change) if found else None

    def find(evidence: Evidence) -> Work[list[Posed]]:
        with suppress(SearchEndedError):
            yield from _changed(evidence)
        first, found = changes[0], evidence.known["changed"]
        out = [
            Posed((v,), object=name, words=first.words(v), change=first)
            for name in evidence.suspects
            for v in exact
        ]
        return [*out, *(guess for guess in found if guess.change in changes)]

    looks = partial(_copies, changes) if kept else find
    return {"assume": assume, "find": looks, "refine": refine}


def _copies(changes: tuple[Change, ...], evidence: Evidence) -> Work[list[Posed]]:
    """Return the changes found of second copies of suspects."""
    out: list[Posed] = []
    for name in evidence.suspects[:TRIED]:
        if looked := (yield from Looked.of(evidence, name, True)):
            for change, starts in (yield from _far(looked, changes)).items():
                guess, _ = yield from _climbed(looked, change, starts, FIRST * looked.width)
                out += [guess] if guess else []
    return out
