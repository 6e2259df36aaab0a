"""The inspector's panels: in the Render properties, and in the sidebars of 3D view and images."""

from __future__ import annotations

from typing import Any

import bpy

from ..explain.derivation import Derivation, Test
from ..explain.digits import exact_text, marked, off_text, ulps
from ..explain.pixel import SENTENCES
from ..explain.textbook import Arithmetic
from . import results
from .explain import (
    TEXT,
    REFERENCE_TRACER_OT_draw_ray,
    REFERENCE_TRACER_OT_remove_ray,
    REFERENCE_TRACER_OT_save_pixel,
)
from .inspector import REFERENCE_TRACER_OT_inspect
from .panels import both, wrapped

_KEYS = ("towards", "t", "s1", "s2", "s3", "sum")  # of what is seen
_DIGITS = 18  # of an exact number: what a sidebar has room for, with its exponent


class _Inspector:
    bl_label = "Pixel Inspector"

    def draw(self, context: Any) -> None:
        """Draw the buttons, and the latest pixel's key numbers."""
        layout = self.layout
        on = REFERENCE_TRACER_OT_inspect.running
        layout.operator(
            REFERENCE_TRACER_OT_inspect.bl_idname,
            icon="EYEDROPPER",
            text="Click a Pixel (Esc: End)" if on else None,
            depress=on,
        )
        layout.prop(context.window_manager.reference_tracer_inspector, "draw_ray")
        row = layout.row(align=True)
        row.operator(REFERENCE_TRACER_OT_draw_ray.bl_idname, text="Draw", icon="LIGHT_SPOT")
        row.operator(REFERENCE_TRACER_OT_remove_ray.bl_idname, text="Remove", icon="TRASH")
        row.operator(REFERENCE_TRACER_OT_save_pixel.bl_idname, text="Save", icon="FILE_TICK")
        found = results.latest(Derivation, context.scene)
        if found:
            _draw(layout, context, found.content, found.lines[0])


def _draw(layout: Any, context: Any, derivation: Derivation, said: str) -> None:
    pixel = derivation.pixel
    box = layout.box()
    box.label(text=f"Pixel ({pixel.x}, {pixel.y})", icon="IMAGE_DATA")
    wrapped(box, context, said)
    wrapped(box, context, f"This is {SENTENCES[derivation.certified.certainty]}.")
    seen = next((t for t in derivation.tests if t.candidate is derivation.seen), None)
    if seen:
        _numbers(layout.box(), seen)
    box = layout.box()
    box.label(text=f"Tested: {len(derivation.tests)}" + _left_out(derivation))
    for number, test in enumerate(derivation.tests, 1):
        judged = test.verdicts[Arithmetic.EXACT]
        icon = "CHECKMARK" if judged.accepted else "X"
        box.label(text=f"2.{number} {test.candidate.title}{_t(test)}", icon=icon)
        for reason in judged.reasons[:1]:
            wrapped(box, context, reason.sentence, "BLANK1")
    wrapped(layout, context, f"All of it is in the text '{TEXT}'.", "TEXT")


def _t(test: Test) -> str:
    t = next((q.values[Arithmetic.EXACT] for q in test.quantities if q.key == "t"), ())
    return f", t = {float(t[0]):.6g}" if t else ""


def _left_out(derivation: Derivation) -> str:
    left = derivation.pixel.left_out
    return f", {left:,} more left out" if left else ""


def _numbers(layout: Any, test: Test) -> None:
    """Draw the key numbers of what is seen; wrong digits are in brackets."""
    quantities = {q.key: q for q in test.quantities}
    for quantity in (quantities[key] for key in _KEYS if key in quantities):
        column = layout.column(align=True)
        column.scale_y = 0.8
        _number(column, quantity.formula.label, "", "ulp")
        exact = quantity.exact(0)
        for name, kind in (("f32", Arithmetic.FLOAT32), ("f64", Arithmetic.FLOAT64)):
            value = quantity.values[kind][0]
            right, wrong, exponent = marked(value, exact)
            shown = f"{right}[{wrong}]{exponent}" if wrong else right
            _number(column, name, shown, off_text(ulps(value, exact)))
        _number(column, "exact", "undefined" if exact is None else exact_text(exact, _DIGITS), "")


def _number(layout: Any, name: str, value: str, off: str) -> None:
    """Draw a number with its error; an exact one may be longer than there is room."""
    if not value:  # a head
        split = layout.split(factor=0.83)
        split.label(text=name)
        split.label(text=off)
        return
    split = layout.split(factor=0.17)
    split.label(text=name)
    if off:
        split = split.split(factor=0.78)
    split.label(text=value)
    if off:
        split.label(text=off)


class IMAGE_PT_reference_tracer_inspector(_Inspector, bpy.types.Panel):
    bl_space_type, bl_region_type, bl_category = "IMAGE_EDITOR", "UI", "Reference Tracer"


CLASSES = (
    *both(_Inspector, "_inspector", bl_options={"DEFAULT_CLOSED"}),
    IMAGE_PT_reference_tracer_inspector,
)


register, unregister = bpy.utils.register_classes_factory(CLASSES)
