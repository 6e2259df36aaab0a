"""A pixel of the open scene -> its derivation, drawn, saved: for buttons and scripts."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..drawing.judges import judge_named
from . import results
from .long_work import named, with_ending
from .properties import SAID, SOURCES
from .results import Kind

if TYPE_CHECKING:
    from ...explain.derivation import Derivation

TEXT = "Reference Tracer Pixel"
_SAID = SAID["explain"]


def derive_here(
    context: Any, x: int, y: int, source: str = "SCENE", limit: int = _SAID["limit"]["default"]
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
    from ...explain.derivation import derive
    from ..compare import export_open_file

    latest = results.latest(Kind.COMPARISON, context.scene)
    if source == "COMPARISON" and latest:
        scene = latest.content.scene
    else:
        judge = judge_named(context.scene.reference_tracer.judge, bpy.app.background)
        scene, _, _ = export_open_file(context, None if source == "RENDER" else judge)
    file = bpy.path.basename(bpy.data.filepath) or "the unsaved file"
    return derive(scene, x, y, limit, file)


@named
class REFERENCE_TRACER_OT_explain(bpy.types.Operator):
    bl_options = {"UNDO"}

    x: IntProperty(**_SAID["x"])  # type: ignore[valid-type]
    y: IntProperty(**_SAID["y"])  # type: ignore[valid-type]
    source: EnumProperty(items=SOURCES, options={"SKIP_SAVE"}, **_SAID["source"])  # type: ignore[valid-type]
    limit: IntProperty(**_SAID["limit"])  # type: ignore[valid-type]
    draw_ray: BoolProperty(options={"SKIP_SAVE"}, **_SAID["draw_ray"])  # type: ignore[valid-type]
    filepath: StringProperty(options={"SKIP_SAVE"}, **_SAID["filepath"])  # type: ignore[valid-type]

    def execute(self, context: Any) -> set[str]:
        from ...explain import document
        from . import ray_objects

        found = derive_here(context, self.x, self.y, self.source, self.limit)
        if self.filepath:
            _write(self.filepath, found)
        said = document.answer_sentence(found)
        results.keep(Kind.PIXEL, found, [said], context.scene.name)
        results.show_text(context, TEXT, document.document_markdown(found))
        if self.draw_ray:
            ray_objects.draw(context.scene, found)
        results.redraw(context)
        self.report({"INFO"}, f"({self.x}, {self.y}): {said}")
        return {"FINISHED"}


def _write(filepath: str, found: Derivation, **other: Callable[[Derivation], str]) -> None:
    """Write a derivation as the file's ending says; `other` writers are by theirs."""
    from ...explain.writers import WRITERS
    from ...report import folders

    writers = WRITERS | {f".{ending}": writer for ending, writer in other.items()}
    path = with_ending(filepath, *writers)
    folders.write_text(path, writers[path.suffix.lower()](found))


class _OfLatest:
    @classmethod
    def poll(cls, context: Any) -> bool:
        return results.latest(Kind.PIXEL, context.scene) is not None


@named
class REFERENCE_TRACER_OT_draw_ray(_OfLatest, bpy.types.Operator):
    bl_options = {"UNDO"}

    def execute(self, context: Any) -> set[str]:
        from . import ray_objects

        found = results.latest(Kind.PIXEL, context.scene).content
        collection = ray_objects.draw(context.scene, found)
        self.report({"INFO"}, f"{len(collection.objects)} objects in '{collection.name}'")
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_remove_ray(bpy.types.Operator):
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        from . import ray_objects

        return ray_objects.are_drawn()

    def execute(self, context: Any) -> set[str]:
        from . import ray_objects

        self.report({"INFO"}, f"{ray_objects.remove()} objects removed")
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_save_pixel(_OfLatest, bpy.types.Operator):
    filepath: StringProperty(**SAID["save_pixel"]["filepath"])  # type: ignore[valid-type]
    filter_glob: StringProperty(default="*.html;*.md;*.json", options={"HIDDEN"})  # type: ignore[valid-type]

    def invoke(self, context: Any, event: Any) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        from ...explain import reproducer

        found = results.latest(Kind.PIXEL, context.scene).content
        _write(self.filepath, found, json=lambda found: reproducer.text(found.pixel))
        self.report({"INFO"}, f"Saved {self.filepath}")
        return {"FINISHED"}
