"""A pixel of the open scene -> its derivation, drawn, saved: for buttons and scripts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..compare.comparison import Comparison
from ..explain import document, reproducer
from ..explain.candidates import LIMIT
from ..explain.derivation import Derivation, derive
from ..explain.document import answer_sentence
from ..explain.writers import WRITERS
from ..report import folders
from ..scene import SceneError
from . import ray_objects, results
from .compare import export_open_file
from .judges import judge_named
from .long_work import failed
from .properties import SAID, SOURCES

TEXT = "Reference Tracer Pixel"
_SAID = SAID["explain"]


def derive_here(
    context: Any, x: int, y: int, source: str = "SCENE", limit: int = LIMIT
) -> Derivation:
    """Derive a pixel of the context's scene.

    Parameters
    ----------
    x, y : int
        Of the picture; (0, 0) is its lower left.
    source : {'SCENE', 'RENDER', 'COMPARISON'}
        The scene as *Trace and Compare* would export it now; as a render would; or as the latest
        comparison did, which is the scene now where there is none.
    limit : int
        Triangles shown.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or has no such pixel.
    """
    latest = results.latest(Comparison, context.scene)
    if source == "COMPARISON" and latest:
        scene = latest.content.scene
    else:
        judge = judge_named(context.scene.reference_tracer.judge, bpy.app.background)
        scene, _, _ = export_open_file(context, None if source == "RENDER" else judge)
    file = bpy.path.basename(bpy.data.filepath) or "the unsaved file"
    return derive(scene, x, y, limit, file)


class REFERENCE_TRACER_OT_explain(bpy.types.Operator):
    bl_idname = "reference_tracer.explain"
    bl_label = "Explain Pixel"
    bl_description = (
        "Derive what one pixel sees, step by step, in float32, float64 and exactly: in the text "
        "'Reference Tracer Pixel', and the key numbers in the panel"
    )
    bl_options = {"UNDO"}

    x: IntProperty(**_SAID["x"])  # type: ignore[valid-type]
    y: IntProperty(**_SAID["y"])  # type: ignore[valid-type]
    source: EnumProperty(items=SOURCES, options={"SKIP_SAVE"}, **_SAID["source"])  # type: ignore[valid-type]
    limit: IntProperty(default=LIMIT, **_SAID["limit"])  # type: ignore[valid-type]
    draw_ray: BoolProperty(options={"SKIP_SAVE"}, **_SAID["draw_ray"])  # type: ignore[valid-type]
    filepath: StringProperty(  # type: ignore[valid-type]
        name="File",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
        description=f"Write it there, too; the ending says as what: {', '.join(WRITERS)}",
    )

    def execute(self, context: Any) -> set[str]:
        try:
            found = derive_here(context, self.x, self.y, self.source, self.limit)
            if self.filepath:
                _write(self.filepath, found)
        except Exception as error:
            return failed(self, error)
        said = answer_sentence(found)
        results.keep(Derivation, found, [said], context.scene.name)
        results.show_text(context, TEXT, document.document_markdown(found))
        if self.draw_ray:
            ray_objects.draw(context.scene, found)
        results.redraw(context)
        self.report({"INFO"}, f"({self.x}, {self.y}): {said}")
        return {"FINISHED"}


def _write(filepath: str, found: Derivation, **other: Callable[[Derivation], str]) -> None:
    """Write a derivation as the file's ending says; `other` writers are by theirs."""
    writers = WRITERS | {f".{ending}": writer for ending, writer in other.items()}
    path = Path(bpy.path.abspath(filepath))
    if path.suffix.lower() not in writers:
        raise SceneError(f"'{filepath}' must end in {' or '.join(writers)}")
    folders.write_text(path, writers[path.suffix.lower()](found))


class _OfLatest:
    @classmethod
    def poll(cls, context: Any) -> bool:
        return results.latest(Derivation, context.scene) is not None


class REFERENCE_TRACER_OT_draw_ray(_OfLatest, bpy.types.Operator):
    bl_idname = "reference_tracer.draw_ray"
    bl_label = "Draw the Ray"
    bl_description = (
        "Draw the pixel's ray, the planes it was tested with, the hit and the three triangles that "
        "weigh the corners, as objects in a collection of their own. No picture shows them"
    )
    bl_options = {"UNDO"}

    def execute(self, context: Any) -> set[str]:
        found = results.latest(Derivation, context.scene).content
        collection = ray_objects.draw(context.scene, found)
        self.report({"INFO"}, f"{len(collection.objects)} objects in '{collection.name}'")
        return {"FINISHED"}


class REFERENCE_TRACER_OT_remove_ray(bpy.types.Operator):
    bl_idname = "reference_tracer.remove_ray"
    bl_label = "Remove the Ray"
    bl_description = "Remove the objects that Draw the Ray has made, and nothing else"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        return ray_objects.are_drawn()

    def execute(self, context: Any) -> set[str]:
        self.report({"INFO"}, f"{ray_objects.remove()} objects removed")
        return {"FINISHED"}


class REFERENCE_TRACER_OT_save_pixel(_OfLatest, bpy.types.Operator):
    bl_idname = "reference_tracer.save_pixel"
    bl_label = "Save Pixel"
    bl_description = (
        "Save the derivation (.html, .md), or the pixel's ray and all that it may meet as a small "
        "file (.json) from which `reftrace explain FILE.json` derives it again"
    )

    filepath: StringProperty(subtype="FILE_PATH", default="pixel.html")  # type: ignore[valid-type]
    filter_glob: StringProperty(default="*.html;*.md;*.json", options={"HIDDEN"})  # type: ignore[valid-type]

    def invoke(self, context: Any, event: Any) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        found = results.latest(Derivation, context.scene).content
        try:
            _write(self.filepath, found, json=lambda found: reproducer.text(found.pixel))
        except Exception as error:
            return failed(self, error)
        self.report({"INFO"}, f"Saved {self.filepath}")
        return {"FINISHED"}


CLASSES = (
    REFERENCE_TRACER_OT_explain,
    REFERENCE_TRACER_OT_draw_ray,
    REFERENCE_TRACER_OT_remove_ray,
    REFERENCE_TRACER_OT_save_pixel,
)


register, unregister = bpy.utils.register_classes_factory(CLASSES)
