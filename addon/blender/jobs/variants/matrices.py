"""Objects in other places: without parents, their inverse, deltas, or as instances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ....arrays import Floats
from ....causes.case import Variant
from ....scene import Instance, Scene
from .origin import Origin

MOST = 6  # objects that are tried alone
NEAR = 1e-5

Placed = Callable[[Any], Any]  # of an object, its other world matrix


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with every object in another place by the same mistake, then single ones."""
    parented = {n: o for n, o in origin.objects.items() if o.parent is not None}
    yield from _all_and_each(origin, "parent_left_out", parented, lambda o: o.matrix_basis)
    yield from _all_and_each(
        origin, "parent_inverse", parented, lambda o: o.parent.matrix_world @ o.matrix_basis
    )
    yield from _all_and_each(
        origin,
        "parent_scale",
        parented,
        lambda o: without_scale(o.parent.matrix_world) @ o.matrix_parent_inverse @ o.matrix_basis,
    )
    yield from _all_and_each(origin, "delta_left_out", origin.objects, _without_delta)
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


def without_scale(matrix: Matrix) -> Matrix:
    """Return the place and the rotation of a matrix of Blender's, as it takes them apart."""
    place, rotation, _ = matrix.decompose()
    return Matrix.LocRotScale(place, rotation, None)


def _all_and_each(
    origin: Origin, fault: str, objects: dict[str, Any], placed: Placed
) -> Iterator[Variant]:
    matrices = {name: np.array(placed(obj), np.float64) for name, obj in objects.items()}
    own = {name: np.array(obj.matrix_world, np.float64) for name, obj in objects.items()}
    wrong = {n: m for n, m in matrices.items() if not np.allclose(m, own[n], atol=NEAR)}
    if not wrong:
        return
    names = ", ".join(f"'{name}'" for name in list(wrong)[:3]) + (" ..." if len(wrong) > 3 else "")
    yield Variant(fault, _moved(origin.exported, wrong, own), f"that of {names}")
    if len(wrong) > 1:
        for name in list(wrong)[:MOST]:
            one = {name: wrong[name]}
            yield Variant(fault, _moved(origin.exported, one, own), f"that of '{name}'", name)


def _moved(scene: Scene, matrices: Mapping[str, Floats], own: Mapping[str, Floats]) -> Scene:
    """Return the scene with other matrices of objects that are no instances."""

    def moved(instance: Instance) -> Instance:
        name = scene.objects[instance.object]
        if name not in matrices:
            return instance
        if not np.allclose(instance.world_from_object, own[name], atol=NEAR):
            return instance  # something else instances it
        return replace(instance, world_from_object=matrices[name])

    return replace(scene, instances=tuple(map(moved, scene.instances)))


def _instances(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with every instance where the object that it shows is."""
    own = {n: np.array(o.matrix_world, np.float64) for n, o in origin.objects.items()}
    count = 0

    def moved(instance: Instance) -> Instance:
        nonlocal count
        matrix = own.get(origin.exported.objects[instance.object])
        if matrix is None or np.allclose(instance.world_from_object, matrix, atol=NEAR):
            return instance
        count += 1
        return replace(instance, world_from_object=matrix)

    instances = tuple(map(moved, origin.exported.instances))
    if count:
        scene = replace(origin.exported, instances=instances)
        yield Variant("instance_transform", scene, f"{count} instances are at their object's place")


def _without_offsets(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with the offsets of all instanced collections left out."""
    moved = [c for c in bpy.data.collections if c.instance_offset.length]
    offsets = [c.instance_offset.copy() for c in moved]
    if not moved:
        return
    try:
        for collection in moved:
            collection.instance_offset = (0, 0, 0)
        scene = origin.again()
    finally:
        for collection, offset in zip(moved, offsets, strict=True):
            collection.instance_offset = offset
    yield Variant("instance_offset", scene, "that of " + ", ".join(f"'{c.name}'" for c in moved))
