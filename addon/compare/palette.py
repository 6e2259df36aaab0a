"""Gives objects colours that tell them apart, and says whether a scene's own colours do.

An object here is what Blender gives one colour: what is instanced counts as what instances it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum, auto
from functools import lru_cache
from itertools import product

import numpy as np

from ..arrays import Bytes, Colors, Integers
from ..images import curve, curve_undone
from ..scene import Scene, SceneError

# Two colours of 8 bits are told apart if they are so many levels apart in a channel: rounding, a
# writer's own curve and dither together move each of them by less than two.
APART = 4
_LEVELS = 26  # of a channel of a clear colour: they lie 10 of 255 apart
_TAKEN = ((0, 0, 0), (255, 255, 255))  # what pages and films have behind a scene
MOST = _LEVELS**3 - len(_TAKEN)  # clear colours that there are


class By(StrEnum):
    """Where the colours of a comparison come from."""

    AUTOMATIC = auto()  # the viewport if it tells objects apart, else a colour for each object
    VIEWPORT = auto()  # as the scene's solid shading says
    OBJECT = auto()  # a clear colour for each object
    MATERIAL = auto()  # each material's base colour


@dataclass(frozen=True)
class Palette:
    """Colours that Blender is to draw a scene in, by the full names of objects or materials."""

    by: By  # not AUTOMATIC, which is one of the others
    colors: Mapping[str, Colors] = field(default_factory=dict)  # (3,) linear RGB each
    note: str = ""  # what a user should know of it


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
    linear = curve_undone(_clear(len(names)) / 255).astype(np.float32)
    return Palette(By.OBJECT, dict(zip(names, linear, strict=True)), note)


@lru_cache(maxsize=4)
def _clear(count: int) -> Bytes:
    """Return colours (count, 3), sRGB of 8 bits, each as far as can be from those before it.

    The first ones are the same whatever the count.
    """
    steps = np.rint(np.linspace(0, 255, _LEVELS)).astype(np.int32)
    lattice = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), -1).reshape(-1, 3)
    nearest = np.full(len(lattice), 3 * 256**2, np.int32)
    out = np.empty((count, 3), np.uint8)

    def take(color: Integers) -> None:
        np.minimum(nearest, ((lattice - color) ** 2).sum(axis=1, dtype=np.int32), out=nearest)

    for taken in _TAKEN:
        take(np.array(taken, np.int32))
    for row in out:
        row[:] = lattice[np.argmax(nearest)]
        take(row.astype(np.int32))
    return out


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


def _shown(scene: Scene, owners: Sequence[str]) -> tuple[Integers, Integers]:
    """Return the colours that objects show, (n, 3) sRGB of 8 bits, and whose each one is, (n,)."""
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
