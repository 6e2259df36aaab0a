"""Explain a pixel, draw its ray, remove the drawing, save the pixel: for buttons and scripts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..arguments import words
from ..explain import markdown, reproducer
from ..explain.candidates import LIMIT
from ..explain.derivation import Derivation
from ..explain.document import answer_sentence
from ..explain.output import WRITERS
from ..report import folders
from ..scene import SceneError
from . import ray_objects, results, texts
from .explain import derive_here

TEXT = "Reference Tracer Pixel"


class REFERENCE_TRACER_OT_explain(bpy.types.Operator):
    """The maths of one pixel."""

    bl_idname = "reference_tracer.explain"
    bl_label = "Explain Pixel"
    bl_description = (
        "Derive what one pixel sees, step by step, in float32, float64 and exactly: in the text "
        "'Reference Tracer Pixel', and the key numbers in the panel"
    )
    bl_options = {"UNDO"}

    x: IntProperty(name="X", min=0, description="From the left of the picture")  # type: ignore[valid-type]
    y: IntProperty(name="Y", min=0, description="From the bottom of the picture")  # type: ignore[valid-type]
    source: EnumProperty(  # type: ignore[valid-type]
        name="Of",
        items=[
            ("SCENE", "Scene", "The scene now, as Trace and Compare takes it"),
            ("RENDER", "Render", "The scene now, as a render takes it"),
            ("COMPARISON", "Comparison", "The scene as the latest comparison took it"),
        ],
        options={"SKIP_SAVE"},
    )
    limit: IntProperty(name="Triangles", default=LIMIT, min=1, description="Shown at most")  # type: ignore[valid-type]
    draw_ray: BoolProperty(  # type: ignore[valid-type]
        name="Draw the Ray", options={"SKIP_SAVE"}, description="As objects in the 3D view, too"
    )
    filepath: StringProperty(  # type: ignore[valid-type]
        name="File",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
        description=f"Write it there, too; the ending says as what: {', '.join(WRITERS)}",
    )

    def execute(self, context: Any) -> set[str]:
        """Derive, show, and write if asked to."""
        try:
            writer = _writer(self.filepath)
            found = derive_here(context, self.x, self.y, self.source, self.limit)
            if writer:
                _write(self.filepath, writer(found))
        except (SceneError, OSError, MemoryError, RuntimeError) as error:
            self.report({"ERROR"}, words(error))
            return {"CANCELLED"}
        said = results.keep_derivation(context.scene, found, answer_sentence(found)).lines[0]
        texts.show(context, TEXT, markdown.text(found))
        if self.draw_ray:
            ray_objects.draw(context.scene, found)
        for area in context.window.screen.areas if context.window else ():
            area.tag_redraw()
        self.report({"INFO"}, f"({self.x}, {self.y}): {said}")
        return {"FINISHED"}


def _writer(filepath: str) -> Any:
    suffix = Path(filepath).suffix.lower()
    if filepath and suffix not in WRITERS:
        raise SceneError(f"'{filepath}' must end in {' or '.join(WRITERS)}")
    return WRITERS.get(suffix)


def _write(filepath: str, text: str) -> None:
    folders.write_text(Path(bpy.path.abspath(filepath)), text)


class _OfLatest:
    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow where a pixel was explained."""
        return results.latest(Derivation, context.scene) is not None

    def found(self, context: Any) -> Derivation:
        """Return its derivation."""
        return results.latest(Derivation, context.scene).content


class REFERENCE_TRACER_OT_draw_ray(_OfLatest, bpy.types.Operator):
    """The ray as objects."""

    bl_idname = "reference_tracer.draw_ray"
    bl_label = "Draw the Ray"
    bl_description = (
        "Draw the pixel's ray, the planes it was tested with, the hit and the three triangles that "
        "weigh the corners, as objects in a collection of their own. No picture shows them"
    )
    bl_options = {"UNDO"}

    def execute(self, context: Any) -> set[str]:
        """Draw."""
        collection = ray_objects.draw(context.scene, self.found(context))
        self.report({"INFO"}, f"{len(collection.objects)} objects in '{collection.name}'")
        return {"FINISHED"}


class REFERENCE_TRACER_OT_remove_ray(bpy.types.Operator):
    """The ray's objects go."""

    bl_idname = "reference_tracer.remove_ray"
    bl_label = "Remove the Ray"
    bl_description = "Remove the objects that Draw the Ray has made, and nothing else"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow where there are some."""
        return ray_objects.drawn()

    def execute(self, context: Any) -> set[str]:
        """Remove."""
        self.report({"INFO"}, f"{ray_objects.remove()} objects removed")
        return {"FINISHED"}


class REFERENCE_TRACER_OT_save_pixel(_OfLatest, bpy.types.Operator):
    """The pixel as a file that stands alone."""

    bl_idname = "reference_tracer.save_pixel"
    bl_label = "Save Pixel"
    bl_description = (
        "Save the derivation (.html, .md), or the pixel's ray and all that it may meet as a small "
        "file (.json) from which `reftrace explain FILE.json` derives it again"
    )

    filepath: StringProperty(subtype="FILE_PATH", default="pixel.html")  # type: ignore[valid-type]
    filter_glob: StringProperty(default="*.html;*.md;*.json", options={"HIDDEN"})  # type: ignore[valid-type]

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Ask for the file."""
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        """Write it."""
        found = self.found(context)
        try:
            writer = _writer(self.filepath)
            is_json = Path(self.filepath).suffix.lower() == ".json"
            _write(self.filepath, reproducer.text(found.pixel) if is_json else writer(found))
        except (SceneError, OSError) as error:
            self.report({"ERROR"}, words(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Saved {self.filepath}")
        return {"FINISHED"}


CLASSES = (
    REFERENCE_TRACER_OT_explain,
    REFERENCE_TRACER_OT_draw_ray,
    REFERENCE_TRACER_OT_remove_ray,
    REFERENCE_TRACER_OT_save_pixel,
)


def register() -> None:
    """Register the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Undo :func:`register`."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
