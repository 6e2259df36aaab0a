"""The panels of the pixel inspector, the trade and the extremes.

The pixel inspector is in the sidebar of images, too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.types import Context, UILayout

from ..drawing.judges import label_of
from . import explain, results, studies
from .differing import IMAGE_PT_reference_tracer_shown
from .inspector import REFERENCE_TRACER_OT_inspect
from .layout import Part, beside, both, draw_facts, fit, wrapped
from .results import Kind
from .swatches import swatch

if TYPE_CHECKING:
    from ...comparison.comparison import Comparison

_KEYS = ("towards", "t", "s1", "s2", "s3", "sum")  # of what is seen
_DIGITS = 18  # of an exact number: what a sidebar has room for, with its exponent
_VALUE = 0.58  # the share of the width that a number has beside its name and error


class _Inspector(Part):
    bl_label = "Pixel Inspector"

    def draw(self, context: Any) -> None:
        """Draw the buttons, and the latest pixel's key numbers."""
        layout = self.layout
        is_on = REFERENCE_TRACER_OT_inspect.running
        layout.operator(
            REFERENCE_TRACER_OT_inspect.bl_idname,
            icon="EYEDROPPER",
            text="Click a Pixel (Esc: End)" if is_on else None,
            depress=is_on,
        )
        layout.prop(context.window_manager.reference_tracer, "draw_ray")
        row = beside(layout, context, ("Draw", "Remove", "Save"))
        row.operator(explain.REFERENCE_TRACER_OT_draw_ray.bl_idname, text="Draw", icon="LIGHT_SPOT")
        row.operator(explain.REFERENCE_TRACER_OT_remove_ray.bl_idname, text="Remove", icon="TRASH")
        row.operator(
            explain.REFERENCE_TRACER_OT_save_pixel.bl_idname, text="Save", icon="FILE_TICK"
        )
        found = results.latest(Kind.PIXEL, context.scene)
        if found.content:
            _draw(layout, context, found.content, found.lines[0])


def _draw(layout: UILayout, context: Context, derivation: Any, said: str) -> None:
    from ...derivation.document import CERTAINTY_SENTENCES
    from ...derivation.textbook import Arithmetic

    pixel = derivation.pixel
    box = layout.box()
    box.label(text=f"{iface_('Pixel')} ({pixel.x}, {pixel.y})", icon="IMAGE_DATA")
    wrapped(box, context, said)
    certainty = iface_(CERTAINTY_SENTENCES[derivation.certified.certainty])
    wrapped(box, context, iface_("This is {}.").format(certainty))
    if comparison := results.comparison(context):
        _draw_compared(layout, context, comparison, pixel.x, pixel.y)
    if derivation.seen_test:
        _numbers(layout.box(), context, derivation.seen_test)
    box = layout.box()
    tested = iface_("Tested: {}, left out: {:,}").format(len(derivation.tests), pixel.left_out)
    box.label(text=tested)
    for number, test in enumerate(derivation.tests, 1):
        judged = test.judgements[Arithmetic.EXACT]
        box.label(
            text=f"2.{number} {test.candidate.title}{_t(test)}",
            icon="CHECKMARK" if judged.accepted else "X",
        )
        for reason in judged.reasons[:1]:
            wrapped(box, context, reason.sentence, "BLANK1")
    wrapped(layout, context, f"{iface_('All of it is in the text')} '{explain.TEXT}'.", "TEXT")


def _draw_compared(
    layout: UILayout, context: Context, comparison: Comparison, x: int, y: int
) -> None:
    """Draw a pixel's colour on both sides of the latest comparison, and why they differ."""
    from ...causes.explain import BY_NUMBER

    height, width = comparison.causes.cause.shape
    if not (x < width and y < height):  # it was of another size
        return
    box = layout.box()
    box.label(text="In the Comparison", icon="MOD_MIRROR")
    sides = {
        "Traced": comparison.frame.color,
        label_of(comparison.case.picture.source): comparison.picture,
    }
    colors = ((name, "  ".join(f"{c:.4g}" for c in shown[y, x])) for name, shown in sides.items())
    draw_facts(box, context, colors)
    cause = BY_NUMBER[comparison.causes.cause[y, x]]
    wrapped(box, context, comparison.why(x, y), swatch=swatch(cause))


def _t(test: Any) -> str:
    from ...derivation.textbook import Arithmetic

    t = next((q.values[Arithmetic.EXACT] for q in test.quantities if q.key == "t"), ())
    return f", t = {float(t[0]):.6g}" if t else ""


def _numbers(layout: UILayout, context: Context, test: Any) -> None:
    """Draw the key numbers of the surface that is seen; wrong digits are in brackets."""
    from ...derivation.digits import exact_text, marked, off_text, ulps
    from ...derivation.textbook import Arithmetic

    quantities = {q.key: q for q in test.quantities}
    for quantity in (quantities[key] for key in _KEYS if key in quantities):
        column = layout.column(align=True)
        column.scale_y = 0.8
        _number(column, context, quantity.formula.label, "", "ulp")
        exact = quantity.exact(0)
        for name, kind in (("f32", Arithmetic.FLOAT32), ("f64", Arithmetic.FLOAT64)):
            value = quantity.values[kind][0]
            off = ulps(value, exact)
            shown = marked(value, exact, off).with_wrong("[{}]")
            _number(column, context, name, shown, off_text(off))
        known = "undefined" if exact is None else exact_text(exact, _DIGITS)
        _number(column, context, "exact", known, "")


def _number(layout: UILayout, context: Context, name: str, value: str, off: str) -> None:
    """Draw a number with its error: in columns, or below its name where it has no room there."""
    if value and not fit(context, [value], _VALUE, 0):
        wrapped(layout, context, f"{name} {off}")
        wrapped(layout, context, value)
        return
    split = layout.split(factor=0.17 if value else 0.83)  # without a value: a head
    split.label(text=name)
    if value and off:
        split = split.split(factor=0.78)
    if value:
        split.label(text=value)
    if off:
        split.label(text=off)


class IMAGE_PT_reference_tracer_inspector(_Inspector, bpy.types.Panel):
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Reference Tracer"


class _Study(Part):
    """Mixed into the panel of a study."""

    bl_options = {"DEFAULT_CLOSED"}
    measure: ClassVar[Any]  # its operator
    icon: ClassVar[Any]
    what: ClassVar[str]  # it measures

    def draw(self, context: Context) -> None:
        """Draw the button, and the result, a sentence with its plot; else what is measured."""
        layout = self.layout
        layout.operator(self.measure.bl_idname, text="Measure", icon=self.icon)
        found = results.latest(self.measure.kind, context.scene)
        line = found.lines[0] if found.lines else self.what
        wrapped(layout, context, line, "INFO" if found.lines else "NONE")
        if found.page:
            layout.operator("wm.url_open", text="Open Plot").url = found.page


class _Trade(_Study):
    bl_label = "Time and Accuracy"
    measure = studies.REFERENCE_TRACER_OT_trade
    icon = "TIME"
    what = "How long each method takes, and what it gets wrong"


class _Extremes(_Study):
    bl_label = "Where Methods Break"
    measure = studies.REFERENCE_TRACER_OT_extremes
    icon = "MOD_NOISE"
    what = "How far, tiny or thin is too much for each method"


CLASSES = (
    *both(_Inspector, "_inspector", bl_options={"DEFAULT_CLOSED"}),
    IMAGE_PT_reference_tracer_inspector,
    IMAGE_PT_reference_tracer_shown,
    *both(_Trade, "_trade"),
    *both(_Extremes, "_extremes"),
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
