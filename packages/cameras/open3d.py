"""Open3D: a `PinholeCameraParameters`, or a `PinholeCameraTrajectory` of several.

Source: Open3D, `open3d.camera` and `io.write_pinhole_camera_parameters`: `extrinsic` (4 x 4) takes
the world to OpenCV's camera space, `intrinsic_matrix` (3 x 3) is K; both are written column by
column, and (u, v) = (fx x/z + cx, fy y/z + cy).

Where a pixel's centre is, Open3D has in both ways: `RaycastingScene.create_rays_pinhole` and the
renderer put the first one's at (0.5, 0.5), which is written here; `create_from_depth_image` of
point clouds and the old `Visualizer` (which takes no other cx than width / 2 - 0.5) at (0, 0). The
file says which, in a key that Open3D does not read.
"""

from __future__ import annotations

from collections.abc import Sequence

from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Files, Source, View
from reference_tracer.camera_files.features import ASPECT, SHIFT
from reference_tracer.camera_files.json_files import (
    CENTERS_KEY,
    dumped,
    first_center,
    flat,
    offset_of,
)
from reference_tracer.files.checked_json import Content, objects, part

_ONE, _MANY = "PinholeCameraParameters", "PinholeCameraTrajectory"
_VERSION = {"version_major": 1, "version_minor": 0}


def _write(views: Sequence[View], centers: str) -> Files:
    bodies = [_body(view, centers) for view in views]
    many: Content = {"class_name": _MANY, "parameters": bodies, **_VERSION}
    return {"": dumped(bodies[0] if len(bodies) == 1 else many)}


def _body(view: View, centers: str) -> Content:
    camera = view.camera
    k = frame.k_of(camera, offset_of(centers))
    return {
        "class_name": _ONE,
        "name": view.name,
        CENTERS_KEY: centers,
        "extrinsic": frame.camera_from_world(camera).T.reshape(-1).tolist(),
        "intrinsic": {
            "width": camera.width,
            "height": camera.height,
            "intrinsic_matrix": k.T.reshape(-1).tolist(),
        },
        **_VERSION,
    }


def _read(source: Source) -> list[View]:
    content = source.object
    is_one = content["class_name"] == _ONE
    every = [(content, "")] if is_one else objects(content, "parameters")
    return [_view(body, where, source) for body, where in every]


def _view(body: Content, where: str, source: Source) -> View:
    lens: Content = part(body, "intrinsic", where, dict)
    k = flat(lens, "intrinsic_matrix", f"{where}intrinsic.", 9).reshape(3, 3).T
    pose = flat(body, "extrinsic", where, 16).reshape(4, 4).T
    size = source.whole_size(lens, f"{where}intrinsic.")
    name = str(body.get("name", ""))
    return frame.pinhole(k, pose, size, name, center=first_center(body))


OPEN3D = Convention(
    "open3d",
    "Open3D",
    "camera.json",
    (SHIFT, ASPECT),
    True,
    _write,
    lambda source: source.object.get("class_name") in (_ONE, _MANY),
    _read,
)
