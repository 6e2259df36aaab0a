"""The threshold self-check: whether this comparison would have found a fault in this very scene.

Known faults are made, one at a time, and judged as the comparison itself was. A fault that changes
no pixel here, as a mirrored camera before a symmetric scene, cannot be seen: that is said, with the
number of pixels that it changed, and not counted as caught.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import SceneError
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import steps
from ..tracer.settings import Settings
from .cause import Cause, differing
from .causes import find_causes
from .faults import FAULTS, Case, Fault, Wrong

ROUNDING = Cause.EDGE, Cause.DEPTH_TIE, Cause.CLIP_PLANE
SAMPLE = 4096  # differing pixels whose cause is looked for: whole pictures may be wrong


@dataclass(frozen=True)
class FaultRow:
    """A fault, and what the comparison made of it.

    `changed` pixels of the traced picture (or of Blender's) are others than without the fault;
    `differ` then differ, `looked_at` of these were asked for their cause, and `unexplained` had
    none. All are `within_rounding` where what Blender's own float32 may do accounts for each.
    """

    name: str
    text: str
    changed: int = 0
    differ: int = 0
    looked_at: int = 0
    unexplained: int = 0
    within_rounding: bool = False
    note: str = ""

    @property
    def result(self) -> str:
        """One of 'caught', 'missed', 'within rounding', 'cannot be seen here'."""
        if not self.changed:
            return "cannot be seen here"
        if self.unexplained:
            return "caught"
        return "within rounding" if self.within_rounding else "missed"

    @property
    def missed(self) -> bool:
        """Whether it changed the picture and was taken for something else."""
        return self.result == "missed"

    def to_dict(self) -> dict[str, Any]:
        """Return the row as JSON can hold it."""
        return asdict(self) | {"result": self.result}


def self_check(case: Case, faults: Sequence[Fault] = FAULTS) -> Work[tuple[FaultRow, ...]]:
    """Make every fault and judge it; yields the share of the work done."""
    rows = []
    for number, fault in enumerate(faults):
        part = 1 / len(faults)
        rows.append((yield from scaled(_judged(case, fault), number * part, part)))
    return tuple(rows)


def _judged(case: Case, fault: Fault) -> Work[FaultRow]:
    try:
        wrong = fault.make(case)
    except SceneError as error:  # nothing can be traced with it: nobody would miss that
        return FaultRow(fault.name, fault.text, note=f"refused: {error}")
    if wrong is None:
        return FaultRow(fault.name, fault.text, note="there is nothing to get wrong")
    frame = case.frame
    if wrong.scene is not case.scene:
        frame = Frame.empty(wrong.scene)
        yield from scaled(steps(wrong.scene, Settings(), frame), 0.0, 0.3)
    changed = int(_changed(case, wrong, frame).sum())
    if not changed:
        return FaultRow(fault.name, fault.text)
    finding = find_causes(
        wrong.scene,
        frame,
        wrong.shown,
        case.unmodelled,
        case.sample_radius,
        case.filter_radius,
        at_most=SAMPLE,
    )
    found = yield from scaled(finding, 0.3, 0.7)
    looked_at = int((found.cause != Cause.AGREE).sum())
    unexplained = int((found.cause == Cause.UNEXPLAINED).sum())
    differ = looked_at + found.passed_over
    within = bool(np.isin(found.cause, (Cause.AGREE, *ROUNDING)).all())
    return FaultRow(fault.name, fault.text, changed, differ, looked_at, unexplained, within)


def _changed(case: Case, wrong: Wrong, frame: Frame) -> NDArray[np.bool_]:
    """Return which pixels (h, w) the fault changes: their colour, or whose surface they show."""
    if wrong.scene is case.scene:
        changed = differing(case.shown.color, wrong.shown.color)
        return (
            changed
            if case.shown.owner is None
            else changed | (case.shown.owner != wrong.shown.owner)
        )
    changed = differing(case.frame.color, frame.color)
    if case.shown.owners is None:
        return changed
    before = case.shown.owners[case.frame.instance_index]
    return changed | (before != wrong.shown.owners[frame.instance_index])


def table(rows: Sequence[FaultRow]) -> list[str]:
    """Return the self-check as a person reads it, a fault a line."""
    if not rows:
        return []
    caught = sum(r.result == "caught" for r in rows)
    seen = caught + sum(r.missed for r in rows)
    out = [f"self-check: {caught} of {seen} faults that can be seen here are caught"]
    for r in rows:
        pixels = f"{r.unexplained:,} of {r.looked_at:,} px unexplained" if r.changed else r.note
        told = f" ({pixels})" if pixels else ""
        out.append(f"  {r.name.replace('_', ' '):18} {r.result}{told}: {r.text}")
    return out
