"""Compares a traced scene with a picture: the counts, the causes, the metrics, the verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Colors
from ..certainty import Certainty
from ..certified.rounding import rounding
from ..manifest import Effect, Manifest
from ..rendering import steps
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.memory import ALWAYS, COMPARED, check_memory
from ..tracer.progress import Work, scaled
from .case import Case
from .cause import Causes
from .causes import BY_NUMBER, CAUSES, explain
from .checks.background import Background
from .checks.hidden import HIDDEN
from .checks.unmodelled import NOT_MODELLED
from .counts import count_pixels
from .diagnosis import Diagnosis, diagnose
from .guessing import SECONDS
from .identity import Identity
from .methods import MethodRow, list_methods
from .metrics import boundary, image_metrics
from .self_check import FaultRow, self_check
from .sentences import lines

SCHEMA = "reference_tracer.comparison/1"

# Shares of the work, roughly. A self-check takes the larger part of it.
_TRACING, _METHODS = 0.4, 0.35
_CHECKING = 0.8
_CAUSES = 0.8  # of comparing: the rest is for metrics and counts

# The verdicts, the gravest last, and what each is to a shell. 3 (the sizes do not match) and 4 (the
# input cannot be read) end a command before there is a verdict.
EXIT_CODES = {"agree": 0, "warnings": 1, "not comparable": 1, "cancelled": 1, "differences": 2}

COMPARABLE = 0.5  # the largest share of a picture in which no fault could be found


@dataclass(frozen=True, eq=False)
class Comparison:
    """What was compared, and what came of it."""

    case: Case  # with the scene before the picture's own background, if it has one
    frame: Frame
    causes: Causes
    pixels: dict[str, Any]  # see count_pixels
    metrics: dict[str, Any]  # see image_metrics
    methods: tuple[MethodRow, ...] = ()
    identity: Identity | None = None  # which object each side shows
    self_check: tuple[FaultRow, ...] = ()  # faults made on purpose, and whether they were found
    background: Background | None = None  # where the picture's is not the scene's
    diagnosis: Diagnosis | None = None  # what accounts for unexplained pixels, if it was looked for

    @property
    def scene(self) -> Scene:
        """The scene that was traced."""
        return self.case.scene

    @property
    def manifest(self) -> Manifest:
        """What was exported, skipped, not modelled."""
        return self.case.manifest

    @property
    def picture(self) -> Colors:
        """What the scene is compared with, (h, w, 4) linear RGBA."""
        return self.case.picture.color

    @property
    def verdict(self) -> str:
        """One of EXIT_CODES: differences are those that no cause explains."""
        if self.frame.cancelled:
            return "cancelled"
        certificate = self.case.certificate
        if self.pixels["unexplained"] or (certificate and not certificate.passed):
            return "differences"
        if self.pixels["not_judged"]["share"] > COMPARABLE:
            return "not comparable"
        return "warnings" if any(self._doubts()) else "agree"

    def _doubts(self) -> Iterator[object]:
        """Yield what is true if the verdict cannot be better than a warning."""
        for cause in CAUSES:
            yield cause.warns and self.pixels["by_cause"][cause.key]
        yield self.pixels["not_judged"]["pixels"]
        yield self.empty
        yield from (u.effect is Effect.UNPLACED for u in self.manifest.unmodelled)
        yield from (entry.left_out for entry in self.manifest.objects)
        yield from (row.missed for row in self.self_check)
        yield self.background and not self.background.transparent

    def told(self, x: int, y: int) -> str:
        """Return why a pixel has its cause, in a sentence with its numbers and names."""
        cause = BY_NUMBER[self.causes.cause[y, x]]
        figure = self.causes.figure[y, x]
        name: object = ""
        if cause == NOT_MODELLED:
            name = self.manifest.unmodelled[int(figure)]
        elif cause == HIDDEN:
            name = self.causes.hidden[int(figure)]
        return cause.told(figure, self.causes.allowed[y, x], name)

    @property
    def empty(self) -> bool:
        """Whether no ray hits anything: then nothing in the picture could have been wrong."""
        return bool((self.frame.instance_index == NOTHING).all())

    @property
    def required(self) -> list[str]:
        """What it took to certify the picture, and what was left out, in words, a fact a line."""
        return list(dict.fromkeys(line for row in self.methods for line in row.required))

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as JSON can hold it."""
        certificate = self.case.certificate
        return {
            "schema": SCHEMA,
            "scene": self.manifest.to_dict(),
            "blender": self.case.picture.to_dict(),
            "tracer": self._tracer(),
            "methods": [row.to_dict() for row in self.methods],
            "pixels": self.pixels,
            "causes": {c.key: c.to_dict() for c in CAUSES},
            "transform": self.causes.transform,
            "shades": [shade._asdict() for shade in self.causes.shades],
            "background": self.background and self.background.to_dict(),
            "hidden": [h._asdict() for h in self.causes.hidden],
            "identity": self.identity and self.identity.to_dict(),
            "diagnosis": self.diagnosis and self.diagnosis.to_dict(),
            "certificate": certificate and certificate.to_dict(),
            "self_check": [row.to_dict() for row in self.self_check],
            "metrics": self.metrics,
            "verdict": self.verdict,
        }

    def _tracer(self) -> dict[str, Any]:
        """Return how the scene was traced, as JSON can hold it."""
        s, settings = self.frame.statistics, self.case.settings
        certainty = self.frame.certainty
        off = rounding(self.scene)._asdict()
        return {
            "method": s.method,
            "precision": str(settings.precision),
            "samples": settings.samples,
            "seconds": round(s.seconds, 6),
            "triangles": s.triangles,
            "refused_triangles": s.refused,
            "pairs_tested": s.pairs_tested,
            "pairs_exact": s.pairs_exact,
            "rounding": {k: v if v < np.inf else None for k, v in off.items()},
            "exact_reasons": {reason.name.lower(): n for reason, n in s.reasons.items()},
            "certainty": {c.name.lower(): int((certainty == c).sum()) for c in Certainty},
            "cancelled": self.frame.cancelled,
        }

    def lines(self) -> list[str]:
        """Return what a person wants to know first, a fact a line."""
        return lines(self)


