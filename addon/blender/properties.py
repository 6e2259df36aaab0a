"""What the user sets: stored in the .blend on the scene and its objects, or of the moment.

Results are not stored here: see `results.py`.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

from ..methods import Method
from ..study.scenarios.sweeps import SCENARIOS
from ..tracer.coloring import Color
from ..tracer.frame import PASSES
from ..tracer.settings import Precision, Settings
from . import judges, results
from .live.shows import SHOWS

# (identifier, name, description, number). A .blend stores the number: one that was given away is
# never given to another, and a new item takes the next.
METHOD_ITEMS = tuple((m.value, m.label, m.description, m.number) for m in reversed(Method))
PRECISIONS = (
    ("float64", "float64", "Double precision", 0),
    ("float32", "float32", "Single precision, as graphics hardware has it", 1),
)
COLORS = tuple((c.value, c.capitalize(), c.description, c.number) for c in Color)
JUDGE_ITEMS = (
    (judges.AUTO, "Automatic", "The viewport in a window, Workbench in background", 0),
    *((j.name.upper(), j.label, j.description, j.number) for j in judges.choices().values()),
)
SHADINGS = (
    (
        "LIKE_FOR_LIKE",
        "Like for Like",
        "Blender draws what the tracer does: flat light, the same colours, no effects, raw view",
        0,
    ),
    ("AS_IS", "As It Is", "Blender draws with the shading that the scene has", 1),
)
# Its number is one bit of what a .blend stores: a new pass takes the last place among PASSES.
PASS_ITEMS = tuple((p.label, p.label, "", 2**k) for k, p in enumerate(PASSES) if p.label)[1:]
SHOW_ITEMS = tuple((s.identifier, s.label, s.description, s.number) for s in SHOWS)
SWEEPS = tuple((s.name, s.title, s.explanation) for s in SCENARIOS)


def _redraw(owner: Any, context: Any) -> None:
    results.redraw(context)  # the 3D views in Rendered mode


class ReferenceTracerScene(bpy.types.PropertyGroup):
    """How to trace and compare this scene."""

    method: EnumProperty(  # type: ignore[valid-type]
        name="Method",
        items=METHOD_ITEMS,
        default="auto",
        description="How a ray meets a triangle",
        update=_redraw,
    )
    precision: EnumProperty(  # type: ignore[valid-type]
        name="Precision",
        items=PRECISIONS,
        default="float64",
        description="Floating-point type of rays and corners; what is proven is proven in float64",
        update=_redraw,
    )
    samples: IntProperty(  # type: ignore[valid-type]
        name="Samples",
        default=1,
        min=1,
        max=16,
        description="Colour is the mean of this number squared of rays, spread over the pixel",
        update=_redraw,
    )
    color: EnumProperty(  # type: ignore[valid-type]
        name="Color",
        items=COLORS,
        description="What a render shows of a surface",
        update=_redraw,
    )
    show: EnumProperty(  # type: ignore[valid-type]
        name="Show",
        items=SHOW_ITEMS,
        description="What a 3D view shows in Rendered mode, if this is the render engine",
        update=_redraw,
    )
    judge: EnumProperty(  # type: ignore[valid-type]
        name="Compare With",
        items=JUDGE_ITEMS,
        default="AUTO",
        description="Which of Blender's own pictures the traced one is compared with",
    )
    shading: EnumProperty(name="Shading", items=SHADINGS, default="LIKE_FOR_LIKE")  # type: ignore[valid-type]

    identity: BoolProperty(  # type: ignore[valid-type]
        name="Object by Object",
        default=True,
        description="Have Blender draw the scene once more, a colour an object, to know whose "
        "surface each pixel shows: a wrong colour and a wrong object are then told apart",
    )
    self_check: BoolProperty(  # type: ignore[valid-type]
        name="Self-Check",
        default=False,
        description="Afterwards make known faults (a pixel off, mirrored, an object left out...) "
        "and see that the comparison finds each: takes several times as long",
    )

    def settings(self) -> Settings:
        """Return what the tracer is to use; a precision that is greyed out does not count."""
        precision = self.precision if self.has_precision else Precision.FLOAT64
        return Settings(self.method, precision, self.samples, color=self.color)

    @property
    def has_precision(self) -> bool:
        """Whether the method leaves a choice of the precision."""
        return Method(self.method).is_plain


def _tell_the_compositor(layer: ReferenceTracerLayer, _: object) -> None:
    for each in layer.id_data.view_layers:
        each.update_render_passes()


class ReferenceTracerLayer(bpy.types.PropertyGroup):
    """What is rendered of a view layer."""

    passes: EnumProperty(  # type: ignore[valid-type]
        name="Passes",
        items=PASS_ITEMS,
        options={"ENUM_FLAG"},
        update=_tell_the_compositor,
        description="What the compositor and files get beside the picture: each takes time",
    )


class ReferenceTracerObject(bpy.types.PropertyGroup):
    """What an object is to the tracer."""

    infinite_plane: BoolProperty(  # type: ignore[valid-type]
        name="Infinite Plane",
        default=False,
        description="Trace this object as an infinite plane through its origin, facing its local "
        "+Z, in place of its own geometry",
    )


class ReferenceTracerWindow(bpy.types.PropertyGroup):
    """What the panels show at the moment, and what a click of the inspector does; not stored."""

    precision: EnumProperty(name="Precision", items=PRECISIONS, options={"SKIP_SAVE"})  # type: ignore[valid-type]
    scenario: EnumProperty(name="Scenario", items=SWEEPS, options={"SKIP_SAVE"})  # type: ignore[valid-type]
    draw_ray: BoolProperty(  # type: ignore[valid-type]
        name="Draw the Ray",
        options={"SKIP_SAVE"},
        description="With every click, draw the ray as objects in the 3D view",
    )


# Where each is: the type of Blender's, and the name there.
POINTERS = (
    (bpy.types.Scene, "reference_tracer", ReferenceTracerScene),
    (bpy.types.ViewLayer, "reference_tracer", ReferenceTracerLayer),
    (bpy.types.Object, "reference_tracer", ReferenceTracerObject),
    (bpy.types.WindowManager, "reference_tracer", ReferenceTracerWindow),
)


def register() -> None:
    """Register the property groups."""
    for owner, name, group in POINTERS:
        bpy.utils.register_class(group)
        setattr(owner, name, PointerProperty(type=group))


def unregister() -> None:
    """Undo :func:`register`."""
    for owner, name, group in reversed(POINTERS):
        delattr(owner, name)
        bpy.utils.unregister_class(group)
