"""Other cameras of the scene, and its own with another lens, type, scale or parent."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from bpy.types import ID

from ....causes.case import Variant
from ....scene import Camera, SceneError
from ...reading.camera import camera_axes, export_camera, projection_of, window_of
from .matrices import OF_PARENT
from .origin import Origin

MOST = 8  # other cameras
TYPES = {"PERSP": "perspective", "ORTHO": "orthographic"}


class _Other:
    """Something of Blender's with some of its attributes changed, for who only reads it."""

    def __init__(self, block: ID, **changed: Any) -> None:
        self._block = block
        self.__dict__.update(changed)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._block, name)


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene as other cameras see it."""
    own = origin.tmp.camera
    for fault, words, camera in (*_lenses(origin), *_placed(origin), *_others(origin)):
        yield Variant(fault, origin.exported.seen_by(camera), words, own.name_full)


def _others(origin: Origin) -> Iterator[tuple[str, str, Camera]]:
    """Yield what the scene's other cameras see."""
    own = origin.tmp.camera
    others = [o for o in origin.scene.objects if o.type == "CAMERA" and o != own]
    for other in others[:MOST]:
        seen_through: Any = _Other(origin.tmp, camera=other)
        try:
            yield "other_camera", f"'{other.name_full}'", export_camera(seen_through)
        except SceneError:  # of a kind that cannot be traced
            continue


def _lenses(origin: Origin) -> Iterator[tuple[str, str, Camera]]:
    """Yield the camera with its sensor's sides swapped, and of the other type."""
    camera, obj = origin.exported.camera, origin.tmp.camera
    data = obj.data
    sides = {"sensor_width": data.sensor_height, "sensor_height": data.sensor_width}
    if data.type == "PERSP":
        yield "sensor_width_for_height", "", _with_data(origin, camera, _Other(data, **sides))
    for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
        if data.type != "PANO" and fit != data.sensor_fit:
            words = f"{fit.lower()} in place of {data.sensor_fit.lower()}"
            fitted = _with_data(origin, camera, _Other(data, sensor_fit=fit))
            if fitted.window != camera.window:
                yield "sensor_fit_setting", words, fitted
    for other, words in TYPES.items():
        if data.type in TYPES and data.type != other:
            yield "camera_type", words, _with_data(origin, camera, _Other(data, type=other))


def _with_data(origin: Origin, camera: Camera, data: Any) -> Camera:
    """Return the camera with other settings of its lens."""
    obj: Any = SimpleNamespace(name=camera.name, type="CAMERA", data=data)
    scene: Any = _Other(origin.tmp, camera=obj)
    return replace(camera, projection=projection_of(obj, scene), window=window_of(scene))


def _placed(origin: Origin) -> Iterator[tuple[str, str, Camera]]:
    """Yield the camera with its scale, without its parent, and without its parent's inverse."""
    camera, obj = origin.exported.camera, origin.tmp.camera
    matrix = np.array(obj.matrix_world, np.float64)
    if not np.allclose(matrix[:3, :3], camera.world_from_camera[:3, :3], atol=1e-6):
        yield "camera_scale", "", replace(camera, world_from_camera=matrix)
    for fault, placed in OF_PARENT.items() if obj.parent else ():
        axes = camera_axes(placed(obj), obj.name)
        name = f"that of camera '{obj.name_full}'"
        yield fault, name, replace(camera, world_from_camera=axes)
