"""Declares the settings that Blender stores, and those of the moment.

The .blend stores them on the scene, its view layers and objects; the window's are not stored.
Results are elsewhere: see `results.py`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)
from bpy.types import Context, UILayout

from ...methods import Method
from ..drawing import judges
from . import choices
from .areas import redraw
from .blocks import MARK

if TYPE_CHECKING:
    from ...tracer.settings import Settings


def _redraw(owner: Any, context: Context) -> None:
    redraw(context)  # the 3D views in Rendered mode


def _engines(owner: Any, context: Context, typed: str) -> list[str]:
    from ..drawing.engines import others

    return [judge.engine for judge in others().values() if judge.engine]


def _is_a_picture(owner: Any, image: Any) -> bool:
    """Offer neither the comparison's own images nor what Blender renders into."""
    return image.type not in ("RENDER_RESULT", "COMPOSITING") and MARK not in image


class ReferenceTracerScene(bpy.types.PropertyGroup):
    """How to trace and compare this scene."""

    method: EnumProperty(
        name="Method",
        description="How a ray meets a triangle",
        items=choices.METHODS,
        default="auto",
        update=_redraw,
    )
    precision: EnumProperty(
        name="Precision",
        description="The floating-point type of rays and corners. A proof needs float64",
        items=choices.PRECISIONS,
        default="float64",
        update=_redraw,
    )
    samples: IntProperty(
        name="Samples",
        description="The square root of the number of rays in a pixel: its colour is their mean",
        default=1,
        min=1,
        max=16,
        update=_redraw,
    )
    color: EnumProperty(
        name="Color",
        description="What a render shows of a surface",
        items=choices.COLORS,
        update=_redraw,
    )
    show: EnumProperty(
        name="Show",
        description="What a 3D view shows in Rendered mode, if this is the render engine",
        items=choices.SHOWS,
        update=_redraw,
    )
    judge: EnumProperty(
        name="Compare With",
        description="Which of Blender's own pictures the traced one is compared with",
        items=choices.JUDGES,
        default="AUTO",
    )
    engine: StringProperty(
        name="Engine",
        description="The engine's name, as the add-on registers it",
        search=_engines,
    )
    image: PointerProperty(
        name="Image",
        description="The picture that the traced one is compared with",
        type=bpy.types.Image,
        poll=_is_a_picture,
    )
    renderer: EnumProperty(
        name="Made By",
        description="Whose rounding may excuse a pixel",
        items=choices.RENDERERS,
        default="AUTO",
    )
    filter: FloatProperty(
        name="Filter",
        description="How far the picture's anti-aliasing reaches. With 0 it has one sample in each "
        "pixel's centre",
        subtype="PIXEL",
        default=0.0,
        min=0.0,
        max=64.0,
    )
    shading: EnumProperty(
        name="Shading",
        description="How Blender draws the picture that is compared",
        items=choices.SHADINGS,
        default="LIKE_FOR_LIKE",
    )
    colors: EnumProperty(
        name="Colors",
        description="In which colours the scene is traced and drawn for a comparison like for "
        "like. The scene's own stay as they are",
        items=choices.PALETTES,
        default="AUTOMATIC",
    )
    identity: BoolProperty(
        name="Object by Object",
        description="Tell a wrong colour from a wrong object. For that, Blender draws the scene "
        "once more, with a colour for each object",
        default=True,
    )
    self_check: BoolProperty(
        name="Self-Check",
        description="After comparing, make known faults (a pixel off, mirrored, an object left "
        "out...) and see that the comparison finds each. This takes several times as long",
        default=False,
    )

    diagnose: BoolProperty(
        name="Diagnosis",
        description="If pixels are left unexplained, look for what accounts for them: known faults "
        "of the camera, the scene and the picture are put right, one at a time, and traced",
        default=True,
    )

    def draw_given(self, layout: UILayout) -> None:
        """Draw what is to be known of a picture that is no judge's."""
        if self.judge == judges.IMAGE:
            layout.template_ID(self, "image", open="image.open", text="Image")
        if self.judge == judges.ENGINE:
            layout.prop(self, "engine")
        if self.judge in judges.GIVEN:
            layout.prop(self, "renderer")
            layout.prop(self, "filter")
            layout.operator("reference_tracer.write_colors", icon="COLOR")

    def settings(self) -> Settings:
        """Return what the tracer is to use; a precision that is greyed out does not count."""
        from ...tracer.settings import Precision, Settings

        precision = self.precision if self.has_precision else Precision.FLOAT64
        return Settings(self.method, precision, self.samples, color=self.color)

    @property
    def has_precision(self) -> bool:
        """Whether the method leaves a choice of the precision."""
        return not Method(self.method).is_proven


def _tell_the_compositor(layer: Any, _: object) -> None:
    for each in layer.id_data.view_layers:
        each.update_render_passes()


class ReferenceTracerLayer(bpy.types.PropertyGroup):
    """The settings of a view layer: its passes."""

    passes: EnumProperty(
        name="Passes",
        description="What the compositor and files get besides the picture; each pass takes time",
        items=choices.PASSES,
        options={"ENUM_FLAG"},
        update=_tell_the_compositor,
    )


class ReferenceTracerObject(bpy.types.PropertyGroup):
    """The settings of an object."""

    infinite_plane: BoolProperty(
        name="Infinite Plane",
        description="Trace this object as an infinite plane through its origin, facing its local "
        "+Z, in place of its own geometry",
        default=False,
    )


class ReferenceTracerWindow(bpy.types.PropertyGroup):
    """The state of the inspector and of Image Editors; not stored."""

    draw_ray: BoolProperty(
        name="Draw the Ray",
        description="With every click, draw the ray as objects in the 3D view",
        options={"SKIP_SAVE"},
    )
    both: BoolProperty(
        name="Both",
        description="The other picture is drawn over the traced one, on the right of a line",
        options={"SKIP_SAVE"},
        update=_redraw,
    )
    split: FloatProperty(
        name="Traced",
        description="The traced picture's share of the width, on the left of the line",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        options={"SKIP_SAVE"},
        update=_redraw,
    )


# The types with settings, in their attribute `reference_tracer`.
GROUPS = (
    (bpy.types.Scene, ReferenceTracerScene),
    (bpy.types.ViewLayer, ReferenceTracerLayer),
    (bpy.types.Object, ReferenceTracerObject),
    (bpy.types.WindowManager, ReferenceTracerWindow),
)


def register() -> None:
    """Register the property groups."""
    for owner, group in GROUPS:
        bpy.utils.register_class(group)
        setattr(owner, "reference_tracer", PointerProperty(type=group))  # noqa: B010


def unregister() -> None:
    """Undo :func:`register`."""
    for owner, group in reversed(GROUPS):
        delattr(owner, "reference_tracer")
        bpy.utils.unregister_class(group)
