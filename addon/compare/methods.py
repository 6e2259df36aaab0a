"""What the textbook and the certified tracer make of the same picture: wrong pixels, seconds."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..certainty import Certainty
from ..certified.arithmetic import broken_assumptions
from ..methods import Method
from ..rendering import steps
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import Tracer
from ..tracer.settings import Precision, Settings


class MethodRow(NamedTuple):
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
        return self._asdict() | {"seconds": round(self.seconds, 6), "required": list(self.required)}

    def line(self) -> str:
        """Return what a person wants to know."""
        found = "" if self.wrong_pixels is None else f", {self.wrong_pixels:,} wrong pixels"
        open_ = f" ({self.ambiguous:,} ambiguous)" if self.ambiguous else ""
        return f"  {self.method} {self.precision}: {self.seconds:.2f} s{found}{open_}"


def list_methods(
    scene: Scene, settings: Settings, frame: Frame, tracer: Tracer | None = None
) -> Work[tuple[tuple[MethodRow, ...], Frame]]:
    """Trace a scene by the textbook and certified, too; yields the share of the work done.

    Returns a row of the certified tracer where that is possible, of the textbook in float64, and of
    `frame`, which was traced with `settings`, if it is neither; and the textbook's frame.
    """
    own = Method(frame.statistics.method), settings.precision
    possible = [Method.TEXTBOOK] if broken_assumptions() else [Method.CERTIFIED, Method.TEXTBOOK]
    wanted = [(method, Precision.FLOAT64) for method in possible]
    frames = dict.fromkeys(wanted) | {own: frame}
    missing = [w for w in wanted if w != own]
    for number, key in enumerate(missing):
        frames[key] = Frame.empty(scene)
        tracing = steps(scene, Settings(*key), frames[key], tracer)
        yield from scaled(tracing, number / len(missing), 1 / len(missing))
    truth = frames[wanted[0]] if Method.CERTIFIED in possible else None
    rows = tuple(
        _row(*key, settings.samples if key == own else 1, traced, truth)
        for key, traced in frames.items()
    )
    return rows, frames[wanted[-1]]


def _row(
    method: Method, precision: Precision, samples: int, frame: Frame, truth: Frame | None
) -> MethodRow:
    wrong = None if truth is None else int(frame.wrong_against(truth).sum())
    ambiguous = 0 if truth is None else int((truth.certainty == Certainty.AMBIGUOUS).sum())
    names, took = (method.value, precision.value), frame.statistics
    return MethodRow(*names, samples, took.seconds, wrong, ambiguous, tuple(took.required()))
