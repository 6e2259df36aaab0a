"""The render engine REFERENCE_TRACER: F12, animations, `blender -b -E ...`, the 3D view.

Blender hands over an evaluated depsgraph. It is exported first; what is traced is the exported
scene. Every failure ends in `report({'ERROR'})`: after an exception or `error_set` alone, Blender
would write an empty picture and exit with 0.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import bpy
from bpy.types import Context, Depsgraph, Scene, ViewLayer

from ..wording import capital, say
from .temporary import ENGINE, is_temporary

if TYPE_CHECKING:
    from ..tracer.frame import Frame, Pass
    from ..tracer.hits import Statistics
    from ..tracer.settings import Settings

SHOW_EVERY = 0.5  # seconds between showing rows, at least; it takes at most a tenth of the time


class ReferenceTracerEngine(bpy.types.RenderEngine):
    """Exports, traces step by step, and hands the rows to Blender; the work is done elsewhere."""

    bl_idname = ENGINE
    bl_label = "Reference Tracer"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True  # else there is no mode Material Preview

    # Blender calls it by position, where the stubs have keywords.
    def update_render_passes(self, scene: Scene, renderlayer: ViewLayer) -> None:  # type: ignore[override]
        """Declare the passes to the compositor."""
        declare: Any = self.register_pass
        for p in _enabled(renderlayer):
            declare(scene, renderlayer, p.label, len(p.letters), p.letters, p.kind)

    # The stubs have Blender's property of this name instead.
    def render(self, depsgraph: Depsgraph) -> None:  # type: ignore[override]
        """Render one view layer of one frame; nothing of a temporary scene."""
        from ..errors import failure

        if is_temporary(depsgraph.scene):  # its evaluation is all that is wanted
            return
        if error := failure(self._trace, depsgraph):
            self.report({"ERROR"}, error)

    def view_update(self, context: Context, depsgraph: Depsgraph) -> None:
        """Take over what has changed for a 3D view in Rendered mode; each has its own engine."""
        from .live.view import LiveView

        self.live = getattr(self, "live", None) or LiveView()
        self.live.update(context, depsgraph)

    def view_draw(self, context: Context, depsgraph: Depsgraph) -> None:
        """Draw such a view."""
        self.live.draw(self, context, depsgraph)

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
            self.report({"INFO"}, capital(note))
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
        from ..tracer.progress import Meter

        began = time.monotonic()
        meter = Meter()
        due = began + SHOW_EVERY
        shown = 0
        for event in steps(frame.scene, settings, frame):
            meter.read(event)
            if meter.share < 1 and self.test_break():
                frame.cancel()
                break
            self.update_progress(meter.share)
            done = int(frame.rows_done.sum())  # they are done from the lowest upwards
            shown = min(shown, done)  # none is, if what was traced had to be withdrawn
            now = time.monotonic()
            if now > due:
                seconds = meter.seconds(now - began)
                rest = "" if seconds is None else f", {seconds:.0f} s left"
                self.update_stats("", f"Tracing {int(100 * meter.share)} %{rest}")
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
            self.report({"WARNING"}, capital(note))
        self.update_stats("", required[0] if required else "")


def _enabled(layer: Any) -> tuple[Pass, ...]:
    """Return the passes of a view layer: the picture first, then what is chosen."""
    from ..tracer.frame import PASSES

    chosen = layer.reference_tracer.passes
    return PASSES[0], *(p for p in PASSES if p.label in chosen)


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerEngine,))
