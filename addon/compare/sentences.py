"""What a comparison found, in sentences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..manifest import Effect
from .causes import CAUSES
from .self_check import table

if TYPE_CHECKING:
    from .comparison import Comparison


def lines(found: Comparison) -> list[str]:
    """Return what a person wants to know first, a fact a line."""
    pixels = found.pixels
    settings, traced = found.case.settings, found.frame.statistics
    return [
        f"{pixels['agree']:,} of {pixels['total']:,} pixels agree with "
        f"{found.case.picture.source}, {pixels['differ']:,} differ",
        *_of_causes(found),
        *_evidence(found),
        *(found.diagnosis.lines() if found.diagnosis else ()),
        _measured(found),
        f"traced {traced.triangles:,} triangles in {traced.seconds:.2f} s "
        f"({traced.method}, {settings.precision}, {settings.samples} x {settings.samples} rays "
        "a pixel)",
        *(row.line() for row in found.methods),
        *found.required,
        *table(found.self_check),
        f"verdict: {found.verdict}{_but(found)}",
    ]


def _but(found: Comparison) -> str:
    """Return what the verdict leaves out, for its own line."""
    if found.background is None or found.background.transparent:
        return ""
    return f" ({found.background.unjudged()})"


def _of_causes(found: Comparison) -> Iterator[str]:
    """Say how many pixels have each cause, and where the first of them are."""
    for cause in sorted(CAUSES):
        if count := found.pixels["by_cause"].get(cause.key):
            first = found.pixels["examples"].get(cause.key, ())[:3]
            at = ", ".join(f"({x}, {y})" for x, y in first)
            yield f"  {cause.label}: {count:,}" + (f", as at {at}" if at else "")


def _measured(found: Comparison) -> str:
    m = found.metrics
    psnr = "infinite" if m["psnr"] is None else f"{m['psnr']:.1f} dB"
    x, y = m["largest_difference"]["pixel"]
    return (
        f"RMSE {m['rmse']:.3g}, PSNR {psnr}, SSIM {m['ssim']:.6f}, largest difference "
        f"{m['largest_difference']['value']:.3g} at pixel ({x}, {y})"
    )


def _evidence(found: Comparison) -> Iterator[str]:
    """Say what else was found out about the pixels that differ."""
    causes, certificate = found.causes, found.case.certificate
    inside, rim = found.pixels["interior"], found.pixels["boundary"]
    yield (
        f"{inside['differ']:,} of {inside['total']:,} interior and {rim['differ']:,} of "
        f"{rim['total']:,} boundary pixels differ"
    )
    if found.background:
        yield found.background.line()
    if found.empty:
        yield "the picture is empty: no ray meets anything"
    yield from not_judged(found)
    if causes.transform:
        yield f"colours: {causes.transform}"
    yield from (shade.line() for shade in causes.shades)
    yield from (f"only one side shows {h}" for h in dict.fromkeys(causes.hidden))
    if found.identity and found.pixels["unexplained"]:
        shows = found.pixels["unexplained_shows"]
        yield (
            f"of the unexplained pixels {shows['same_object']:,} show the same object in "
            f"another colour, {shows['other_object']:,} another object"
        )
    if certificate:
        yield certificate.line()


def not_judged(found: Comparison) -> Iterator[str]:
    """Say what share of the picture cannot be judged, why, and what would help."""
    told, total = found.pixels["not_judged"], found.pixels["total"]
    if lights := [str(u) for u in found.manifest.unmodelled if u.effect is Effect.LIGHT]:
        known = "whose surfaces it shows can" if found.identity else "nor whose surfaces"
        yield f"no colour of this picture can be judged, {known}: {', '.join(lights)}"
    if told["pixels"]:
        features = ", ".join(told["by_feature"])
        yield f"{_share(told['pixels'], total)} of this picture cannot be judged: {features}"
    if undecided := found.pixels["not_decidable"]:
        yield (
            f"{_share(undecided, total)} of this picture is not decidable: so far from the "
            "origin, or at such a scale, float32 moves Blender's surfaces by more than half a "
            "pixel; move the scene to the origin, or apply the objects' scale"
        )


def _share(pixels: int, total: int) -> str:
    """Return a share in per cent. What is not all of it is never said to be 100 %, or 0 %."""
    share = 100 * pixels / total
    if 1 <= share <= 99 or pixels == total:
        return f"{share:.0f} %"
    return f"{min(max(share, 0.1), 99.9):.1f} %"
