"""The operators of the comparison, for buttons and scripts; the work is done elsewhere."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty
from bpy.types import Context

from ...tracer.progress import Work
from ...wording import capital, say
from ..drawing.judges import OF_ONE_FRAME, STILLS
from . import blocks, results
from .areas import redraw
from .long_work import LongWork, named
from .results import Kind
from .shown import open_as_render, show_where_shown


@named
class REFERENCE_TRACER_OT_compare(LongWork, bpy.types.Operator):
    bl_label = "Trace and Compare"
    bl_description = (
        "Trace the scene by the chosen method, and compare every pixel with Blender's own "
        "picture. The textbook's formulas and the proven picture are listed side by side"
    )
    kind: Kind | None = Kind.COMPARISON
    needs_camera = True
    announced = "Blender draws the scene"
    _is_shown = False

    def begin(self, context: Context) -> Work[Any]:
        """Have Blender draw the scene, and compare."""
        from ..jobs.compare import compare_open_file

        return compare_open_file(context, self.folder())

    def show(self, context: Context, result: Any) -> Work[None]:
        """Keep a comparison, and show the user the traced picture, once."""
        yield from results.keep_comparison(result, self.scene)
        self.left = rpt_("the comparison stays, without a diagnosis")
        redraw(context)
        if not self._is_shown:
            show = open_as_render if self.pressed else show_where_shown
            show(context, blocks.ours(blocks.TRACED))
            self._is_shown = True
            self.kind = None

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        """Print the comparison; report its first line."""
        from ...report.lines import describe

        said = describe(result)  # of the comparison: the context's scene may be another one by now
        say(*result.manifest.lines(), *said)
        return "INFO" if result.verdict == "agree" else "WARNING", said[0]


@named
class REFERENCE_TRACER_OT_compare_all(LongWork, bpy.types.Operator):
    bl_label = "Compare All Engines"
    bl_description = (
        "Trace the scene, and compare it with the picture of each engine, Blender's own and those "
        "of add-ons: which of them shows a wrong object, where, and why"
    )
    kind = Kind.ENGINES
    needs_camera = True
    announced = "Blender draws the scene"

    def begin(self, context: Context) -> Work[Any]:
        """Have every engine draw the scene at once; return the work that is left."""
        from ..jobs.engines import compare_all

        return compare_all(context, self.folder())

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        from ...comparison import engines
        from ...report import engines as engines_report

        lines = engines_report.lines(result)
        say(*results.keep(Kind.ENGINES, tuple(result), lines, self.scene).lines)
        verdict = engines.worst(result)
        text = ", ".join(f"{row.engine}: {row.verdict}" for row in result)
        return "INFO" if verdict == "agree" else "WARNING", capital(text)


@named
class REFERENCE_TRACER_OT_compare_animation(LongWork, bpy.types.Operator):
    bl_label = "Compare Animation"
    bl_description = (
        "Step the scene through its frames, and compare each; the worst are listed first. Esc "
        "keeps the frames that are done. Afterwards the scene is at its frame again"
    )
    kind = Kind.FRAMES
    needs_camera = True
    announced = "Blender draws the scene"
    alone = True

    @classmethod
    def blocked(cls, context: Any) -> str:
        """Return what is in the way: every frame needs a picture of its own."""
        is_still = context.scene.reference_tracer.judge in STILLS
        return rpt_(OF_ONE_FRAME) if is_still else super().blocked(context)

    def begin(self, context: Context) -> Work[Any]:
        from ..jobs import animation

        self._folder = self.folder() or results.session_folder() / "animation"
        self._frames = animation.frames_of(context.scene)
        return animation.compare_frames(self._folder, self._frames)

    def show(self, context: Context, result: Any) -> Work[None]:
        """Keep the rows of the frames so far."""
        from ...comparison.animation import worst_first
        from ...report import animation as frames_report

        content = self._folder / frames_report.PAGE, worst_first(result)
        lines = frames_report.lines(self._frames, result)
        found = results.keep(Kind.FRAMES, content, lines, self.scene)
        self.left = ", ".join(found.lines[-2:])
        redraw(context)
        yield None

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        say(*results.latest(Kind.FRAMES, context.scene).lines)
        return "INFO" if self.left.endswith(": agree") else "WARNING", self.left.capitalize()


@named
class REFERENCE_TRACER_OT_open_page(LongWork, bpy.types.Operator):
    bl_label = "Open Page"
    bl_description = (
        "Write the comparison as one HTML file and open it in the browser: every pixel's "
        "cause, numbers and derivation, and what else was measured"
    )
    bl_options = set()  # it leaves nothing in Blender

    open_browser: BoolProperty(
        name="Open in the Browser",
        description="Open the file once it is written",
        default=True,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs a comparison, and runs alone."""
        found = results.comparison(context)
        return super().blocked(context) if found else rpt_("Trace and Compare comes first")

    def begin(self, context: Context) -> Work[Any]:
        from ...comparison.extras import extras

        self._folder = self.folder() or results.session_folder()
        self._comparison = results.comparison(context)
        self._trade = results.content(Kind.TRADE, context.scene)
        return extras(self._comparison)

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        """Write the page, with the studies that there are, and open it."""
        from ...report import page

        path = self._folder / page.NAME
        extremes = results.content(Kind.EXTREMES, context.scene)
        page.write(path, self._comparison, replace(result, trade=self._trade, extremes=extremes))
        if self.open_browser:
            bpy.ops.wm.url_open(url=path.resolve().as_uri())
        return "INFO", rpt_("The page is {}").format(path)
