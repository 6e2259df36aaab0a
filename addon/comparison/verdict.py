"""How a comparison ends."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Verdict(StrEnum):
    """How a comparison ended; the gravest last.

    A picture of another size (exit code 3) ends a command before there is a verdict.
    """

    AGREE = "agree"
    WARNINGS = "warnings"
    NOT_COMPARABLE = "not comparable"
    CANCELLED = "cancelled"
    DIFFERENCES = "differences"
    FAILED = "failed"  # nothing could be compared: the input cannot be read

    @property
    def exit_code(self) -> int:
        """What it is to a shell."""
        return _EXIT_CODES.get(self, 1)

    @property
    def gravity(self) -> int:
        """Its place among all of them, the gravest last."""
        return list(Verdict).index(self)

    @classmethod
    def gravest(cls, verdicts: Iterable[Verdict]) -> Verdict:
        """Return the gravest of one or more."""
        return max(verdicts, key=lambda verdict: verdict.gravity)


_EXIT_CODES = {Verdict.AGREE: 0, Verdict.DIFFERENCES: 2, Verdict.FAILED: 4}
