"""One 3D view in Rendered mode: what it shows, and the work towards it, in small steps.

While the view changes, coarse pictures follow it; once it rests, the whole one is made. A drawing
begins the work, so that a fast picture is there at once; a timer goes on with it. Nothing of bpy is
kept: Blender frees the engine whose view this is, and all that is here goes with it.
"""

from __future__ import annotations

import time
import traceback
import weakref
from collections.abc import Iterator
from functools import partial
from typing import Any, NamedTuple

import bpy

from ...arguments import EXPECTED, words
from ...scene import Camera
from ...tracer.settings import Settings
from . import shows
from .camera import camera_of, coarser
from .drawing import Textures, draw_words
from .kept import KeptScene

AT_ONCE = 0.015  # seconds that the interface waits for work
COARSE, COARSER = 4, 8  # sizes of a coarse picture's pixels
SLOW = 0.05  # seconds: one that takes longer is followed by a coarser one
SHOW_EVERY = 0.3  # seconds between drawings of a picture that grows: Blender's own take long


class Wanted(NamedTuple):
    """What is to be shown; two that are equal look the same."""

    key: str  # of the camera
    version: int  # of the scene
    settings: Settings
    show: shows.Show

    def differs_in_more_than_the_camera(self, other: Wanted) -> bool:
        """Return whether not only the camera has moved."""
        return self[1:] != other[1:]


class Job:
    """A picture in the making, or made."""

    def __init__(self, wanted: Wanted, camera: Camera, factor: int, kept: KeptScene) -> None:
        self.wanted, self.camera, self.factor = wanted, camera, factor
        scene = kept.scene(camera if factor == 1 else coarser(camera, factor))
        self.region = scene.camera.region
        self.picture = shows.Picture.empty(scene.camera)
        self.work: Iterator[float] = wanted.show.steps(scene, wanted.settings, self.picture)
        self.textures: Textures | None = None
        self.seconds, self.is_done = 0.0, False

    def step(self) -> None:
        """Do one step."""
        began = time.perf_counter()
        self.is_done = next(self.work, None) is None
        self.seconds += time.perf_counter() - began
        if self.is_done:
            self.work = iter(())  # what it holds is free

    def upload(self, until: float) -> bool:
        """Bring what is done to the graphics card; True if some of it is left."""
        self.textures = self.textures or Textures(self.picture)
        return self.textures.upload(until)

    def draw(self, width: int, height: int) -> None:
        """Draw what is there over a region of this size, stretched if it is of another."""
        x = self.factor * width / self.camera.width
        y = self.factor * height / self.camera.height
        self.textures.draw(self.region.x0 * x, self.region.y0 * y, x, y)


class LiveView:
    """The state of a 3D view."""

    def __init__(self) -> None:
        self._kept = KeptScene()
        self._version = 0
        self._wanted: tuple[Wanted, Camera] | None = None
        self._shown: Job | None = None  # the best that is whole
        self._job: Job | None = None
        self._factor = COARSE
        self._scene_error = self._error = ""
        self._timer: Any = None
        self._drawn = 0.0

    def update(self, context: Any, depsgraph: Any) -> None:
        """Take over what has changed in the scene."""
        self._version += 1
        self._scene_error = _said(self._kept.update, depsgraph, context.space_data)

    def draw(self, engine: Any, context: Any) -> None:
        """Draw the view, as well as it is known at once."""
        until = time.perf_counter() + AT_ONCE
        self._error = self._scene_error or _said(self._aim, context)
        while not self._error and self._job and self._job.factor > 1:
            self._error = _said(self._step)
            if time.perf_counter() > until:
                break
        if self._error:
            self._shown = self._job = None
        self._draw(engine, context, until)
        if self._job and not (self._timer and bpy.app.timers.is_registered(self._timer)):
            self._timer = partial(_tick, weakref.ref(engine))
            bpy.app.timers.register(self._timer, first_interval=0.0)

    def _aim(self, context: Any) -> None:
        """Find out what is wanted, and begin to make it."""
        region, space, scene = context.region, context.space_data, context.scene
        camera = camera_of(region, context.region_data, space, scene)
        settings = scene.reference_tracer.settings()
        wanted = Wanted(str(camera.to_dict()), self._version, settings, shows.chosen(context))
        self._wanted = wanted, camera
        job = self._job
        if job and job.wanted != wanted:
            # A coarse picture of where the view has just been is finished: else a view that never
            # rests would never see one.
            if job.factor == 1 or job.wanted.differs_in_more_than_the_camera(wanted):
                self._job = None
        self._begin()

    def _begin(self) -> None:
        """Begin the next picture, if there is none in the making and a better one to be made."""
        wanted, camera = self._wanted
        if self._job:
            return
        if not self._shown or self._shown.wanted != wanted:
            self._job = Job(wanted, camera, self._factor, self._kept)
        elif self._shown.factor > 1:
            self._job = Job(wanted, camera, 1, self._kept)

    def _step(self) -> None:
        """Do one step of the work that there is, and begin the next if that was the last."""
        job = self._job
        job.step()
        if job.is_done:
            if job.factor > 1:
                limit = SLOW if job.factor == COARSE else SLOW * (COARSE / COARSER) ** 2
                self._factor = COARSER if job.seconds > limit else COARSE
            self._shown, self._job = job, None
            self._begin()

    def tick(self, engine: Any) -> float | None:
        """Work for a while; returns when to go on, in seconds, None for never."""
        until, shown = time.perf_counter() + AT_ONCE, self._shown
        while self._job and not self._error and time.perf_counter() < until:
            self._error = self._scene_error = _said(self._step)
        grown = self._job and self._job.picture.rows_done.any()
        due = grown and time.perf_counter() > self._drawn + SHOW_EVERY
        if self._shown is not shown or self._error or due:
            engine.tag_redraw()
        return 0.0 if self._job and not self._error else None

    def _draw(self, engine: Any, context: Any, until: float) -> None:
        import gpu

        region = context.region
        jobs = [job for job in (self._shown, self._job) if job]
        gpu.state.blend_set("NONE")  # what is drawn later replaces what is below
        engine.bind_display_space_shader(context.scene)
        for job in jobs:
            if job.upload(until):
                engine.tag_redraw()
            job.draw(region.width, region.height)
        engine.unbind_display_space_shader()
        if self._error:
            draw_words(self._error, region, context.preferences.system.ui_scale)
        engine.update_stats("", jobs[-1].picture.line if jobs else "")
        self._drawn = time.perf_counter()


def _said(work: Any, *arguments: Any) -> str:
    """Do some work; returns what went wrong in words, or nothing."""
    try:
        work(*arguments)
    except (*EXPECTED, ValueError) as error:
        return words(error)
    except Exception as error:  # whatever it is, the view must say so
        traceback.print_exc()
        return f"Reference Tracer failed: {type(error).__name__}: {error}"
    return ""


def _tick(reference: weakref.ref) -> float | None:
    engine = reference()  # None once Blender has freed it
    return engine.live.tick(engine) if engine else None
