"""How a comparison ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..causes.counts import Counts

BUT = ", but for "  # what an agreement leaves out


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
        """The exit code of a command."""
        return _EXIT_CODES.get(self, 1)

    @property
    def gravity(self) -> int:
        """Its place among all of them, the gravest last."""
        return list(Verdict).index(self)

    def in_words(self, counts: Counts, words: Callable[[str], str] = str) -> str:
        """Return it in a line with the pixels that do not agree; `words` translates its parts."""
        verdict = words(self.capitalize())
        most_first = sorted(counts.of_causes(), key=lambda found: -found[1])
        but = ", ".join(cause.count_in_words(n, words) for cause, n in most_first)
        if not but:
            return verdict
        return f"{verdict}{words(BUT) if self is Verdict.AGREE else ': '}{but}"

    @classmethod
    def gravest(cls, verdicts: Iterable[Verdict]) -> Verdict:
        """Return the gravest of one or more."""
        return max(verdicts, key=lambda verdict: verdict.gravity)


_EXIT_CODES = {Verdict.AGREE: 0, Verdict.DIFFERENCES: 2, Verdict.FAILED: 4}
