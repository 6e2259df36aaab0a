"""From a scene's description to the comparison's Case: this side may use the add-on's code."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np
from reference_tracer.causes.case import Case
from reference_tracer.manifest import Manifest, ObjectEntry
from reference_tracer.pictures.given import Making
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.pictures.source import Source
from reference_tracer.pictures.storage import Storage
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import Camera, Instance, Mesh, Region, Scene, ViewWindow
from reference_tracer.tracer.settings import Settings
from reference_tracer_data.given import GivenData

from .description import Description, Film, Item, Lens, Shape
from .making import ids_of


def window_of(lens: Lens, film: Film) -> ViewWindow:
    """Return the view window, as the exporter has it of Blender's camera."""
    width, height = film.size
    tall = film.aspect_y / film.aspect_x
    vertical = lens.fit == "VERTICAL" or (lens.fit == "AUTO" and width < tall * height)
    fitted = tall * height if vertical else width
    sensor = lens.sensor_height if lens.fit == "VERTICAL" else lens.sensor_width
    pixel = (lens.ortho_scale if lens.parallel else sensor / lens.focal) / fitted
    x, y = lens.shift_x * fitted * pixel, lens.shift_y * fitted * pixel
    half_width, half_height = width * pixel / 2, tall * height * pixel / 2
    return ViewWindow(x - half_width, x + half_width, y - half_height, y + half_height)


def camera_of(lens: Lens, film: Film, matrix: np.ndarray, name: str = "Camera") -> Camera:
    """Return the tracer's camera, without the scale of its object's matrix (4, 4)."""
    matrix = matrix.copy()
    matrix[:3, :3] /= np.linalg.norm(matrix[:3, :3], axis=0)
    x0, x1, y0, y1 = film.cut
    return Camera(
        matrix,
        window_of(lens, film),
        *film.size,
        projection=ORTHOGRAPHIC if lens.parallel else PERSPECTIVE,
        clip_start=lens.clip_start,
        clip_end=lens.clip_end,
        region=Region(x0, y0, x1, y1),
        name=name,
    )


def mesh_of(item: Item, shape: Shape) -> Mesh:
    """Return an item's triangles in object space."""
    slots = shape.slots(len(item.colors))
    return Mesh(shape.vertices, shape.triangles(), slots, name=item.name)


def scene_of(description: Description, frame: float | None = None) -> Scene:
    """Return the whole scene at a frame, also what the camera does not see."""
    frame = description.frame if frame is None else frame
    shown = description.shown
    camera = camera_of(description.lens, description.film, description.eye.world(frame))
    return Scene(
        camera,
        tuple(mesh_of(item, item.shape) for item in shown),
        tuple(Instance(n, n, item.world(frame), [*item.colors]) for n, item in enumerate(shown)),
        background=premultiplied(description.background),
        objects=tuple(item.name for item in shown),
    )


def premultiplied(color: tuple[float, ...]) -> np.ndarray:
    """Return straight linear RGBA (4,) with its alpha multiplied in."""
    *rgb, alpha = color
    return np.array([*(c * alpha for c in rgb), alpha], np.float32)


def manifest_of(description: Description, scene: Scene) -> Manifest:
    """Return what was exported."""
    entries = tuple(
        ObjectEntry(
            item.name,
            "MESH",
            not (item.hidden or item.other_layer),
            "hidden in renders" if item.hidden else "in another layer" if item.other_layer else "",
            instances=1,
            hidden=item.hidden or item.other_layer,
        )
        for item in description.items
    )
    return Manifest(
        f"{description.name}.blend",
        "Scene",
        "ViewLayer",
        int(description.frame),
        "RENDER",
        scene.camera.name,
        entries,
        owners=scene.objects,
    )


def case_of(
    description: Description, shown: np.ndarray, levels: int = 0, filter_radius: float = 0.0
) -> Case:
    """Return the case of a picture (h, w, 4) of linear RGBA, row 0 at the *top*, alpha multiplied.

    Nothing is known of it but its pixels, as of any picture from outside Blender; `levels` are
    those of its file, 255 for a PNG, and `filter_radius` is what its renderer says, in pixels.
    """
    scene = scene_of(description)
    picture = Picture(
        np.ascontiguousarray(shown[::-1], np.float32),
        Source("picture", file=f"{description.name}.exr"),
        storage=Storage(levels),
        sampling=Sampling(filter_radius=filter_radius),
    )
    return Case(scene, manifest_of(description, scene), Settings(), picture, curves=())


def case_of_data(description: Description, values: np.ndarray, holds: str) -> Case:
    """Return the case of data (h, w), row 0 at the *top*; of ids, with a table of them."""
    scene = scene_of(description)
    with tempfile.TemporaryDirectory() as folder:
        names = Path(folder) / "names.json"
        numbers = ids_of(np.arange(len(scene.objects))).tolist()
        names.write_text(json.dumps(dict(zip(scene.objects, numbers, strict=True))))
        ids = holds == "ids"
        held = np.ascontiguousarray(values[::-1], np.uint16 if ids else np.float32)
        given = GivenData(holds, held, names=names if ids else None)
        shown = given.picture(scene, Making())
    return Case(scene, manifest_of(description, scene), Settings(), shown)
