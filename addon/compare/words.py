"""A comparison in words: what a person wants to know first, a fact a line.

In comes a `comparison.Comparison`, which imports this module: it is not imported here.
"""

from __future__ import annotations

from typing import Any

from .cause import Cause
from .self_check import table


def lines(comparison: Any) -> list[str]:
    """Return what was compared, and what came of it."""
    p, m, statistics = comparison.pixels, comparison.metrics, comparison.frame.statistics
    psnr = "infinite" if m["psnr"] is None else f"{m['psnr']:.1f} dB"
    x, y = m["largest_difference"]["pixel"]
    return [
        f"{p['agree']:,} of {p['total']:,} pixels agree with {comparison.case.picture.source}, "
        f"{p['differ']:,} differ",
        *(
            f"  {Cause[name.upper()].label}: {n:,}{_at(p['examples'].get(name, ()))}"
            for name, n in p["by_cause"].items()
            if n
        ),
        *_evidence(comparison),
        f"RMSE {m['rmse']:.3g}, PSNR {psnr}, SSIM {m['ssim']:.6f}, largest difference "
        f"{m['largest_difference']['value']:.3g} at pixel ({x}, {y})",
        f"traced {statistics.triangles:,} triangles in {statistics.seconds:.2f} s",
        *(row.line() for row in comparison.methods),
        *comparison.required,
        *table(comparison.self_check),
        f"verdict: {comparison.verdict}",
    ]


def _evidence(comparison: Any) -> list[str]:
    """Say what else was found out of the pixels that differ."""
    p, causes = comparison.pixels, comparison.causes
    inside, rim = p["interior"], p["boundary"]
    out = [
        f"{inside['differ']:,} of {inside['total']:,} interior and {rim['differ']:,} of "
        f"{rim['total']:,} boundary pixels differ"
    ]
    if comparison.background:
        out.append(comparison.background.line())
    if causes.transform:
        out.append(f"colours: {causes.transform}")
    hidden = dict.fromkeys(causes.hidden)
    out += [f"only one side shows '{h.object}': {h.reason}" for h in hidden]
    if comparison.identity and p["unexplained"]:
        shows = p["unexplained_shows"]
        out.append(
            f"of the unexplained pixels {shows['same_object']:,} show the same object in another "
            f"colour, {shows['other_object']:,} another object"
        )
    if comparison.case.certificate:
        out.append(comparison.case.certificate.line())
    return out


def _at(pixels: list[list[int]]) -> str:
    """Say where the first of some pixels are."""
    return f", as at {', '.join(f'({x}, {y})' for x, y in pixels[:3])}" if pixels else ""
