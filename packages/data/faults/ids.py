"""Faults of ids: objects that have the id of another, or of none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from reference_tracer.arrays import Floats
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.wording import listed

from ..ids import ids_of
from ..kind import Data, Turn
from ..seen import Seen
from .turned import Turned, data_fault

_MOST = 0.5  # of an object's unexplained pixels that have one id, at least
_NAMED = 3  # objects that are named
_LEAST = 8  # pixels that hold a mean
_REACH = 2  # pixels: as far does a filter mix


def _values(evidence: Evidence, data: Data, wrong: bool) -> dict[str, float]:
    """Return the id that most wrong pixels of each object have, or the right one of each.

    Of those that are wrong it has to be more than half.
    """
    scene, seen = evidence.case.scene, evidence.frame.object_index
    made = data.of_frame(evidence.frame)
    out: dict[str, float] = {}
    where = (seen != NOTHING) & (evidence.unexplained | (not wrong))
    for number in np.unique(seen[where]):
        own = where & (seen == number)
        value, count = np.unique((data.values if wrong else made)[own][:, 0], return_counts=True)
        if np.max(count) > _MOST * count.sum():
            out[scene.objects[number]] = float(value[np.argmax(count)])
    return out


def _turned(own: dict[str, float]) -> Turn:
    """Return what gives objects other ids."""

    def turn(made: Floats, seen: Seen) -> Floats:
        new = ids_of(own, seen)
        return np.where(np.isnan(new), made, new)

    return turn


def _is_exchange(evidence: Evidence, data: Data, own: dict[str, float]) -> bool:
    """Return whether objects have one another's ids, and no other."""
    right = _values(evidence, data, wrong=False)
    return len(own) > 1 and {right[name] for name in own} == {*own.values()}


def _shared(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess that each object has the id that most of its wrong pixels have."""
    own = _values(evidence, data, wrong=True)
    if own and not _is_exchange(evidence, data, own):
        words = listed([f"'{name}'" for name in own], _NAMED)
        yield Turned(words=f"{words} {'have' if len(own) > 1 else 'has'}", turn=_turned(own))


def _exchanged(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess that objects whose pixels are wrong have one another's ids."""
    own = _values(evidence, data, wrong=True)
    if _is_exchange(evidence, data, own):
        words = ", ".join(f"'{name}'" for name in own)
        yield Turned(words=words, turn=_turned(own))


def _mixed(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess which pixels hold a mean of ids around them: none of these, but between some."""
    assert data.raw is not None
    made = data.of_frame(evidence.frame)
    raw = np.full(data.raw.shape, np.nan)  # as it should be
    nothing = evidence.frame.object_index == NOTHING
    if (data.blank & nothing).any():
        raw[nothing] = data.raw[data.blank & nothing][0]
    for number in np.unique(made[~nothing]):
        same = data.values[..., 0] == number
        if same.any():
            raw[made[..., 0] == number] = data.raw[same][0]
    rows, columns = np.nonzero(evidence.unexplained)
    held, sides = data.raw[rows, columns][..., None, None], (2 * _REACH + 1,) * 2
    wide = np.pad(raw, ((_REACH, _REACH), (_REACH, _REACH), (0, 0)), "edge")
    around = sliding_window_view(wide, sides, (0, 1))[rows, columns]  # (n, c, y, x)
    own = (around == held).all(axis=1).any(axis=(1, 2))
    low, high = (of.reduce(around, (2, 3), keepdims=True) for of in (np.fmin, np.fmax))
    between = ((low <= held) & (held <= high)).all(axis=(1, 2, 3)) & ~own
    if between.sum() < _LEAST:
        return
    mixed = np.zeros_like(nothing)
    mixed[rows[between], columns[between]] = True
    values = np.where((mixed & ~nothing)[..., None], made, data.values)
    mended = replace(data, values=values, blank=data.blank | (mixed & nothing))
    yield Turned(change=lambda _: mended)


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
    data_fault(
        "id_exchanged",
        ("ids",),
        "{words} have one another's ids",
        "Ids and objects stand in two lists, of which one is sorted.",
        "store the id with the object, or write the table and the picture in one run",
        _exchanged,
        words="which objects",
        witness="facebookresearch/House3D#6",
    ),
    data_fault(
        "id_mixed",
        ("ids",),
        "ids are mixed at edges, as colours are: their means are nobody's ids",
        "The picture of ids is rendered with anti-aliasing, or is scaled smoothly.",
        "render ids with one sample in each pixel's centre, and scale them by the nearest pixel",
        _mixed,
        witness="princeton-vl/infinigen#383",
    ),
)
