"""Faults of objects' colours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Guess, instances_named, of_object
from .suspects import seen_instances


def _of_one_color(case: Case, frame: Frame) -> list[int]:
    """Return the instances that are seen without colours of their corners."""
    scene = case.scene
    meshes = {n: scene.meshes[scene.instances[n].mesh] for n in seen_instances(case, frame)}
    return [n for n, mesh in meshes.items() if mesh.corner_colors is None]


def _in_color(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Give an object one colour, linear RGB."""
    color = np.array([[*guess.values[:3], 1.0]], np.float32)
    return of_object(lambda instance, *_: replace(instance, colors=color))(case, frame, guess)


def _recolored(change: Callable[[Array], Array]) -> Callable[[Case, Frame], Guess | None]:
    """Return what picks the largest object of one colour that changes, and that colour changed."""

    def pick(case: Case, frame: Frame) -> Guess | None:
        for number in _of_one_color(case, frame):
            instance = case.scene.instances[number]
            other = change(instance.colors[:1])[0, :3]
            if len(instance.colors) == 1 and not np.allclose(other, instance.colors[0, :3]):
                name = case.scene.objects[instance.object]
                return Guess(tuple(float(v) for v in other), object=name)
        return None

    return pick


def _shown_color(evidence: Evidence) -> Work[list[Guess]]:
    """Return, for each object that is suspected, the colour in which most of it is shown."""
    out = []
    scene, picture = evidence.case.scene, evidence.picture
    for name in evidence.suspects:
        own = np.isin(evidence.frame.instance_index, instances_named(scene, name))
        where = own & evidence.open
        if 2 * where.sum() > own.sum() and picture.transform is None:
            color = np.median(picture.color[where], axis=0)
            if np.isfinite(color).all() and color[3] > 0:
                values = tuple(float(v) for v in color[:3])
                out.append(Guess(values, values, values, object=name))
        yield 0.0
    return out


def _swapped(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Give two objects each other's colours: the values are their instances' numbers."""
    instances = case.scene.instances
    first, second = (int(v) for v in guess.values)
    one, other = (case.scene.objects[instances[n].object] for n in (first, second))
    colors = {one: instances[second].colors, other: instances[first].colors}

    def swapped(scene: Scene) -> Scene:
        made = [
            replace(i, colors=colors.get(scene.objects[i.object], i.colors))
            for i in scene.instances
        ]
        return replace(scene, instances=tuple(made))

    return case.with_scenes(swapped)


def _two_colors(case: Case, frame: Frame) -> Guess | None:
    """Pick the largest object, and another one of another colour."""
    instances = case.scene.instances
    first, *others = _of_one_color(case, frame) or [0]
    for second in others:
        if not np.array_equal(instances[first].colors, instances[second].colors):
            return Guess((float(first), float(second)))
    return None


def _nothing_swapped(evidence: Evidence) -> Work[list[Guess]]:
    """Return the two objects that are suspected first, if both have one colour."""
    if len(evidence.suspects) < 2:
        return []
    scene = evidence.case.scene
    first, second = (instances_named(scene, name) for name in evidence.suspects[:2])
    if not (first and second):
        return []
    names = " and ".join(f"'{name}'" for name in evidence.suspects[:2])
    return [Guess((float(first[0]), float(second[0])), words=names)]
    yield


COLOR_FAULTS = (
    Fault(
        "swapped_colors",
        "{words} have each other's colours",
        "check by which index colours are taken",
        _swapped,
        _nothing_swapped,
        examples=(
            Example("swapped_colors", "two objects with one another's colours", _two_colors),
        ),
        words="two objects",
    ),
    Fault(
        "recolored",
        "'{object}' is shown in another colour: ({red:.3f}, {green:.3f}, {blue:.3f}), linear",
        "check its material, and in which colour space its colour is stored",
        _in_color,
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
    ),
)
