"""Gives objects colours that tell them apart, and says whether a scene's own colours do.

An object here is what Blender gives one colour: what is instanced counts as what instances it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum, auto
from functools import cache
from itertools import permutations, product

import numpy as np

from ..arrays import Bytes, Colors, Index, Integers
from ..files.images import curve, curve_undone
from ..scene import Scene, SceneError

# Two colours of 8 bits are told apart if they are so many levels apart in a channel: rounding, a
# writer's own curve and dither together move each of them by less than two.
APART = 4
_LEVELS = 26  # of a channel of a clear colour: they lie 10 of 255 apart
# Backgrounds of films and pages, and Blender's default colour.
_TAKEN = ((0, 0, 0), (255, 255, 255), (128, 128, 128), (231, 231, 231))
MOST = 17_000  # clear colours: those of _LEVELS^3 that are farthest from what is behind


class By(StrEnum):
    """The source of a comparison's colours."""

    AUTOMATIC = auto()  # the viewport if it tells objects apart, else a colour for each object
    VIEWPORT = auto()  # as the scene's solid shading says
    OBJECT = auto()  # a clear colour for each object
    MATERIAL = auto()  # each material's base colour


Key = tuple[str, str]  # an object, and what instances it: else itself


@dataclass(frozen=True, eq=False)
class GivenColors:
    """Colours that a file gives to objects: (k, 3) linear RGB by material slot."""

    file: str
    slots: dict[Key, Colors]

    def check_known(self, names: Collection[str]) -> None:
        """Raise a SceneError if the file names an object that is not in the scene."""
        for name in dict.fromkeys(n for key in self.slots for n in key):
            if name not in names:
                raise SceneError(
                    f"'{self.file}' has a colour for '{name}', and the scene has no such object: "
                    "correct the name, or write the file anew with --colors-out"
                )

    def of(self, name: str, owner: str) -> Colors:
        """Return the colours of an object.

        Raises
        ------
        SceneError
            If it has none.
        """
        if (name, owner) not in self.slots:
            by = "" if owner == name else f", as instanced by '{owner}',"
            raise SceneError(
                f"'{self.file}' has no colour for '{name}'{by} which is in the view: add it, or "
                "write the file anew with --colors-out"
            )
        return self.slots[name, owner]


@dataclass(frozen=True)
class Palette:
    """Colours that Blender is to draw a scene in, by the full names of objects or materials."""

    by: By  # not AUTOMATIC, which is one of the others
    colors: Mapping[str, Colors] = field(default_factory=dict)  # (3,) linear RGB each
    note: str = ""  # what a user should know of it
    given: GivenColors | None = None  # the file that it is from

    def check(self, scene: Scene, owners: Sequence[str]) -> None:
        """Raise a SceneError if the file lacks the colour of an object that is in the view."""
        if self.given is None:
            return
        for number, owner in zip(scene.instance_objects, owners, strict=False):
            self.given.of(scene.objects[number], owner)


VIEWPORT = Palette(By.VIEWPORT)


def clear_palette(names: Sequence[str], note: str = "") -> Palette:
    """Return a clear colour for each object, in their order: the first ones are farthest apart.

    Raises
    ------
    SceneError
        If there are more than MOST.
    """
    if len(names) > MOST:
        raise SceneError(
            f"{len(names):,} objects are more than the {MOST:,} that clear colours tell apart: "
            "compare with the colours of the viewport"
        )
    linear = curve_undone(_clear()[: len(names)] / 255).astype(np.float32)
    return Palette(By.OBJECT, dict(zip(names, linear, strict=True)), note)


