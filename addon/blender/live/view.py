"""Draws one 3D view in Rendered mode, and works towards its picture in small steps.

While the view changes, coarse pictures follow it; once it rests, the whole one is made. A drawing
begins the work, so that a fast picture is there at once; a timer goes on with it. Nothing of bpy is
held: Blender frees the engine that this view belongs to, and all that is here goes with it.
"""

from __future__ import annotations

import time
import weakref
from functools import partial
from typing import Any, NamedTuple

import bpy
from bpy.types import Context, Depsgraph, RenderEngine

from ...errors import failure
from ...scene import Camera, alike
from ...tracer.settings import Settings
from . import shows
from .camera import camera_of, coarser
from .layers import Layers, draw_words
from .scene import ViewScene

AT_ONCE = 0.012  # seconds that the interface waits for work; a step may take longer than is left
COARSE = 4  # the size of a coarse picture's pixels
COARSER = 8  # if those take too long
SLOW = 0.025  # seconds that it waits for a coarse one; of what takes longer the next one is coarser
PAUSE = 0.1  # seconds until a request that cannot be met now is repeated
LINES = 2  # of what the picture lacks, in the view's corner
SHOW_EVERY = 0.3  # seconds between drawings of a picture that grows: Blender's own part takes long


class Wanted(NamedTuple):
    """The picture that a view is to show; those that are alike look the same."""

    camera: Camera
    version: int  # of the scene
    settings: Settings
    show: shows.Steps
    space: int  # the address of the view's


class Job:
    """A picture in the making; its pixels are `factor` times as wide and high as the view's."""

    def __init__(self, wanted: Wanted, whole: ViewScene, factor: int) -> None:
        camera = wanted.camera
        self.wanted = wanted
        self.factor = factor
        self.seconds = 0.0
        self.is_done = False
        scene = whole.scene(camera if factor == 1 else coarser(camera, factor))
        width = factor / camera.width
        height = factor / camera.height
        corner = scene.camera.region
        self.place = corner.x0 * width, corner.y0 * height, width, height
        self.picture = shows.Picture.empty(scene.camera, wanted.space, factor > 1)
        self._work = wanted.show(scene, wanted.settings, self.picture)

    def step(self) -> None:
        """Do one step of the work; a generator that has ended holds nothing."""
        began = time.perf_counter()
        self.is_done = next(self._work, self) is self
        self.seconds += time.perf_counter() - began


