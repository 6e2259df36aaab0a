"""Blender's camera -> `scene.Camera`: what `tracer/camera.py` reads.

The rules are Blender's own (its view plane from lens, sensor, shift and pixel aspect; its float32
rounding of the border), in float64 from the float32 settings. `Object.calc_matrix_camera` is what
they are held to: of each export by its certificate. (It knows no panoramas: a test holds their
rays against those of Cycles.)
"""

from __future__ import annotations

import numpy as np
from bpy.types import Depsgraph, Object, RenderSettings, Scene
from mathutils import Matrix

from ...arrays import Floats
from ...pictures.certificate import CameraCertificate, certify, known_points
from ...projections import Projection
from ...projections.projection import Edges
from ...scene import Camera, Region, SceneError, ViewWindow, check_size
from ..versions import lens
from .lenses import LENSES, lens_of
from .missing import why_gone


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


def resolution(render: RenderSettings) -> tuple[int, int]:
    """Return the size in pixels of the whole picture of `bpy.types.RenderSettings`."""
    percent = render.resolution_percentage
    return render.resolution_x * percent // 100, render.resolution_y * percent // 100


def pixel_height(render: RenderSettings) -> float:
    """Return the height of a pixel of `bpy.types.RenderSettings`, in widths."""
    return render.pixel_aspect_y / render.pixel_aspect_x


def window_of(scene: Scene) -> ViewWindow:
    """Return what the camera of a `bpy.types.Scene` shows, in its type's units."""
    data = scene.camera.data
    render = scene.render
    width, height = resolution(render)
    tall = pixel_height(render)
    vertical = data.sensor_fit == "VERTICAL"
    sensor = data.sensor_height if vertical else data.sensor_width
    if data.sensor_fit == "AUTO":
        # The products are float32 in Blender: at nearly square pictures they decide the side.
        across = np.float32(render.pixel_aspect_x) * np.float32(width)
        vertical = across < np.float32(render.pixel_aspect_y) * np.float32(height)
    fitted = tall * height if vertical else width  # length of that side, in pixel widths
    x = data.shift_x * fitted  # shifts are in lengths of that side
    y = data.shift_y * fitted

    def around(extent: float) -> Edges:
        size = extent / fitted  # width of a pixel
        return (
            (x - 0.5 * width) * size,
            (x + 0.5 * width) * size,
            (y - 0.5 * tall * height) * size,
            (y + 0.5 * tall * height) * size,
        )

    own = lens_of(projection_of(scene.camera, scene))
    return ViewWindow(*own.window(data, sensor, around))


def camera_axes(matrix_world: Matrix, name: str) -> np.ndarray:
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


def projection_of(obj: Object, scene: Scene) -> Projection:
    """Return how an object projects that a `bpy.types.Scene` is seen through.

    Raises
    ------
    SceneError
        If it is no camera, or of a kind that the tracer does not model.
    """
    if obj.type != "CAMERA":
        raise SceneError(
            f"'{obj.name}', the active camera of scene '{scene.name}', is a {obj.type.lower()}: "
            "make a camera object active."
        )
    projections = {own.kind: own.projection for own in LENSES}
    kind = getattr(lens(obj.data), "panorama_type", "PANO")
    kind = kind if obj.data.type == "PANO" else obj.data.type
    if kind not in projections:
        *first, last = (p.name for p in projections.values())
        raise SceneError(
            f"Camera '{obj.name}' is of type {kind.lower()}; Reference Tracer models "
            f"{', '.join(first)} and {last} cameras."
        )
    return projections[kind]


def export_camera(scene: Scene) -> Camera:
    """Return the active camera of an evaluated `bpy.types.Scene`.

    Raises
    ------
    SceneError
        If there is none, it is missing, or of a kind that the tracer does not model.
    """
    obj = scene.camera
    if obj is None:
        raise SceneError(
            f"Scene '{scene.name}' has no camera: add one that frames all (the panel's button, or "
            "--set eye=all), place one (--set eye=X,Y,Z), or make one active (--camera NAME)."
        )
    if obj.original.is_missing:
        raise SceneError(
            f"'{obj.name}', the active camera of scene '{scene.name}', is not there: "
            f"{why_gone(obj.original)}. Find the file, or make another camera the active one."
        )
    projection = projection_of(obj, scene)
    data = obj.data
    render = scene.render
    width, height = resolution(render)
    check_size(width, height)
    region = Region(0, 0, width, height)
    if render.use_border:
        names = ("border_min_x", "border_max_x", "border_min_y", "border_max_y")
        region = border_region(width, height, *(getattr(render, name) for name in names))
    return Camera(
        world_from_camera=camera_axes(obj.matrix_world, obj.name),
        window=window_of(scene),
        width=width,
        height=height,
        projection=projection,
        clip_start=data.clip_start,
        clip_end=data.clip_end,
        region=region,
        name=obj.name,
    )


def certify_camera(depsgraph: Depsgraph, camera: Camera) -> CameraCertificate | None:
    """Return how far apart the camera exported of a depsgraph and Blender's own see known points.

    None of a panorama: Blender has no matrix of it.
    """
    if not camera.projection.is_linear:
        return None
    points = known_points(camera)
    return certify(camera, points, film_of_blender(depsgraph, points))


def film_of_blender(depsgraph: Depsgraph, points: Floats) -> Floats:
    """Return where Blender has world points (3, n), (2, n) pixels of the whole picture."""
    scene = depsgraph.scene_eval
    obj = scene.camera.evaluated_get(depsgraph)
    render = scene.render
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
