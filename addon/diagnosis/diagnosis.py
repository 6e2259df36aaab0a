"""The diagnosis: what accounts for the unexplained pixels, with numbers to act on.

Each known fault is put into the scene that is traced, or taken out of the picture. It is told only
if the picture then agrees: `guessing.py` says under which conditions. It never changes the verdict.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..arrays import Colors
from ..causes.case import Case
from ..causes.cause import Causes
from ..tracer.frame import Frame
from ..tracer.progress import Work
from ..wording import count_of, listed
from .evidence import LEAST_SETTLED, Evidence
from .faults import FAULTS
from .faults.fault import AnyFault, Guess
from .faults.fitting import ENCLOSED
from .guessing import ROUGHLY, STEPS, Guessing, accounting
from .regions import Region, regions, sides
from .trial import Trial, counted, in_full
from .variants import carried, in_its_colors, with_variants

ROUNDS = 3  # faults one after the other, at most
FRAMED = 5  # regions that are named
ALTERNATIVES = 3  # that are reported in full
NAMED = 6  # faults that are named where there is no room for more


@dataclass(frozen=True, eq=False)
class Told:
    """A fault that accounts for unexplained pixels."""

    fault: AnyFault
    guess: Guess
    unexplained: int  # pixels, before
    settled: int  # of these, pixels that agree with this put right
    agreed: int  # pixels that agreed or had a cause
    broken: int  # of these, pixels that do not, with this put right
    frame: Frame  # traced with it, and with those before it, in the picture's colours
    picture: Colors  # what it is compared with, (h, w, 4) linear RGBA
    alternative: bool = False  # it explains as much as the one before it
    also: tuple[str, ...] = ()  # names of further faults that do as well
    colors: str = ""  # by which transform colours then agree, if they did not before

    @property
    def sentence(self) -> str:
        """The fault in words, without a full stop."""
        then = f"; its colours then agree by one transform: {self.colors}" if self.colors else ""
        return self.fault.sentence_of(self.guess) + then

    def effect(self) -> str:
        """Say what putting it right does."""
        lost = f"{self.broken:,}" if self.broken else "none"
        return (
            f"with this put right, {self.settled:,} of {self.unexplained:,} unexplained pixels "
            f"agree, and {lost} that agreed {'are' if self.broken > 1 else 'is'} lost"
        )

    @property
    def is_all(self) -> bool:
        """Whether it settles all that was unexplained, and loses nothing."""
        return self.settled == self.unexplained and not self.broken

    def enclosed(self) -> str:
        """Say the ranges of its numbers; empty if none was fitted, or none has a range.

        Where pixels are left, or lost, something else is wrong, too, or the fit ended beside the
        best place: then nothing is said of how far the numbers may be off.
        """
        g = self.guess
        if not self.is_all:
            return ""
        ends = zip(self.fault.numbers, g.low, g.high, strict=False)
        wide = ((name, f"{low:.6g}", f"{high:.6g}") for name, low, high in ends)
        said = [f"{name} from {low} to {high}" for name, low, high in wide if low != high]
        return ", ".join([*said, "each by itself"] if len(said) > 1 else said)

    def lines(self) -> Iterator[str]:
        """Yield it as lines of text."""
        yield f"diagnosis: {'or, as likely, ' if self.alternative else ''}{self.sentence}"
        yield f"           {self.effect()}"
        if enclosed := self.enclosed():
            yield f"           as many pixels agree with {enclosed}"
        if self.also:
            named = ", ".join(map(spoken, self.also))
            how = "so it would be with" if self.fault.sums_up else "as likely"
            yield f"           {how}: {named}"
        yield f"           what to do: {self.fault.advice_of(self.guess)}"

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        g = self.guess
        numbers = {name: [v] for name, v in zip(self.fault.numbers, g.values, strict=False)}
        if self.is_all:
            for name, low, high in zip(self.fault.numbers, g.low, g.high, strict=False):
                numbers[name] += [low, high]
        return {
            "fault": self.fault.name,
            "sentence": self.sentence,
            "advice": self.fault.advice_of(g),
            "object": g.object,
            "numbers": numbers,
            "alternative": self.alternative,
            "also": list(self.also),
            "unexplained": self.unexplained,
            "settled": self.settled,
            "agreed": self.agreed,
            "broken": self.broken,
        }


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """The faults that account for the unexplained pixels of a comparison."""

    told: tuple[Told, ...] = ()
    guesses: int = 0  # that were tried on the sample
    steps: int = 0  # of work
    seconds: float = 0.0
    untried: tuple[str, ...] = ()  # faults with a search that was not finished: it took too many
    left: int = 0  # pixels that nothing accounts for
    regions: tuple[Region, ...] = ()  # in which these are, those of the most pixels first
    silent: str = ""  # why there was no search, without a full stop

    def lines(self) -> list[str]:
        """Return it as lines of text, the most important first."""
        out = [line for told in self.told for line in told.lines()]
        if not out:
            which = "fault that was tried" if self.untried else "known fault"
            none = f"no {which} accounts for the unexplained pixels"
            out = [f"diagnosis: {self.silent or none}"]
        if self.left:
            places = count_of(len(self.regions), "region")
            out.append(f"           {self.left:,} px are left, in {places}:")
            out += [f"             {_framed(region)}" for region in self.regions[:FRAMED]]
        if self.untried and not (self.told and self.told[-1].is_all):
            untried = listed([*map(spoken, self.untried)], NAMED)
            out.append(f"           (a limit of work ended the search for: {untried})")
        return out

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return {
            "told": [told.to_dict() for told in self.told],
            "guesses": self.guesses,
            "steps": self.steps,
            "seconds": round(self.seconds, 3),
            "ended": bool(self.untried),
            "untried": list(self.untried),
            "left": self.left,
            "regions": [region.to_dict() for region in self.regions],
            "silent": self.silent,
        }


def _framed(region: Region) -> str:
    """Say where a region is, from the picture's lower left, and what is in it."""
    shows = ", ".join(f"'{name}'" for name in region.objects[:3]) or "nothing of the scene"
    place = f"{region.width} x {region.height} px from ({region.left}, {region.bottom})"
    return f"{region.pixels:,} px in {place}: {shows}"


