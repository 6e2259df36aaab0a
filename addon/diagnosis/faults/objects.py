"""Faults of the scene's objects: which are there, where, and how large."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import combinations

import numpy as np

from ...causes.case import Case
from ...scene import Instance, Scene
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Effort, Example, Fault, Guess, instances_named, of_object
from .pose import DISPLACED, MOVED, SCALED, TWICE, copied, inflated, moved, scaled
from .suspects import largest, seen_instances, suspects

SHEARED = 1e-6  # of the longest axis' square: products of axes below are rounding
UNITS = (0.01, 100.0, 0.001, 1000.0, 0.1, 10.0, 0.0254, 1 / 0.0254, 0.3048, 1 / 0.3048)


def _a_pixel_to_the_right(case: Case, frame: Frame) -> Guess | None:
    """Pick the object that is seen in the most pixels, moved by a pixel of them."""
    seen = seen_instances(case, frame)
    if not seen:
        return None
    camera = case.scene.camera
    depth = float(np.median(frame.t[frame.instance_index == seen[0]]))
    move = pixel_size(camera)[0] * camera.projection.scale(depth) * camera.right
    name = case.scene.objects[case.scene.instances[seen[0]].object]
    return Guess(tuple(float(v) for v in move), object=name)


def _without_parts(instance: Instance, part: float) -> Instance:
    """Leave out an instance's transform, or the rotation, scale or place in it."""
    matrix = instance.world_from_object
    axes, lengths = matrix[:3, :3], np.linalg.norm(matrix[:3, :3], axis=0)
    lengths = np.where(lengths > 0, lengths, 1)
    other = matrix.copy()
    if part == 0:
        other = np.eye(4)
    elif part == 1:
        other[:3, :3] = np.diag(lengths)
    elif part == 2:
        other[:3, :3] = axes / lengths
    else:
        other[:3, 3] = 0
    return replace(instance, world_from_object=other)


def _unsheared(instance: Instance, way: float) -> Instance:
    """Make a matrix of its own place, rotation and scale, which can hold no shear.

    The scale is the length of the axes. The rotation is that of the first axis and the plane of the
    first two, or that nearest to all three (polar decomposition: Higham 1986).
    """
    matrix = instance.world_from_object.copy()
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    axes = matrix[:3, :3] / np.where(lengths > 0, lengths, 1)
    if way:
        u, _, v = np.linalg.svd(axes)
        rotation = u @ v
    else:
        q, r = np.linalg.qr(axes)
        rotation = q * np.where(np.diag(r) < 0, -1, 1)
    matrix[:3, :3] = rotation * lengths
    return replace(instance, world_from_object=matrix)


def _sheared(evidence: Evidence) -> Work[list[Guess]]:
    """Return the suspects whose axes are not at right angles, in both ways."""
    scene = evidence.case.scene
    found = []
    for name in evidence.suspects:
        for n in instances_named(scene, name)[:1]:
            axes = scene.instances[n].world_from_object[:3, :3]
            products = (axes.T @ axes)[np.triu_indices(3, 1)]
            if np.abs(products).max() > SHEARED * np.abs(axes).max() ** 2:
                found += [Guess((way,), object=name) for way in (0.0, 1.0)]
    return found
    yield


