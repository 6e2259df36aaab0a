"""The same formulas in fractions, where nothing is rounded: what float64 is judged by here.

Arrays of `Fraction`; the formulas are written apart from the tracer's, in other forms of the same.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Scene
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.vector import transform_points

Exact = NDArray[np.object_]

rational = np.vectorize(Fraction, otypes=[object])


def det(a: Exact, b: Exact, c: Exact) -> Exact:
    """Return a . (b x c)."""
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def functions(origins, directions, corners) -> tuple[Exact, Exact, Exact]:
    """e_ab, e_bc, e_ca (3, n), T and D (n,) of n rays and n triangles, pair by pair."""
    o, d, corners = rational(origins), rational(directions), rational(corners)
    a, b, c = (corner - o for corner in corners)
    edges = np.stack([det(d, p, q) for p, q in ((a, b), (b, c), (c, a))])
    return edges, det(a, b, c), edges.sum(axis=0)


def plane_functions(origins, directions, point, normal) -> tuple[Exact, Exact]:
    """T and D of n rays and n planes, pair by pair."""
    o, d, p, n = (rational(v) for v in (origins, directions, point, normal))
    return ((p - o) * n).sum(axis=0), (d * n).sum(axis=0)


def rounded(value: Fraction) -> float:
    """The nearest float64."""
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf


def t_of(origin, direction, corners) -> float:
    """T / D of one ray and one triangle, correctly rounded."""
    columns = (np.asarray(v, np.float64)[..., None] for v in (origin, direction, corners))
    _, depth, towards = functions(*columns)
    return rounded(depth[0] / towards[0])


def world_corners(scene: Scene, name: tuple[int, int]) -> NDArray[np.float64]:
    """(corner, component) of a triangle of an instance."""
    instance = scene.instances[name[0]]
    mesh = scene.meshes[instance.mesh]
    world = transform_points(instance.world_from_object, mesh.vertices.T)
    return world[:, mesh.triangles[name[1]]].T


def t_of_pixels(scene: Scene, names) -> NDArray[np.float64]:
    """The correctly rounded t of the rays through the centres with what they see, (n,)."""
    camera = scene.camera
    rays = camera_rays(camera, *film_positions(camera.region, 0.0, 0.0))
    shape = (3, camera.region.width * camera.region.height)
    out = []
    for o, d, name in zip(
        np.broadcast_to(rays.origins, shape).T,
        np.broadcast_to(rays.directions, shape).T,
        names,
        strict=True,
    ):
        if name[0] == NOTHING:
            out.append(inf)
        elif name[0] >= len(scene.instances):
            plane = scene.planes[name[0] - len(scene.instances)]
            depth, towards = plane_functions(o, d, plane.point, plane.normal)
            out.append(rounded(depth / towards))
        else:
            out.append(t_of(o, d, world_corners(scene, name)))
    return np.array(out)
