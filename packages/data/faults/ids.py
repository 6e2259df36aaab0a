"""Faults of ids: objects that have the id of another, or of none."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.tracer.hits import NOTHING

from ..kind import Data
from ..seen import Seen
from .turned import Turned, data_fault

_MOST = 0.5  # of an object's unexplained pixels that have one id, at least
_NAMED = 3  # objects that are named


def _shared(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess that each object has the id that most of its wrong pixels have."""
    scene, seen = evidence.case.scene, evidence.frame.object_index
    own: dict[str, float] = {}
    wrong = evidence.unexplained & (seen != NOTHING)
    for number in np.unique(seen[wrong]):
        shown = data.values[wrong & (seen == number)][:, 0]
        value, count = np.unique(shown, return_counts=True)
        if np.max(count) > _MOST * count.sum():
            own[scene.objects[number]] = float(value[np.argmax(count)])
    if not own:
        return

    def turn(made: Floats, seen: Seen) -> Floats:
        names = seen.scene.objects
        table = np.array([own.get(name, np.nan) for name in names])
        new = table[seen.scene.instance_objects[seen.instance]][:, None]
        return np.where(np.isnan(new), made, new)

    named = [f"'{name}'" for name in own]
    more = len(named) - _NAMED
    words = ", ".join(named[:_NAMED]) + (f" and {more} more" if more > 0 else "")
    yield Turned(words=f"{words} {'have' if len(named) > 1 else 'has'}", turn=turn)


ID_FAULTS = (
    data_fault(
        "id_shared",
        ("ids",),
        "{words} the id of another object, or of none",
        "Ids are cut off to 8 bits, all objects start with the same pass index, or the id 0 stands "
        "for nothing, too.",
        "number the objects from 1, each by itself, and store as many bits as that takes",
        _shared,
        words="which objects",
        witness="DIYer22/bpycv#52",
    ),
)
