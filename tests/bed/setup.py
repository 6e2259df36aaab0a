"""From a scene's description to what the renderer takes: K, R, t, and triangles in the world.

The formulas are written from Blender's manual for the renderer's conventions (pixels from the upper
left corner, y down, z forward), and share nothing with the tracer's view window.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .description import Description, Film, Item, Lens, Shape
from .renderer import Camera, Solid

FLIP = np.diag((1.0, -1.0, -1.0))  # Blender's camera looks along -z with y up


def fitted_side(lens: Lens, film: Film) -> tuple[bool, float]:
    """Return whether the sensor is fitted to the height, and that side's length in pixel widths."""
    width, height = film.size
    tall = film.aspect_y / film.aspect_x
    vertical = lens.fit == "VERTICAL" or (lens.fit == "AUTO" and width < tall * height)
    return vertical, tall * height if vertical else width


def intrinsics(lens: Lens, film: Film) -> np.ndarray:
    """Return K, (3, 3), of the whole film."""
    width, height = film.size
    tall = film.aspect_y / film.aspect_x
    _, fitted = fitted_side(lens, film)
    sensor = lens.sensor_height if lens.fit == "VERTICAL" else lens.sensor_width
    focal = fitted / lens.ortho_scale if lens.parallel else fitted * lens.focal / sensor
    return np.array(
        [
            [focal, 0.0, width / 2 - lens.shift_x * fitted],
            [0.0, focal / tall, height / 2 + lens.shift_y * fitted / tall],
            [0.0, 0.0, 1.0],
        ]
    )


def without_scale(matrix: np.ndarray) -> np.ndarray:
    """Return a matrix (4, 4) with axes one unit long."""
    matrix = matrix.copy()
    matrix[:3, :3] /= np.linalg.norm(matrix[:3, :3], axis=0)
    return matrix


def extrinsics(world_from_camera: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return R (3, 3) and t (3,) of Blender's camera matrix (4, 4)."""
    r = FLIP @ np.linalg.inv(world_from_camera[:3, :3])
    return r, -r @ world_from_camera[:3, 3]


def posed(camera: Camera, world_from_camera: np.ndarray) -> Camera:
    """Return the camera at another place: a matrix (4, 4) as Blender has it."""
    r, t = extrinsics(world_from_camera)
    return replace(camera, r=r, t=t)


def camera_of(scene: Description, frame: float | None = None) -> Camera:
    """Return the camera, its picture cut to the border."""
    frame = scene.frame if frame is None else frame
    return camera_through(scene.lens, scene.film, scene.eye.world(frame))


def camera_through(lens: Lens, film: Film, world_from_camera: np.ndarray) -> Camera:
    """Return the camera of a lens and a film at a place."""
    x0, x1, y0, y1 = film.cut
    moved = np.array([[1.0, 0, -x0], [0, 1, -(film.size[1] - y1)], [0, 0, 1]])
    r, t = extrinsics(without_scale(world_from_camera))
    k = moved @ intrinsics(lens, film)
    size = {"width": x1 - x0, "height": y1 - y0}
    clip = {"near": lens.clip_start, "far": lens.clip_end}
    return Camera(k, r, t, **size, parallel=lens.parallel, **clip)


def solid_of(item: Item, frame: float, shape: Shape | None = None) -> Solid:
    """Return an item in the world at a frame, in another shape if one is given."""
    shape = shape or item.shape
    at = placed(shape.vertices, item.world(frame))
    paint = np.array(item.colors)[shape.slots(len(item.colors))]
    return Solid(item.name, at, shape.triangles(), item.color, paint if item.more else None)


def placed(vertices: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return object-space vertices (v, 3) in the world, float64."""
    return np.asarray(vertices, np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def solids_of(scene: Description, frame: float | None = None) -> list[Solid]:
    """Return all that a render shows: neither hidden items nor those of another layer."""
    frame = scene.frame if frame is None else frame
    return [solid_of(item, frame) for item in scene.shown]
