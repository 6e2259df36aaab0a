"""The operators that derive what one pixel sees, draw it and save it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from bpy.types import Context, Event

from ...wording import count_of
from ..drawing.judges import judge_or_none
from . import blocks, choices, results
from .areas import redraw
from .long_work import Answer, named, with_ending
from .results import Kind

if TYPE_CHECKING:
    from ...derivation.derivation import Derivation

TEXT = "Reference Tracer Pixel"


def derive_here(context: Context, x: int, y: int, source: str) -> Derivation:
    """Derive a pixel of the context's scene.

    Parameters
    ----------
    x, y : int
        The pixel's column and row; (0, 0) is the lower left of the picture.
    source : {'SCENE', 'RENDER', 'COMPARISON', 'PUT_RIGHT'}
        The scene as *Trace and Compare* would export it now; as a render would; as the latest
        comparison did; or this with what is shown as put right. Without a comparison, it is the
        scene now.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or has no such pixel; or if nothing is shown as put right.
    """
    from ...derivation.derivation import derive
    from ..jobs.open_file import Choices, export_open_file

    file = bpy.path.basename(bpy.data.filepath) or "the unsaved file"
    comparison = results.comparison(context)
    if source == "COMPARISON" and comparison:
        scene = comparison.scene
    elif source == "PUT_RIGHT":
        told = results.shown_put_right(context.scene)
        scene = told.frame.scene
        file += f", with this put right: {told.sentence}"
    else:
        chosen = Choices.of(context.scene, {}).judge
        judge = None if source == "RENDER" else judge_or_none(chosen, bpy.app.background)
        scene, _, _ = export_open_file(context, judge)
    return derive(scene, x, y, source=file)


@named
class REFERENCE_TRACER_OT_explain(bpy.types.Operator):
    bl_label = "Explain Pixel"
    bl_description = (
        "Derive what one pixel sees, step by step, in float32, float64 and exactly. The text "
        "'Reference Tracer Pixel' has all of it, the panel the key numbers"
    )
    bl_options = set()  # what it leaves is a result; the objects of the ray are a step of their own

    x: IntProperty(name="X", description="The pixel's column, from the left", min=0)
    y: IntProperty(name="Y", description="The pixel's row, from the bottom", min=0)
    source: EnumProperty(
        name="Of",
        description="The picture that the pixel belongs to",
        items=choices.SOURCES,
        options={"SKIP_SAVE"},
    )
    draw_ray: BoolProperty(
        name="Draw the Ray",
        description="Also draw the ray, as objects in the 3D view",
        options={"SKIP_SAVE"},
    )

    def execute(self, context: Context) -> Answer:
        from ...derivation import document

        found = derive_here(context, self.x, self.y, self.source)
        said = document.answer_sentence(found)
        if self.source == "PUT_RIGHT":
            told = results.shown_put_right(context.scene)
            said = rpt_("With this put right: {}. {}").format(told.sentence, said)
        results.keep(Kind.PIXEL, found, [said], context.scene.session_uid)
        blocks.show_text(TEXT, document.document_markdown(found))
        if self.draw_ray:
            draw: Any = bpy.ops.reference_tracer.draw_ray  # type: ignore[attr-defined]
            draw("EXEC_DEFAULT", True)
        redraw(context)
        self.report({"INFO"}, f"({self.x}, {self.y}): {said}")
        return {"FINISHED"}


class _OfLatest:
    @classmethod
    def poll(cls, context: Context) -> bool:
        return results.content(Kind.PIXEL, context.scene) is not None


@named
class REFERENCE_TRACER_OT_draw_ray(_OfLatest, bpy.types.Operator):
    bl_label = "Draw the Ray"
    bl_description = (
        "Draw the pixel's ray, the film, the planes it was tested with, the hit and the three "
        "triangles that weigh the corners, as objects in a collection of their own. No picture "
        "shows them"
    )
    bl_options = {"UNDO"}

    def execute(self, context: Context) -> Answer:
        from . import ray_objects

        found = results.content(Kind.PIXEL, context.scene)
        collection = ray_objects.draw(context.scene, found)
        count = count_of(len(collection.objects), "object")
        self.report({"INFO"}, f"{count} in '{collection.name}'")
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_remove_ray(bpy.types.Operator):
    bl_label = "Remove the Ray"
    bl_description = "Remove the objects that Draw the Ray has made, and nothing else"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        from . import ray_objects

        return ray_objects.are_drawn()

    def execute(self, context: Context) -> Answer:
        from . import ray_objects

        self.report({"INFO"}, rpt_("{} objects removed").format(ray_objects.remove()))
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_save_pixel(_OfLatest, bpy.types.Operator):
    bl_label = "Save Pixel"
    bl_description = (
        "Save the derivation (.html, .md); or the pixel's ray and all that it may meet as a "
        "small file (.json), from which `reftrace explain FILE.json` derives it again"
    )
    filepath: StringProperty(
        name="File",
        description="The file to write; its name ends in .html, .md or .json",
        default="pixel.html",
        subtype="FILE_PATH",
    )
    filter_glob: StringProperty(default="*.html;*.md;*.json", options={"HIDDEN"})

    def invoke(self, context: Context, event: Event) -> Answer:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Context) -> Answer:
        from ...derivation import reproducer
        from ...report import folders, pixel

        found = results.content(Kind.PIXEL, context.scene)
        path = with_ending(self.filepath, ".html", ".md", ".json")
        ending = path.suffix.lower()
        again = ending == ".json"
        text = reproducer.text(found.pixel) if again else pixel.WRITERS[ending](found)
        folders.write_text(path, text)
        self.report({"INFO"}, rpt_("Saved {}").format(self.filepath))
        return {"FINISHED"}
