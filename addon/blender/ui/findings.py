"""Shows the diagnosis in the panel: a line for each fault, and buttons that lead to it.

A fault of an object has a button that selects the object; one of the camera a button that adds a
copy of the camera that sees what the picture shows, and then one that makes the copy the scene's
camera. Where a fault changes a picture, a button shows that picture put right.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import IntProperty
from bpy.types import Context, UILayout

from ...wording import capital
from . import blocks, results
from .differing import OBJECT_MODE, REFERENCE_TRACER_OT_select_object, select_alone
from .layout import wrapped
from .long_work import Answer, named
from .shown import open_as_render, show_where_shown

if TYPE_CHECKING:
    from ...comparison.comparison import Comparison
    from ...diagnosis.diagnosis import Told


class _OfFinding:
    """Mixed into an operator that is about a fault of the diagnosis."""

    in_object_mode: ClassVar[bool] = True  # it needs that

    number: IntProperty(
        name="Number",
        description="Which of the faults that the diagnosis tells, from 0",
        min=0,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs a finding, and may need Object Mode."""
        comparison = results.comparison(context)
        if not (comparison and comparison.diagnosis and comparison.diagnosis.told):
            return rpt_("No diagnosis has found something yet")
        in_way = cls.in_object_mode and context.mode != "OBJECT"
        return rpt_(OBJECT_MODE) if in_way else ""

    def told(self, context: Context) -> Told:
        """Return the fault.

        Raises
        ------
        SceneError
            If there are fewer.
        """
        from ...scene import SceneError

        found: tuple[Told, ...] = results.comparison(context).diagnosis.told
        if self.number >= len(found):
            raise SceneError(f"The diagnosis tells {len(found)} faults, numbered from 0.")
        return found[self.number]


@named
class REFERENCE_TRACER_OT_copy_camera(_OfFinding, bpy.types.Operator):
    bl_label = "Apply to a Copy"
    bl_description = (
        "Add a copy of the camera that sees what the picture shows, with this and what was found "
        "before it put right, and select it. Your camera stays, and is still the active one"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> Answer:
        from ...scene import SceneError
        from ..drawing.camera_object import copy_camera

        if context.scene.camera is None:
            raise SceneError(f"Scene '{context.scene.name}' has no camera to copy.")
        camera = self.told(context).frame.scene.camera
        name = f"{context.scene.camera.name} as in the picture"
        obj = copy_camera(context.scene, camera, name)
        select_alone(context, obj)
        results.of_comparison(context).copies[obj.session_uid] = self.number
        said = rpt_("'{}' sees what the picture shows; your own camera is still the active one")
        self.report({"INFO"}, said.format(obj.name))
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_activate_copy(bpy.types.Operator):
    bl_label = "Make It the Active Camera"
    bl_description = "Have the scene seen through the copy of its camera that is the active object"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs a copy that was added for the latest comparison."""
        why = rpt_("The active object is no copy that 'Apply to a Copy' added for this result")
        return why if _copied_for(context) is None else ""

    def execute(self, context: Context) -> Answer:
        context.scene.camera = context.view_layer.objects.active
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_show_put_right(_OfFinding, bpy.types.Operator):
    bl_label = "Show as Put Right"
    bl_description = (
        "Show the picture that this is wrong in, the traced one or the other, as it is with this "
        "and what was found before it put right"
    )
    bl_options = set()  # it changes no data
    in_object_mode = False

    def execute(self, context: Context) -> Answer:
        from ...scene import SceneError

        said = self.told(context).sentence
        kept = results.of_comparison(context)
        color = kept.put_right.get(self.number)
        if color is None:
            raise SceneError(f"No picture shows it put right: {said}.")
        show = show_where_shown if bpy.app.background else open_as_render
        show(context, blocks.show(blocks.PUT_RIGHT, color))
        kept.shown[:] = [self.number]
        return {"FINISHED"}


def draw_findings(layout: UILayout, context: Context, comparison: Comparison) -> None:
    """Draw what accounts for the unexplained pixels: a line each, with its button."""
    from ...scene import alike

    diagnosis = comparison.diagnosis
    if diagnosis is None:
        return
    box = layout.box()
    if not diagnosis.told:
        wrapped(box, context, "No known fault accounts for the unexplained pixels", "QUESTION")
    here = {obj.name_full for obj in context.scene.objects}
    before = comparison.scene.camera
    for number, told in enumerate(diagnosis.told):
        said = f"or, as likely, {told.sentence}" if told.alternative else told.sentence
        wrapped(box, context, capital(said), "INFO")
        if not alike(before, told.frame.scene.camera):
            box.operator(REFERENCE_TRACER_OT_copy_camera.bl_idname).number = number
            if number == _copied_for(context):
                box.operator(REFERENCE_TRACER_OT_activate_copy.bl_idname)
        elif told.guess.object in here:
            box.operator(REFERENCE_TRACER_OT_select_object.bl_idname).name = told.guess.object
        if number in results.of_comparison(context).put_right:
            box.operator(REFERENCE_TRACER_OT_show_put_right.bl_idname).number = number
        if not told.alternative:
            before = told.frame.scene.camera


def _copied_for(context: Context) -> int | None:
    """Return the number of what the active object was added for, if it is a copy.

    None if it is the scene's camera already.
    """
    active = context.view_layer.objects.active  # `context.object` is None in the Render properties
    if not active or active == context.scene.camera:
        return None
    return results.of_comparison(context).copies.get(active.session_uid)