class LiveView:
    """The state of a 3D view."""

    def __init__(self) -> None:
        self._scene = ViewScene()
        self._layers = Layers()
        self._wanted: Wanted | None = None
        self.shown: Job | None = None  # the best one that is done
        self._job: Job | None = None  # a better one
        self._factor = COARSE  # of the next coarse picture
        self._rows = 0  # rows that are drawn of the better one
        self._unread = ""  # why there is no scene
        self.said = ""  # why what is wanted is not shown
        self._timer: Any = None
        self._drawn = 0.0  # when
        self._is_drawn = False  # all that is known

    @property
    def rests(self) -> bool:
        """Whether nothing is left to do: the whole picture is there, or why it cannot be."""
        return not self._job and self._is_drawn and bool(self.shown or self.said)

    def update(self, context: Context, depsgraph: Depsgraph) -> None:
        """Take over what has changed in the scene."""
        self._unread = failure(self._scene.update, depsgraph, context.space_data)

    def draw(self, engine: RenderEngine, context: Any, depsgraph: Depsgraph) -> None:
        """Draw the view, as well as it is known at once."""
        if self._scene.outdated(context.scene, context.space_data):
            self.update(context, depsgraph)
        until = time.perf_counter() + SLOW
        if error := self._unread or failure(self._aim, context):
            self._give_up(error)
            self._wanted = None  # whatever is wanted next is to be tried
        while self._job and self._job.factor > 1 and time.perf_counter() < until:
            self._step(self._job)
        if error := failure(self._draw, engine, context, until):
            self._give_up(error)
            engine.tag_redraw()  # to say so
        if self._job and not (self._timer and bpy.app.timers.is_registered(self._timer)):
            self._timer = partial(_tick, weakref.ref(engine))
            bpy.app.timers.register(self._timer, first_interval=0.0)

    def tick(self, engine: RenderEngine) -> float | None:
        """Work for a while; returns when to go on, in seconds, None for not."""
        until = time.perf_counter() + AT_ONCE
        pause = 0.0
        while self._job and not pause and time.perf_counter() < until:
            pause = PAUSE if self._job.picture.waits else 0.0
            self._step(self._job)
        rows = int(self._job.picture.rows_done.sum()) if self._job else 0
        if not self._is_drawn or (rows > self._rows and until > self._drawn + SHOW_EVERY):
            self._rows = rows
            engine.tag_redraw()
        return pause if self._job else None

    def _aim(self, context: Context) -> None:
        """Find out what is wanted, and begin to make it."""
        scene: Any = context.scene
        space: Any = context.space_data
        camera = camera_of(context.region, context.region_data, space, scene)
        settings = scene.reference_tracer.settings()
        show = shows.SHOWS[scene.reference_tracer.show]
        version = self._scene.version
        if show is shows.difference:  # a part of it is Blender's drawing
            version += self._scene.drawings
        wanted = Wanted(camera, version, settings, show, space.as_pointer())
        if not alike(self._wanted, wanted):
            self._wanted = wanted
            self.said = ""
        # A coarse picture of where the view has just been is finished: a view that never rests
        # would never show one.
        job = self._job
        is_other = job and (job.factor == 1 or job.wanted[1:] != wanted[1:])
        if job and is_other and not alike(job.wanted, wanted):
            self._job = None
        self._begin(wanted)

    def _begin(self, wanted: Wanted) -> None:
        """Begin a better picture, if there is one to be made and none in the making."""
        right = self.shown if self.shown and alike(self.shown.wanted, wanted) else None
        if self._job or self.said or (right and right.factor == 1):
            return
        self._rows = 0
        self._job = Job(wanted, self._scene, 1 if right else self._factor)

    def _step(self, job: Job) -> None:
        """Do one step; a picture that is done with it is shown, and a better one begun."""
        if error := failure(job.step):
            self._give_up(error)
        elif job.is_done:
            if job.factor > 1:  # the time falls with the pixels: from one to the other a quarter
                share = job.seconds / SLOW * (job.factor / COARSE) ** 2
                self._factor = COARSER if share > 1 else COARSE
            self._layers.add(job.picture, job.place)
            self.shown = job
            self._job = None
            self._is_drawn = False
            if self._wanted:
                self._give_up(failure(self._begin, self._wanted))

    def _give_up(self, error: str) -> None:
        """Show nothing but what went wrong, if something did."""
        if error:
            self.said = error
            self.shown = None
            self._job = None
            self._is_drawn = False
            self._layers = Layers()

    def _draw(self, engine: RenderEngine, context: Context, until: float) -> None:
        """Draw the pictures that there are, the better ones over the others."""
        import gpu

        region = context.region
        gpu.state.blend_set("NONE")  # what is better replaces what is below, where it is done
        if self._job:
            self._layers.add(self._job.picture, self._job.place)
        self._is_drawn = not self._layers.draw(region.width, region.height, until)
        if not self._is_drawn:
            engine.tag_redraw()
        if self.said:
            draw_words(self.said, region, context.preferences.system.ui_scale)
        engine.update_stats("", self._corner())
        self._drawn = time.perf_counter()

    def _corner(self) -> str:
        """Return the text in the view's corner."""
        jobs = [job for job in (self._job, self.shown) if job and job.picture.line]
        own = ["coarse: " * (job.factor > 1) + job.picture.line for job in jobs]
        text = "; ".join([*own[:1], *self._scene.lines[:LINES]])
        more = len(self._scene.lines) - LINES
        return f"{text}; and {more} more" if more > 0 else text


def _tick(reference: weakref.ref[Any]) -> float | None:
    engine = reference()  # None once Blender has freed it
    return engine.live.tick(engine) if engine else None
