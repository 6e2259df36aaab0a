"""Two pictures of one scene -> `Comparison`: the counts, the causes, the metrics, the verdict."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..manifest import Manifest
from ..scene import Scene
from ..tracer.certified.certainty import Certainty
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.progress import Work, scaled
from ..tracer.render import steps
from ..tracer.settings import Settings
from .background import Background, find_background
from .boundary import boundary
from .cause import DESCRIPTIONS, Cause, Causes, Hidden
from .causes import find_causes
from .certificate import CameraCertificate
from .counts import count_pixels
from .faults import Case
from .identity import Identity
from .known import Known
from .methods import MethodRow, list_methods
from .metrics import measure
from .self_check import FaultRow, self_check
from .shown import Shown
from .words import lines

SCHEMA = "reference_tracer.comparison/1"

_TRACING = 0.4  # of the work, roughly
_METHODS = 0.35
_COMPARING = 0.25
_CHECKING = 0.8  # with a self-check
_CAUSES = 0.8  # of what is left

# What a verdict is to a shell: 3 (sizes do not match) and 4 (input error) never get this far.
EXIT_CODES = {"agree": 0, "warnings": 1, "differences": 2, "cancelled": 1}


_WARNINGS = Cause.COLOR, Cause.HIDDEN, Cause.ANTI_ALIASING  # explained, and yet not alike


class SizeError(ValueError):
    """The pictures differ in size."""


@dataclass(eq=False)
class Comparison:
    """What was compared, and what came of it."""

    scene: Scene
    manifest: Manifest
    settings: Settings
    frame: Frame
    picture: NDArray[np.float32]  # (h, w, 4) linear RGBA: Blender's
    blender: dict[str, Any]  # version, source, sample radius, settings used
    causes: Causes
    pixels: dict[str, Any]  # see count_pixels
    metrics: dict[str, Any]  # see measure
    methods: tuple[MethodRow, ...] = ()
    identity: Identity | None = None  # which object each side shows
    certificate: CameraCertificate | None = None
    self_check: tuple[FaultRow, ...] = ()  # known faults, and whether they were found
    background: Background | None = None  # where the picture has one that the scene has not

    @property
    def verdict(self) -> str:
        """One of EXIT_CODES: differences are those that no cause explains."""
        if self.frame.cancelled:
            return "cancelled"
        pixels = self.pixels
        if pixels["unexplained"] or (self.certificate and not self.certificate.passed):
            return "differences"
        doubtful = (
            pixels["not_decidable"],
            *(pixels["by_cause"][c.name.lower()] for c in _WARNINGS),
            self.manifest.unmodelled,
            *(o.left_out for o in self.manifest.objects),
            *(row.missed for row in self.self_check),
            self.background and not self.background.transparent,
        )
        return "warnings" if any(doubtful) else "agree"

    @property
    def required(self) -> list[str]:
        """What it took to certify the picture, and what was left out, in words, a fact a line."""
        return list(dict.fromkeys(line for row in self.methods for line in row.required))

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as JSON can hold it."""
        s = self.frame.statistics
        return {
            "schema": SCHEMA,
            "scene": self.manifest.to_dict(),
            "blender": self.blender,
            "tracer": {
                "method": s.method,
                "precision": self.settings.precision.value,
                "samples": self.settings.samples,
                "seconds": round(s.seconds, 6),
                "triangles": s.triangles,
                "refused_triangles": s.refused,
                "pairs_tested": s.pairs_tested,
                "pairs_exact": s.pairs_exact,
                "exact_reasons": {reason.name.lower(): n for reason, n in s.reasons.items()},
                "certainty": {
                    c.name.lower(): int((self.frame.certainty == c).sum()) for c in Certainty
                },
                "cancelled": self.frame.cancelled,
            },
            "methods": [row.to_dict() for row in self.methods],
            "pixels": self.pixels,
            "causes": _DESCRIBED,
            "transform": self.causes.transform,
            "background": self.background and self.background.to_dict(),
            "hidden": [h._asdict() for h in self.causes.hidden],
            "identity": self.identity and self.identity.to_dict(),
            "certificate": self.certificate and self.certificate.to_dict(),
            "self_check": [row.to_dict() for row in self.self_check],
            "metrics": self.metrics,
            "verdict": self.verdict,
        }

    def lines(self) -> list[str]:
        """Return what a person wants to know first, a fact a line."""
        return lines(self)


