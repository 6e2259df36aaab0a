"""Blender's camera -> `scene.Camera`: what `tracer/camera.py` reads.

The rules are Blender's own (its view plane from lens, sensor, shift and pixel aspect; its float32
rounding of the border), in float64 from the float32 settings. `Object.calc_matrix_camera` is what
they are held to: of each export by its certificate. Nothing here needs bpy itself.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare.certificate import CameraCertificate, certify, known_points
from ..projections import PROJECTIONS
from ..scene import Camera, Region, SceneError, ViewWindow


def view_window(
    *,
    width: int,
    height: int,
    sensor_fit: str = "AUTO",
    lens: float | None = None,
    sensor_width: float = 36.0,
    sensor_height: float = 24.0,
    ortho_scale: float | None = None,
    shift_x: float = 0.0,
    shift_y: float = 0.0,
    aspect_x: float = 1.0,
    aspect_y: float = 1.0,
) -> ViewWindow:
    """Return what a camera's picture shows, at depth 1 or, with `ortho_scale`, in metres.

    Parameters
    ----------
    width, height : int
        Pixels of the whole picture, resolution percentage included.
    sensor_fit : {'AUTO', 'HORIZONTAL', 'VERTICAL'}
    lens, sensor_width, sensor_height : float
        Millimetres; `lens` is not used by an orthographic camera.
    ortho_scale : float, optional
        Metres across the fitted side; makes the camera orthographic.
    shift_x, shift_y : float
        In lengths of the fitted side.
    aspect_x, aspect_y : float
        Shape of a pixel.
    """
    if sensor_fit == "AUTO":
        # The product is float32 in Blender: at nearly square pictures it decides the side.
        wide = np.float32(aspect_x) * np.float32(width) >= np.float32(aspect_y) * np.float32(height)
        fit, sensor = ("HORIZONTAL" if wide else "VERTICAL"), sensor_width
    else:
        fit, sensor = sensor_fit, sensor_height if sensor_fit == "VERTICAL" else sensor_width
    tall = aspect_y / aspect_x  # height of a pixel, in widths
    fitted = width if fit == "HORIZONTAL" else tall * height  # length of that side, in pixel widths
    extent = ortho_scale if ortho_scale is not None else sensor / lens
    size = extent / fitted  # width of a pixel
    x, y = shift_x * fitted, shift_y * fitted
    return ViewWindow(
        left=(x - 0.5 * width) * size,
        right=(x + 0.5 * width) * size,
        bottom=(y - 0.5 * tall * height) * size,
        top=(y + 0.5 * tall * height) * size,
    )


def border_region(
    width: int, height: int, min_x: float, max_x: float, min_y: float, max_y: float
) -> Region:
    """Return the pixels inside a render border, which runs from 0 to 1.

    Blender multiplies in float32 and cuts off: 0.3 of 250 pixels is 75, 0.7 of 10 is 6 or 7 as
    the float32 product has it.
    """

    def cut(share: float, size: int) -> int:
        return int(np.float32(share) * np.float32(size))

    return Region(cut(min_x, width), cut(min_y, height), cut(max_x, width), cut(max_y, height))


def resolution(render: Any) -> tuple[int, int]:
    """Return the size in pixels of the whole picture of `bpy.types.RenderSettings`."""
    percent = render.resolution_percentage
    return render.resolution_x * percent // 100, render.resolution_y * percent // 100


def window_of(scene: Any) -> ViewWindow:
    """Return what the camera of a `bpy.types.Scene` shows."""
    data, render = scene.camera.data, scene.render
    width, height = resolution(render)
    return view_window(
        width=width,
        height=height,
        sensor_fit=data.sensor_fit,
        lens=data.lens,
        sensor_width=data.sensor_width,
        sensor_height=data.sensor_height,
        ortho_scale=data.ortho_scale if data.type == "ORTHO" else None,
        shift_x=data.shift_x,
        shift_y=data.shift_y,
        aspect_x=render.pixel_aspect_x,
        aspect_y=render.pixel_aspect_y,
    )


def camera_axes(matrix_world: Any, name: str) -> np.ndarray:
    """Return world_from_camera, (4, 4) float64, without the scale of the camera object.

    Blender divides each axis by its length; what is mirrored or sheared stays so.
    """
    matrix = np.array(matrix_world, dtype=np.float64)
    lengths = np.sqrt((matrix[:3, :3] ** 2).sum(axis=0))
    if not np.isfinite(matrix).all() or not lengths.all():
        raise SceneError(
            f"Camera '{name}' has a scale of zero or a matrix that is not finite: clear its scale."
        )
    matrix[:3, :3] /= lengths
    return matrix


def export_camera(scene: Any) -> Camera:
    """Return the active camera of an evaluated `bpy.types.Scene`.

    Raises
    ------
    SceneError
        If there is none, or it is of a kind that the tracer does not model.
    """
    obj = scene.camera
    if obj is None:
        raise SceneError(
            f"Scene '{scene.name}' has no camera: add one that frames all (the panel's button, or "
            "--frame-all), place one (--eye X Y Z), or make one active (--camera NAME)."
        )
    if obj.type != "CAMERA":
        raise SceneError(
            f"'{obj.name}', the active camera of scene '{scene.name}', is a {obj.type.lower()}: "
            "make a camera object active."
        )
    data, render = obj.data, scene.render
    projections = {p.blender: p for p in PROJECTIONS.values()}
    if data.type not in projections:
        raise SceneError(
            f"Camera '{obj.name}' is of type {data.type.lower()}; Reference Tracer models "
            f"{' and '.join(PROJECTIONS)} cameras."
        )
    width, height = resolution(render)
    if width < 1 or height < 1:
        raise SceneError(
            f"The picture of scene '{scene.name}' has {width} x {height} pixels: raise the "
            "resolution or its percentage."
        )
    region = None
    if render.use_border:
        names = ("border_min_x", "border_max_x", "border_min_y", "border_max_y")
        region = border_region(width, height, *(getattr(render, name) for name in names))
    return Camera(
        world_from_camera=camera_axes(obj.matrix_world, obj.name),
        window=window_of(scene),
        width=width,
        height=height,
        projection=projections[data.type],
        clip_start=data.clip_start,
        clip_end=data.clip_end,
        region=region,
        name=obj.name,
    )


def certify_camera(scene: Any, depsgraph: Any, camera: Camera) -> CameraCertificate:
    """Return how far apart the camera exported of a scene and Blender's own see known points."""
    points = known_points(camera)
    return certify(camera, points, _film(scene, depsgraph, points))


def _film(scene: Any, depsgraph: Any, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where world points (3, n) appear, (2, n) pixels of the whole picture."""
    obj, render = scene.camera.evaluated_get(depsgraph), scene.render
    width, height = resolution(render)
    projection = obj.calc_matrix_camera(
        depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y
    )
    world = np.array(obj.matrix_world.normalized(), np.float64)  # as Blender's view matrix has it
    at = np.linalg.solve(world[:3, :3], points - world[:3, 3:])
    clip = np.array(projection, np.float64) @ np.vstack((at, np.ones(at.shape[1])))
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = clip[:2] / clip[3]
    return np.stack(((x + 1) / 2 * width, (y + 1) / 2 * height))
