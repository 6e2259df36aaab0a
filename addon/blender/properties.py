"""What the user sets, stored in the .blend: on the scene and on its objects.

Results are not stored here: see `results.py`.
"""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

from ..tracer.settings import Settings

METHODS = (
    (
        "textbook",
        "Textbook",
        "The exercise's plane-then-barycentrics test, usable in floating point",
    ),
    (
        "textbook_literal",
        "Textbook, Literal",
        "The test exactly as printed, s1 + s2 + s3 = 1 included: it loses about half of all hits",
    ),
    ("moller_trumbore", "Möller–Trumbore", "The test most renderers started from"),
)
PRECISIONS = (
    ("float64", "float64", "Double precision"),
    ("float32", "float32", "Single precision, as graphics hardware has it"),
)
JUDGES = (
    ("AUTO", "Automatic", "The viewport in a window, Workbench in background"),
    ("WORKBENCH", "Workbench", "A Workbench render: render visibility and modifier levels"),
    (
        "CYCLES",
        "Cycles",
        "A Cycles render of the same constant colours, one sample in each pixel's centre",
    ),
)
SHADINGS = (
    (
        "LIKE_FOR_LIKE",
        "Like for Like",
        "Blender draws what the tracer does: flat light, the same colours, no effects, raw view",
    ),
    ("AS_IS", "As It Is", "Blender draws with the shading that the scene has"),
)


class ReferenceTracerScene(bpy.types.PropertyGroup):
    """How to trace and compare this scene."""

    method: EnumProperty(name="Method", items=METHODS, default="textbook")  # type: ignore[valid-type]
    precision: EnumProperty(name="Precision", items=PRECISIONS, default="float64")  # type: ignore[valid-type]
    samples: IntProperty(  # type: ignore[valid-type]
        name="Samples",
        default=1,
        min=1,
        max=16,
        description="Colour is the mean of this number squared of rays, spread over the pixel",
    )
    judge: EnumProperty(  # type: ignore[valid-type]
        name="Compare With",
        items=JUDGES,
        default="AUTO",
        description="Which of Blender's own pictures the traced one is compared with",
    )
    shading: EnumProperty(name="Shading", items=SHADINGS, default="LIKE_FOR_LIKE")  # type: ignore[valid-type]

    def settings(self) -> Settings:
        """Return what the tracer is to use."""
        return Settings(method=self.method, precision=self.precision, samples=self.samples)


class ReferenceTracerObject(bpy.types.PropertyGroup):
    """What an object is to the tracer."""

    infinite_plane: BoolProperty(  # type: ignore[valid-type]
        name="Infinite Plane",
        default=False,
        description="Trace this object as an infinite plane through its origin, facing its local "
        "+Z, in place of its own geometry",
    )


CLASSES = (ReferenceTracerScene, ReferenceTracerObject)


def register() -> None:
    """Register the property groups."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.reference_tracer = PointerProperty(type=ReferenceTracerScene)
    bpy.types.Object.reference_tracer = PointerProperty(type=ReferenceTracerObject)


def unregister() -> None:
    """Undo :func:`register`."""
    del bpy.types.Object.reference_tracer
    del bpy.types.Scene.reference_tracer
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
