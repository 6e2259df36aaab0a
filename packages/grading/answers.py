"""What a student's function made of the checks, and which of that is wrong, in three ways.

Hits, t and barycentrics are judged apart: one may be wrong where the others are right.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from reference_tracer.arrays import Floats

from .checks import Checks, Group
from .faults import Tests
from .programs import Mask
from .tally import Tally
from .wrong_case import WrongCase

MOST, FEW = 0.9, 0.1  # shares of pairs: "nearly all", "hardly any"


@dataclass(frozen=True, eq=False)
class Answers:
    """What a function made of the checks: t (n,), barycentrics (n, 3)."""

    checks: Checks
    t: Floats  # -inf: it raises
    s: Floats

    @property
    def cases(self) -> Checks:
        """The checks."""
        return self.checks

    @cached_property
    def table(self) -> Floats:
        """T and barycentrics side by side, (n, 4)."""
        return np.column_stack((self.t, self.s))

    @property
    def tests(self) -> tuple[Tests, ...]:
        """The tests for faults that are no mutation of a formula."""
        from .hit_faults import HIT_TESTS
        from .value_faults import S_TESTS, T_TESTS

        return (
            Tests(self.wrong_hit, HIT_TESTS, "hits"),
            Tests(self.wrong_t, T_TESTS, "values of t"),
            Tests(self.wrong_s, S_TESTS, "barycentrics"),
        )

    @property
    def examples(self) -> list[WrongCase]:
        """None: each fault is shown in the scenes."""
        return []

    @property
    def tally(self) -> Tally:
        """How many are right."""
        known, raised = self.checks.known, np.isneginf(self.t)
        right = {
            "surface": (self.hit == known.hit) & ~raised,
            "t": self.both & ~self.wrong_t,
            "barycentrics": self.both & ~self.wrong_s,
        }
        counted = (self.hit | known.hit | raised) & self.counts
        doubt = known.doubt & ~raised
        return Tally.of(counted, doubt, right, self.checks.subject.weights)

    @cached_property
    def hit(self) -> Mask:
        """Where it says to hit, in front or behind."""
        return np.isfinite(self.t)

    @property
    def to_hit(self) -> Mask:
        """Where it should say so."""
        return self.checks.known.hit

    @property
    def counts(self) -> Mask:
        """Which pairs are more than a means to tell mistakes apart."""
        return ~self.checks.of(Group.ELSEWHERE)

    @cached_property
    def both(self) -> Mask:
        """Where it says to hit, and does, and where that counts."""
        return self.hit & self.checks.known.hit & self.counts

    @cached_property
    def wrong_hit(self) -> Mask:
        """Where it hits what it should not, or the other way round, without a doubt."""
        known = self.checks.known
        return (self.hit != known.hit) & ~known.doubt & ~np.isneginf(self.t)

    @cached_property
    def wrong_t(self) -> Mask:
        """Where a hit is right, and its t is off by more than float64 may be."""
        return self.both & ~self.is_t(self.t)

    @cached_property
    def wrong_s(self) -> Mask:
        """Where a hit is right, and a barycentric is off by more than float64 may be."""
        return self.both & ~self.are_s(self.s)

    @property
    def wrong(self) -> Mask:
        """Where any of the three is wrong."""
        return self.wrong_hit | self.wrong_t | self.wrong_s

    def is_t(self, t: Floats) -> Mask:
        """Return where t (n,) is the true one."""
        known = self.checks.known
        with np.errstate(all="ignore"):
            return np.abs(t - known.t) <= known.t_allowed

    def are_s(self, s: Floats) -> Mask:
        """Return where barycentrics (n, 3) are the true ones."""
        known = self.checks.known
        with np.errstate(all="ignore"):
            return (np.abs(s - known.s) <= known.s_allowed[:, None]).all(axis=1)

    def share(self, what: Mask, *groups: Group, where: Mask | None = None) -> float:
        """Return of how many pairs of some groups something holds, 0 to 1; 0 of none."""
        of = self.checks.of(*groups)
        if where is not None:
            of = of & where
        return float(what[of].mean()) if of.any() else 0.0

    @cached_property
    def facing(self) -> Mask:
        """Where the ray sees the corners counter-clockwise."""
        p = self.checks.triangles
        n = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        return (n * self.checks.directions).sum(axis=1) < 0
