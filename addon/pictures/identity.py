"""Tells which object each pixel shows on both sides, by colours that stand for numbers.

A picture in which every object has a colour of its own says which object Blender shows. A number
becomes three digits of LEVELS, one a channel, with an even sum. Half floats and steps of 1/255 are
far smaller than a digit's step, so a renderer does not change a digit. A mix of two colours mostly
falls between digits, or has an odd sum: then the object is not known.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..arrays import Bools, Colors, Floats, Index, Integers, Where, by_runs
from ..scene import Scene

NOTHING, UNKNOWN = -1, -2

LEVELS = 32  # of a channel: a step is 8 of 255
MOST_OBJECTS = LEVELS**3 // 2  # that can be distinguished
_OFF = 0.1  # how far a channel may lie from its digit, in steps (half of 1/255 is 0.06)


class Shows(NamedTuple):
    """How many pixels show the traced object, another one, or an unknown one."""

    same_object: int
    other_object: int
    not_known: int


class Identity(NamedTuple):
    """The object that each side shows."""

    names: tuple[str, ...]
    traced: Integers  # (h, w) indices into `names`, or NOTHING
    shown: Integers  # (h, w) indices into `names`, NOTHING or UNKNOWN

    def shows(self, where: Bools | bool = True) -> Shows:
        """Count the pixels, or some, that show the same object, another, or one not known."""
        unknown = self.shown == UNKNOWN
        same = self.shown == self.traced
        other = ~same & ~unknown
        return Shows(
            same_object=int((same & where).sum()),
            other_object=int((other & where).sum()),
            not_known=int((unknown & where).sum()),
        )

    def to_dict(self) -> dict[str, object]:
        """Return the names and the counts; the pictures are arrays."""
        return {"names": list(self.names), "pixels": self.shows()._asdict()}


@dataclass(frozen=True, eq=False)
class Owners:
    """The object that a picture shows in each pixel, and that of each traced instance.

    What is instanced belongs to the object that instances it.
    """

    names: tuple[str, ...]  # of the objects that may be shown
    pixels: Integers  # (...) indices into `names`, NOTHING or UNKNOWN
    # (k + 1,) of each instance, then of each plane, and NOTHING; len(names) for none of the names.
    instances: Integers

    @classmethod
    def of(cls, names: Sequence[str], pixels: Integers, owners: Sequence[str]) -> Owners:
        """Return the owners of pixels, and of k instances and planes by their owners' names."""
        number = {name: n for n, name in enumerate(names)}
        numbers = [*(number.get(owner, len(names)) for owner in owners), NOTHING]
        return cls(tuple(names), pixels, np.array(numbers, np.int32))

    @property
    def known(self) -> Bools:
        """The pixels with a known object, (...)."""
        return self.pixels != UNKNOWN

    def same(self, instance: Index) -> Bools:
        """Return where the object of the instances (...) is known to be shown."""
        return self.pixels == self.instances[instance]

    def at(self, where: Where) -> Owners:
        """Return some of the pixels."""
        return replace(self, pixels=self.pixels[where])

    def identity(self, instance: Index) -> Identity:
        """Return which object each side shows, where the instances (...) are traced."""
        return Identity(self.names, self.instances[instance], self.pixels)

    def in_scene(self, scene: Scene, own: Scene) -> Owners:
        """Return these owners as they are in another scene, matching objects by name.

        No pixel is known to show an object that has several owners in its own scene: which of them
        an instance of the other has is not known.
        """
        objects = own.instance_objects
        if np.array_equal(scene.instance_objects, objects) and scene.objects == own.objects:
            return self
        owners = zip(objects[:-1].tolist(), self.instances.tolist(), strict=False)
        pairs = {(own.objects[n], owner) for n, owner in owners}
        several = Counter(name for name, _ in pairs)
        none = len(self.names)
        number = {name: n for n, name in enumerate(self.names)}
        number |= {name: n if several[name] == 1 else none for name, n in pairs}
        numbers = [number.get(scene.objects[n], none) for n in scene.instance_objects[:-1]]
        return replace(self, instances=np.array([*numbers, NOTHING], np.int32))


def colors_of(count: int) -> Colors:
    """Return the colours that stand for the numbers 0 to count - 1, (count, 3) linear RGB.

    Raises
    ------
    ValueError
        If there are more than MOST_OBJECTS.
    """
    if count > MOST_OBJECTS:
        raise ValueError(
            f"{count} objects are more than the {MOST_OBJECTS} that colours tell apart"
        )
    number = np.arange(count)
    red, green = number // (LEVELS // 2) // LEVELS, number // (LEVELS // 2) % LEVELS
    blue = 2 * (number % (LEVELS // 2)) + (red + green) % 2
    return (np.stack((red, green, blue), axis=-1) / (LEVELS - 1)).astype(np.float32)


def decode(picture: Floats, count: int) -> Integers:
    """Return the numbers (h, w) that a picture's colours stand for.

    The picture is (h, w, 4), linear RGBA, premultiplied. A pixel is NOTHING where it is
    transparent, and UNKNOWN where it has none of the first `count` colours.
    """
    flat = picture.reshape(-1, picture.shape[-1])
    return by_runs(lambda some: _decode(some, count), flat).reshape(picture.shape[:-1])


def _decode(colors: Floats, count: int) -> Integers:
    with np.errstate(invalid="ignore"):
        scaled = np.nan_to_num(colors[..., :3].astype(np.float64), nan=0.5) * (LEVELS - 1)
        digits = np.rint(np.clip(scaled, 0, LEVELS - 1)).astype(np.int32)
        sure = (np.abs(scaled - digits) <= _OFF).all(axis=-1)
        red, green, blue = np.moveaxis(digits, -1, 0)
        sure &= ((red + green + blue) % 2 == 0) & (np.abs(colors[..., 3] - 1) <= 1 / 255)
        number = (red * LEVELS + green) * (LEVELS // 2) + blue // 2
        found = np.where(sure & (number < count), number, UNKNOWN)
        # A window lets a little of the neighbour through beside an edge.
        return np.where(colors[..., 3] <= 1 / 255, NOTHING, found).astype(np.int32)
