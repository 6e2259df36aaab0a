"""Two pictures of one scene -> `Comparison`: the counts, the causes, the metrics, the verdict."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..manifest import Manifest
from ..scene import Scene
from ..tracer.certainty import Certainty
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import Steps, steps
from ..tracer.settings import Settings
from . import metrics
from .cause import Cause, Causes
from .causes import find_causes
from .methods import MethodRow, list_methods

SCHEMA = "reference_tracer.comparison/1"

# What a verdict is to a shell: 3 (sizes do not match) and 4 (input error) never get this far.
EXAMPLES = 10  # pixels named of each cause
_SHOWN = (Cause.UNEXPLAINED, Cause.NOT_MODELLED, Cause.DEPTH_TIE, Cause.EDGE)

_TRACING = 0.4  # of the work, roughly
_METHODS = 0.35
_CAUSES = 0.8  # of what is left

EXIT_CODES = {"agree": 0, "warnings": 1, "differences": 2, "cancelled": 1}


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

    @property
    def verdict(self) -> str:
        """One of EXIT_CODES: differences are those that no cause explains."""
        if self.frame.cancelled:
            return "cancelled"
        pixels = self.pixels
        if pixels["unexplained"]:
            return "differences"
        left_out = any(o.left_out for o in self.manifest.objects)
        if pixels["not_decidable"] or self.manifest.unmodelled or left_out:
            return "warnings"
        return "agree"

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
            "metrics": self.metrics,
            "verdict": self.verdict,
        }

    def lines(self) -> list[str]:
        """Return what a person wants to know first, a fact a line."""
        p, m = self.pixels, self.metrics
        psnr = "infinite" if m["psnr"] is None else f"{m['psnr']:.1f} dB"
        x, y = m["largest_difference"]["pixel"]
        out = [
            f"{p['agree']:,} of {p['total']:,} pixels agree with Blender's "
            f"{self.blender['source']} picture, {p['differ']:,} differ",
            *(
                f"  {name.replace('_', ' ')}: {n:,}{_at(p['examples'].get(name, ()))}"
                for name, n in p["by_cause"].items()
                if n
            ),
            f"RMSE {m['rmse']:.3g}, PSNR {psnr}, SSIM {m['ssim']:.6f}, largest difference "
            f"{m['largest_difference']['value']:.3g} at pixel ({x}, {y})",
            f"traced {self.frame.statistics.triangles:,} triangles in "
            f"{self.frame.statistics.seconds:.2f} s",
            *(row.line() for row in self.methods),
            *self.required,
            f"verdict: {self.verdict}",
        ]
        return out


def compare(
    scene: Scene,
    manifest: Manifest,
    settings: Settings,
    frame: Frame,
    picture: NDArray[np.float32],
    blender: dict[str, Any],
) -> Work[Comparison]:
    """Compare a traced frame with Blender's picture; yields the share of the work done.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    """
    if picture.shape != frame.color.shape:
        raise SizeError(
            f"Blender's picture has {picture.shape[1]} x {picture.shape[0]} pixels, the traced one "
            f"{frame.color.shape[1]} x {frame.color.shape[0]}."
        )
    finding = find_causes(
        scene, frame, picture, manifest.unmodelled, blender.get("sample_radius", 0.0)
    )
    causes = yield from scaled(finding, 0.0, _CAUSES)
    measured = yield from scaled(measure(frame.color, picture), _CAUSES, 1 - _CAUSES)
    return Comparison(
        scene, manifest, settings, frame, picture, blender, causes, count_pixels(causes), measured
    )


def count_pixels(causes: Causes) -> dict[str, Any]:
    """Count pixels by what is said of them.

    total = agree + differ + not_decidable + not_traced, and differ = explained + unexplained. The
    `examples` are some pixels of each cause, [x, y] of the region from its lower left.
    """
    count = {c: int((causes.cause == c).sum()) for c in Cause}
    explained = count[Cause.EDGE] + count[Cause.DEPTH_TIE] + count[Cause.NOT_MODELLED]
    return {
        "total": causes.cause.size,
        "agree": count[Cause.AGREE],
        "differ": explained + count[Cause.UNEXPLAINED],
        "explained": explained,
        "unexplained": count[Cause.UNEXPLAINED],
        "not_decidable": count[Cause.NOT_DECIDABLE],
        "not_traced": count[Cause.NOT_TRACED],
        "by_cause": {
            c.name.lower(): count[c] for c in Cause if c not in (Cause.AGREE, Cause.NOT_TRACED)
        },
        "examples": {c.name.lower(): _positions(causes.cause == c) for c in _SHOWN if count[c]},
    }


def _at(pixels: list[list[int]]) -> str:
    """Say where the first of some pixels are."""
    return f", as at {', '.join(f'({x}, {y})' for x, y in pixels[:3])}" if pixels else ""


def _positions(where: NDArray[np.bool_]) -> list[list[int]]:
    """Return the first pixels of some as [x, y], x from the left and y from the bottom."""
    width = where.shape[1]
    return [[int(i % width), int(i // width)] for i in np.flatnonzero(where)[:EXAMPLES]]


def measure(traced: NDArray[np.float32], picture: NDArray[np.float32]) -> Work[dict[str, Any]]:
    """Measure how far two pictures of linear RGBA differ; what is not a number counts as 0.

    RMSE, PSNR in decibels (None for infinite), SSIM, and the largest difference.
    """
    a, b = np.nan_to_num(traced), np.nan_to_num(picture)
    height, squares, largest = len(a), 0.0, {"value": -1.0}
    for start in range(0, height, metrics.ROWS):
        rows = slice(start, min(start + metrics.ROWS, height))
        squares += metrics.rmse(a[rows], b[rows]) ** 2 * (rows.stop - start)
        found = metrics.largest_difference(a[rows], b[rows])
        if found["value"] > largest["value"]:
            largest = found | {"pixel": [found["pixel"][0], found["pixel"][1] + start]}
        yield 0.2 * start / height
    rmse = float(np.sqrt(squares / height))
    similarity = yield from scaled(metrics.ssim_work(a, b), 0.2, 0.8)
    return {
        "rmse": rmse,
        "psnr": metrics.psnr_of(rmse) if rmse else None,
        "ssim": similarity,
        "largest_difference": largest,
    }


def trace_and_compare(
    scene: Scene,
    manifest: Manifest,
    settings: Settings,
    picture: NDArray[np.float32],
    blender: dict[str, Any],
    trace: Steps = steps,
) -> Work[Comparison]:
    """Trace a scene and compare it with Blender's picture, in small steps.

    Yields the share of the work done; the caller stops by not asking for more.
    """
    frame = Frame.empty(scene)
    for share in trace(scene, settings, frame):
        yield _TRACING * share
    methods = yield from scaled(list_methods(scene, settings, frame, trace), _TRACING, _METHODS)
    comparing = compare(scene, manifest, settings, frame, picture, blender)
    comparison = yield from scaled(comparing, _TRACING + _METHODS, 1 - _TRACING - _METHODS)
    return replace(comparison, methods=methods)
