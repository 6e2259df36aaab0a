"""Faults of objects' colours."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...scene import Instance, Scene
from ...tracer.frame import Frame
from ...tracer.progress import Work, at_once
from ..evidence import Evidence
from .climbing import values_of
from .fault import (
    AnyFault,
    Example,
    Fault,
    Numbers,
    Pair,
    Pick,
    instances_named,
    of_object,
    with_instances,
)
from .suspects import seen_instances


def _of_one_color(case: Case, frame: Frame) -> list[int]:
    """Return the visible instances without corner colours, those with the most pixels first."""
    scene = case.scene
    meshes = {n: scene.meshes[scene.instances[n].mesh] for n in seen_instances(case, frame)}
    return [n for n, mesh in meshes.items() if mesh.corner_colors is None]


def _in_colors(instance: Instance, colors: Array) -> Instance:
    return replace(instance, colors=colors)


def _in_color(instance: Instance, *rgb: float) -> Instance:
    """Give an instance one colour, linear RGB."""
    return _in_colors(instance, np.array([[*rgb, 1.0]], np.float32))


def _recolored(change: Callable[[Array], Array]) -> Pick:
    """Return a function that picks the largest object with one colour, and changes that."""

    def pick(case: Case, frame: Frame) -> Numbers | None:
        for number in _of_one_color(case, frame):
            instance = case.scene.instances[number]
            other = change(instance.colors[:1])[0, :3]
            if len(instance.colors) == 1 and not np.allclose(other, instance.colors[0, :3]):
                name = case.scene.objects[instance.object]
                return Numbers(values_of(other), object=name)
        return None

    return pick


def _shown_color(evidence: Evidence) -> Work[list[Numbers]]:
    """Guess, for each suspect, the median colour in which it is shown."""
    out = []
    scene, picture = evidence.case.scene, evidence.picture
    for name in evidence.suspects:
        own = np.isin(evidence.frame.instance_index, instances_named(scene, name))
        where = own & evidence.unexplained
        if 2 * where.sum() > own.sum() and picture.transform is None:
            color = np.median(picture.color[where], axis=0)
            if np.isfinite(color).all() and color[3] > 0:
                values = values_of(color[:3])
                out.append(Numbers(values, values, values, object=name))
        yield 0.0
    return out


def _colors_of(scene: Scene, names: Iterable[str]) -> list[Array]:
    """Return the colours of the first instance of each object that has any."""
    found = (instances_named(scene, name)[:1] for name in names)
    return [scene.instances[n].colors for some in found for n in some]


def _swapped(case: Case, guess: Pair) -> Case:
    """Return the case with two objects in each other's colours."""

    def swapped(scene: Scene) -> Scene:
        colors = _colors_of(scene, (guess.second, guess.first))
        if len(colors) < 2:
            return scene
        for name, other in zip((guess.first, guess.second), colors, strict=True):
            scene = with_instances(scene, name, partial(_in_colors, colors=other))
        return scene

    return case.with_scenes(swapped)


def _two_colors(case: Case, frame: Frame) -> Pair | None:
    """Pick the largest object, and another one of another colour."""
    scene = case.scene
    names = [scene.objects[scene.instances[n].object] for n in _of_one_color(case, frame)]
    for name in names[1:]:
        first, second = _colors_of(scene, (names[0], name))
        if not np.array_equal(first, second):
            return Pair(names[0], name)
    return None


@at_once
def _first_suspects(evidence: Evidence) -> list[Pair]:
    """Guess the first two suspects, if they have colours."""
    names = evidence.suspects[:2]
    if len(_colors_of(evidence.case.scene, names)) < 2:
        return []
    return [Pair(*names, words=" and ".join(f"'{name}'" for name in names))]


COLOR_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "swapped_colors",
        "{words} have each other's colours",
        "Objects and colours come in two lists in different orders.",
        "check by which index colours are taken",
        _swapped,
        _first_suspects,
        examples=(
            Example("swapped_colors", "two objects with one another's colours", _two_colors),
        ),
        words="two objects",
        witness="WolvenKit/WolvenKit#1036",
    ),
    Fault(
        "recolored",
        "'{object}' is shown in another colour: ({red:.3f}, {green:.3f}, {blue:.3f}), linear",
        "A material has one colour for the viewport and another in its shader. Hexadecimal "
        "colours are sRGB, those in Blender's Python are linear.",
        "check its material, and in which colour space its colour is stored; a mesh is grey unless "
        "--colors names its colours",
        of_object(_in_color),
        _shown_color,
        ("red", "green", "blue"),
        examples=(
            Example("one_shade", "one object half as bright", _recolored(lambda c: c * 0.5)),
            Example(
                "one_channels",
                "one object's red and blue swapped",
                _recolored(lambda c: c[:, [2, 1, 0, 3]]),
            ),
        ),
        witness="godotengine/collada-exporter#115",
    ),
)
