"""The operator that selects what the camera sees, or what it does not."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty

from ...tracer.progress import Work
from ...wording import say
from .long_work import LongWork, named

NAME = "camera_sees"


@named
class REFERENCE_TRACER_OT_select_seen(LongWork, bpy.types.Operator):
    bl_label = "Select What the Camera Sees"
    bl_description = (
        "Select objects if the camera sees any face of theirs, in Edit Mode the faces that it "
        "sees, be it a thousandth of a pixel: each is proven. A face is seen if any that modifiers "
        "make of it is. Nothing is deleted"
    )
    bl_options = {"UNDO"}
    needs_camera = True
    announced = "Blender evaluates the scene"
    alone = True

    hidden: BoolProperty(
        name="Not Seen",
        description="Select what the camera surely does not see",
        options={"SKIP_SAVE"},
    )
    frames: BoolProperty(
        name="All Frames",
        description="Select what is seen in any frame of the scene, or in none",
        options={"SKIP_SAVE"},
    )
    attribute: BoolProperty(
        name="Face Attribute",
        description="Store camera_sees with the faces, too: 0 hidden, 1 seen, 2 undecided",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def blocked(cls, context: Any) -> str:
        """Allow it in Object Mode, and where meshes are edited."""
        if context.mode not in ("OBJECT", "EDIT_MESH"):
            return rpt_("Only in Object Mode and in Edit Mode of meshes")
        return super().blocked(context)

    def begin(self, context: Any) -> Work[Any]:
        from ..jobs.animation import frames_of
        from ..jobs.seen import CameraSees

        edited = context.mode == "EDIT_MESH"
        objects = context.objects_in_mode if edited else context.view_layer.objects
        faces = edited or self.attribute
        own = {o.data for o in objects if faces and o.type == "MESH" and not o.data.library}
        return CameraSees(context, own).look(frames_of(context.scene) if self.frames else ())

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Select, store the attribute, and say what is seen."""
        from ...visible import HIDDEN, SEEN, UNDECIDED
        from ..jobs.faces import select_faces, store
        from ..jobs.seen import RANKS

        wanted = int(RANKS[HIDDEN if self.hidden else SEEN])
        if self.attribute:
            for mesh, ranks in result.faces.items():
                store(mesh, NAME, RANKS[ranks])
        if context.mode == "EDIT_MESH":
            context.tool_settings.mesh_select_mode = (False, False, True)
            every = []
            for mesh, ranks in result.faces.items():
                select_faces(mesh, ranks == wanted)
                every += ranks.tolist()
            said = rpt_("{} faces seen, {} hidden, {} undecided")
        else:
            for obj in context.view_layer.objects:
                obj.select_set(result.objects.get(obj.name_full) == wanted)
            every = [*result.objects.values()]
            said = rpt_("{} objects seen, {} hidden, {} undecided")
        say(*result.notes)
        counts = (every.count(RANKS[state]) for state in (SEEN, HIDDEN, UNDECIDED))
        text = "; ".join([said.format(*counts), *result.notes])
        return "WARNING" if result.notes else "INFO", text


class REFERENCE_TRACER_MT_select_seen(bpy.types.Menu):
    bl_label = "What the Camera Sees"

    def draw(self, context: Any) -> None:
        """List what can be selected, and stored."""
        layout: Any = self.layout
        for text, options in (
            ("Select What the Camera Sees", ()),
            ("Select What the Camera Does Not See", ("hidden",)),
            ("Select What It Sees in Any Frame", ("frames",)),
            ("Select What It Sees in No Frame", ("hidden", "frames")),
            ("Store as Face Attribute", ("attribute",)),
            ("Store as Face Attribute, All Frames", ("attribute", "frames")),
        ):
            shown = layout.operator("reference_tracer.select_seen", text=text)
            for option in options:
                setattr(shown, option, True)
