"""The render engine REFERENCE_TRACER: F12, animations, `blender -b -E ...`, the 3D view.

Blender hands over an evaluated depsgraph; it is exported first, and what is traced then is the
exported scene. Every failure ends in `report({'ERROR'})`: an exception or `error_set` alone would
leave Blender writing an empty picture and exiting with 0.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import bpy

if TYPE_CHECKING:
    from ..compare.certificate import CameraCertificate
    from ..manifest import Manifest
    from ..scene import Scene
    from ..tracer.frame import Frame, Pass
    from .drawing.judges import Judge

    Certified = tuple[Scene, Manifest, CameraCertificate | None]

ENGINE = "REFERENCE_TRACER"
SHOWN = 10.0  # seconds that the status bar shows a message
SHOW_EVERY = 0.5  # seconds, at least: showing rows takes at most the tenth part of the time

_captured: list[Certified] | None = None


class ReferenceTracerEngine(bpy.types.RenderEngine):
    """A thin engine: exports, drives `tracer.render.steps`, hands the rows to Blender."""

    bl_idname = ENGINE
    bl_label = "Reference Tracer"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True  # else there is no mode Material Preview

    def update_render_passes(self, scene: Any, renderlayer: Any) -> None:
        """Declare the passes to the compositor."""
        for p in _enabled(renderlayer):
            self.register_pass(scene, renderlayer, p.label, len(p.letters), p.letters, p.kind)

    def render(self, depsgraph: Any) -> None:
        """Render one view layer of one frame."""
        from ..errors import failure
        from .drawing.temporary import is_temporary

        captures = _captured is not None and is_temporary(depsgraph.scene)
        if error := failure(_capture if captures else self._trace, depsgraph):
            self.report({"ERROR"}, error)

    def view_update(self, context: Any, depsgraph: Any) -> None:
        """Take over what has changed for a 3D view in Rendered mode; each has its own engine."""
        from .live.view import LiveView

        self.live = getattr(self, "live", None) or LiveView()
        self.live.update(context, depsgraph)

    def view_draw(self, context: Any, depsgraph: Any) -> None:
        """Draw such a view."""
        self.live.draw(self, context, depsgraph)

    def _trace(self, depsgraph: Any) -> None:
        from ..rendering import steps
        from ..tracer.frame import Frame
        from .reading.export import export

        began = time.monotonic()
        due = began + SHOW_EVERY
        self.update_stats("", "Exporting")
        scene, manifest = export(depsgraph)
        for line in manifest.lines():
            print(f"Reference Tracer: {line}")
        settings = depsgraph.scene.reference_tracer.settings()
        frame = Frame.empty(scene)
        layer, rows, shown = depsgraph.view_layer.name, frame.shape[0], 0
        passes = _enabled(depsgraph.view_layer)
        for share in steps(scene, settings, frame):
            if share < 1 and self.test_break():
                frame.cancel()
                break
            now = time.monotonic()
            self.update_progress(share)
            if now > due:
                left = f", {(now - began) * (1 - share) / share:.0f} s left" if share else ""
                self.update_stats("", f"Tracing {int(100 * share)} %{left}")
                done = int(frame.rows_done.sum())  # they are done from the lowest upwards
                if done > shown:
                    self._show(frame, layer, passes[:1], slice(shown, done))
                    shown = done
                ended = time.monotonic()
                due = ended + max(SHOW_EVERY, 9 * (ended - now))
        # Blender takes over all passes of a row at once: those that are added need all rows again.
        self._show(frame, layer, passes, slice(0 if len(passes) > 1 else shown, rows))
        if frame.cancelled:
            done = int(frame.rows_done.sum())
            _say(f"Cancelled: {done} of {rows} rows are traced, the others are empty")
            return
        for line in (required := frame.statistics.required()):
            print(f"Reference Tracer: {line}")
        for note in frame.statistics.notes:  # such as that nothing can be certified here
            self.report({"WARNING"}, note[0].upper() + note[1:])
        self.update_stats("", required[0] if required else "")

    def _show(self, frame: Frame, layer: str, passes: Sequence[Pass], rows: slice) -> None:
        """Give Blender some rows of some passes; it puts them where they belong."""
        import numpy as np

        width, height = frame.shape[1], rows.stop - rows.start
        result = self.begin_result(0, rows.start, width, height, layer=layer)
        have = result.layers[0].passes
        for p in passes:
            if p.label not in have:
                self.add_pass(p.label, len(p.letters), p.letters, layer=layer)
            values = np.ascontiguousarray(p.shown(getattr(frame, p.name)[rows]), dtype=np.float32)
            have[p.label].rect.foreach_set(values.ravel())
        self.end_result(result)


def _enabled(layer: Any) -> tuple[Pass, ...]:
    """Return the passes of a view layer: the picture first, then what is chosen."""
    from ..tracer.frame import PASSES

    chosen = layer.reference_tracer.passes
    return PASSES[0], *(p for p in PASSES if p.label in chosen)


def _say(text: str) -> None:
    """Print a message and show it in the status bar: a cancelled render's reports are dropped."""
    print(f"Reference Tracer: {text}")
    if not bpy.app.background:
        # Timers run in the main thread; a render does not.
        bpy.app.timers.register(lambda: _set_status(text), first_interval=0.2)
        bpy.app.timers.register(lambda: _set_status(None), first_interval=SHOWN)


def _set_status(text: str | None) -> None:
    for window in bpy.context.window_manager.windows:
        window.workspace.status_text_set(text)


def export_certified(depsgraph: Any) -> Certified:
    """Return what :func:`export.export` does, and how well its camera is Blender's own."""
    from .reading.camera import certify_camera
    from .reading.export import export

    scene, manifest = export(depsgraph)
    return scene, manifest, certify_camera(depsgraph.scene_eval, depsgraph, scene.camera)


def _capture(depsgraph: Any) -> None:
    _captured.append(export_certified(depsgraph))


def export_for_render(scene: Any) -> Certified:
    """Return the *render* evaluation of a temporary scene, whose engine is set to this one.

    Such an evaluation exists only inside an engine.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    from ..scene import SceneError
    from .drawing.temporary import values_kept

    global _captured
    scene.render.engine = ENGINE
    _captured = []
    try:
        # Else the frame would be that of the context's scene (5.2).
        override = bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0])
        with values_kept(), override:
            bpy.ops.render.render(scene=scene.name)
        return _captured[0]
    except RuntimeError as error:  # Blender turns our report into one
        raise SceneError(str(error).removeprefix("Error: ").strip()) from error
    finally:
        _captured = None


def export_for_judge(tmp: Any, layer: str, judge: Judge) -> Certified:
    """Return what a judge is to be compared with, as :func:`export_certified` does."""
    if not judge.needs_window:
        return export_for_render(tmp)
    with bpy.context.temp_override(scene=tmp, view_layer=tmp.view_layers[layer]):
        return export_certified(bpy.context.evaluated_depsgraph_get())


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerEngine,))
