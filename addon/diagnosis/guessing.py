"""Guesses what is wrong, tries the guesses, and decides which to report.

A guess is reported under three conditions.

- It is right in nearly all the pixels that it changes (`PRECISE`). A wrong guess has no reason to
  be: it changes edges that agreed, and these are lost. A fit of the wrong kind, such as an offset
  for a distorted lens, is right in some places alone.
- It settles enough pixels. A guess that changes k pixels of two colours is right in all of them by
  chance once in 2^k times, and some hundred guesses are tried: so `LEAST_SETTLED` are needed, and
  half as many again for each number that was fitted.
- It settles a share of what is unexplained (`SHARE`), or all that earlier ones left: a fault of a
  few pixels beside another one of many is looked for once that one is put right. In a picture that
  is wrong in a way that is not known, a small thing that is shown elsewhere looks like a missing
  one: in the test bed it settled a tenth.

Among equally good guesses, all with the fewest fitted numbers are reported. A `vague` one, which
allows for several pictures, is reported if no exact one is as good.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from ..causes.case import PRECISE
from ..causes.checks.color import find_transform
from ..pictures.metrics import boundary
from ..scene import SceneError
from ..tracer.progress import Progress, Work
from .evidence import FEW, LEAST_SETTLED, Evidence, Score, least_with
from .faults import FAULTS
from .faults.fault import TRIED, AnyFault, Effort, Guess, SearchEndedError
from .faults.fitting import ENCLOSED
from .faults.matching import is_everywhere
from .trial import Trial, in_full, traced_anew, trial_of
from .variants import carried

T = TypeVar("T")
Scored = tuple[float, AnyFault, Guess]  # what a guess gains on the sample

COMPLETE = 0.75  # the least recall of a guess, in the regions that it touches
FITTED = 0.9  # that of fitted numbers: a fit of the wrong kind is nearly right in small regions
SHARE = 0.2  # of the unexplained pixels
AS_GOOD = 0.98  # of the best gain on the sample: others are not tried once a guess does it all
ALIKE = 0.0001  # of the pixels settled: guesses that differ by less are as good
PROMISING = 0.3  # of the best gain on the sample: guesses below it get no trial
LIKELY = 8.0  # pixels that a guess without numbers gains in the sample for each one that it breaks
UNLIKELY = 0.5  # of the least gain: guesses below it in the small sample are dropped
NEARLY = 0.5  # of the unexplained pixels: a guess that gains as much may be all there is
ENOUGH = 0.995  # of the unexplained pixels: after such a gain, no more effort is made
ROUGHLY = 0.03  # of the unexplained pixels: what numbers without a range may leave
ALL_EDGES = 1 << 11  # the sample of a refinement: pixels of each kind
MOST_UNSURE = 6  # trials of guesses of all efforts, at most
MOST_SURE = 24  # trials of guesses that gain nearly all, at most: an empty picture has many
MAIN = 0.5  # of the unexplained pixels: a guess with such a gain may need a second one beside it
STARTS = 2  # first guesses of two that are followed
LOST = 0.1  # of the pixels that a first guess settles: it may break no more
IN_PLACES = (  # where most of the picture agrees
    Effort.NOTHING,
    Effort.LEFT_OUT,
    Effort.OBJECT,
    Effort.PIXELS,
    Effort.VIEW,
    Effort.FILM,
    Effort.CAMERA,
    Effort.ANYTHING,
)
# The limit of work; a search that reaches it is given up. A step is a bounded number of rays, pairs
# or pixels, the same on each machine.
STEPS = 16_000
PART = 3  # of them: one search, or one trial, has no more than one part in as many
NONE = Score(0.0, 0.0)


class Guessing:
    """The guesses that are made in one diagnosis, and how many steps of work they took."""

    def __init__(self, faults: Sequence[AnyFault], limit: float) -> None:
        self.faults = faults
        self.limit = limit
        self.steps = 0
        self.guesses = 0
        self.untried: set[str] = set()  # names of faults whose search was not finished

    def _limited(self, work: Work[T], fault: AnyFault) -> Work[T | None]:
        """Run work that looks for a fault.

        If it reaches its part of the limit, or all work does, it may return what it has, or None.
        """
        end = min(self.limit, self.steps + self.limit / PART)
        try:
            while self.steps < end:
                next(work)
                self.steps += 1
                yield None
            self.untried.add(fault.name)
            work.throw(SearchEndedError())
        except StopIteration as stop:
            found: T = stop.value
            return found
        except SearchEndedError:
            pass
        return None

    def trials(self, evidence: Evidence, of: Evidence) -> Work[list[Trial]]:
        """Return guesses tried on the whole picture, the best first.

        Faults without numbers to fit are tried before the others: where one of them does it
        all, a fit that does as well says no more. What is vague comes last: it takes most work,
        and is not told where something exact does as well. Where a fault of the view accounts for
        most, no object's is looked for until that is put right.
        """
        unexplained = float(evidence.unexplained.sum())
        most = of.unexplained.sum()
        faults = [
            f
            for f in self.faults
            if not (f.everywhere and evidence.of_object)
            and least_with(1 if f.refine else 0) <= most
        ]
        pool: list[Scored] = []
        vague: list[Scored] = []
        out: list[Trial] = []
        order = Effort if is_everywhere(evidence) else IN_PLACES
        for number, effort in enumerate(order, 1):
            some = [fault for fault in faults if fault.effort == effort]
            of_view = [t for t in out if not t.guess.object and of is evidence]
            if effort == Effort.OBJECT and any(_may_be_first(of, t) for t in of_view):
                break
            yield Progress(None, f"{number}/{len(order)}: trying {TRIED[effort]}")
            sure: list[Scored] = []
            for one in (yield from self._scored(evidence, some)):
                gain, fault, _ = one
                of_gain = sure if gain >= NEARLY * unexplained else pool
                (vague if fault.vague else of_gain).append(one)
            out += yield from self._trials_of(evidence, of, sure, MOST_SURE)
            if _is_enough(of, out):
                break
        else:
            out += yield from self._trials_of(evidence, of, pool, MOST_UNSURE)
            if not _is_enough(of, out):
                out += yield from self._trials_of(evidence, of, vague, MOST_SURE)
        return sorted(out, key=lambda trial: (-trial.gain, trial.cost))

    def _scored(self, evidence: Evidence, faults: Sequence[AnyFault]) -> Work[list[Scored]]:
        """Score the guesses of some faults on the sample; return those that gain enough."""
        out = []
        for fault in faults:
            found = yield from self._limited(fault.find(evidence), fault)
            for guess in found or ():
                self.guesses += 1
                score = (yield from self._limited(_score(evidence, fault, guess), fault)) or NONE
                if _may_be_finer(evidence, score):
                    guess = yield from self._finer(evidence, fault, guess)
                    again = self._limited(_score(evidence, fault, guess), fault)
                    score = (yield from again) or NONE
                likely = bool(guess.low) or score.gain >= LIKELY * score.broken
                if likely and score.gain >= _least(evidence):
                    out.append((score.gain, fault, guess))
        return out

    def _finer(self, evidence: Evidence, fault: AnyFault, guess: Guess) -> Work[Guess]:
        """Refine the numbers of a roughly fitted guess."""
        if not (fault.refine and guess.low and guess.low == guess.high):
            return guess
        finer = replace(evidence, size=ALL_EDGES, fine=True)
        return (yield from self._limited(fault.refine(finer, guess), fault)) or guess

    def _trials_of(
        self,
        evidence: Evidence,
        of: Evidence,
        scored: list[Scored],
        most: int,
    ) -> Work[list[Trial]]:
        """Try the guesses with the most gain, refining fitted ones."""
        best = max((gain for gain, _, _ in scored), default=0.0)
        # Among equally good guesses try one of each fault first: a fault may have dozens.
        tried: Counter[str] = Counter()
        ranked = []
        for gain, fault, guess in sorted(scored, key=lambda one: -one[0]):
            tried[fault.name] += 1
            if gain >= PROMISING * best:
                cost = len(guess.low) if gain >= AS_GOOD * best else np.inf
                ranked.append((cost, -gain, tried[fault.name], fault, guess))
        ranked.sort(key=lambda one: one[:3])
        out: list[Trial] = []
        done: dict[str, int] = {}  # faults with a guess that does it all, in so many numbers
        for cost, _, _, fault, guess in ranked[:most]:
            worse = cost == np.inf
            longer = not guess.object and len(guess.low) > min(done.values(), default=0)
            if fault.name in done or (done and (worse or longer)):
                continue
            guess = yield from self._finer(evidence, fault, guess)
            trial = yield from self._limited(trial_of(evidence, fault, guess, of), fault)
            if trial and trial.gain > 0:
                out.append(trial)
                if trial.perfect:
                    done[fault.name] = trial.cost
        return out


def _least(evidence: Evidence) -> float:
    """Return how many pixels a guess must settle, at least."""
    return float(max(LEAST_SETTLED, SHARE * evidence.unexplained.sum()))


def _may_be_finer(evidence: Evidence, score: Score) -> bool:
    """Return whether a rough fit may break as many pixels as there are to settle."""
    unexplained = int(evidence.unexplained.sum())
    return (
        score.gain < _least(evidence) and MAIN * unexplained <= score.settled <= unexplained <= FEW
    )


def _score(evidence: Evidence, fault: AnyFault, guess: Guess) -> Work[Score]:
    """Score a guess on the sample; one that cannot be sampled is taken to settle all."""
    if not fault.sampled:
        return Score(float(evidence.unexplained.sum()), 0.0)
    try:
        case = fault.assume(evidence.case, guess)
        if case is None:
            return NONE
        few = yield from evidence.few.score(case)
        if few.gain < UNLIKELY * _least(evidence):
            return few
        return (yield from evidence.score(case))
    except SceneError:
        return NONE


def accounting(guessing: Guessing, evidence: Evidence) -> Work[list[list[Trial]]]:
    """Return the next fault with its alternatives, or two faults that account for more together.

    Of two, the first one alone must lose few pixels, and with the second one more must agree.
    """
    trials = yield from guessing.trials(evidence, evidence)
    if best := _best(evidence, trials):
        return [best]
    turned = yield from _turned(guessing, evidence)
    likely = [t for t in trials[:STARTS] if _may_be_first(evidence, t, not t.broken)]
    for trial in (*turned, *likely):
        first = yield from in_full(trial)
        seconds = yield from guessing.trials(carried(evidence, first), evidence)
        own = first.guess.object  # two changes of one object are one that is not known
        others = [t for t in seconds if not own or t.guess.object != own]
        if best := _best(evidence, [t for t in others if t.gain > first.gain]):
            return [[first], best]
    return []


def _may_be_first(evidence: Evidence, trial: Trial, of_little: bool = False) -> bool:
    """Return whether a second fault may account for what this one, or one of little, leaves."""
    return bool(
        trial.gain >= (SHARE if of_little else MAIN) * evidence.unexplained.sum()
        and trial.broken <= LOST * trial.settled
        and trial.own >= COMPLETE
        and trial.evidence.unexplained.sum() >= LEAST_SETTLED
    )


def _turned(guessing: Guessing, evidence: Evidence) -> Work[list[Trial]]:
    """Try how the picture may be turned if all of its colours are wrong, too.

    No pixel says so then, but surfaces do: one transform makes their colours agree.
    """
    case, picture, out = replace(evidence.case, curves=None), evidence.picture, []
    known = picture.transform or picture.lit or not picture.has_colors
    if known or evidence.unexplained.mean() < MAIN:
        return []
    if case.background is not None:  # what was taken for the picture's is what lies elsewhere in it
        case = case.before(case.background)
        case = replace(case, picture=replace(case.picture, background=None))
    frame = yield from traced_anew(case, evidence.case, evidence.frame)
    evidence = replace(evidence, case=case, frame=frame)
    for fault in (f for f in guessing.faults if f.turns):
        for guess in (yield from fault.find(evidence)):
            if other := fault.assume(case, guess):
                traced = yield from traced_anew(other, case, frame)
                if (yield from find_transform(traced, other.picture, ~boundary(traced))):
                    out.append((yield from trial_of(evidence, fault, guess, promising=True)))
    return [trial for trial in out if trial]


def _good(evidence: Evidence, trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that may be reported."""
    unexplained = int(evidence.unexplained.sum())
    return [
        t
        for t in trials
        if t.precision >= PRECISE
        and t.settled >= least_with(t.cost)
        and t.settled >= SHARE * unexplained
        and min(t.recall, t.own) >= (FITTED if t.cost else COMPLETE)
        and not t.unseen
    ]


