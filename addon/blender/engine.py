"""The render engine REFERENCE_TRACER: F12, animations, `blender -b -E ...`, the 3D view.

Blender hands over an evaluated depsgraph. It is exported first; what is traced is the exported
scene. Every failure ends in `report({'ERROR'})`: after an exception or `error_set` alone, Blender
would write an empty picture and exit with 0.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import bpy

from ..wording import say
from .temporary import is_temporary

if TYPE_CHECKING:
    from ..manifest import Manifest
    from ..pictures.certificate import CameraCertificate
    from ..scene import Scene
    from ..tracer.frame import Frame, Pass
    from ..tracer.hits import Statistics
    from ..tracer.settings import Settings
    from .drawing.judge import Judge

    Certified = tuple[Scene, Manifest, CameraCertificate | None]

ENGINE = "REFERENCE_TRACER"
SHOW_EVERY = 0.5  # seconds between showing rows, at least; it takes at most a tenth of the time


class ReferenceTracerEngine(bpy.types.RenderEngine):
    """Exports, traces step by step, and hands the rows to Blender; the work is done elsewhere."""

    bl_idname = ENGINE
    bl_label = "Reference Tracer"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True  # else there is no mode Material Preview

    export_to: ClassVar[list[Any]]  # what is Certified, while a temporary scene is rendered

    # Blender calls it by position, where the stubs have keywords.
    def update_render_passes(self, scene: Any, renderlayer: Any) -> None:  # type: ignore[override]
        """Declare the passes to the compositor."""
        declare: Any = self.register_pass
        for p in _enabled(renderlayer):
            declare(scene, renderlayer, p.label, len(p.letters), p.letters, p.kind)

    # The stubs have Blender's property of this name instead.
    def render(self, depsgraph: Any) -> None:  # type: ignore[override]
        """Render one view layer of one frame; a temporary scene is only exported."""
        from ..errors import failure

        work = self._export if is_temporary(depsgraph.scene) else self._trace
        if error := failure(work, depsgraph):
            self.report({"ERROR"}, error)

    def view_update(self, context: Any, depsgraph: Any) -> None:
        """Take over what has changed for a 3D view in Rendered mode; each has its own engine."""
        from .live.view import LiveView

        self.live = getattr(self, "live", None) or LiveView()
        self.live.update(context, depsgraph)

    def view_draw(self, context: Any, depsgraph: Any) -> None:
        """Draw such a view."""
        self.live.draw(self, context, depsgraph)

    def _export(self, depsgraph: Any) -> None:
        self.export_to.append(export_certified(depsgraph))

    def _trace(self, depsgraph: Any) -> None:
        """Export, trace and show one view layer of one frame, as long as Esc is not pressed."""
        from ..certified.arithmetic import AssumptionError
        from ..tracer.frame import Frame
        from .reading.export import export
        from .reading.palettes import as_compared

        self.update_stats("", "Exporting")
        scene, manifest = as_compared(depsgraph.scene, *export(depsgraph))
        say(*manifest.lines())
        for note in manifest.notes:
            self.report({"INFO"}, note[0].upper() + note[1:])
        frame = Frame.empty(scene)
        layer = depsgraph.view_layer.name
        passes = _enabled(depsgraph.view_layer)
        settings = depsgraph.scene.reference_tracer.settings()
        try:
            shown = self._fill(frame, settings, layer, passes[:1])
        except AssumptionError:
            self._show(frame, layer, passes, slice(0, frame.shape[0]))  # empty: it is withdrawn
            raise
        # Blender takes over all passes of a row at once: those that are added need all rows again.
        first = 0 if len(passes) > 1 else shown
        self._show(frame, layer, passes, slice(first, frame.shape[0]))
        if frame.cancelled:
            done = int(frame.rows_done.sum())
            rows = f"{done} of {frame.shape[0]} rows are traced, the others are empty"
            say(f"Cancelled: {rows}")  # Blender shows no report now
        else:
            self._tell(frame.statistics)

    def _fill(self, frame: Frame, settings: Settings, layer: str, picture: Sequence[Pass]) -> int:
        """Trace a frame and show its picture as it grows; return how many rows are shown."""
        from ..rendering import steps

        began = time.monotonic()
        due = began + SHOW_EVERY
        shown = 0
        for share in steps(frame.scene, settings, frame):
            if share < 1 and self.test_break():
                frame.cancel()
                break
            self.update_progress(share)
            done = int(frame.rows_done.sum())  # they are done from the lowest upwards
            shown = min(shown, done)  # none is, if what was traced had to be withdrawn
            now = time.monotonic()
            if now > due:
                left = f", {(now - began) * (1 - share) / share:.0f} s left" if share else ""
                self.update_stats("", f"Tracing {int(100 * share)} %{left}")
                if done > shown:
                    self._show(frame, layer, picture, slice(shown, done))
                    shown = done
                ended = time.monotonic()
                due = ended + max(SHOW_EVERY, 9 * (ended - now))
        return shown

    def _show(self, frame: Frame, layer: str, passes: Sequence[Pass], rows: slice) -> None:
        """Give Blender some rows of some passes; it puts them where they belong."""
        import numpy as np

        result: Any = self.begin_result(
            0, rows.start, frame.shape[1], rows.stop - rows.start, layer=layer
        )
        known = result.layers[0].passes
        for p in passes:
            if p.label not in known:
                self.add_pass(p.label, len(p.letters), p.letters, layer=layer)
            values = np.ascontiguousarray(p.shown(getattr(frame, p.name)[rows]), dtype=np.float32)
            known[p.label].rect.foreach_set(values.ravel())
        self.end_result(result)

    def _tell(self, statistics: Statistics) -> None:
        """Say what a picture took."""
        required = statistics.required()
        say(*required)
        for note in statistics.notes:  # such as that nothing can be certified here
            self.report({"WARNING"}, note[0].upper() + note[1:])
        self.update_stats("", required[0] if required else "")


def _enabled(layer: Any) -> tuple[Pass, ...]:
    """Return the passes of a view layer: the picture first, then what is chosen."""
    from ..tracer.frame import PASSES

    chosen = layer.reference_tracer.passes
    return PASSES[0], *(p for p in PASSES if p.label in chosen)


def export_certified(depsgraph: Any) -> Certified:
    """Return what :func:`.reading.export.export` does, and how close its camera is to Blender's."""
    from .reading.camera import certify_camera
    from .reading.export import export

    scene, manifest = export(depsgraph)
    if not scene.camera.projection.is_linear:  # Blender has no matrix for it
        return scene, manifest, None
    return scene, manifest, certify_camera(depsgraph.scene_eval, depsgraph, scene.camera)


def export_for_render(scene: Any) -> Certified:
    """Return the *render* evaluation of a temporary scene, and set its engine to this one.

    Such an evaluation exists only inside an engine: so the scene is rendered by this one.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    from ..scene import SceneError
    from .values import values_restored

    scene.render.engine = ENGINE
    exported: list[Certified] = []
    ReferenceTracerEngine.export_to = exported
    try:
        # Else the frame would be that of the context's scene (5.2).
        override = bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0])
        with values_restored(), override:
            bpy.ops.render.render(scene=scene.name)
    except RuntimeError as error:  # Blender turns our report into one
        raise SceneError(str(error).removeprefix("Error: ").strip()) from error
    finally:
        del ReferenceTracerEngine.export_to
    return exported[0]


def export_for_judge(tmp: Any, layer: str, judge: Judge) -> Certified:
    """Return what a judge's picture is to be compared with, as :func:`export_certified` does."""
    if not judge.needs_window:
        return export_for_render(tmp)
    with bpy.context.temp_override(scene=tmp, view_layer=tmp.view_layers[layer]):
        return export_certified(bpy.context.evaluated_depsgraph_get())


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerEngine,))
