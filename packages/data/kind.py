"""A kind of data, and the data of a picture: which values are right in a pixel.

A value is right if it is what the tracer computes of the surface that it sees, but for what the
file's own steps, and the float32 arithmetic of a renderer, may change. Nothing here is tuned: the
former are known from the file, and the latter is the bound that excuses an edge (`renderers.py`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from reference_tracer.arrays import Array, Bools, Colors, Floats, Where
from reference_tracer.pictures.bounds import U32
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.scene import Camera, Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING, Hits

from .seen import Seen
from .step import Step

Made = Callable[[Seen], Floats]  # -> (n, c)
Turn = Callable[[Floats, Seen], Floats]  # of right values (n, c), what a fault makes of them


@dataclass(frozen=True)
class Kind:
    """A kind of data: what a file of it holds, and what is right."""

    name: str  # of its option, too
    words: str  # what the values are, in words
    channels: int
    made: Made
    layers: tuple[str, ...]  # names of a file's layers or arrays that hold it, in small letters
    unit: str = ""
    follows_t: bool = True  # rounding along a ray, or beside it, moves the values
    # How far the rounding of a renderer may move them besides, (n,).
    loose: Callable[[Seen], Floats] = lambda seen: np.zeros(len(seen.t))
    empty: tuple[float, ...] = (0.0,)  # what all channels have where nothing is
    space: str = ""  # of vectors: 'world' or 'camera'
    range: str = ""  # of normals: 'signed', -1 to 1, or 'unit', stored as 0 to 1
    presumed: str = ""  # what is taken to be so, as nobody says it

    @property
    def encoded(self) -> bool:
        """Whether -1 to 1 is stored as 0 to 1."""
        return self.range == "unit"

    @property
    def variant(self) -> str:
        """Which of several conventions it is, in words."""
        way = {"normals": f", from {0 if self.encoded else -1} to 1"}.get(self.name, "")
        return f"in {self.space} space{way}"


@dataclass(frozen=True, eq=False)
class Data:
    """The values that a picture shows in each pixel (...), or in some of them."""

    kind: Kind
    values: Floats  # (..., c) as the file has them, integers times their unit
    blank: Bools  # (...) the file says that nothing is there
    film: Floats  # (..., 2) the pixels' centres, in pixels of the whole picture
    # With the scene's own clip range: a depth buffer's steps grow with it, and a guessed one could
    # excuse any depth.
    camera: Camera
    step: Step
    full: float = 1.0  # the largest value that the file can hold; 1 of floats
    turn: Turn = lambda made, seen: made
    raw: Array | None = None  # of ids: the values or colours of the whole picture, (h, w, c)

    def at(self, where: Where) -> Data:
        """Return some of the pixels."""
        own = self.values[where], self.blank[where], self.film[where]
        return replace(self, values=own[0], blank=own[1], film=own[2])

    @property
    def flat(self) -> Data:
        """The data of the n pixels in a row."""
        channels = self.kind.channels
        return replace(
            self,
            values=self.values.reshape(-1, channels),
            blank=self.blank.reshape(-1),
            film=self.film.reshape(-1, 2),
        )

    def turned(self, turn: Turn) -> Data:
        """Return the data, taken to be made with a fault beside those that it has."""
        before = self.turn
        return replace(self, turn=lambda made, seen: turn(before(made, seen), seen))

    def made(self, seen: Seen) -> Floats:
        """Return what the file should hold of what n pixels see, (n, c)."""
        return self.turn(self.kind.made(seen), seen)

    def of_frame(self, frame: Frame) -> Floats:
        """Return what the file should hold of a frame, (h, w, c); NaN where nothing is seen."""
        hits, out = frame.hits(), np.full(self.values.shape, np.nan)
        seen = np.flatnonzero(hits.instance != NOTHING)
        film = self.film.reshape(-1, 2)[seen]
        some = hits.take(seen)
        out.reshape(-1, self.kind.channels)[seen] = self.made(
            Seen.of(frame.scene, film, some, some.t)
        )
        return out

    def same(self, scene: Scene, hits: Hits, sampling: Sampling, t: Floats | None = None) -> Bools:
        """Return which of n pixels may show what n hits have.

        `t` (n,) is that of the centre rays, if the hits are theirs: then it is taken as it is.
        """
        hit = hits.instance != NOTHING
        out = self.blank.copy()
        nothing, there = np.flatnonzero(~hit), np.flatnonzero(hit)
        out[nothing] |= self.at(nothing)._at_the_end(scene)
        seen = Seen.of(scene, self.film[there], hits.take(there), None if t is None else t[there])
        out[there] = self.at(there)._shown(seen, sampling)
        return out

    @np.errstate(invalid="ignore", over="ignore", divide="ignore")
    def _shown(self, seen: Seen, sampling: Sampling) -> Bools:
        """Return which of n pixels show what they see."""
        made = self.made(seen)
        out = (np.abs(self.values - made) <= self.step.half(made)).all(axis=1)
        left = np.flatnonzero(~out & np.isfinite(self.values).all(axis=1))
        if len(left):
            some = Seen(
                seen.scene, seen.film[left], seen.instance[left], seen.triangle[left], seen.t[left]
            )
            allowed = self.step.half(made[left]) + self._rounding(made[left], some, sampling)
            out[left] = (np.abs(self.values[left] - made[left]) <= allowed).all(axis=1)
        return out

    def _rounding(self, made: Floats, seen: Seen, sampling: Sampling) -> Floats:
        """Return how far a renderer's float32 and its samples may move values, (n, c)."""
        out = np.repeat(self.kind.loose(seen)[:, None], made.shape[1], axis=1)
        if not self.kind.follows_t:
            return out
        renderer = sampling.renderer
        far = renderer.along(seen.scene, seen.hits, seen.positions, seen.rays)
        far = far + renderer.step(self.camera, seen.t)
        # A position may be made of barycentrics: these err as t does, along the surface.
        ends = np.array([self.made(seen.along(sign * far)) - made for sign in (-1, 1)])
        out += np.sqrt((ends * ends).sum(axis=2)).max(axis=0)[:, None]
        if aside := renderer.snapping + sampling.sample_radius:
            corners = [seen.aside(x, y) for x in (-aside, aside) for y in (-aside, aside)]
            out += np.max([np.abs(self.made(one) - made) for one in corners], axis=0)
        return out

    @np.errstate(invalid="ignore", over="ignore", divide="ignore")
    def _at_the_end(self, scene: Scene) -> Bools:
        """Return which of n pixels have the value of the clip range's end: an emptied buffer."""
        if self.kind.channels > 1 or not self.kind.follows_t:
            return np.zeros(len(self.blank), bool)
        none = np.full(len(self.blank), NOTHING, np.int32)
        end = np.full(len(none), float(scene.camera.clip_end))
        far = self.made(Seen(scene, self.film, none, none, end))
        if not np.isfinite(far).all():  # without an end there is no value of it
            return np.zeros(len(self.blank), bool)
        allowed = 2 * self.step.half(far) + 4 * U32 * np.abs(far)
        return (np.abs(self.values - far) <= allowed)[:, 0]

    @property
    def held(self) -> Floats:
        """What the file holds, (..., c); NaN where it says that nothing is there."""
        return np.where(self.blank[..., None], np.nan, self.values)

    def shown(self, values: Array) -> Colors:
        """Return values (h, w, c) as colours to look at, (h, w, 4): from the file's least to most.

        What is not finite, or where nothing is, is transparent.
        """
        own = self.held[np.isfinite(self.held)]
        low, high = (float(np.min(own)), float(np.max(own))) if own.size else (0.0, 1.0)
        with np.errstate(invalid="ignore", over="ignore"):
            grey = np.clip((values - low) / ((high - low) or 1.0), 0, 1)
        out = np.zeros((*values.shape[:-1], 4), np.float32)
        known = np.isfinite(values).all(axis=-1)
        out[known, :3] = np.broadcast_to(grey, (*grey.shape[:-1], 3))[known]
        out[known, 3] = 1
        return out

    @property
    def color(self) -> Colors:
        """The file's own values as colours, (h, w, 4)."""
        return self.shown(self.held)
