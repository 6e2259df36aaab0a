"""The operator that selects what the camera sees, or what it does not."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty

from ...tracer.progress import Work
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
        """Return what is in the way: it needs Object Mode, or Edit Mode of meshes."""
        if context.mode not in ("OBJECT", "EDIT_MESH"):
            return rpt_("Only in Object Mode and in Edit Mode of meshes")
        return super().blocked(context)

    def begin(self, context: Any) -> Work[Any]:
        from ..jobs.animation import frames_of
        from ..jobs.faces import check_free
        from ..jobs.seen import look

        objects = context.objects_in_mode
        if context.mode == "OBJECT":
            objects = context.view_layer.objects if self.attribute else ()
        meshes = {o.data for o in objects if o.type == "MESH"}
        for mesh in meshes:
            if self.attribute and not mesh.library:
                check_free(mesh, NAME)
        return look(context, meshes, frames_of(context.scene) if self.frames else ())

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Select, store the attribute, and say what is seen."""
        import numpy as np

        from ..jobs.faces import select_faces, store
        from ..jobs.seen import HIDDEN, SEEN, STATES

        wanted = HIDDEN if self.hidden else SEEN
        for mesh, ranks in result.faces.items() if self.attribute else ():
            store(mesh, NAME, STATES[ranks])
        if context.mode == "OBJECT":
            said = rpt_("{} objects seen, {} hidden, {} undecided")
            every = np.array([*result.objects.values()])
            for obj in context.view_layer.objects:
                obj.select_set(result.objects.get(obj.name_full) == wanted)
        else:
            said = rpt_("{} faces seen, {} hidden, {} undecided")
            every = np.concatenate([*result.faces.values()])
            bpy.ops.mesh.select_mode(type="FACE")
            for mesh, ranks in result.faces.items():
                select_faces(mesh, ranks == wanted)
        hidden, undecided, seen = np.bincount(every, minlength=3)
        text = "; ".join((said.format(seen, hidden, undecided), *result.notes))
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