def diagnose(
    case: Case,
    frame: Frame,
    causes: Causes,
    faults: Sequence[AnyFault] | None = None,
    steps: float = STEPS,
) -> Work[Diagnosis]:
    """Look for what accounts for the unexplained pixels.

    The frame was traced of the case, and the causes were found of it, all before the picture's own
    background. If nothing is unexplained, nothing is done. No guess is begun after `steps`.
    """
    evidence = in_its_colors(Evidence(case, frame, causes))
    if not evidence.unexplained.any() or frame.cancelled:
        return Diagnosis()
    began = time.monotonic()
    silent = case.picture.silent(frame)
    known = case.picture.faults_of(FAULTS) if faults is None else faults
    guessing = Guessing(() if silent else known, steps)
    evidence = yield from with_variants(evidence)
    at_first = evidence.unexplained
    told: list[Told] = []
    for _ in range(ROUNDS):
        chain = yield from accounting(guessing, evidence)
        if not chain:
            break
        for trials in chain:
            trials[0] = yield from in_full(trials[0])
            told += _all_told(evidence, trials)
            evidence = carried(evidence, trials[0])
        remain = int((evidence.unexplained & at_first).sum())
        broken = int((evidence.unexplained & ~at_first).sum())
        # Do not blame another fault for pixels that this one broke, for their neighbours, or for
        # what a rough fit leaves.
        own = ROUGHLY * at_first.sum() if len(chain[0][0].guess.values) > ENCLOSED else 0
        if remain < max(LEAST_SETTLED, broken, own):
            break
    left = int(evidence.unexplained.sum())
    return Diagnosis(
        tuple(told),
        guessing.guesses,
        guessing.steps,
        time.monotonic() - began,
        tuple(sorted(guessing.untried)),
        left,
        _regions(evidence),
        silent,
    )


def _regions(evidence: Evidence) -> tuple[Region, ...]:
    """Return the regions of what is unexplained, with the objects in them."""
    case, frame = evidence.case, evidence.frame
    identity = case.picture.identity(frame.instance_index)
    return tuple(regions(evidence.unexplained, sides(case.scene, frame, identity)))


def spoken(name: str) -> str:
    """Return a fault's name in words: its sentence, if that is the same for every guess."""
    same = (f.sentence for f in FAULTS if f.name == name and "{" not in f.sentence)
    return next(same, name.replace("_", " "))


def _all_told(evidence: Evidence, trials: Sequence[Trial]) -> list[Told]:
    """Return what is reported of a fault and its alternatives, the first few in full."""
    first, *others = trials
    many = 0 if first.fault.sums_up else ALTERNATIVES
    also = tuple(t.fault.name for t in others[many:])
    at_length = [_told(evidence, t, True) for t in others[:many]]
    return [replace(_told(evidence, first, False), also=also), *at_length]


def _told(evidence: Evidence, trial: Trial, alternative: bool) -> Told:
    """Return what is reported of a trial, counted in the evidence before it."""
    after = trial.evidence
    settled, broken, _, _ = counted(evidence, after)
    color = after.case.picture.as_shown(after.frame)
    return Told(
        trial.fault,
        trial.guess,
        int(evidence.unexplained.sum()),
        settled,
        int(evidence.judged.sum()),
        broken,
        replace(after.frame, color=color),
        after.case.picture.color,
        alternative,
        colors="" if evidence.picture.transform else after.causes.transform,
    )