def trace_and_compare(case: Case) -> Work[Comparison]:
    """Trace a scene and compare it with the picture, in small steps.

    Yields the share of the work done; the caller stops by not asking for more.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    SceneError
        If its samples lie too far from the pixels' centres.
    PictureTooLargeError
        If there is not enough memory to compare them.
    """
    region = case.scene.camera.region
    check_memory(region.width, region.height, COMPARED, 2 * ALWAYS)  # frames ask for theirs again
    frame = Frame.empty(case.scene)
    case.picture.check(frame.color.shape)
    rest = 1 - _CHECKING if case.self_check else 1.0
    tracing = steps(case.scene, case.settings, frame, case.tracer)
    yield from scaled(tracing, 0.0, rest * _TRACING)
    listing = list_methods(case.scene, case.settings, frame, case.tracer)
    rows = yield from scaled(listing, rest * _TRACING, rest * _METHODS)
    done = rest * (_TRACING + _METHODS)
    found = yield from scaled(compare(case, frame), done, 1 - done)
    return replace(found, methods=rows)


def diagnosed(comparison: Comparison, seconds: float = SECONDS) -> Work[Comparison]:
    """Return a comparison with what accounts for its unexplained pixels, if it has any.

    Yields the share of the work done. The verdict stays. No guess is begun after `seconds`.
    """
    if not comparison.pixels["unexplained"]:
        return comparison
    case, frame, causes = comparison.case, comparison.frame, comparison.causes
    found = yield from diagnose(case, frame, causes, seconds=seconds)
    return replace(comparison, diagnosis=found)


def compare(case: Case, frame: Frame) -> Work[Comparison]:
    """Compare a traced frame with the picture; yields the share of the work done.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    SceneError
        If its samples lie too far from the pixels' centres.
    """
    case.picture.check(frame.color.shape)
    rest = 1 - _CHECKING if case.self_check else 1.0
    found = yield from scaled(explain(case, frame), 0.0, rest * _CAUSES)
    traced, picture = found.frame, found.case.picture  # both before the picture's own background
    measuring = image_metrics(traced.color, picture.color)
    measured = yield from scaled(measuring, rest * _CAUSES, rest * (1 - _CAUSES))
    identity = None
    if picture.owner is not None and picture.owners is not None:
        own = picture.owners[traced.instance_index]
        identity = Identity(picture.names, own, picture.owner)
    yield rest
    at_boundary = boundary(traced)
    yield rest
    features = [str(u) for u in case.manifest.unmodelled]
    pixels = count_pixels(found.causes, at_boundary, identity, features)
    yield rest
    checked: tuple[FaultRow, ...] = ()
    if case.self_check:
        checking = self_check(case, frame, found.causes)
        checked = yield from scaled(checking, rest, _CHECKING)
    return Comparison(
        found.case,
        traced,
        found.causes,
        pixels,
        measured,
        identity=identity,
        self_check=checked,
        background=found.background,
    )
