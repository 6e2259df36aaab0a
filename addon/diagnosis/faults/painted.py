"""Guesses that several objects have other colours: one another's, another slot's, or others."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ...arrays import Array, Colors, Floats, Places
from ...causes.case import Case
from ...pictures.curves import FITTED_SHARE
from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.progress import at_once
from ...wording import listed
from ..evidence import NEAR, Evidence
from .fault import Key, Numbers, Values, keys_of
from .processed import shades_apart
from .surfaces import Surfaces, surfaces
from .suspects import seen_instances

NAMED = 4  # objects


def of_one_color(case: Case, frame: Frame) -> list[int]:
    """Return the visible instances without corner colours, those with the most pixels first."""
    scene = case.scene
    meshes = {n: scene.meshes[scene.instances[n].mesh] for n in seen_instances(case, frame)}
    return [n for n, mesh in meshes.items() if mesh.corner_colors is None]


@dataclass(frozen=True, eq=False)
class Painted(Numbers):
    """Objects in other colours."""

    colors: Mapping[Key, Colors] = field(default_factory=dict)  # by material slot, (k, 4)


def painted_case(case: Case, guess: Painted) -> Case:
    """Return the case with objects in other colours."""

    def painted(scene: Scene) -> Scene:
        keys, count = keys_of(scene), len(scene.instances)
        of, others = guess.colors, zip(keys_of(scene)[count:], scene.planes, strict=True)
        instances = zip(keys[:count], scene.instances, strict=True)
        return replace(
            scene,
            instances=tuple(replace(i, colors=of.get(k, i.colors)) for k, i in instances),
            planes=tuple(replace(p, color=of.get(k, p.color[None])[0]) for k, p in others),
        )

    return case.with_scenes(painted)


def with_table(scene: Scene, table: Array, words: str, numbers: Values = ()) -> Painted:
    """Guess the colours of a table, one for each row of the scene's `color_table`."""
    first, last = scene.color_rows
    rows = zip(keys_of(scene), first, last, strict=False)
    colors = {key: table[a : b + 1].astype(np.float32) for key, a, b in rows}
    return Painted(numbers, numbers, numbers, colors, words=words)


def _swapped(scene: Scene, first: int, second: int) -> Painted:
    """Guess two instances in each other's colours."""
    keys, instances = keys_of(scene), scene.instances
    colors = {keys[first]: instances[second].colors, keys[second]: instances[first].colors}
    return Painted(colors=colors)


def two_colors(case: Case, frame: Frame) -> Painted | None:
    """Pick the largest object, and another one of another colour."""
    scene = case.scene
    first, *others = of_one_color(case, frame) or [0]
    for other in others:
        if not np.array_equal(scene.instances[first].colors, scene.instances[other].colors):
            return _swapped(scene, first, other)
    return None


def _repainted(
    scene: Scene, found: Surfaces, colors: Floats, words: str, numbers: Values = ()
) -> Painted:
    """Guess k surfaces in other colours, (k, 4)."""
    table = scene.color_table.copy()
    for (first, last), own, color in zip(
        scene.color_rows.T[found.instance], found.traced, colors, strict=True
    ):
        rows = scene.color_table[first : last + 1]
        table[first : last + 1][(rows == own).all(axis=1)] = color
    return with_table(scene, table, words, numbers)


@at_once
def exchanged(evidence: Evidence) -> list[Painted]:
    """Guess that objects have one another's colours, if all that are wrong show these."""
    found = _colors(evidence)
    scene = evidence.case.scene
    if found is None:
        return []
    found = found.take(found.wrong & (found.alike > FITTED_SHARE))
    names = found.names(scene)
    if len(set(names)) < 2:  # those of one object's material slots are another fault
        return []
    apart = np.abs(found.shown[:, None, :3] - found.traced[None, :, :3]).max(axis=-1)
    other = apart.argmin(axis=1)
    if apart.min(axis=1).max() > NEAR or len(set(other)) < len(other):
        return []
    pairs = [f"'{a}' that of '{names[b]}'" for a, b in zip(names, other, strict=True)]
    return [_repainted(scene, found, found.traced[other], listed(pairs, NAMED))]


def _colors(evidence: Evidence) -> Surfaces | None:
    """Return the colours that are seen; None where they are interpolated."""
    mixed = any(mesh.corner_colors is not None for mesh in evidence.case.scene.meshes)
    return None if mixed else surfaces(evidence, whole=True)


# Which material slot's colour a face of slot k of n is shown in, by mistake.
_SLOTS: tuple[tuple[str, Callable[[Places, int], Places]], ...] = (
    ("that of the first material slot, for all faces", lambda k, n: 0 * k),
    ("that of the last material slot, for all faces", lambda k, n: 0 * k + n - 1),
    ("that of the next material slot", lambda k, n: (k + 1) % n),
    ("that of the next material slot", lambda k, n: np.minimum(k + 1, n - 1)),
    ("that of the material slot before", lambda k, n: (k - 1) % n),
    ("that of the material slot before", lambda k, n: np.maximum(k - 1, 0)),
)


@at_once
def other_source(evidence: Evidence) -> list[Painted]:
    """Guess other material slots, and the colours that are shown where nearly all are others."""
    scene = evidence.case.scene
    found = _colors(evidence)
    first, last = scene.color_rows
    out = []
    for words, slot in _SLOTS if (first < last).any() else ():
        each = zip(first, last - first + 1, strict=True)
        rows = np.concatenate([start + slot(np.arange(n), n) for start, n in each])
        out.append(with_table(scene, scene.color_table[rows], words=words))
    if found is None or not found.nearly_all_wrong:
        return out
    if np.average(found.alike, weights=found.pixels) < FITTED_SHARE:
        return out
    if np.abs(found.shown - scene.background).max() <= NEAR:
        return out  # no surface is shown
    if shades_apart(found.traced, found.shown) is not None:
        return out  # these are the same, processed
    colors = found.shown[:, :3]
    some = zip(found.names(scene)[:NAMED], colors, strict=False)
    named = ", ".join("'{}' in ({:.3f}, {:.3f}, {:.3f})".format(name, *rgb) for name, rgb in some)
    numbers = tuple(colors.ravel().tolist())
    return [*out, _repainted(scene, found, found.shown, f"{named}, linear", numbers)]