@cache
def _clear() -> Bytes:
    """Return all clear colours, (MOST, 3) sRGB of 8 bits: each is far from those before it.

    None of the first ones, some hundreds, is nearly another with its channels in another order:
    else two objects that are exchanged would look like swapped channels. What is left comes then.
    """
    steps: Integers = np.rint(np.linspace(0, 255, _LEVELS)).astype(np.int32)
    squares = (steps[:, None] - steps) ** 2  # of a level's distance to each

    def distance(at: Index) -> Integers:
        red, green, blue = squares[at]
        return red[:, None, None] + green[:, None] + blue

    behind = [distance(np.searchsorted(steps, color)) for color in _TAKEN]
    taken = np.stack(behind).min(axis=0)
    open_ = taken.copy()  # squared distance to the nearest; below 0 where none may come
    chosen = []
    while open_.flat[first := np.argmax(open_)] > 0:
        at = np.unravel_index(first, open_.shape)
        chosen.append(first)
        np.minimum(open_, distance(np.array(at)), out=open_)
        for place in permutations(at):
            open_[tuple(slice(max(k - 1, 0), k + 2) for k in place)] = -1
    farthest_first = np.argsort(-taken, axis=None, kind="stable")
    left = farthest_first[~np.isin(farthest_first, chosen)]
    order = np.unravel_index(np.append(chosen, left)[:MOST], taken.shape)
    return steps[np.stack(order, axis=1)].astype(np.uint8)


def not_told_apart(scene: Scene, owners: Sequence[str]) -> tuple[str, str] | None:
    """Return two objects in the view that have a colour in common; None if there are none.

    Parameters
    ----------
    scene : Scene
    owners : sequence of str
        The object that gives its colour to each instance, then to each plane.
    """
    colors, owner = _shown(scene, owners)
    names = tuple(dict.fromkeys(owners))
    # Two colours that are less than APART apart fall together on one of these grids.
    for offset in product((0, APART), repeat=3):
        red, green, blue = ((colors + offset) // (2 * APART)).T
        cell = (red * 64 + green) * 64 + blue
        order = np.lexsort((owner, cell))
        same = (np.diff(cell[order]) == 0) & (np.diff(owner[order]) != 0)
        if same.any():
            k = int(same.argmax())
            return names[owner[order[k]]], names[owner[order[k + 1]]]
    return None


def automatic_note(whose: str, pair: tuple[str, str]) -> str:
    """Say why objects have clear colours instead of those of the file or the viewport."""
    return (
        f"each object is shown in a clear colour of its own, as the {whose}'s colours do not tell "
        f"'{pair[0]}' from '{pair[1]}'"
    )


def _shown(scene: Scene, owners: Sequence[str]) -> tuple[Integers, Integers]:
    """Return the colours that objects show, (n, 3) sRGB of 8 bits, and the owner of each, (n,)."""
    number = {name: n for n, name in enumerate(dict.fromkeys(owners))}
    found: dict[tuple[int, int, bytes], Colors] = {}
    for instance, owner in zip(scene.instances, owners, strict=False):
        key = number[owner], instance.mesh, instance.colors.tobytes()
        if key not in found:
            found[key] = shown_colors(scene, instance.mesh, instance.colors)
    of_planes = owners[len(scene.instances) :]
    for plane, owner in zip(scene.planes, of_planes, strict=True):
        found[number[owner], -1, plane.color.tobytes()] = plane.color[None, :3]
    rows = [np.unique(eight_bits(colors), axis=0) for colors in found.values()]
    if not rows:
        return np.zeros((0, 3), np.int32), np.zeros(0, np.int32)
    of = np.array([key[0] for key in found], np.int32)
    return np.concatenate(rows).astype(np.int32), np.repeat(of, [len(r) for r in rows])


def shown_colors(scene: Scene, mesh: int, colors: Colors) -> Colors:
    """Return what an instance shows, (n, 3) linear RGB: of its colours by slot, those in use."""
    shown = scene.meshes[mesh]
    if shown.corner_colors is not None:
        return shown.corner_colors.reshape(-1, 4)[:, :3]
    used = np.minimum(np.unique(shown.slots), len(colors) - 1)
    return colors[np.unique(used), :3]


def eight_bits(linear: Colors) -> Bytes:
    """Return linear RGB as sRGB of 8 bits."""
    return np.rint(255 * curve(np.clip(linear, 0, 1))).astype(np.uint8)
