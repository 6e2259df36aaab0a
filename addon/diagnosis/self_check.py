"""The self-check: whether the comparison would have found a fault in this very scene.

Known faults are made, one at a time, and explained as the comparison itself was: by the same
function, method, alternatives and curves. A fault is caught if it leaves pixels unexplained, or if
the comparison then names a transform of the colours that it did not name before. Two kinds of
faults are reported, but not counted: those that change no pixel here, as a mirrored camera before
a symmetric scene, and those that change only pixels that cannot be judged.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Bools
from ..causes.case import Case
from ..causes.cause import AGREE, UNEXPLAINED, Causes
from ..causes.explain import CAUSES, explain
from ..pictures.storage import differing
from ..scene import SceneError
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from .fault_rows import FaultRow
from .faults import EXAMPLES
from .faults.fault import AnyFault, Example
from .trial import traced_anew

# Differing pixels that are checked, as whole pictures may be wrong: more only where
# the fewer leave none unexplained.
SAMPLES = 256, 4096


def self_check(
    case: Case,
    frame: Frame,
    causes: Causes,
    examples: Sequence[tuple[AnyFault, Example]] = EXAMPLES,
) -> Work[tuple[FaultRow, ...]]:
    """Make every example of a fault and see what becomes of it.

    `case` is the right one, as it was given; `frame` was traced, and `causes` were found of it.
    """
    rows: list[FaultRow] = []
    part = 1 / len(examples)
    for fault, example in examples:
        words = f"self-check: {example.name.replace('_', ' ')}"
        checking = _checked(case, frame, causes, fault, example)
        row = yield from scaled(checking, len(rows) * part, part, words)
        rows.append(row)
    return tuple(rows)


def _checked(
    case: Case, frame: Frame, causes: Causes, fault: AnyFault, example: Example
) -> Work[FaultRow]:
    row = FaultRow(example.name, example.text)
    try:
        guess = example.pick(case, frame)
        wrong = None if guess is None else (example.make or fault.assume)(case, guess)
    except SceneError as error:  # the scene cannot be traced then, which nobody would overlook
        return row._replace(note=f"refused: {error}")
    if wrong is None:
        return row._replace(note="there is nothing to get wrong")
    traced = yield from scaled(traced_anew(wrong, case, frame), 0.0, 0.3)
    changed = _changed(case, frame, wrong, traced)
    if not changed.any():
        return row
    for most in SAMPLES:
        found = (yield from scaled(explain(wrong, traced, most), 0.3, 0.7)).causes
        of_fault = found.cause[changed]
        named = bool(found.transform) and found.transform != causes.transform
        if named or not len(found.passed_over) or (of_fault == UNEXPLAINED).any():
            break
    looked_at = int((of_fault != AGREE).sum())
    rounding = [c for c in CAUSES if c.rounding or c == AGREE]
    return row._replace(
        changed=int(changed.sum()),
        differ=looked_at + len(found.passed_over),
        looked_at=looked_at,
        unexplained=int((of_fault == UNEXPLAINED).sum()),
        within_rounding=bool(np.isin(of_fault, rounding).all()),
        note=f"named: {found.transform}" if named else "",
        named=named,
        blind=not (changed & ~causes.unjudged & ~found.unjudged).any(),
    )


def _changed(case: Case, frame: Frame, wrong: Case, traced: Frame) -> Bools:
    """Return which pixels (h, w) the fault changes, in colour or in the object shown."""
    own, other = case.picture.owners, wrong.picture.owners
    if traced is frame:  # it is the picture's
        changed = differing(case.picture.color, wrong.picture.color)
        return changed | (own.pixels != other.pixels) if own and other else changed
    changed = differing(frame.color, traced.color)
    if not own or not other:
        return changed
    return changed | (own.instances[frame.instance_index] != other.instances[traced.instance_index])
