"""The legend of the causes, and the list of the regions that differ: a click goes to one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import IntProperty, StringProperty
from bpy.types import Context, OperatorProperties, UILayout, Window

from . import results, shown
from .areas import areas, within
from .layout import fit, wrapped
from .long_work import Answer, named
from .swatches import swatch

if TYPE_CHECKING:
    from ...diagnosis.regions import Region

LISTED = 8
OBJECT_MODE = "Leave the mode that the active object is in: Tab"
_AROUND = 24  # pixels of the picture that are shown around a region, at least
_BESIDE = 0.85  # of a panel's width, beside the button that goes to the view


@named
class REFERENCE_TRACER_OT_frame_region(bpy.types.Operator):
    bl_label = "Frame Region"
    bl_description = "Enlarge this region in the Image Editors that show the comparison"
    bl_options = set()  # it changes no data

    number: IntProperty(
        name="Number",
        description="Which of the regions that the panel lists, from 0",
        min=0,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def description(cls, context: Context, properties: OperatorProperties) -> str:
        """Return what the region is, too: the button may have no room for it."""
        found = results.of_comparison(context).regions[properties.number :][:1]
        return "\n".join((*(texts_of(r)[0] for r in found), tip_(cls.bl_description)))

    def execute(self, context: Context) -> Answer:
        from ...scene import SceneError

        found = results.of_comparison(context).regions
        if self.number >= len(found):
            raise SceneError(f"The comparison has {len(found)} regions, numbered from 0.")
        for window, area in () if bpy.app.background else areas("IMAGE_EDITOR"):
            if shown.chosen(area.spaces.active):
                _enlarge(window, area, found[self.number])
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_select_object(bpy.types.Operator):
    bl_label = "Select"
    bl_description = (
        "Select this object alone, make it active, and frame it in the 3D views that do not look "
        "through the camera"
    )
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(
        name="Name", description="The object, by its full name", options={"SKIP_SAVE"}
    )

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs Object Mode."""
        return "" if context.mode == "OBJECT" else rpt_(OBJECT_MODE)

    def execute(self, context: Context) -> Answer:
        from ...scene import SceneError

        layer = context.view_layer
        found = next((o for o in context.scene.objects if o.name_full == self.name), None)
        if found is None:
            raise SceneError(
                f"Scene '{context.scene.name}' has no object '{self.name}' now: it is instanced "
                "from elsewhere, or was renamed or removed since the comparison."
            )
        if found not in set(layer.objects):
            raise SceneError(
                f"'{self.name}' is not in view layer '{layer.name}': its collection is excluded."
            )
        select_alone(context, found)
        if not found.select_get():
            said = rpt_(
                "'{}' is active, but hidden in this view: Blender selects only what is seen"
            )
            self.report({"WARNING"}, said.format(self.name))
        for window, area in () if bpy.app.background else areas("VIEW_3D"):
            if area.spaces.active.region_3d.view_perspective != "CAMERA":
                with within(window, area):
                    bpy.ops.view3d.view_selected()
        return {"FINISHED"}


def select_alone(context: Context, obj: Any) -> None:
    """Select an object and no other, and make it active."""
    for other in context.selected_objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj


def _enlarge(window: Window, area: Any, region: Region) -> None:
    """Enlarge a region in an Image Editor."""
    around = max(_AROUND, region.width // 2, region.height // 2)
    width, height = area.spaces.active.image.size
    low = region.left - around, region.bottom - around
    high = region.left + region.width + around, region.top + 1 + around
    with within(window, area) as inside:
        view = inside.view2d
        (x0, y0), (x1, y1) = (
            view.view_to_region(x / width, y / height, clip=False) for x, y in (low, high)
        )
        bpy.ops.image.view_zoom_border(xmin=x0, xmax=x1, ymin=y0, ymax=y1)


def draw_causes(layout: UILayout, context: Context) -> None:
    """Draw each cause in its colour with its pixels, and a button for each of the first regions."""
    from ...causes.explain import BY_NUMBER

    comparison = results.comparison(context)
    if comparison is None:
        return
    for cause, count in comparison.counts.of_causes():
        said = cause.count_in_words(count, iface_)
        wrapped(layout, context, said, swatch=swatch(cause))
    column = layout.column(align=True)
    for number, region in enumerate(results.of_comparison(context).regions[:LISTED]):
        cause = BY_NUMBER[region.cause]
        row = column.row(align=True)
        texts = texts_of(region)
        text = next((text for text in texts if fit(context, [text], _BESIDE)), texts[-1])
        to = row.operator(
            REFERENCE_TRACER_OT_frame_region.bl_idname,
            text=text,
            icon_value=swatch(cause),
            translate=False,
        )
        to.number = number
        if region.objects:
            select = REFERENCE_TRACER_OT_select_object.bl_idname
            row.operator(select, text="", icon="VIEW3D").name = region.objects[0]
    if more := len(results.of_comparison(context).regions[LISTED:]):
        column.label(text=iface_("and {} more regions").format(more))


def texts_of(region: Region) -> tuple[str, str, str]:
    """Return a region's pixels, cause, place and object in a line; then less, for less room."""
    from ...causes.explain import BY_NUMBER

    many = BY_NUMBER[region.cause].count_in_words(region.pixels, iface_)
    shows = region.objects[0] if region.objects else iface_("Background")
    at = f"({region.left}, {region.bottom})"
    return f"{many} {at}: {shows}", f"{many} {at}", f"{region.pixels:,} px {at}"


class IMAGE_PT_reference_tracer_shown(bpy.types.Panel):
    bl_label = "Comparison"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Reference Tracer"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return shown.chosen(context.space_data) is not None

    def draw(self, context: Context) -> None:
        """Draw the legend and the regions; the header has the switch."""
        draw_causes(self.layout, context)
