"""How far Blender's own arithmetic may move what a pixel shows: float32, snapping, depth buffer.

These are bounds on *Blender's* side; the tracer's own errors are far below them. u = 2^-24 is the
rounding unit of float32.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Scene
from ..tracer.camera import pixel_size

U = 2.0**-24
SNAPPING = 1 / 256  # pixels: rasterisers keep eight bits of a vertex' position below the pixel

# A vertex goes through three float32 products: model, view, projection. Of each component the
# model's has 4 roundings of terms whose absolute values sum up to S = |T| + 3 |p - T| at most (T
# the object's position, p the point; 3 bounds the sum over a rotation's entries); the view's has
# 4, and its matrix was inverted in float32 (8 more), of terms up to |p| + |o|.
_MODEL, _VIEW = 4, 12
# The projection rounds a film position a few times more, and so does the division by w.
_FILM = 4
# A depth buffer has 24 bits; the depth itself comes from a product of 2 terms and a division.
_DEPTH_STEPS = 5


def view_error(
    scene: Scene, positions: NDArray, instances: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return how far float32 may move a point in camera space, (n,) metres.

    Parameters
    ----------
    scene : Scene
    positions : (n, 3) float64
        World space.
    instances : (n,) int
        Whose points they are; planes come after the instances.
    """
    origins = [i.world_from_object[:3, 3] for i in scene.instances]
    origins += [p.point for p in scene.planes]
    own = np.array(origins).reshape(-1, 3)[instances]
    p = np.abs(positions).sum(axis=1)
    model = np.abs(own).sum(axis=1) + 3 * np.linalg.norm(positions - own, axis=1)
    return U * (_MODEL * model + _VIEW * (p + np.abs(scene.camera.origin).sum()))


def pixel_error(
    camera: Camera, depth: NDArray[np.float64], view: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far Blender's sample may lie from the pixel's centre, (n,) pixels.

    Snapping to 1/256 pixel, plus the error `view` (n,) of a point at `depth` (n,) on the film.
    """
    width, height = pixel_size(camera)
    w = camera.window
    if camera.orthographic:
        moved = view
    else:
        steepest = max(abs(w.left), abs(w.right), abs(w.bottom), abs(w.top))
        moved = view * (1 + steepest) / np.maximum(depth, camera.clip_start)
    film = _FILM * U * max(camera.width, camera.height)
    return SNAPPING + film + moved / min(width, height)


def depth_resolution(
    camera: Camera, depth: NDArray[np.float64], view: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far apart in depth Blender can tell two surfaces, (n,) metres.

    A 24-bit depth buffer holds f / (f - n) (1 - n / z) of a perspective camera, so a step at depth
    z is z^2 (f - n) / (f n) 2^-24; of an orthographic one (f - n) 2^-24. Both surfaces carry the
    error `view` (n,) besides.
    """
    near, far = camera.clip_start, camera.clip_end
    step = (far - near) * U
    if not camera.orthographic:
        step = step * depth**2 / (far * near)
    return _DEPTH_STEPS * step + 2 * view
