"""The other side's picture: its pixels, which objects they show, and how it was sampled.

A pixel differs if its colour does, or if it shows another object than the tracer sees there. Each
is looked at by itself: the right colour excuses no wrong object, an edge nearby no wrong colour.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple, Self, TypeVar

import numpy as np

from ..arrays import Array, Bools, Colors, Floats, Index, Where
from ..scene import Scene
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.hits import Hits
from .drawn_over import DrawnOver, some
from .identity import Identity, Owners
from .metrics import Metrics
from .sampling import AT_CENTRES, Sampling
from .source import ANYBODY, Source, check_size
from .storage import FLOATS, Storage, difference, differing

F = TypeVar("F")  # a fault
Transform = Callable[[Floats], Floats]  # of straight linear RGB
MAJORITY = 0.5  # the share of what a known curve changes that it must make agree


class Curve(NamedTuple):
    """A transform of colours with a name, and the share of pixels that it must account for."""

    name: str
    of: Transform
    share: float = MAJORITY
    key: str = "view_transform"  # the name of its fault, in `faults/`


@dataclass(frozen=True, eq=False)
class Picture:
    """The pixels (...) of the other side's picture, or some of them.

    This one has colours; `packages/data` has the other, of depths and so on.
    """

    color: Colors  # (..., 4) linear RGBA, alpha premultiplied
    source: Source = ANYBODY
    owners: Owners | None = None  # of each pixel, if that is known of any
    sampling: Sampling = AT_CENTRES
    storage: Storage = FLOATS
    lit: bool = False  # by a light that the tracer does not have: colours prove nothing
    transform: Transform | None = None  # turns traced colours into the picture's
    background: Colors | None = None  # (4,) its own, linear RGBA, not transformed
    # Both (k + 1,): of each instance of the traced scene, then of each plane; last False.
    colorless: Bools | None = None  # the tracer does not know the instance's colours
    holes: Bools | None = None  # the instance is shown as if nothing were there
    drawn: DrawnOver | None = None  # what draws itself, if anything does
    has_colors: ClassVar[bool] = True  # else these are only to look at

    def to_dict(self) -> dict[str, object]:
        """Return who made it and how, as JSON can hold it."""
        source = self.source
        out: dict[str, object] = {
            "version": source.version,
            "source": source.name,
            **self.sampling.to_dict(),
            "settings": source.settings,
        }
        if source.file:
            out["picture"] = source.file
        if source.known:
            out["renderer_known"] = source.known
        return out

    def check(self, shape: tuple[int, ...]) -> None:
        """Refuse a picture that cannot be compared with a traced one of a shape (h, w, 4).

        Raises
        ------
        SizeError
            If it has another shape.
        SceneError
            If its samples lie so far from the pixels' centres that nothing could be decided.
        """
        check_size(self.color.shape, shape)
        self.sampling.check(self.source)

    def at(self, where: Where) -> Self:
        """Return some of the pixels: rows by a slice, those of a mask, or by their indices."""
        return replace(
            self,
            color=self.color[where],
            owners=self.owners and self.owners.at(where),
            drawn=self.drawn and self.drawn.at(where),
        )

    def moved(self, where: Where) -> Picture:
        """Return the picture (h, w) with its pixels in other places, those of `where`."""
        return self.at(where)

    def shows(self, frame: Frame, rows: slice = slice(None)) -> Bools:
        """Return which of these pixels, some rows, may show what a frame has there, (k, w)."""
        return self.alike(frame.scene, frame.instance_index[rows], frame.color[rows])

    def sees_apart(self, first: Frame, second: Frame) -> Bools:
        """Return where two frames (h, w) have something else to show in such a picture."""
        return (first.color != second.color).any(axis=-1)

    def holds_as(self, other: Picture) -> bool:
        """Return whether another picture holds the same pixels."""
        return self.color is other.color

    def measured_with(self, frame: Frame) -> tuple[Colors, Array, Array]:
        """Return a frame's colours, and the colours of both sides that are measured.

        An opaque picture says nothing of alpha.
        """
        channels = slice(3 if self.storage.opaque else 4)
        return frame.color, frame.color[..., channels], self.color[..., channels]

    def as_shown(self, frame: Frame) -> Colors:
        """Return what such a picture of a frame would look like, (h, w, 4)."""
        color = frame.color.copy()
        made = self.made_of(color)  # by a transform, if that is the fault
        color[..., : made.shape[-1]] = made
        return color

    def measured(self, metrics: Metrics) -> str:
        """Say how large the error is; empty where it has no size."""
        psnr = f"{metrics.psnr:.1f} dB" if metrics.rmse else "infinite"
        return f"RMSE {metrics.rmse:.3g}, PSNR {psnr}, SSIM {metrics.ssim:.6f}"

    @property
    def presumed(self) -> str:
        """What of it is taken to be so, as nobody says it; empty if nothing is."""
        return ""

    def silent(self, frame: Frame) -> str:
        """Say why such a picture says nothing of what is wrong; empty if it does."""
        return ""

    def faults_of(self, known: Sequence[F]) -> Sequence[F]:
        """Return the faults that are looked for in it, of all that are known of colours."""
        return known

    def of_instances(self, some_of: Bools) -> Picture:
        """Return the picture with its owners for some of the scene's instances and planes only."""
        owners = self.owners
        return replace(
            self,
            owners=owners and replace(owners, instances=owners.instances[some_of]),
            colorless=some(self.colorless, some_of),
            holes=some(self.holes, some_of),
        )

    def differ(self, scene: Scene, hits: Hits) -> Bools:
        """Return which of n hits show something else than these n pixels."""
        return self.other_object(hits.instance) | ~self.same_color(scene, hits)

    def other_color(self, colors: Array, interpolated: Bools | bool = False) -> Bools:
        """Return where the colour is another than (..., 4) traced ones."""
        return differing(*self._sides(colors), interpolated, self.storage)

    def difference(self, colors: Array) -> tuple[Floats, Floats]:
        """Return how far (..., 4) traced colours are from these, and how far they may be, (...).

        Both are of the channel in which a pixel is nearest to differing, or differs most.
        """
        traced, own = self._sides(colors)
        apart, allowed = difference(traced, own, stored=self.storage)
        worst = np.argmax(np.nan_to_num(apart - allowed), axis=-1)[..., None]
        apart, allowed = (np.take_along_axis(v, worst, -1)[..., 0] for v in (apart, allowed))
        return apart, allowed

    def _sides(self, colors: Array) -> tuple[Array, Array]:
        """Return traced colours (..., 4) and the own ones, in the channels that are compared."""
        traced = self.made_of(colors)
        return traced, self.color[..., : traced.shape[-1]]

    def made_of(self, colors: Array) -> Array:
        """Return traced colours (..., 4) as this picture has them, (..., 3) if it is opaque."""
        made = colors
        if self.transform is not None:
            alpha = np.asarray(colors[..., 3:], np.float64)
            made = np.concatenate((self.transform(straight(colors)) * alpha, alpha), axis=-1)
            if self.background is not None:
                own = (colors == self.background).all(axis=-1, keepdims=True)
                made = np.where(own, colors, made)
        return made[..., : 3 if self.storage.opaque else 4]

    def other_object(self, instance: Index) -> Bools:
        """Return where another object is known to be shown than that of the instances (...)."""
        return self.known(instance) & ~self.same_object(instance)

    def same_color(self, scene: Scene, hits: Hits) -> Bools:
        """Return which of n hits may have the colour of these n pixels.

        In a lit picture any colour may be right, and so may be that of a colourless surface.
        """
        if self.lit:
            return self.known(hits.instance)
        return self.alike(scene, hits.instance, shading.colors(scene, hits))

    def alike(self, scene: Scene, instance: Array, colors: Array) -> Bools:
        """Return where these pixels may be (..., 4) colours that instances (...) are traced in."""
        if self.holes is not None:
            colors = np.where(self.holes[instance][..., None], np.float32(0), colors)
        same = ~self.other_color(colors, shading.interpolated(scene, instance))
        return same if self.colorless is None else same | self.colorless[instance]

    def known(self, instance: Index) -> Bools:
        """Return where it is known which object is shown, in the shape of `instance`."""
        return self.owners.known if self.owners else np.zeros(instance.shape, bool)

    def identity(self, instance: Index) -> Identity | None:
        """Return which object each side shows, where instances (...) are traced, if it is known."""
        return self.owners.identity(instance) if self.owners else None

    def same_object(self, instance: Index) -> Bools:
        """Return where the object of the instances (...) is known to be shown."""
        return self.owners.same(instance) if self.owners else np.zeros(instance.shape, bool)


def straight(colors: Array) -> Floats:
    """Return the straight RGB (..., 3) of premultiplied RGBA (..., 4)."""
    colors = np.asarray(colors, np.float64)
    return colors[..., :3] / np.where(colors[..., 3:] > 0, colors[..., 3:], 1)