_DESCRIBED = {
    cause.name.lower(): {"number": int(cause)} | told._asdict()
    for cause, told in DESCRIPTIONS.items()
}


def compare(
    scene: Scene,
    manifest: Manifest,
    settings: Settings,
    frame: Frame,
    picture: NDArray[np.float32] | Shown,
    blender: dict[str, Any],
    known: Known | None = None,
) -> Work[Comparison]:
    """Compare a traced frame with Blender's picture; yields the share of the work done.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    """
    shown = picture if isinstance(picture, Shown) else Shown(picture)
    known = known or Known()
    check_sizes(shown.color, frame.color)
    finding = find_causes(
        scene,
        frame,
        shown,
        manifest.unmodelled,
        blender.get("sample_radius", 0.0),
        blender.get("filter_radius", 0.0),
        _absent(manifest, known.names),
        known.alternatives,
        known.curves,
    )
    causes = yield from scaled(finding, 0.0, _CAUSES)
    measured = yield from scaled(measure(frame.color, shown.color), _CAUSES, 1 - _CAUSES)
    identity = None
    if shown.owner is not None:
        identity = Identity(known.names, shown.owners[frame.instance_index], shown.owner)
    return Comparison(
        scene,
        manifest,
        settings,
        frame,
        shown.color,
        blender,
        causes,
        count_pixels(causes, boundary(frame), identity),
        measured,
        identity=identity,
        certificate=known.certificate,
    )


def check_sizes(picture: NDArray, traced: NDArray) -> None:
    """Raise a SizeError if two pictures (h, w, 4) are not of one size."""
    if picture.shape != traced.shape:
        raise SizeError(
            f"The picture has {picture.shape[1]} x {picture.shape[0]} pixels, the traced one "
            f"{traced.shape[1]} x {traced.shape[0]}."
        )


def _absent(manifest: Manifest, names: tuple[str, ...]) -> dict[int, Hidden]:
    """Return of the objects that may be shown why they are not traced, by their numbers."""
    why = {e.name: e.reason for e in manifest.objects if e.hidden}
    return {n: Hidden(name, why[name]) for n, name in enumerate(names) if name in why}


def trace_and_compare(
    scene: Scene,
    manifest: Manifest,
    settings: Settings,
    picture: NDArray[np.float32] | Shown,
    blender: dict[str, Any],
    known: Known | None = None,
) -> Work[Comparison]:
    """Trace a scene and compare it with Blender's picture, in small steps.

    Yields the share of the work done; the caller stops by not asking for more.
    """
    shown = picture if isinstance(picture, Shown) else Shown(picture)
    checking = _CHECKING if known and known.self_check else 0.0
    tracing, methods, rest = ((1 - checking) * s for s in (_TRACING, _METHODS, _COMPARING))
    frame = Frame.empty(scene)
    for share in steps(scene, settings, frame):
        yield tracing * share
    rows = yield from scaled(list_methods(scene, settings, frame), tracing, methods)
    check_sizes(shown.color, frame.color)
    background = None
    if known and known.curves is not None and not frame.cancelled:
        background = find_background(frame, shown, known.curves)
    if background:
        scene, known = background.under(scene), background.behind(known)
        shown = replace(shown, background=scene.background)
        frame = _before(scene, settings, frame)
    comparing = compare(scene, manifest, settings, frame, shown, blender, known)
    found = yield from scaled(comparing, tracing + methods, rest)
    faults: tuple[FaultRow, ...] = ()
    if checking:
        case = Case(
            scene,
            frame,
            shown,
            manifest.unmodelled,
            blender.get("sample_radius", 0.0),
            blender.get("filter_radius", 0.0),
            known.next_frame,
        )
        faults = yield from scaled(self_check(case), 1 - checking, checking)
    return replace(found, methods=rows, self_check=faults, background=background)


def _before(scene: Scene, settings: Settings, frame: Frame) -> Frame:
    """Return a traced frame before another background, the scene's; of one sample, not again."""
    color = frame.color.copy()
    color[frame.instance_index == NOTHING] = scene.background
    if settings.samples > 1:
        again = Frame.empty(scene)
        for _ in steps(scene, settings, again):
            pass
        color = again.color
    return replace(frame, scene=scene, color=color)
