"""Packs arrays as text within a page, which its `data.js` unpacks: also the surfaces of a picture.

A pixel holds the number of its surface in a table, 0 for none. The table holds vertices and
matrices as the scene has them. The page computes world-space corners from these as the tracer does,
so that all numbers that follow have the same bits.
"""

from __future__ import annotations

import base64
import zlib
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array, Index, Integers, parts, run_starts
from ...scene import Scene
from ...tracer import plane
from ...tracer.camera import camera_rays, film_positions
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.shading import by_mesh
from ...tracer.vector import gather
from ...tracer.world import planes_of

_LEVEL = 1  # of zlib: 6 takes twice as long, for a page that is a fifth smaller
_TOGETHER = 1 << 16  # pixels: some MiB of temporaries


def packed(values: Array) -> dict[str, object]:
    """Return an array's type, its shape, and its bytes, deflated (zlib) and in base64.

    The first bytes of all numbers come first, then all second ones, and so on, so that the
    exponents of neighbouring numbers stand side by side and compress. Numbers are little-endian.
    """
    values = np.ascontiguousarray(values)
    values = values.astype(values.dtype.newbyteorder("<"), copy=False)
    planes = values.reshape(-1).view(np.uint8).reshape(-1, values.dtype.itemsize).T
    data = base64.b64encode(zlib.compress(np.ascontiguousarray(planes), _LEVEL)).decode("ascii")
    return {"type": values.dtype.name, "shape": list(values.shape), "data": data}


def size(value: object) -> int:
    """Return how many characters the packed arrays in a value take."""
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    return len(value) if isinstance(value, str) else 0


class SeenSurfaces(NamedTuple):
    """The k surfaces that are seen, and which of them each pixel sees."""

    number: Index  # (h, w): 0 for none, else one more than the index into the others
    instance: Integers  # (k,), as in a `Frame`
    triangle: Integers


def seen(frame: Frame) -> SeenSurfaces:
    """Return the surfaces that a frame sees, each once."""
    every = frame.instance_index.ravel(), frame.triangle_index.ravel()
    first = run_starts(*every)
    instance, triangle = (a[first].astype(np.int64) for a in every)
    names = np.where(instance == NOTHING, -1, (instance << 32) | (triangle + 1))
    unique, number = np.unique(np.append(names, -1), return_inverse=True)
    number = number[:-1].astype(np.int32)
    return SeenSurfaces(
        np.repeat(number, np.diff(first, append=len(every[0]))).reshape(frame.shape),
        (unique[1:] >> 32).astype(np.int32),
        ((unique[1:] & 0xFFFFFFFF) - 1).astype(np.int32),
    )


def surface_table(scene: Scene, surfaces: SeenSurfaces) -> dict[str, object]:
    """Return the surfaces as the page has them: their instances, and their corners.

    Vertices are in object space, those that a seen triangle has; `matrices` are the rows of
    `world_from_object` of the instances that `instance` numbers, which come in this order.
    """
    instances, instance = np.unique(surfaces.instance, return_inverse=True)
    corners = np.zeros((len(instance), 3), np.uint32)
    vertices, count = [], 0
    for mesh, rows in by_mesh(scene, surfaces.instance):
        used, corner = np.unique(mesh.triangles[surfaces.triangle[rows]], return_inverse=True)
        corners[rows] = corner.reshape(-1, 3) + count
        vertices.append(mesh.vertices[used])
        count += len(used)
    matrices = [  # an infinite plane has none
        scene.instances[k].world_from_object if k < len(scene.instances) else np.eye(4)
        for k in instances.tolist()
    ]
    return {
        "instance": packed(instance.astype(np.int32)),
        "triangle": packed(surfaces.triangle),
        "corners": packed(corners),
        "vertices": packed(np.concatenate(vertices or [np.zeros((0, 3))])),
        "matrices": packed(np.array(matrices).reshape(-1, 4, 4)[:, :3]),
        "instances": instances.tolist(),
    }


def t_offsets(scene: Scene, frame: Frame, surfaces: SeenSurfaces) -> NDArray[np.uint64]:
    """Return by how many ulp the traced t is above that of the textbook's formula, (h, w).

    The page computes the formula's t by itself. With these small numbers it has the traced t to the
    last bit, in a fraction of the space. They are differences of bit patterns (modulo 2^64), from 0
    where nothing is seen or the formula gives no number. The differences 0, -1, 1, -2, 2... are
    stored as 0, 1, 2, 3, 4..., so that all but the lowest bytes are zero and compress.
    """
    t = frame.t.ravel()
    number = surfaces.number.ravel()
    formula = np.zeros(len(t))
    with np.errstate(all="ignore"):
        points, normals = planes_of(scene, surfaces.instance, surfaces.triangle)
        for part in parts(len(t), _TOGETHER):
            pixel = part.start + np.flatnonzero(number[part])
            rays = camera_rays(scene.camera, *film_positions(scene.camera.region, pixel=pixel))
            own = number[pixel] - 1
            formula[pixel] = plane.intersect(rays, gather(points, own), gather(normals, own))
    formula[~np.isfinite(formula)] = 0.0
    with np.errstate(over="ignore"):
        offsets = t.view(np.int64) - formula.view(np.int64)
    offsets = np.where(np.isfinite(t), offsets, 0).reshape(frame.shape)
    return ((offsets << 1) ^ (offsets >> 63)).view(np.uint64)
