"""What the other side shows: its colours, and, where that is known, whose surfaces they are.

A pixel differs where its colour does, or where it shows another object than the tracer sees there:
so neither is a wrong object excused by its colour, nor a wrong colour by an edge nearby.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..tracer import shading
from ..tracer.nearest import Hits
from .cause import difference, differing
from .identity import NOTHING, UNKNOWN

Transform = Callable[[NDArray[np.float64]], NDArray[np.float64]]  # of straight linear RGB


@dataclass(frozen=True, eq=False)
class Shown:
    """Some pixels of the other side's picture.

    Parameters
    ----------
    color : (..., 4) float32
        Linear RGBA, alpha premultiplied.
    owner : (...,) int32, optional
        Whose surface it is: an index of `Identity.names`, NOTHING or UNKNOWN.
    owners : (k + 1,) int32, optional
        Whose each instance of the traced scene is, then each plane; NOTHING at the end.
    levels : int
        Above 0 where the picture was stored in so many levels of sRGB's curve: 255 for a PNG.
    dither : float
        So many levels of noise were added.
    sums : int
        How many samples were added up in half floats; 0 for one.
    opaque : bool
        The picture has no alpha: it is not compared.
    lit : bool
        Its colours are of a light that the tracer does not have: they prove nothing.
    transform : callable, optional
        What turns traced colours into its own.
    background : (4,) float32, optional
        Its own background, linear RGBA: as it is shown, whatever the transform.
    """

    color: NDArray[np.float32]
    owner: NDArray[np.int32] | None = None
    owners: NDArray[np.int32] | None = None
    levels: int = 0
    dither: float = 0.0
    sums: int = 0
    opaque: bool = False
    lit: bool = False
    transform: Transform | None = None
    background: NDArray[np.float32] | None = None

    def at(self, where: NDArray | slice) -> Shown:
        """Return some of the pixels: rows by a slice, or those where a mask is True."""
        owner = None if self.owner is None else self.owner[where]
        return replace(self, color=self.color[where], owner=owner)

    def differ(self, scene: Scene, hits: Hits) -> NDArray[np.bool_]:
        """Return which of n hits show something else than these n pixels."""
        ramp = shading.interpolated(scene, hits.instance)
        return self.differ_from(shading.colors(scene, hits), hits.instance, ramp)

    def differ_from(
        self,
        colors: NDArray,
        instance: NDArray[np.integer],
        interpolated: NDArray[np.bool_] | bool = False,
    ) -> NDArray[np.bool_]:
        """Return which of (..., 4) traced colours of these instances (...) differ."""
        other = self.other_object(instance)
        if self.lit:
            return other | ~self.known(instance)
        return other | self.other_color(colors, interpolated)

    def other_color(
        self, colors: NDArray, interpolated: NDArray[np.bool_] | bool = False
    ) -> NDArray[np.bool_]:
        """Return where the colour is another than (..., 4) traced ones."""
        traced, own = self._sides(colors)
        return differing(traced, own, interpolated, self.levels, self.sums, self.dither)

    def difference(self, colors: NDArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return how far (..., 4) traced colours are from these, and how far they may be, (...).

        Of the channel that is nearest to being too far.
        """
        traced, own = self._sides(colors)
        apart, allowed = difference(traced, own, False, self.levels, self.sums, self.dither)
        worst = np.argmax(np.nan_to_num(apart - allowed), axis=-1)[..., None]
        return tuple(np.take_along_axis(v, worst, -1)[..., 0] for v in (apart, allowed))

    def _sides(self, colors: NDArray) -> tuple[NDArray, NDArray]:
        """Return traced colours (..., 4) and these, in the channels that are compared."""
        traced = self.made_of(colors)
        return traced, self.color[..., : traced.shape[-1]]

    def made_of(self, colors: NDArray) -> NDArray:
        """Return traced colours (..., 4) as this picture has them, (..., 3) if it is opaque."""
        return self._transformed(colors)[..., : 3 if self.opaque else 4]

    def _transformed(self, colors: NDArray) -> NDArray:
        if self.transform is None:
            return colors
        made = transformed(colors, self.transform)
        if self.background is None:
            return made
        return np.where((colors == self.background).all(axis=-1, keepdims=True), colors, made)

    def through(self, transform: Transform) -> Shown:
        """Return the same, seen as made by a transform."""
        return replace(self, transform=transform)

    def in_another_light(self) -> Shown:
        """Return the same, its colours proving nothing."""
        return replace(self, lit=True)

    def other_object(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where another object is known to be shown than that of the instances (...)."""
        if self.owner is None:
            return np.zeros(instance.shape, bool)
        return (self.owner != UNKNOWN) & (self.owner != self.owners[instance])

    def same_color(self, scene: Scene, hits: Hits) -> NDArray[np.bool_]:
        """Return which of n hits have the colour of these n pixels; of lit ones, all may."""
        if self.lit:
            return self.known(hits.instance)
        ramp = shading.interpolated(scene, hits.instance)
        return ~self.other_color(shading.colors(scene, hits), ramp)

    def known(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where it is known whose surface is shown, of the shape of `instance`."""
        return np.zeros(instance.shape, bool) if self.owner is None else self.owner != UNKNOWN

    def same_object(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where the object of the instances (...) is known to be shown."""
        if self.owner is None:
            return np.zeros(instance.shape, bool)
        return self.owner == self.owners[instance]


def transformed(colors: NDArray, transform: Transform) -> NDArray[np.float64]:
    """Return premultiplied RGBA (..., 4) with its straight RGB transformed."""
    alpha = np.asarray(colors[..., 3:], np.float64)
    return np.concatenate((transform(straight(colors)) * alpha, alpha), axis=-1)


def straight(colors: NDArray) -> NDArray[np.float64]:
    """Return the straight RGB (..., 3) of premultiplied RGBA (..., 4)."""
    colors = np.asarray(colors, np.float64)
    return colors[..., :3] / np.where(colors[..., 3:] > 0, colors[..., 3:], 1)


def numbered(names: Sequence[str], owners: Sequence[str]) -> NDArray[np.int32]:
    """Return the number in `names` of each owner, and NOTHING at the end: (k + 1,) int32.

    One that is not there gets a number of its own, which nothing shows.
    """
    number = {name: n for n, name in enumerate(names)}
    return np.array([*(number.get(o, len(names)) for o in owners), NOTHING], np.int32)
