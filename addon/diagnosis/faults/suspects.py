"""Which objects a fault is looked for in, and which ones the self-check makes it of."""

from __future__ import annotations

import numpy as np

from ...causes.case import Case
from ...tracer.frame import Frame
from .fault import Find, Guess, Numbers, Values, at_once


def suspects(*values: float) -> Find[Numbers]:
    """Return what suspects each object that is seen in unexplained pixels, with some numbers."""
    chosen: list[Values] = [(value,) for value in values] or [()]
    return at_once(
        lambda evidence: [
            Numbers(some, object=name) for name in evidence.suspects for some in chosen
        ]
    )


def largest(case: Case, frame: Frame) -> Guess | None:
    """Pick the object whose instance is seen in the most pixels."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    return Guess(object=case.scene.objects[case.scene.instances[seen[0]].object])


def seen_instances(case: Case, frame: Frame) -> list[int]:
    """Return the instances of meshes that are seen, those of the most pixels first."""
    index = frame.instance_index
    index = index[(index >= 0) & (index < len(case.scene.instances))]
    found, count = np.unique(index, return_counts=True)
    return [int(i) for i in found[np.argsort(-count, kind="stable")]]
