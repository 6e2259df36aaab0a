"""Shows a comparison in the panel: the verdict, what differs, and the figures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from bpy.app.translations import pgettext_iface as iface_
from bpy.types import Context, UILayout

from ..drawing.judges import label_of
from . import operators, results
from .differing import draw_causes
from .findings import draw_findings
from .layout import draw_facts, short_name, wrapped
from .long_work import LongWork

if TYPE_CHECKING:
    from ...comparison.comparison import Comparison

Facts = Iterator[tuple[str, str]]  # names and values


def draw_outcome(layout: UILayout, context: Context, comparison: Comparison) -> None:
    """Draw the verdict, the way to the page, and what differs and why."""
    text, icon = _verdict(comparison)
    wrapped(layout, context, text, icon)
    layout.operator(operators.REFERENCE_TRACER_OT_open_page.bl_idname, icon="URL")
    for line in comparison.excused.lines():
        wrapped(layout, context, line.strip(), "ERROR")
    draw_findings(layout, context, comparison)
    draw_causes(layout, context)


def draw_in_header(layout: UILayout, context: Context) -> None:
    """Draw the verdict beside the picture of a comparison, or how far the work on it is."""
    comparison = results.comparison(context)
    if LongWork.running:
        layout.progress(factor=LongWork.meter.share)
        layout.label(text=LongWork.said, translate=False)
    elif comparison:
        text, icon = _verdict(comparison)
        layout.label(text=text, icon=icon, translate=False)


def _verdict(comparison: Comparison) -> tuple[str, Any]:
    """Return the verdict in a line, and its icon."""
    icon = {"agree": "CHECKMARK", "differences": "CANCEL"}.get(comparison.verdict, "ERROR")
    return comparison.verdict.in_words(comparison.counts, iface_), icon


def draw_figures(layout: UILayout, context: Context, comparison: Comparison) -> None:
    """Draw the metrics, and what each method needed and got wrong."""
    from ...diagnosis.fault_rows import table

    draw_facts(layout, context, _measured(comparison))
    other = iface_(label_of(comparison.case.picture.source))
    wrapped(layout, context, f"{iface_('Compared with')} {other}")
    for row in comparison.methods:
        wrong = "unknown" if row.wrong_pixels is None else f"{row.wrong_pixels:,} px"
        facts = [
            (short_name(row), f"{row.seconds:.2f} s"),
            ("Wrong", wrong),
            ("Ambiguous", f"{row.ambiguous:,} px"),
        ]
        draw_facts(layout.box(), context, facts)
    for line in (*comparison.required, *table(comparison.self_check)[:1]):
        wrapped(layout, context, line)


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
