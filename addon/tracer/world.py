"""Triangles by their names, in world space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .vector import transform_points

Index = NDArray[np.integer]


def world_corners(scene: Scene, instance: Index, triangle: Index) -> NDArray[np.float64]:
    """Return the corners of named triangles in world space, (3, 3, m): corner, component."""
    out = np.empty((3, 3, len(instance)))
    groups = [slice(None)]
    if len(instance) and (instance[0] != instance).any():
        of = scene.instance_meshes[instance]
        groups = [np.flatnonzero(of == mesh) for mesh in np.unique(of)]
    with np.errstate(over="ignore", invalid="ignore"):
        for rows in groups:
            own, which = instance[rows], triangle[rows]
            if not len(own):
                continue
            one = bool((own == own[0]).all())
            matrices = scene.instance_matrices[..., own[:1] if one else own]
            mesh = scene.meshes[scene.instances[own[0]].mesh]
            corners = mesh.triangles.take(which, axis=0)
            for corner in range(3):
                local = mesh.vertices.take(corners[:, corner], axis=0).T
                out[corner][:, rows] = transform_points(matrices, local)
    return out
