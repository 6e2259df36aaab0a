"""The results of the self-check: a row for each fault, and the rows as text.

Apart from the faults themselves, which take a twentieth of a second to import.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple


class FaultRow(NamedTuple):
    """A fault, and what the comparison made of it."""

    name: str
    text: str
    changed: int = 0  # pixels that the fault changes, in the traced picture or in Blender's
    differ: int = 0  # of those, pixels that differ then
    looked_at: int = 0  # of those, pixels that were checked
    unexplained: int = 0  # of those, pixels that have none
    within_rounding: bool = False  # Blender's own float32 accounts for every changed pixel
    note: str = ""
    named: bool = False  # only the faulty comparison names a transform of the colours
    blind: bool = False  # no changed pixel can be judged

    @property
    def result(self) -> str:
        """The outcome: 'caught', 'missed', or why it could not be caught."""
        if not self.changed:
            return "cannot be seen here"
        if self.unexplained or self.named:
            return "caught"
        if self.blind:
            return "cannot be judged here"
        return "within rounding" if self.within_rounding else "missed"

    @property
    def missed(self) -> bool:
        """Whether it changed the picture and was taken for something else."""
        return self.result == "missed"

    def to_dict(self) -> dict[str, Any]:
        """Return the row as JSON can hold it."""
        held = {k: v for k, v in self._asdict().items() if k not in ("named", "blind")}
        return held | {"result": self.result}


def table(rows: Sequence[FaultRow]) -> list[str]:
    """Return the self-check as lines of text, a fault a line."""
    if not rows:
        return []
    caught = sum(r.result == "caught" for r in rows)
    seen = caught + sum(r.missed for r in rows)
    out = [f"self-check: {caught} of {seen} faults that can be seen here are caught"]
    if blind := sum(r.blind and r.result != "caught" for r in rows):
        out[0] += f"; {blind} more change only what cannot be judged"
    for r in rows:
        pixels = f"{r.unexplained:,} of {r.looked_at:,} px unexplained" if r.changed else ""
        notes = ", ".join(filter(None, (pixels, r.note)))
        told = f" ({notes})" if notes else ""
        out.append(f"  {r.name.replace('_', ' '):18} {r.result}{told}: {r.text}")
    return out
