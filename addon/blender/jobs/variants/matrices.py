"""Objects in other places: without parents, their inverse, deltas, or as instances."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ....arrays import Floats
from ....causes.case import Variant
from ....scene import Scene
from ...values import values_restored
from .origin import Origin, all_and_each

NEAR = 1e-5

Placed = Callable[[Any], Any]  # of an object, its other world matrix


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with every object in another place by the same mistake, then single ones."""
    objects = origin.objects.items()
    for fault, placed in OF_PARENT.items():
        yield from _misplaced(origin, fault, {n: placed(o) for n, o in objects if o.parent})
    without = {name: _without_delta(obj) for name, obj in objects}
    yield from _misplaced(origin, "delta_left_out", without)
    yield from _instances(origin)
    yield from _without_offsets(origin)


def _without_delta(obj: Any) -> Matrix:
    """Return an object's world matrix without its delta transform."""
    rotation = obj.rotation_euler
    if obj.rotation_mode == "QUATERNION":
        rotation = obj.rotation_quaternion.normalized()
    elif obj.rotation_mode == "AXIS_ANGLE":
        angle, *axis = obj.rotation_axis_angle
        rotation = Matrix.Rotation(angle, 3, axis).to_quaternion()
    own = Matrix.LocRotScale(obj.location, rotation, obj.scale)
    if np.allclose(own, obj.matrix_basis, atol=NEAR):
        return obj.matrix_world  # it has none: far away, the inverse is rounded
    return obj.matrix_world @ obj.matrix_basis.inverted_safe() @ own


def _without_scale(matrix: Matrix) -> Matrix:
    """Return the place and the rotation of a matrix of Blender's, as it takes them apart."""
    place, rotation, _ = matrix.decompose()
    return Matrix.LocRotScale(place, rotation, None)


# By their faults, mistakes about where what has a parent is.
OF_PARENT: dict[str, Placed] = {
    "parent_left_out": lambda o: o.matrix_basis,
    "parent_inverse": lambda o: o.parent.matrix_world @ o.matrix_basis,
    "parent_scale": lambda o: (
        _without_scale(o.parent.matrix_world) @ o.matrix_parent_inverse @ o.matrix_basis
    ),
}


def _misplaced(origin: Origin, fault: str, found: Mapping[str, Matrix]) -> Iterator[Variant]:
    """Yield the scene with objects in another place, where that is another than their own."""
    own = origin.objects
    wrong = {
        name: _world(matrix)
        for name, matrix in found.items()
        if not np.allclose(matrix, own[name].matrix_world, atol=NEAR)
    }

    def made(names: Collection[str]) -> Scene:
        return _moved(origin, {name: wrong[name] for name in names}, are_at_home=True)[0]

    yield from all_and_each(fault, wrong, made, "that of {}")


def _instances(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with every instance where the object that it shows is."""
    own = {name: _world(obj.matrix_world) for name, obj in origin.objects.items()}
    scene, count = _moved(origin, own, are_at_home=False)
    if count:
        yield Variant("instance_transform", scene, f"{count} instances are at their object's place")


def _moved(origin: Origin, matrices: Mapping[str, Floats], are_at_home: bool) -> tuple[Scene, int]:
    """Return the scene with other matrices of some objects' instances, and how many these are.

    Either of those that are where their object is, or of those that something else instances.
    """
    scene = origin.exported
    objects = origin.objects
    instances = list(scene.instances)
    count = 0
    for number, instance in enumerate(instances):
        name = scene.objects[instance.object]
        if name in matrices:
            home = _world(objects[name].matrix_world)
            is_at_home = np.allclose(instance.world_from_object, home, atol=NEAR)
            if is_at_home == are_at_home:
                instances[number] = replace(instance, world_from_object=matrices[name])
                count += 1
    return replace(scene, instances=tuple(instances)), count


def _world(matrix: Any) -> Floats:
    return np.array(matrix, np.float64)


def _without_offsets(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with the offsets of all instanced collections left out."""
    moved = [c for c in bpy.data.collections if c.instance_offset.length]
    if not moved:
        return
    with values_restored((c, "instance_offset") for c in moved):
        for collection in moved:
            collection.instance_offset = (0, 0, 0)
        scene = origin.again()
    yield Variant("instance_offset", scene, "that of " + ", ".join(f"'{c.name}'" for c in moved))
