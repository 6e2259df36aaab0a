"""Scenes that are hard by their numbers: how large, how far, and through which camera or matrix.

Each function takes the scale that is swept, and the size of the picture.
"""

from __future__ import annotations

import numpy as np

from ...projections import ORTHOGRAPHIC
from ...scene import Mesh, Scene
from .parts import BESIDE, TURNED, camera, moved, scene, sheet, sphere

EYE = np.array((0.3, -0.2, 0.25))  # inside the sphere, not at its centre
AWAY = np.array((1.0, 0.0083, -1.506))  # the direction of the centre in Embree's own test
BACKWARD = TURNED[:, 2]


def far_from_origin(distance: float, width: int, height: int, size: float = 1.0) -> Scene:
    """Return a sphere of radius 2, and the camera inside, far from the world's origin."""
    centre = distance * AWAY
    view = camera(width, height, 1.0, eye=centre + size * EYE, near=1e-3 * size, far=1e3 * size)
    return scene(view, sphere(2.0 * size, 8), matrices=(moved(centre),))


def far_corners(distance: float, width: int, height: int) -> Scene:
    """Return a closed surface met at its corners and edges, far from the world's origin."""
    view = camera(width, height, eye=distance * AWAY)
    return scene(view, sheet(view))


def uniform_scale(size: float, width: int, height: int) -> Scene:
    """Return a sphere with the camera inside, all of it scaled."""
    view = camera(width, height, 1.0, eye=size * EYE, near=1e-3 * size, far=1e3 * size)
    return scene(view, sphere(), matrices=(np.diag((size, size, size, 1.0)),))


def far_camera(distance: float, width: int, height: int) -> Scene:
    """Return a sphere of 1 m at the origin, and a camera of long focal length far from it."""
    half = 0.6 / distance
    view = camera(
        width,
        height,
        half,
        half,
        eye=distance * BACKWARD,
        near=1e-3 * distance,
        far=1e3 * distance,
    )
    return scene(view, sphere(0.5, 8))


def narrow_view(angle: float, width: int, height: int) -> Scene:
    """Return a rough surface through a camera with this horizontal angle of view, in radians."""
    view = camera(width, height, np.tan(0.5 * angle), eye=EYE)
    return scene(view, sheet(view, 4, beside=BESIDE))


def wide_view(rest: float, width: int, height: int) -> Scene:
    """Return a rough surface through a camera whose angle of view is 180 less `rest`, degrees."""
    view = camera(width, height, 1 / np.tan(np.radians(0.5 * rest)), eye=EYE)
    return scene(view, sheet(view, 4, beside=BESIDE))


def ortho_scale(size: float, width: int, height: int) -> Scene:
    """Return a rough surface through an orthographic camera of this width, in metres."""
    view = camera(width, height, 0.5 * size, eye=EYE, projection=ORTHOGRAPHIC)
    return scene(view, sheet(view, 4, beside=BESIDE, around=False))


def squashed(thickness: float, width: int, height: int) -> Scene:
    """Return a sphere from outside, mirrored and pressed flat by its object's matrix."""
    matrix = np.eye(4)
    matrix[:3, :3] = TURNED * (1.0, 1.0, -thickness)
    view = camera(width, height, 0.4, eye=6 * BACKWARD, axes=_tilted())
    return scene(view, sphere(), matrices=(matrix,))


def _tilted() -> np.ndarray:
    """Return camera axes whose view is along `TURNED`'s, a little rolled about it."""
    c, s = np.cos(0.3), np.sin(0.3)
    right, up, backward = TURNED.T
    return np.stack((c * right + s * up, c * up - s * right, backward), axis=1)


def sheared(factor: float, width: int, height: int) -> Scene:
    """Return a sphere with the camera inside, mirrored and sheared by its object's matrix."""
    shear = np.array([[1.0, factor, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]])
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [sum(TURNED[i, j] * shear[j, k] for j in range(3)) for k in range(3)] for i in range(3)
    ]
    view = camera(
        width,
        height,
        1.0,
        axes=np.eye(3),
        near=1e-6 / factor,
        far=1e3 * factor,
        eye=1e-3 * EYE / factor,
    )
    return scene(view, sphere(), matrices=(matrix,))


def stored_float32(offset: float, width: int, height: int) -> Scene:
    """Return a sphere whose corners are stored in float32, far from its object's own origin.

    The object stands at the opposite of that offset, so that the sphere appears where it should:
    with the digits that float32 has left of it. What is certified is this mesh, as it is stored.
    """
    centre = offset * AWAY
    points = (sphere().vertices + centre).astype(np.float32)
    view = camera(width, height, 0.5, eye=6 * BACKWARD)
    mesh = Mesh(points, sphere().triangles, name="Sphere")
    return scene(view, mesh, matrices=(moved(-centre),))
