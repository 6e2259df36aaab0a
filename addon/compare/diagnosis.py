"""The diagnosis: what accounts for the unexplained pixels, with numbers that one can act on.

Each known fault is put into the scene that is traced, or taken out of the picture. It is told only
if the picture then agrees: `guessing.py` says under which conditions. It never changes the verdict.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..arrays import Colors
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from .case import Case
from .cause import Causes
from .evidence import Evidence
from .faults import FAULTS
from .faults.fault import Fault, Guess
from .guessing import LEAST, SECONDS, Guessing, accounting, carried, with_variants
from .identity import Identity
from .regions import Region, regions, sides
from .trial import Trial

ROUNDS = 3  # faults one after the other, at most
FRAMED = 5  # regions that are named


@dataclass(frozen=True, eq=False)
class Told:
    """A fault that accounts for unexplained pixels."""

    fault: Fault
    guess: Guess
    unexplained: int  # pixels, before
    settled: int  # of these, pixels that agree with this put right
    agreed: int  # pixels that agreed or had a cause
    broken: int  # of these, pixels that do not, with this put right
    frame: Frame  # what is traced with it, and with those told before, in the picture's colours
    picture: Colors  # what it is compared with, (h, w, 4) linear RGBA
    alternative: bool = False  # it does as well as the one told before it

    @property
    def sentence(self) -> str:
        """What is wrong, without a full stop."""
        return self.fault.told(self.guess)

    def effect(self) -> str:
        """Say what putting it right does."""
        lost = f"{self.broken:,}" if self.broken else "none"
        return (
            f"with this put right, {self.settled:,} of {self.unexplained:,} unexplained pixels "
            f"agree, and {lost} that agreed {'are' if self.broken > 1 else 'is'} lost"
        )

    def enclosed(self) -> str:
        """Say between what its numbers lie; empty if none was fitted, or each is one number."""
        g = self.guess
        ends = zip(self.fault.numbers, g.low, g.high, strict=False)
        wide = ((name, f"{low:.6g}", f"{high:.6g}") for name, low, high in ends)
        return ", ".join(f"{name} from {low} to {high}" for name, low, high in wide if low != high)

    def lines(self) -> Iterator[str]:
        """Yield it as a person reads it."""
        yield f"diagnosis: {'or, as likely, ' if self.alternative else ''}{self.sentence}"
        yield f"           {self.effect()}"
        if enclosed := self.enclosed():
            yield f"           it agrees as well for {enclosed}"
        yield f"           what to do: {self.fault.advised(self.guess)}"

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        g = self.guess
        numbers = {name: [v] for name, v in zip(self.fault.numbers, g.values, strict=False)}
        for name, low, high in zip(self.fault.numbers, g.low, g.high, strict=False):
            numbers[name] += [low, high]
        return {
            "fault": self.fault.name,
            "sentence": self.sentence,
            "advice": self.fault.advised(g),
            "object": g.object,
            "numbers": numbers,
            "alternative": self.alternative,
            "unexplained": self.unexplained,
            "settled": self.settled,
            "agreed": self.agreed,
            "broken": self.broken,
        }


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What accounts for the unexplained pixels of a comparison."""

    told: tuple[Told, ...] = ()
    guesses: int = 0  # that were tried on the sample
    seconds: float = 0.0
    ended: bool = False  # before all guesses were made, as it took too long
    left: int = 0  # pixels that nothing accounts for
    regions: tuple[Region, ...] = ()  # in which these are, those of the most pixels first

    def lines(self) -> list[str]:
        """Return what a person wants to know first."""
        out = [line for told in self.told for line in told.lines()]
        if not out:
            out = ["diagnosis: no known fault accounts for the unexplained pixels"]
        if self.left:
            places = "region" if len(self.regions) == 1 else "regions"
            out.append(f"           {self.left:,} px are left, in {len(self.regions)} {places}:")
            out += [f"             {_framed(region)}" for region in self.regions[:FRAMED]]
        if self.ended:
            out.append(f"           (ended after {self.seconds:.0f} s, before all were tried)")
        return out

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return {
            "told": [told.to_dict() for told in self.told],
            "guesses": self.guesses,
            "seconds": round(self.seconds, 3),
            "ended": self.ended,
            "left": self.left,
            "regions": [region.to_dict() for region in self.regions],
        }


def _framed(region: Region) -> str:
    """Say where a region is, and what is in it; the pixel counts from the picture's lower left."""
    shows = ", ".join(f"'{name}'" for name in region.objects[:3]) or "nothing of the scene"
    place = f"{region.width} x {region.height} px from ({region.left}, {region.bottom})"
    return f"{region.pixels:,} px in {place}: {shows}"


def diagnose(
    case: Case,
    frame: Frame,
    causes: Causes,
    faults: Sequence[Fault] = FAULTS,
    seconds: float = SECONDS,
) -> Work[Diagnosis]:
    """Look for what accounts for the unexplained pixels; yields the share of the work done.

    The frame was traced of the case, and the causes were found of it, all before the picture's own
    background. If nothing is unexplained, nothing is done. No guess is begun after `seconds`.
    """
    evidence = Evidence(case, frame, causes)
    if not evidence.open.any() or frame.cancelled:
        return Diagnosis()
    guessing = Guessing(faults, seconds)
    evidence = yield from with_variants(evidence)
    was_open = evidence.open
    told: list[Told] = []
    for number in range(ROUNDS):
        finding = accounting(guessing, evidence)
        chain = yield from scaled(finding, number / ROUNDS, 1 / ROUNDS)
        if not chain:
            break
        for trials in chain:
            told += [_told(evidence, trial, bool(n)) for n, trial in enumerate(trials)]
        for first, *_ in chain:
            evidence = carried(evidence, first)
        remain = int((evidence.open & was_open).sum())
        broken = int((evidence.open & ~was_open).sum())
        if remain < max(
            LEAST, broken
        ):  # what was broken is no other fault's, nor is what is beside
            break
    seconds = time.monotonic() - guessing.began
    left = int(evidence.open.sum())
    framed = _regions(evidence) if left else ()
    return Diagnosis(tuple(told), guessing.guesses, seconds, guessing.ended, left, framed)


def _regions(evidence: Evidence) -> tuple[Region, ...]:
    """Return the regions of what is unexplained, with the objects in them."""
    case, frame = evidence.case, evidence.frame
    identity, picture = None, case.picture
    if picture.owner is not None and picture.owners is not None:
        own = picture.owners[frame.instance_index]
        identity = Identity(picture.names, own, picture.owner)
    return tuple(regions(evidence.open, sides(case.scene, frame, identity)))


def _told(evidence: Evidence, trial: Trial, alternative: bool) -> Told:
    after = trial.evidence
    color = after.frame.color.copy()
    made = after.case.picture.made_of(color)  # by a transform, if that is the fault
    color[..., : made.shape[-1]] = made
    return Told(
        trial.fault,
        trial.guess,
        int(evidence.open.sum()),
        trial.settled,
        int(evidence.judged.sum()),
        trial.broken,
        replace(after.frame, color=color),
        after.case.picture.color,
        alternative,
    )
