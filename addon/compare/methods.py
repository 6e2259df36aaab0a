"""What the textbook and the certified tracer make of the same picture: wrong pixels, seconds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..methods import Method
from ..scene import Scene
from ..tracer.certified.certainty import Certainty, broken_assumptions
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import steps
from ..tracer.settings import Precision, Settings


@dataclass(frozen=True)
class MethodRow:
    """One way to trace a picture."""

    method: str
    precision: str
    samples: int
    seconds: float
    wrong_pixels: int | None  # whose surface is not the certified one; None: nothing is certified
    ambiguous: int  # pixels that have no unique answer, which the certified tracer's rule decided
    required: tuple[str, ...] = ()  # what the scene required, in words

    def to_dict(self) -> dict[str, Any]:
        """Return the row as JSON can hold it."""
        return vars(self) | {"seconds": round(self.seconds, 6), "required": list(self.required)}

    def line(self) -> str:
        """Return what a person wants to know."""
        found = "" if self.wrong_pixels is None else f", {self.wrong_pixels:,} wrong pixels"
        open_ = f" ({self.ambiguous:,} ambiguous)" if self.ambiguous else ""
        return f"  {self.method} {self.precision}: {self.seconds:.2f} s{found}{open_}"


def list_methods(scene: Scene, settings: Settings, frame: Frame) -> Work[tuple[MethodRow, ...]]:
    """Trace a scene by the textbook and certified, too; yields the share of the work done.

    Parameters
    ----------
    scene : Scene
    settings : Settings
        What `frame` was traced with.
    frame : Frame

    Returns
    -------
    tuple of MethodRow
        Certified where that is possible, the textbook in float64, and what `frame` is if neither.
    """
    certified = None if broken_assumptions() else (Method.CERTIFIED, Precision.FLOAT64)
    own = Method(frame.statistics.method), settings.precision
    frames = {own: frame}
    wanted = [w for w in (certified, (Method.TEXTBOOK, Precision.FLOAT64)) if w]
    missing = [w for w in wanted if w not in frames]
    for number, (method, precision) in enumerate(missing):
        traced = frames[method, precision] = Frame.empty(scene)
        tracing = steps(scene, Settings(method, precision), traced)
        yield from scaled(tracing, number / len(missing), 1 / len(missing))
    truth = frames[certified] if certified else None
    order: Sequence = [*wanted, *(f for f in frames if f not in wanted)]
    return tuple(
        _row(method, precision, settings.samples if key == own else 1, frames[key], truth)
        for key in order
        for method, precision in [key]
    )


def _row(method, precision, samples: int, frame: Frame, truth: Frame | None) -> MethodRow:
    wrong = None if truth is None else int(frame.wrong_against(truth).sum())
    ambiguous = 0 if truth is None else int((truth.certainty == Certainty.AMBIGUOUS).sum())
    took = frame.statistics
    return MethodRow(
        method.value,
        precision.value,
        samples,
        took.seconds,
        wrong,
        ambiguous,
        tuple(took.required()),
    )