def _exchanged(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case with two objects at each other's places; the values are their numbers."""
    names = [case.scene.objects[int(v)] for v in guess.values]

    def exchanged(scene: Scene) -> Scene:
        own = [instances_named(scene, name) for name in names]  # numbered otherwise elsewhere
        if any(len(some) != 1 for some in own):
            return scene
        instances = list(scene.instances)
        first, second = (some[0] for some in own)
        a, b = instances[first], instances[second]
        instances[first] = replace(a, world_from_object=b.world_from_object)
        instances[second] = replace(b, world_from_object=a.world_from_object)
        return replace(scene, instances=tuple(instances))

    return case.with_scenes(exchanged)


def _exchange(scene: Scene, first: str, second: str) -> Guess:
    numbers = (float(scene.objects.index(name)) for name in (first, second))
    return Guess(tuple(numbers), words=f"'{first}' and '{second}'")


def _pairs(evidence: Evidence) -> Work[list[Guess]]:
    """Return each two of the suspects that have one instance."""
    scene = evidence.case.scene
    return [_exchange(scene, a, b) for a, b in combinations(_single(scene, evidence.suspects), 2)]
    yield


def _two(case: Case, frame: Frame) -> Guess | None:
    """Pick the two that are seen in the most pixels, of those with one instance."""
    scene = case.scene
    seen = (scene.objects[scene.instances[n].object] for n in seen_instances(case, frame))
    names = _single(scene, dict.fromkeys(seen))[:2]
    return _exchange(scene, *names) if len(names) == 2 else None


def _single(scene: Scene, names: Iterable[str]) -> list[str]:
    return [name for name in names if len(instances_named(scene, name)) == 1]


def _units_or_fitted(evidence: Evidence) -> Work[list[Guess]]:
    """Return factors between units for each object that is suspected, and one that is fitted."""
    fitted = yield from SCALED[0](evidence)
    return [*(yield from suspects(*UNITS)(evidence)), *fitted]


def _whole(instance: Instance, factor: float) -> Instance:
    """Scale an instance about the world's origin."""
    matrix = instance.world_from_object.copy()
    matrix[:3] *= factor
    return replace(instance, world_from_object=matrix)


def _units(evidence: Evidence) -> Work[list[Guess]]:
    return [Guess((factor,)) for factor in UNITS]
    yield


OBJECT_FAULTS = (
    Fault(
        "nothing_shown",
        "nothing of the scene is in the picture",
        "check where the camera is and looks, and whether anything is rendered",
        lambda case, frame, guess: case.with_scenes(
            lambda scene: replace(scene, instances=(), planes=())
        ),
        sums_up=True,
    ),
    Fault(
        "object_missing",
        "'{object}' is missing",
        "check why it was not exported, or is hidden",
        of_object(lambda instance: None),
        suspects(),
        examples=(Example("dropped_instance", "the largest object left out", largest),),
    ),
    Fault(
        "transform_left_out",
        "the transform of '{object}' is left out",
        "multiply its vertices by its world matrix",
        of_object(lambda instance: _without_parts(instance, 0)),
        suspects(),
    ),
    Fault(
        "rotation_left_out",
        "the rotation of '{object}' is left out",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 1)),
        suspects(),
    ),
    Fault(
        "scale_left_out",
        "the scale of '{object}' is left out",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 2)),
        suspects(),
    ),
    Fault(
        "place_left_out",
        "'{object}' is at the world's origin",
        "multiply its vertices by its whole world matrix",
        of_object(lambda instance: _without_parts(instance, 3)),
        suspects(),
    ),
    Fault(
        "shear_left_out",
        "the shear of '{object}' is left out: it has the location, rotation and scale alone",
        "a child that is turned in a parent with a scale is sheared: store its whole world matrix",
        of_object(_unsheared),
        _sheared,
    ),
    Fault(
        "swapped_transforms",
        "{words} have each other's transforms",
        "check by which index, or in which order, world matrices are taken",
        _exchanged,
        _pairs,
        examples=(Example("swapped_transforms", "two objects at each other's places", _two),),
        words="two objects",
    ),
    Fault(
        "object_scaled",
        "'{object}' is {factor:.4g} times as large",
        "check the units: a factor of 100 is metres for centimetres",
        of_object(scaled),
        _units_or_fitted,
        ("factor",),
        refine=SCALED[1],
        effort=Effort.SIZE,
    ),
    Fault(
        "scene_scaled",
        "all objects are {factor:.4g} times as large, and the camera is not",
        "use the same unit for the meshes and the camera",
        of_object(lambda instance, factor: _whole(instance, factor)),
        lambda evidence: _units(evidence),
        ("factor",),
    ),
    Fault(
        "object_moved",
        "'{object}' is moved by ({x:+.4g}, {y:+.4g}, {z:+.4g}) m",
        "compare its world matrix with the one that the scene has",
        of_object(moved),
        MOVED[0],
        ("x", "y", "z"),
        refine=MOVED[1],
        effort=Effort.PLACE,
        examples=(
            Example("moved_object", "the largest object moved by a pixel", _a_pixel_to_the_right),
        ),
    ),
    Fault(
        "object_twice",
        "'{object}' is there twice: again at ({x:+.4g}, {y:+.4g}, {z:+.4g}) m from its place",
        "look for a second export of it, as an instance or a duplicate",
        copied,
        TWICE[0],
        ("x", "y", "z"),
        refine=TWICE[1],
        effort=Effort.ANYTHING,
    ),
    Fault(
        "smooth_displaced",
        "the vertices of '{object}' are displaced along their normals by {distance:+.4g} m",
        "check a displacement's strength and midlevel, and whether normals are smooth",
        inflated,
        DISPLACED[0],
        ("distance",),
        refine=DISPLACED[1],
        effort=Effort.SIZE,
    ),
)
