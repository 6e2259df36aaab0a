"""What came of a comparison, in the panel: the verdict, what differs, and the figures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from bpy.app.translations import pgettext_iface as iface_

from ..drawing.judges import label_of
from . import operators
from .differing import draw_regions
from .findings import draw_findings
from .layout import draw_facts, short_name, wrapped

if TYPE_CHECKING:
    from ...causes.counts import PixelCounts
    from ...comparison.comparison import Comparison

Facts = Iterator[tuple[str, str]]  # names and values


def draw_outcome(layout: Any, context: Any, comparison: Comparison) -> None:
    """Draw the verdict, the way to the page, and what differs and why."""
    icon = {"agree": "CHECKMARK", "differences": "CANCEL"}.get(comparison.verdict, "ERROR")
    counts = comparison.counts
    verdict = iface_(comparison.verdict.capitalize())
    said = iface_("{}: {:,} px differ").format(verdict, counts.differ)
    wrapped(layout, context, said, icon)
    layout.operator(operators.REFERENCE_TRACER_OT_open_page.bl_idname, icon="URL")
    for line in comparison.excused.lines():
        wrapped(layout, context, line.strip(), "ERROR")
    draw_findings(layout, context, comparison)
    draw_facts(layout, _of_pixels(counts))
    draw_regions(layout, context)


def draw_figures(layout: Any, context: Any, comparison: Comparison) -> None:
    """Draw the metrics, and what each method needed and got wrong."""
    from ...diagnosis.fault_rows import table

    draw_facts(layout, _measured(comparison))
    other = iface_(label_of(comparison.case.picture.source))
    wrapped(layout, context, f"{iface_('Compared with')} {other}")
    for row in comparison.methods:
        wrong = "unknown" if row.wrong_pixels is None else f"{row.wrong_pixels:,} px"
        facts = [
            (short_name(row), f"{row.seconds:.2f} s"),
            ("Wrong", wrong),
            ("Ambiguous", f"{row.ambiguous:,} px"),
        ]
        draw_facts(layout.box(), facts)
    for line in (*comparison.required, *table(comparison.self_check)[:1]):
        wrapped(layout, context, line)


def _of_pixels(pixels: PixelCounts) -> Facts:
    """Yield how many pixels agree; how many differ, by cause, and in and around surfaces."""
    from ...causes.explain import CAUSES

    counts = {"Agree": pixels.agree}
    for cause in sorted(CAUSES)[1:]:
        if count := pixels.by_cause.get(cause.key):
            counts[cause.label.capitalize()] = count
    if pixels.differ:
        counts["Inside surfaces"] = pixels.interior.differ
        counts["Along edges"] = pixels.boundary.differ
    for label, count in counts.items():
        yield label, f"{count:,} px"


def _measured(comparison: Comparison) -> Facts:
    metrics = comparison.metrics
    largest = metrics.largest_difference
    yield "RMSE", f"{metrics.rmse:.3g}"
    yield "PSNR", f"{metrics.psnr:.1f} dB" if metrics.rmse else "infinite"
    yield "SSIM", f"{metrics.ssim:.6f}"
    if metrics.rmse:
        yield "Max. diff.", f"{largest.value:.3g}"
        yield "At pixel", "{}, {}".format(*largest.pixel)
    yield "Traced in", f"{comparison.frame.statistics.seconds:.2f} s"
