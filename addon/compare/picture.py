"""The other side's picture: its pixels, whose surfaces they show, and how it was sampled.

A pixel differs where its colour does, or where it shows another object than the tracer sees there:
so neither is a wrong object excused by its colour, nor a wrong colour by an edge nearby.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..runs import by_runs
from ..scene import Scene
from ..tracer import shading
from ..tracer.nearest import Hits
from .bounds import SNAPPING, difference, differing
from .identity import NOTHING, UNKNOWN

Transform = Callable[[NDArray[np.float64]], NDArray[np.float64]]  # of straight linear RGB
MAJORITY = 0.5  # the share of what a known curve changes that it must make agree


class SizeError(ValueError):
    """The pictures differ in size."""


class Curve(NamedTuple):
    """A transform of colours with a name, and the share of pixels that it must account for."""

    name: str
    of: Transform
    share: float = MAJORITY


@dataclass(frozen=True)
class Source:
    """Who made the picture: one of Blender's engines, or anybody (`version` None, `file` named)."""

    name: str = "picture"
    version: str | None = None
    file: str = ""
    settings: dict[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"the picture '{self.file}'" if self.file else f"Blender's {self.name} picture"


@dataclass(frozen=True, eq=False)
class Picture:
    """The pixels (...) of the other side's picture, or some of them."""

    color: NDArray[np.float32]  # (..., 4) linear RGBA, alpha premultiplied
    source: Source = Source()
    owner: NDArray[np.int32] | None = None  # (...) whose surface: of `names`, NOTHING or UNKNOWN
    # (k + 1,) whose each instance of the traced scene is, then each plane; NOTHING at the end.
    owners: NDArray[np.int32] | None = None
    names: tuple[str, ...] = ()  # of the objects that may be shown
    sample_radius: float = 0.0  # pixels: how far from a pixel's centre it is sampled on purpose
    # Pixels: how far the filter reaches that mixes several samples of a pixel; 0 for one sample.
    filter_radius: float = 0.0
    levels: int = 0  # above 0 of sRGB's curve, in so many of which it was stored: 255 for a PNG
    dither: float = 0.0  # so many levels of noise were added
    sums: int = 0  # how many samples were added up in half floats; 0 for one
    opaque: bool = False  # the picture has no alpha: it is not compared
    lit: bool = False  # by a light that the tracer does not have: colours prove nothing
    transform: Transform | None = None  # what turns traced colours into its own
    background: NDArray[np.float32] | None = None  # (4,) its own, linear RGBA, not transformed
    snapping: float = SNAPPING  # pixels: to what its rasteriser rounds the corners of triangles
    # (k + 1,) as `owners`, False at the end: whose colours the tracer does not know,
    colorless: NDArray[np.bool_] | None = None
    holes: NDArray[np.bool_] | None = None  # and what is shown as if nothing were there.
    # (...) the number of the unmodelled feature that draws itself over what is traced, or NOTHING;
    drawn: NDArray[np.int32] | None = None
    beneath: NDArray[np.float32] | None = None  # (..., 4) its colour without these; NaN: not known

    def to_dict(self) -> dict[str, Any]:
        """Return who made it and how, as JSON can hold it."""
        source = self.source
        return {
            "version": source.version,
            "source": source.name,
            **({"picture": source.file} if source.file else {}),
            "sample_radius": self.sample_radius,
            "snapping": self.snapping,
            "filter_radius": self.filter_radius,
            "settings": source.settings,
        }

    def at(self, where: NDArray | slice | tuple[NDArray, ...]) -> Picture:
        """Return some of the pixels: rows by a slice, those of a mask, or by their indices."""
        of_pixels = {name: getattr(self, name) for name in ("owner", "drawn", "beneath")}
        some = {name: None if v is None else v[where] for name, v in of_pixels.items()}
        return replace(self, color=self.color[where], **some)

    def differ(self, scene: Scene, hits: Hits) -> NDArray[np.bool_]:
        """Return which of n hits show something else than these n pixels."""
        return self.other_object(hits.instance) | ~self.same_color(scene, hits)

    def other_color(
        self, colors: NDArray, interpolated: NDArray[np.bool_] | bool = False
    ) -> NDArray[np.bool_]:
        """Return where the colour is another than (..., 4) traced ones."""
        shape, count = colors.shape[:-1], colors.shape[-1]
        flat = colors.reshape(-1, count), self.color.reshape(-1, self.color.shape[-1])

        def differ(traced: NDArray, own: NDArray, between: NDArray) -> NDArray[np.bool_]:
            return differing(
                *self._sides(traced, own), between, self.levels, self.sums, self.dither
            )

        between = np.broadcast_to(interpolated, shape).ravel()
        return by_runs(differ, *flat, between).reshape(shape)

    def difference(self, colors: NDArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return how far (..., 4) traced colours are from these, and how far they may be, (...).

        Of the channel that is nearest to being too far.
        """
        traced, own = self._sides(colors, self.color)
        apart, allowed = difference(traced, own, False, self.levels, self.sums, self.dither)
        worst = np.argmax(np.nan_to_num(apart - allowed), axis=-1)[..., None]
        return tuple(np.take_along_axis(v, worst, -1)[..., 0] for v in (apart, allowed))

    def _sides(self, colors: NDArray, own: NDArray) -> tuple[NDArray, NDArray]:
        """Return traced colours (..., 4) and those of pixels, in the channels that are compared."""
        traced = self.made_of(colors)
        return traced, own[..., : traced.shape[-1]]

    def made_of(self, colors: NDArray) -> NDArray:
        """Return traced colours (..., 4) as this picture has them, (..., 3) if it is opaque."""
        made = colors
        if self.transform is not None:
            alpha = np.asarray(colors[..., 3:], np.float64)
            made = np.concatenate((self.transform(straight(colors)) * alpha, alpha), axis=-1)
            if self.background is not None:
                own = (colors == self.background).all(axis=-1, keepdims=True)
                made = np.where(own, colors, made)
        return made[..., : 3 if self.opaque else 4]

    def other_object(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where another object is known to be shown than that of the instances (...)."""
        return self.known(instance) & ~self.same_object(instance)

    def same_color(self, scene: Scene, hits: Hits) -> NDArray[np.bool_]:
        """Return which of n hits have the colour of these n pixels.

        Of lit ones, and of surfaces whose colour nobody knows, all may.
        """
        if self.lit:
            return self.known(hits.instance)
        return self.alike(scene, hits.instance, shading.colors(scene, hits))

    def alike(self, scene: Scene, instance: NDArray, colors: NDArray) -> NDArray[np.bool_]:
        """Return where these pixels may be (..., 4) colours that instances (...) are traced in."""
        if self.holes is not None:
            colors = np.where(self.holes[instance][..., None], np.float32(0), colors)
        same = ~self.other_color(colors, shading.interpolated(scene, instance))
        return same if self.colorless is None else same | self.colorless[instance]

    def known(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where it is known whose surface is shown, of the shape of `instance`."""
        return np.zeros(instance.shape, bool) if self.owner is None else self.owner != UNKNOWN

    def same_object(self, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return where the object of the instances (...) is known to be shown."""
        if self.owner is None:
            return np.zeros(instance.shape, bool)
        return self.owner == self.owners[instance]


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
