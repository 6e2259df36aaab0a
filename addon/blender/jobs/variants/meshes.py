"""Objects with other meshes: without modifiers, those of the viewport, other levels."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import partial

import bpy
import numpy as np

from ....causes.case import Variant
from ....scene import Mesh, Scene
from ...reading.export import export
from ...reading.meshes import read_mesh
from ...values import values_restored
from .origin import Origin, all_and_each

LEVELS = (-1, 1, -2, 2)  # of subdivision more, or less
MOST_TRIANGLES = 300_000  # of the scene, where a level is added: each makes four of one
DEFORMING = {"ARMATURE", "HOOK", "LATTICE", "CURVE", "MESH_DEFORM", "SURFACE_DEFORM"}


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with other meshes."""
    yield from _without_modifiers(origin)
    yield from _as_in_the_viewport(origin)
    yield from _subdivided(origin)


def _without_modifiers(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with the meshes as they are edited; only deformed ones are at rest then."""
    found: dict[str, Mesh] = {}
    rest: dict[str, Mesh] = {}
    for name, obj in origin.objects.items():
        if obj.type != "MESH" or not (obj.modifiers or obj.data.shape_keys):
            continue
        read = read_mesh(obj, name, False)
        if read is None:
            continue
        only_moved = {m.type for m in obj.modifiers} <= DEFORMING
        (rest if only_moved else found)[name] = read[0]
    yield from all_and_each("no_modifiers", found, partial(_with, origin.exported, found))
    yield from all_and_each("rest_pose", rest, partial(_with, origin.exported, rest))


def _with(scene: Scene, meshes: dict[str, Mesh], names: Collection[str]) -> Scene:
    """Return the scene with other meshes of some of these objects."""
    named = ((n, scene.objects[i.object]) for n, i in enumerate(scene.instances))
    return scene.with_meshes({n: meshes[name] for n, name in named if name in names})


def _as_in_the_viewport(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with the meshes of the viewport's evaluation, where these are others."""
    with bpy.context.temp_override(scene=origin.tmp, view_layer=origin.tmp.view_layers[0]):
        other, _ = export(bpy.context.evaluated_depsgraph_get())
    meshes, own = (
        {scene.objects[i.object]: scene.meshes[i.mesh] for i in scene.instances}
        for scene in (other, origin.exported)
    )
    changed = {n: m for n, m in meshes.items() if n in own and not _alike(m, own[n])}
    made = partial(_with, origin.exported, changed)
    yield from all_and_each("viewport_modifiers", changed, made)


def _alike(one: Mesh, other: Mesh) -> bool:
    same = np.array_equal(one.triangles, other.triangles)
    return same and np.array_equal(one.vertices, other.vertices)


def _subdivided(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with its subdivision modifiers at other levels."""
    objects = [o for o in origin.objects.values() if o.type == "MESH" and not o.particle_systems]
    modifiers = [m for o in objects for m in o.modifiers if m.type in ("SUBSURF", "MULTIRES")]
    for change in LEVELS if modifiers else ():
        many = change > 0 and 4**change * origin.exported.triangle_count > MOST_TRIANGLES
        if many or all(m.render_levels + change < 0 for m in modifiers):
            continue
        with values_restored((m, "render_levels") for m in modifiers):
            for modifier in modifiers:
                modifier.render_levels = max(modifier.render_levels + change, 0)
            scene = origin.again()
        yield Variant("subdivision", scene, f"{change:+d} of the render's levels")
