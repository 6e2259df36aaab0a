"""Chooses the objects in which a fault is searched, and those to which the self-check gives it."""

from __future__ import annotations

import numpy as np

from ...causes.case import Case
from ...tracer.frame import Frame
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import Guess


@at_once
def suspects(evidence: Evidence) -> list[Guess]:
    """Guess each suspected object."""
    return [Guess(object=name) for name in evidence.suspects]


def largest(case: Case, frame: Frame) -> Guess | None:
    """Pick the object of the instance visible in the most pixels."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    return Guess(object=case.scene.objects[case.scene.instances[seen[0]].object])


def seen_instances(case: Case, frame: Frame) -> list[int]:
    """Return the visible instances, those with the most pixels first."""
    index = frame.instance_index
    index = index[(index >= 0) & (index < len(case.scene.instances))]
    found, count = np.unique(index, return_counts=True)
    return [int(i) for i in found[np.argsort(-count, kind="stable")]]
