"""Traces the same scene by the textbook and certified: which pixels are wrong, and the seconds."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from ..arrays import Colors
from ..certainty import Certainty
from ..certified.arithmetic import broken_assumptions
from ..methods import Method
from ..rendering import steps
from ..scene import Region, Scene
from ..tracer import nearest, shading
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING, Hits
from ..tracer.progress import Work, scaled
from ..tracer.render import Tracer
from ..tracer.settings import Precision, Settings


class MethodRow(NamedTuple):
    """One way to trace a picture, and what came of it."""

    method: str
    precision: str
    samples: int
    seconds: float
    wrong_pixels: int | None  # that see another surface than certified; None: nothing is certified
    ambiguous: int  # pixels without a unique answer, which the certified tracer's rule decided
    required: tuple[str, ...] = ()  # what the scene required, in words

    def to_dict(self) -> dict[str, object]:
        """Return the row as JSON can hold it."""
        return self._asdict() | {"seconds": round(self.seconds, 6), "required": list(self.required)}

    def line(self) -> str:
        """Return what a person wants to know."""
        found = "" if self.wrong_pixels is None else f", {self.wrong_pixels:,} wrong pixels"
        open_ = f" ({self.ambiguous:,} ambiguous)" if self.ambiguous else ""
        return f"  {self.method} {self.precision}: {self.seconds:.2f} s{found}{open_}"


class Methods(NamedTuple):
    """The result of each method, and the picture of the textbook as printed."""

    rows: tuple[MethodRow, ...]
    literal: Colors | None  # (h, w, 4) linear RGBA; NaN where it sees nothing. None: not traced


def list_methods(
    scene: Scene,
    settings: Settings,
    frame: Frame,
    tracer: Tracer | None = None,
    literally: bool = False,
) -> Work[Methods]:
    """Trace a scene with the textbook and certified, too.

    Returns a row for the certified tracer (where numpy keeps what the proof assumes), one for the
    textbook in float64, and one for `frame`, which was traced with `settings`, if it is neither.
    If the textbook is traced here, the picture by its test as printed costs little more: it is
    returned, too, where that is wanted.
    """
    own = Method(frame.statistics.method), Precision(settings.precision)
    certified = Method.CERTIFIED, Precision.FLOAT64
    ways = {} if broken_assumptions() else {certified: 1}  # the samples of each
    ways |= {(Method.TEXTBOOK, Precision.FLOAT64): 1, own: settings.samples}
    truth: Frame | None = None
    literal: Colors | None = None
    rows = []
    for number, way in enumerate(ways):
        traced = frame
        if way != own:
            traced = Frame.empty(scene)
            by = tracer
            if literally and tracer is None and way[0] is Method.TEXTBOOK:
                literal = np.full_like(traced.color, np.nan)
                by = partial(nearest.tracer, literally=partial(_shade, scene, literal))
            tracing = steps(scene, Settings(*way), traced, by)
            yield from scaled(tracing, number / len(ways), 1 / len(ways))
        if way == certified:  # it comes first, and the others are held against it
            truth = traced
        rows.append(_row(way, ways[way], traced, truth))
    return Methods(tuple(rows), literal)


def _shade(scene: Scene, out: Colors, band: Region, hits: Hits) -> None:
    """Enter the colours of what a band's rays meet into a picture."""
    first = scene.camera.region.y0
    rows = out[band.y0 - first : band.y1 - first].reshape(-1, 4)
    seen = np.flatnonzero(hits.instance != NOTHING)
    rows[seen] = shading.colors(scene, hits.take(seen))


def _row(
    way: tuple[Method, Precision], samples: int, frame: Frame, truth: Frame | None
) -> MethodRow:
    wrong, ambiguous = None, 0
    if truth is not None:
        wrong = int(frame.wrong_against(truth).sum())
        ambiguous = int((truth.certainty == Certainty.AMBIGUOUS).sum())
    took = frame.statistics
    return MethodRow(
        way[0].value, way[1].value, samples, took.seconds, wrong, ambiguous, tuple(took.required())
    )
