"""Constant shading, and the other outputs of a hit: colour, position, normal, object.

In come `Hits` and the rays that made them; out go arrays, a row a ray. All of it is float64
whatever the precision of the intersection: it says where the hit was found to be.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .camera import Rays
from .vector import cross, transform_points
from .visibility import NOTHING, Hits


def colors(scene: Scene, hits: Hits) -> NDArray[np.float32]:
    """Return what each ray sees, (n, 4) linear RGBA; alpha is 1 on every surface.

    The colour of a triangle is that of its material slot; where the mesh has corner colours, the
    barycentrics weigh them.
    """
    out = np.tile(scene.background, (len(hits.t), 1))
    for index, rows in _by_instance(hits):
        if index >= len(scene.instances):
            out[rows] = scene.planes[index - len(scene.instances)].color
        else:
            instance = scene.instances[index]
            mesh = scene.meshes[instance.mesh]
            triangle = hits.triangle[rows]
            if mesh.corner_colors is not None:
                out[rows] = (mesh.corner_colors[triangle] * hits.s[:, rows].T[..., None]).sum(
                    axis=1
                )
            else:
                out[rows] = instance.colors[
                    np.minimum(mesh.slots[triangle], len(instance.colors) - 1)
                ]
        out[rows, 3] = 1
    return out


def normals(scene: Scene, hits: Hits) -> NDArray[np.float64]:
    """Return the geometric unit normal in world space, (n, 3); zero where nothing is hit.

    It is the side that the winding (p2 - p1) x (p3 - p1) names in *object* space: a mirrored
    instance keeps its outside outside. (The textbook's own n is its opposite.)
    """
    out = np.zeros((len(hits.t), 3))
    for index, rows in _by_instance(hits):
        if index >= len(scene.instances):
            n = scene.planes[index - len(scene.instances)].normal[:, None]
        else:
            instance = scene.instances[index]
            mesh = scene.meshes[instance.mesh]
            corners = mesh.triangles[hits.triangle[rows]].T
            p1, p2, p3 = (
                transform_points(instance.world_from_object, mesh.vertices[c].T) for c in corners
            )
            mirrored = np.linalg.det(instance.world_from_object[:3, :3]) < 0
            n = cross(p2 - p1, p3 - p1) * (-1 if mirrored else 1)
        n = n / np.abs(n).max(axis=0)  # so that the square below cannot underflow
        out[rows] = (n / np.sqrt((n * n).sum(axis=0))).T
    return out


def positions(rays: Rays, hits: Hits) -> NDArray[np.float64]:
    """Return where each ray ends in world space, (n, 3) metres; zero where nothing is hit."""
    hit = hits.instance != NOTHING
    out = np.zeros((len(hits.t), 3))
    points = rays.at(np.where(hit, hits.t, 0.0))
    out[hit] = points.T[hit]
    return out


def objects(scene: Scene, hits: Hits) -> NDArray[np.int32]:
    """Return the index into `scene.objects` of what each ray sees, (n,); NOTHING for nothing."""
    of = [i.object for i in (*scene.instances, *scene.planes)]
    return np.array([*of, NOTHING], np.int32)[hits.instance]


def _by_instance(hits: Hits):
    """Yield each instance that is seen, with its rows."""
    order = np.argsort(hits.instance, kind="stable")
    seen, start = np.unique(hits.instance[order], return_index=True)
    for index, rows in zip(seen, np.split(order, start[1:]), strict=True):
        if index != NOTHING:
            yield int(index), rows
