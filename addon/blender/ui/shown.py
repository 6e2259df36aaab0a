"""Shows the images of a comparison in Image Editors, opened as F12 opens its own.

The header of such an editor has a switch between the images; with *Both* the traced picture and the
other one share the editor, and a line between them is dragged: see `split.py`.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import bpy
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import EnumProperty
from bpy.types import Context, Image, OperatorProperties, SpaceImageEditor, UILayout

from ..reading.rendered import result_image
from . import blocks
from .areas import areas, redraw_said, within
from .long_work import Answer, named

SETTLED = 0.5  # seconds until Blender has moved the panels below one that has grown

# By the identifiers of the switch; Both is the traced picture with the other one over it.
IMAGES = {
    "TRACED": blocks.TRACED,
    "OTHER": blocks.BLENDER,
    "BOTH": blocks.TRACED,
    "DIFFERENCE": blocks.DIFFERENCE,
    "CAUSES": blocks.CAUSES,
    "PUT_RIGHT": blocks.PUT_RIGHT,
}
_CHOICES = (
    ("TRACED", "Traced", "What the tracer sees"),
    ("OTHER", "Other", "The picture that it is compared with"),
    ("BOTH", "Both", "The traced picture on the left of a line, the other one on its right"),
    (
        "DIFFERENCE",
        "Difference",
        "How far apart the colours are, raised so that one level of 255 is seen; black where they "
        "are the same",
    ),
    ("CAUSES", "Causes", "Why pixels differ, a colour for each cause: the sidebar has the legend"),
    ("PUT_RIGHT", "Put Right", "The picture as it is with a fault of the diagnosis put right"),
)


@named
class REFERENCE_TRACER_OT_show_image(bpy.types.Operator):
    bl_label = "Show Image"
    bl_description = "Show another image of the comparison in this editor"
    bl_options = set()  # it changes no data

    image: EnumProperty(name="Image", description="Which", items=_CHOICES)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow it in an Image Editor, once there are images."""
        return context.area is not None and chosen(context.space_data) is not None

    @classmethod
    def description(cls, context: Context, properties: OperatorProperties) -> str:
        """Return the choice's own."""
        return next(tip_(text) for key, _, text in _CHOICES if key == properties.image)

    def execute(self, context: Any) -> Answer:
        context.window_manager.reference_tracer.both = self.image == "BOTH"
        context.space_data.image = blocks.ours(IMAGES[self.image])
        context.area.tag_redraw()
        return {"FINISHED"}


def chosen(space: SpaceImageEditor) -> str | None:
    """Return which image of the comparison a space shows, as the switch names it, or None."""
    image = space.image if space.type == "IMAGE_EDITOR" else None
    mark = image.get(blocks.MARK) if image else None
    keys = [key for key, name in IMAGES.items() if name == mark]
    manager: Any = bpy.context.window_manager
    if manager.reference_tracer.both:
        keys.reverse()
    return next(iter(keys), None)


def open_as_render(context: Context, image: Image) -> None:
    """Show an image where F12 would show its own: the user's preference decides.

    An editor that shows an image of a comparison already is taken first, in any window. A new one
    is opened in a moment: within an operator, Blender would lose track of the operator's window.
    """
    if not show_where_shown(context, image):
        opening = partial(_open, context.window.as_pointer(), image[blocks.MARK])
        bpy.app.timers.register(opening, first_interval=0.0)


def _open(window: int, name: str) -> None:
    """Have Blender open its editor for renders from a window's address; show our image in it."""
    context = bpy.context
    image = blocks.ours(name)
    found = [w for w in context.window_manager.windows if w.as_pointer() == window]
    if not (image and found):  # another file was opened since
        return
    had_result = result_image()
    # In an area, Blender's operator would put away a render that is shown already.
    way = context.preferences.view.render_display_type
    if way == "WINDOW" or (way != "NONE" and _of_render() is None):
        with context.temp_override(window=found[0]):
            bpy.ops.render.view_show("INVOKE_DEFAULT")
        # Blender leaves panels where they are by then: they would lie over each other.
        bpy.app.timers.register(redraw_said, first_interval=SETTLED)
    if space := _of_render():
        space.image = image
        _fit(space)
    if not had_result and (extra := result_image()):  # Blender makes it to be shown
        bpy.data.images.remove(extra)


def _fit(space: SpaceImageEditor) -> None:
    """Have an Image Editor show all of its picture."""
    for window, area in areas("IMAGE_EDITOR"):
        if area.spaces.active == space:
            with within(window, area):
                bpy.ops.image.view_all(fit_view=True)


def _of_render() -> SpaceImageEditor:
    """Return the first space that shows a Render Result, or None."""
    shown = (s for s in _spaces() if s.image and s.image.type == "RENDER_RESULT")
    return next(shown, None)


def show_where_shown(context: Context, image: Image) -> bool:
    """Show an image in an editor that shows one of a comparison, or none; return whether it is."""
    found = [s for s in _spaces() if s.image is None or chosen(s)]
    for space in sorted(found, key=lambda s: s.image is None)[:1]:
        space.image = image
    return bool(found)


def _spaces() -> list[SpaceImageEditor]:
    """Return the spaces of all Image Editors that view; those of the context's window first."""
    spaces = (area.spaces.active for _, area in areas("IMAGE_EDITOR"))
    return [space for space in spaces if space.mode == "VIEW"]


def draw_switch(layout: UILayout, space: SpaceImageEditor) -> None:
    """Draw the switch of a space that shows an image of a comparison."""
    now = chosen(space)
    there = (choice for choice in _CHOICES if blocks.ours(IMAGES[choice[0]]))
    for key, label, _ in there:
        button = layout.operator(
            REFERENCE_TRACER_OT_show_image.bl_idname, text=label, depress=key == now
        )
        button.image = key
