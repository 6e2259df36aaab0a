"""Other frames: those around, half of one away, and the ends of the animation."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from ....causes.case import Variant
from ...evaluating import export_at
from .origin import Origin

AROUND = (-1.0, 1.0, -0.5, 0.5, -2.0, 2.0)  # frames


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene at other frames, if anything in the file is animated."""
    if not len(bpy.data.actions):
        return
    tmp = origin.tmp
    now = tmp.frame_current + tmp.frame_subframe
    ends = (float(tmp.frame_start), float(tmp.frame_end), 0.0, 1.0)
    frames = dict.fromkeys(f for f in (*(now + d for d in AROUND), *ends) if f != now)
    for frame in frames:
        yield Variant("other_frame", export_at(tmp, frame), f"{frame:g} in place of {now:g}")
