"""Guesses that several objects have other colours: one another's, another slot's, or others."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Bools, Colors, Floats, Places
from ...causes.case import Case
from ...causes.checks.color import medians
from ...pictures.curves import FITTED_SHARE
from ...pictures.picture import MAJORITY
from ...scene import Scene
from ...tracer import shading
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import at_once
from ..evidence import NEAR, Evidence
from .fault import Key, Numbers, keys_of
from .processed import shades_apart
from .suspects import seen_instances

ALL = 0.8  # of the colours, at least, that are others where all come from another source
SEVERAL = 3  # colours, at least
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


def with_table(scene: Scene, table: Array, *numbers: float, words: str) -> Painted:
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


class Shown(NamedTuple):
    """The k colours of the scene that are seen, and what is shown in their place."""

    rows: Places  # (k,) of `color_table`, those with the most pixels first
    colors: Floats  # (k, 4) the median of what is shown
    wrong: Bools  # (k,) most of their pixels are unexplained
    alike: Floats  # (k,) the share of their pixels that show that median
    pixels: Places  # (k,) how many there are

    def names(self, scene: Scene) -> list[str]:
        """Return the objects that have them."""
        instance = np.searchsorted(scene.color_rows[1], self.rows)
        return [scene.objects[n] for n in scene.instance_objects[instance]]


def shown_colors(evidence: Evidence) -> Shown | None:
    """Return the colours that are seen (cached); None where the picture says nothing of them."""
    if "colors" not in evidence.known:
        evidence.known["colors"] = _looked_at(evidence)
    found: Shown | None = evidence.known["colors"]
    return found


def _looked_at(evidence: Evidence) -> Shown | None:
    picture, frame, scene = evidence.picture, evidence.frame, evidence.case.scene
    seen = (evidence.unexplained | evidence.judged) & (frame.instance_index != NOTHING)
    unknown = picture.transform is not None or picture.lit or not picture.has_colors
    mixed = any(mesh.corner_colors is not None for mesh in scene.meshes)
    if unknown or mixed or not seen.any():
        return None
    numbers = np.repeat(np.arange(len(scene.color_table))[:, None], 4, axis=1)
    numbered = painted_case(evidence.case, with_table(scene, numbers, words="")).scene
    row = shading.colors(numbered, frame.hits())[:, 0].reshape(seen.shape)[seen].astype(np.intp)
    rows, group, count = np.unique(row, return_inverse=True, return_counts=True)
    shown = picture.color[seen]
    _, middle = medians(shown, group)
    flat = replace(picture.at(seen), color=middle[group].astype(np.float32), owners=None)
    alike = np.bincount(group, ~flat.other_color(shown)) / count
    wrong = np.bincount(group, evidence.unexplained[seen]) > MAJORITY * count
    order = np.argsort(-count, kind="stable")
    return Shown(rows[order], middle[order], wrong[order], alike[order], count[order])


@at_once
def exchanged(evidence: Evidence) -> list[Painted]:
    """Guess that objects have one another's colours, if all that are wrong show these."""
    shown, scene = shown_colors(evidence), evidence.case.scene
    if shown is None:
        return []
    wrong = np.flatnonzero(shown.wrong & (shown.alike > FITTED_SHARE))
    names = [shown.names(scene)[n] for n in wrong]
    if len(set(names)) < 2:  # those of one object's material slots are another fault
        return []
    own = scene.color_table[shown.rows[wrong]]
    apart = np.abs(shown.colors[wrong][:, None, :3] - own[None, :, :3]).max(axis=-1)
    other = apart.argmin(axis=1)
    if apart.min(axis=1).max() > NEAR or len(set(other)) < len(other):
        return []
    table = scene.color_table.copy()
    table[shown.rows[wrong]] = own[other]
    pairs = [f"'{a}' that of '{names[b]}'" for a, b in zip(names, other, strict=True)]
    more = f", and {len(pairs) - NAMED} more" if len(pairs) > NAMED else ""
    return [with_table(scene, table, words=", ".join(pairs[:NAMED]) + more)]


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
    scene, shown = evidence.case.scene, shown_colors(evidence)
    first, last = scene.color_rows
    out = []
    for words, slot in _SLOTS if (first < last).any() else ():
        each = zip(first, last - first + 1, strict=True)
        rows = np.concatenate([start + slot(np.arange(n), n) for start, n in each])
        out.append(with_table(scene, scene.color_table[rows], words=words))
    if shown is None or len(shown.rows) < SEVERAL or shown.wrong.mean() < ALL:
        return out
    if np.average(shown.alike, weights=shown.pixels) < FITTED_SHARE:
        return out
    if np.abs(shown.colors - scene.background).max() <= NEAR:
        return out  # no surface is shown
    if shades_apart(scene.color_table[shown.rows], shown.colors) is not None:
        return out  # these are the same, processed
    table = scene.color_table.copy()
    table[shown.rows] = shown.colors
    some = zip(shown.names(scene)[:NAMED], shown.colors[:, :3], strict=False)
    named = ", ".join("'{}' in ({:.3f}, {:.3f}, {:.3f})".format(name, *rgb) for name, rgb in some)
    numbers = shown.colors[:, :3].ravel().tolist()
    return [*out, with_table(scene, table, *numbers, words=f"{named}, linear")]
