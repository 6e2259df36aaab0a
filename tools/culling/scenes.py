"""Small scenes, in a line each; cameras look along -Z from the origin, Y up."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import trimesh
from numpy.typing import NDArray
from reference_tracer.scene import Camera, Mesh, Scene, ViewWindow
from reference_tracer_meshes.contents import Contents, Placed
from reference_tracer_meshes.load import scene_of_meshes


def mesh(vertices: NDArray, triangles: NDArray) -> Placed:
    return Placed(Mesh(np.array(vertices, float), np.array(triangles)), np.eye(4), "Mesh")


def sphere(detail: int, radius: float, x: float, y: float, z: float) -> Placed:
    """A sphere of 20 * 4^detail triangles."""
    shape = trimesh.creation.icosphere(detail)
    return mesh(shape.vertices * radius + (x, y, z), shape.faces)


def sheet(columns: int, rows: int, half: tuple[float, float], z: Callable) -> Placed:
    """A sheet across the view, two triangles for each of its fields, with z as z(x, y)."""
    x, y = np.meshgrid(np.linspace(-1, 1, columns + 1), np.linspace(-1, 1, rows + 1))
    x, y = x.ravel() * half[0], y.ravel() * half[1]
    a = (np.arange(columns) + np.arange(rows)[:, None] * (columns + 1)).ravel()
    b, c, d = a + 1, a + columns + 1, a + columns + 2
    triangles = np.stack((a, b, d, a, d, c), axis=1).reshape(-1, 3)
    return mesh(np.stack((x, y, z(x, y)), axis=1), triangles)


def ahead(width: int, height: int, half: float = 0.5, **options) -> Camera:
    """A camera whose picture is 2 `half` high, at depth 1 or in metres."""
    wide = half * width / height
    return Camera(np.eye(4), ViewWindow(-wide, wide, -half, half), width, height, **options)


def scene(camera: Camera, *meshes: Placed) -> Scene:
    named = tuple(shown._replace(object=f"Mesh {k}") for k, shown in enumerate(meshes))
    return scene_of_meshes(Contents(named), camera, camera.width, camera.height)


def fine_sphere(width: int, height: int, detail: int) -> Scene:
    """One sphere that fills the picture."""
    return scene(ahead(width, height, 0.3), sphere(detail, 1, 0, 0, -3.5))


def nested_spheres(width: int, height: int, detail: int) -> Scene:
    """64 spheres, one inside the other."""
    shapes = (sphere(detail - 3, k / 64, 0, 0, -3.5) for k in range(64, 0, -1))
    return scene(ahead(width, height, 0.3), *shapes)