def _is_enough(evidence: Evidence, trials: Sequence[Trial]) -> bool:
    """Return whether one that may be reported settles nearly all: then no more are tried."""
    count = evidence.unexplained.sum()
    return any(
        t.gain >= count * (ENOUGH if t.cost <= ENCLOSED else 1 - ROUGHLY)
        for t in _good(evidence, trials)
    )


def _best(evidence: Evidence, trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials with the most gain and the fewest numbers, one of each fault.

    What sums up the others comes first. An object's fault is not told where the picture or the view
    as a whole may have one.
    """
    good = _good(evidence, trials)
    most = max((t.gain for t in good), default=0)
    alike = [t for t in good if t.gain >= (1 - ALIKE) * most]
    fewest = min(((t.fault.vague, t.cost) for t in alike), default=None)
    # A change of one object may look the same in more numbers: report that, too.
    own = {t.guess.object for t in alike if (t.fault.vague, t.cost) == fewest}
    of_one = own - {""} if len(own) == 1 else ()
    alike = [t for t in alike if (t.fault.vague, t.cost) == fewest or t.guess.object in of_one]
    sums_up = any(t.fault.sums_up for t in alike)
    if not sums_up and not all(t.guess.object for t in alike):
        alike = [t for t in alike if not t.guess.object]
    told: dict[str, Trial] = {}
    table = [fault.name for fault in FAULTS]
    place = {t: table.index(t.fault.name) if t.guess.object else 0 for t in alike}
    for trial in sorted(alike, key=lambda t: (not t.fault.sums_up, t.cost, place[t], -t.gain)):
        told.setdefault(trial.fault.name, trial)
    return list(told.values())
