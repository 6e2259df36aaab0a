"""Two pictures of one scene -> `Comparison`: the counts, the causes, the metrics, the verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
from .cause import Cause, Causes
from .causes import explain
from .checks.background import Background
from .identity import Identity
from .methods import MethodRow, list_methods
from .metrics import boundary, count_pixels, image_metrics
from .picture import SizeError
from .self_check import FaultRow, self_check, table

SCHEMA = "reference_tracer.comparison/1"

# Shares of the work, roughly.
_TRACING, _METHODS, _COMPARING = 0.4, 0.35, 0.25
_CHECKING = 0.8  # with a self-check, of the comparing
_CAUSES = 0.8  # of what is left

# What a verdict is to a shell, the gravest last: 3 (sizes do not match) and 4 (input error) never
# get this far.
EXIT_CODES = {"agree": 0, "warnings": 1, "not comparable": 1, "cancelled": 1, "differences": 2}

COMPARABLE = 0.5  # so much of a picture may be such that no fault would be found in it


@dataclass(eq=False)
class Comparison:
    """What was compared, and what came of it."""

    case: Case
    frame: Frame
    causes: Causes
    pixels: dict[str, Any]  # see count_pixels
    metrics: dict[str, Any]  # see image_metrics
    methods: tuple[MethodRow, ...] = ()
    textbook: Frame | None = None  # what the textbook makes of the scene, in float64
    identity: Identity | None = None  # which object each side shows
    self_check: tuple[FaultRow, ...] = ()  # known faults, and whether they were found
    background: Background | None = None  # where the picture has one that the scene has not

    @property
    def scene(self) -> Scene:
        """The scene, before the picture's background."""
        return self.case.scene

    @property
    def manifest(self) -> Manifest:
        """What was exported, skipped, not modelled."""
        return self.case.manifest

    @property
    def picture(self) -> NDArray[np.float32]:
        """What the scene is compared with, (h, w, 4) linear RGBA."""
        return self.case.picture.color

    @property
    def verdict(self) -> str:
        """One of EXIT_CODES: differences are those that no cause explains."""
        if self.frame.cancelled:
            return "cancelled"
        pixels, certificate = self.pixels, self.case.certificate
        if pixels["unexplained"] or (certificate and not certificate.passed):
            return "differences"
        if pixels["not_judged"]["share"] > COMPARABLE:
            return "not comparable"
        doubtful = (
            *(pixels["by_cause"][c.key] for c in Cause if c.warns),
            pixels["not_judged"]["pixels"],
            self.empty,
            *(u.effect is Effect.UNPLACED for u in self.manifest.unmodelled),
            *(o.left_out for o in self.manifest.objects),
            *(row.missed for row in self.self_check),
            self.background and not self.background.transparent,
        )
        return "warnings" if any(doubtful) else "agree"

    def told(self, x: int, y: int) -> str:
        """Return why a pixel has its cause, in a sentence with its numbers and names."""
        causes = self.causes
        cause, figure = Cause(causes.cause[y, x]), causes.figure[y, x]
        counted = {Cause.NOT_MODELLED: self.manifest.unmodelled, Cause.HIDDEN: causes.hidden}
        name = counted[cause][int(figure)] if cause in counted else ""
        return cause.told(figure, causes.allowed[y, x], name)

    @property
    def empty(self) -> bool:
        """Whether no ray met anything: then there is nothing that could have been wrong."""
        return bool((self.frame.instance_index == NOTHING).all())

    @property
    def required(self) -> list[str]:
        """What it took to certify the picture, and what was left out, in words, a fact a line."""
        return list(dict.fromkeys(line for row in self.methods for line in row.required))

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as JSON can hold it."""
        s, certificate = self.frame.statistics, self.case.certificate
        off = rounding(self.scene)._asdict()
        return {
            "schema": SCHEMA,
            "scene": self.manifest.to_dict(),
            "blender": self.case.picture.to_dict(),
            "tracer": {
                "method": s.method,
                "precision": self.case.settings.precision.value,
                "samples": self.case.settings.samples,
                "seconds": round(s.seconds, 6),
                "triangles": s.triangles,
                "refused_triangles": s.refused,
                "pairs_tested": s.pairs_tested,
                "pairs_exact": s.pairs_exact,
                "rounding": {k: v if v < np.inf else None for k, v in off.items()},
                "exact_reasons": {reason.name.lower(): n for reason, n in s.reasons.items()},
                "certainty": {
                    c.name.lower(): int((self.frame.certainty == c).sum()) for c in Certainty
                },
                "cancelled": self.frame.cancelled,
            },
            "methods": [row.to_dict() for row in self.methods],
            "pixels": self.pixels,
            "causes": {c.key: c.to_dict() for c in Cause},
            "transform": self.causes.transform,
            "shades": [shade._asdict() for shade in self.causes.shades],
            "background": self.background and self.background.to_dict(),
            "hidden": [h._asdict() for h in self.causes.hidden],
            "identity": self.identity and self.identity.to_dict(),
            "certificate": certificate and certificate.to_dict(),
            "self_check": [row.to_dict() for row in self.self_check],
            "metrics": self.metrics,
            "verdict": self.verdict,
        }

    def lines(self) -> list[str]:
        """Return what a person wants to know first, a fact a line."""
        p, m, statistics = self.pixels, self.metrics, self.frame.statistics
        chosen = self.case.settings
        psnr = "infinite" if m["psnr"] is None else f"{m['psnr']:.1f} dB"
        x, y = m["largest_difference"]["pixel"]
        return [
            f"{p['agree']:,} of {p['total']:,} pixels agree with {self.case.picture.source}, "
            f"{p['differ']:,} differ",
            *(
                f"  {c.label}: {n:,}{_at(p['examples'].get(c.key, ()))}"
                for c in sorted(Cause)
                if (n := p["by_cause"].get(c.key))
            ),
            *self._evidence(),
            f"RMSE {m['rmse']:.3g}, PSNR {psnr}, SSIM {m['ssim']:.6f}, largest difference "
            f"{m['largest_difference']['value']:.3g} at pixel ({x}, {y})",
            f"traced {statistics.triangles:,} triangles in {statistics.seconds:.2f} s "
            f"({statistics.method}, {chosen.precision.value}, {chosen.samples} x "
            f"{chosen.samples} rays a pixel)",
            *(row.line() for row in self.methods),
            *self.required,
            *table(self.self_check),
            f"verdict: {self.verdict}",
        ]

    def _evidence(self) -> list[str]:
        """Say what else was found out of the pixels that differ."""
        p, causes = self.pixels, self.causes
        inside, rim = p["interior"], p["boundary"]
        certificate, hidden, told = self.case.certificate, dict.fromkeys(causes.hidden), ""
        if self.identity and p["unexplained"]:
            shows = p["unexplained_shows"]
            told = (
                f"of the unexplained pixels {shows['same_object']:,} show the same object in "
                f"another colour, {shows['other_object']:,} another object"
            )
        facts = (
            f"{inside['differ']:,} of {inside['total']:,} interior and {rim['differ']:,} of "
            f"{rim['total']:,} boundary pixels differ",
            self.background and self.background.line(),
            self.empty and "the picture is empty: no ray meets anything",
            *self.not_judged(),
            causes.transform and f"colours: {causes.transform}",
            *(shade.line() for shade in causes.shades),
            *(f"only one side shows {h}" for h in hidden),
            told,
            certificate and certificate.line(),
        )
        return [fact for fact in facts if fact]

    def not_judged(self) -> Iterator[str]:
        """Say what share of the picture cannot be judged, why, and what would help."""
        told, total = self.pixels["not_judged"], self.pixels["total"]
        if lights := [str(u) for u in self.manifest.unmodelled if u.effect is Effect.LIGHT]:
            known = "whose surfaces it shows can" if self.identity else "nor whose surfaces"
            yield f"no colour of this picture can be judged, {known}: {', '.join(lights)}"
        if told["pixels"]:
            of = ", ".join(told["by_feature"])
            yield f"{_share(told['pixels'], total)} of this picture cannot be judged: {of}"
        if undecided := self.pixels["not_decidable"]:
            yield (
                f"{_share(undecided, total)} of this picture is not decidable: so far from the "
                "origin, or at such a scale, float32 moves Blender's surfaces by more than half a "
                "pixel; move the scene to the origin, or apply the objects' scale"
            )


def _share(pixels: int, total: int) -> str:
    """Return a share in per cent; what is not all or nothing is said to be neither."""
    share = 100 * pixels / total
    if 1 <= share <= 99 or pixels == total:
        return f"{share:.0f} %"
    return f"{min(max(share, 0.1), 99.9):.1f} %"


def _at(pixels: list[list[int]]) -> str:
    """Say where the first of some pixels are."""
    return f", as at {', '.join(f'({x}, {y})' for x, y in pixels[:3])}" if pixels else ""


def trace_and_compare(case: Case) -> Work[Comparison]:
    """Trace a scene and compare it with the picture, in small steps.

    Yields the share of the work done; the caller stops by not asking for more.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    PictureTooLargeError
        If there is not enough memory to compare them.
    """
    region = case.scene.camera.region
    check_memory(region.width, region.height, COMPARED, 2 * ALWAYS)  # frames ask for theirs again
    frame = Frame.empty(case.scene)
    tracing = steps(case.scene, case.settings, frame, case.tracer)
    checking = _CHECKING if case.self_check else 0.0
    first, second = ((1 - checking) * share for share in (_TRACING, _METHODS))
    yield from scaled(tracing, 0.0, first)
    listing = list_methods(case.scene, case.settings, frame, case.tracer)
    rows, textbook = yield from scaled(listing, first, second)
    found = yield from scaled(compare(case, frame), first + second, 1 - first - second)
    return replace(found, methods=rows, textbook=textbook)


def compare(case: Case, frame: Frame) -> Work[Comparison]:
    """Compare a traced frame with the picture; yields the share of the work done.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    """
    shown, traced = case.picture.color.shape, frame.color.shape
    if shown != traced:
        raise SizeError(
            f"The picture has {shown[1]} x {shown[0]} pixels, the traced one {traced[1]} x "
            f"{traced[0]}."
        )
    share = (1 - _CHECKING if case.self_check else 1.0) * _CAUSES
    found = yield from scaled(explain(case, frame), 0.0, share)
    picture, before = found.case.picture, found.frame  # before the picture's own background
    measuring = image_metrics(before.color, picture.color)
    measured = yield from scaled(measuring, share, share * (1 / _CAUSES - 1))
    identity = None
    if picture.owner is not None:
        traced = picture.owners[before.instance_index]
        identity = Identity(picture.names, traced, picture.owner)
    yield share / _CAUSES
    at_boundary = boundary(before)
    yield share / _CAUSES
    features = [str(u) for u in case.manifest.unmodelled]
    counted = count_pixels(found.causes, at_boundary, identity, features)
    yield share / _CAUSES
    made = Comparison(found.case, before, found.causes, counted, measured, identity=identity)
    made.background = found.background
    if case.self_check:
        checking = self_check(case, frame, found.causes)
        made.self_check = yield from scaled(checking, 1 - _CHECKING, _CHECKING)
    return made
