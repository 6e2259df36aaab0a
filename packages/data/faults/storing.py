"""Faults of how data are stored: coarser than the file is, or cut off in place of rounded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from reference_tracer.diagnosis.evidence import Evidence

from ..ids import kind_of, owners_of
from ..kind import Data
from ..step import Step
from .turned import Turned, data_fault

_STEPS = (
    (Step("float16"), "half floats, of 11 bits"),
    (Step("float16", cut=True), "half floats, of 11 bits, by cutting off the others"),
    (Step("", 0.001), "steps of a millimetre"),
    (Step("", 0.01), "steps of a centimetre"),
)
NUMBERS = "depth", "distance", "normals", "positions"


def _steps(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess the steps on which all values lie, as they would if they had been rounded to them."""
    own = data.values[~data.blank]
    # Floats were rounded as the file has them, before their unit was applied.
    for known, words in _STEPS:
        step = replace(known, unit=data.step.unit) if known.type else known
        if step.holds(own):
            yield Turned(words=words, change=partial(replace, step=step))


def _cut_off(evidence: Evidence, data: Data) -> Iterator[Turned]:
    if not data.step.type:
        half = data.step.unit / 2
        yield Turned(turn=lambda made, seen: made - half)


def _columns(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess that pixels were stored column by column, from the topmost row or from the lowest."""
    height, width = data.blank.shape
    y, x = np.indices(data.blank.shape)
    for words, upward in (("topmost", False), ("lowest", True)):
        row, column = np.divmod(x * height + (y if upward else height - 1 - y), width)
        row = row if upward else height - 1 - row
        kind, blank = data.kind, data.blank[row, column]
        if kind.presumed:
            numbers = data.values[row, column, 0].ravel()
            own, nothing, _ = owners_of(evidence.case.scene, evidence.frame.hits(), numbers)
            kind, blank = kind_of(own, kind.presumed), nothing.reshape(blank.shape)
        known = partial(replace, kind=kind, blank=blank)
        yield Turned(words=words, where=(row, column), change=known)


STORING_FAULTS = (
    data_fault(
        "column_order",
        (*NUMBERS, "ids"),
        "the pixels are stored column by column, from the {words} row, and read row by row",
        "COCO's masks, MATLAB and Fortran store columns; numpy's reshape takes rows.",
        "reshape with order='F', or transpose before saving",
        _columns,
        words="topmost or lowest",
        witness="cocodataset/cocoapi#184",
    ),
    replace(
        data_fault(
            "data_rounded",
            NUMBERS,
            "the values were rounded before they were stored: to {words}",
            "A renderer's buffer, or a conversion on the way, has fewer digits than the file.",
            "keep float32 from the renderer to the file",
            _steps,
            words="half floats, millimetres or centimetres",
            witness="nerfstudio-project/nerfstudio#2317",
        ),
        vague=True,
        sampled=False,
    ),
    data_fault(
        "data_cut_off",
        NUMBERS,
        "the values are cut off, not rounded, to the file's steps",
        "A cast to integers, such as astype(uint16), drops the fraction.",
        "add half a step before the cast, or round",
        _cut_off,
        witness="instamatic-dev/instamatic#127",
    ),
)
