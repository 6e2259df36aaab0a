"""The list of the regions that differ: a click frames one, in Image Editors and in 3D views."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.props import IntProperty

from . import results, shown
from .long_work import Answer, named
from .results import Kind

if TYPE_CHECKING:
    from ...diagnosis.regions import Region

LISTED = 8
_AROUND = 8  # pixels of the picture that are shown around a region, at least


@named
class REFERENCE_TRACER_OT_frame_region(bpy.types.Operator):
    bl_label = "Frame Region"
    bl_description = (
        "Enlarge this region in the Image Editors that show the comparison, select the object that "
        "it shows, and frame that in the 3D views that do not look through the camera"
    )
    bl_options = {"REGISTER", "UNDO"}

    number: IntProperty(
        name="Number",
        description="Which of the regions that the panel lists, from 0",
        min=0,
        options={"SKIP_SAVE"},
    )

    def execute(self, context: Any) -> Answer:
        from ...scene import SceneError

        found = results.latest(Kind.COMPARISON, context.scene)
        regions = found.regions if found else ()
        if self.number >= len(regions):
            raise SceneError(f"The comparison has {len(regions)} regions, numbered from 0.")
        region = regions[self.number]
        is_selected = context.mode == "OBJECT" and _select(context, region.objects)
        for window in () if bpy.app.background else context.window_manager.windows:
            for area in window.screen.areas:
                _frame(window, area, region, is_selected)
        return {"FINISHED"}


def _select(context: Any, names: tuple[str, ...]) -> bool:
    """Select the first of these objects that the view layer has, alone, and make it active.

    Returns whether there is one.
    """
    by_name = {o.name_full: o for o in context.view_layer.objects}
    found = next((by_name[name] for name in names if name in by_name), None)
    if found is not None:
        for obj in context.selected_objects:
            obj.select_set(False)
        found.select_set(True)
        context.view_layer.objects.active = found
    return found is not None


def _frame(window: Any, area: Any, region: Region, is_selected: bool) -> None:
    """Enlarge a region in an Image Editor, or frame its object in a 3D view if it is selected."""
    inside = next(r for r in area.regions if r.type == "WINDOW")
    space = area.spaces.active
    with bpy.context.temp_override(window=window, area=area, region=inside):
        if shown.chosen(space):
            around = max(_AROUND, region.width // 2, region.height // 2)
            width, height = space.image.size
            ends = (
                (region.left - around, region.bottom - around),
                (
                    region.left + region.width + around,
                    region.top + 1 + around,
                ),
            )
            view = inside.view2d
            (x0, y0), (x1, y1) = (
                view.view_to_region(x / width, y / height, clip=False) for x, y in ends
            )
            bpy.ops.image.view_zoom_border(xmin=x0, xmax=x1, ymin=y0, ymax=y1)
        elif space.type == "VIEW_3D" and space.region_3d.view_perspective != "CAMERA":
            if is_selected:
                bpy.ops.view3d.view_selected()


def draw_regions(layout: Any, context: Any) -> None:
    """Draw the largest regions, each with a button that frames it."""
    found = results.latest(Kind.COMPARISON, context.scene)
    regions = found.regions if found else ()
    column = layout.column(align=True)
    for number, region in enumerate(regions[:LISTED]):
        shows = region.objects[0] if region.objects else iface_("Background")
        text = f"{region.pixels:,} px: {shows}"
        button = column.operator(
            REFERENCE_TRACER_OT_frame_region.bl_idname, text=text, translate=False
        )
        button.number = number
    if more := len(regions[LISTED:]):
        column.label(text=iface_("and {} more regions").format(more))


class IMAGE_PT_reference_tracer_shown(bpy.types.Panel):
    bl_label = "Comparison"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Reference Tracer"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return shown.chosen(context.space_data) is not None

    def draw(self, context: Any) -> None:
        """Draw the switch, the line's place, and the regions."""
        layout: Any = self.layout
        shown.draw_switch(layout.column(align=True), context.space_data)
        if shown.chosen(context.space_data) == "BOTH":
            layout.prop(context.window_manager.reference_tracer, "split", slider=True)
        draw_regions(layout, context)
