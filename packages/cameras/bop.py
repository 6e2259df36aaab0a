"""BOP: `scene_camera.json` and `camera.json` in a folder, as the benchmark's datasets have them.

Source: bop_toolkit, `docs/bop_datasets_format.md`: by the number of the image, `cam_K` (3 x 3, row
by row), `cam_R_w2c` and `cam_t_w2c`, from the world to OpenCV's camera space, in *millimetres*. The
size stands in the dataset's `camera.json`.

The toolkit has a pixel's centre in both ways: its renderers put the first one's at (0.5, 0.5),
which is written here, and `misc.depth_im_to_dist_im` at (0, 0). `camera.json` says which, in a key
that the toolkit does not read.
"""

from __future__ import annotations

from collections.abc import Sequence

from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Files, Size, Source, View
from reference_tracer.camera_files.features import ASPECT, SHIFT
from reference_tracer.camera_files.json_files import (
    CENTERS_KEY,
    dumped,
    first_center,
    flat,
    offset_of,
)
from reference_tracer.files.checked_json import Content, part
from reference_tracer.scene import SceneError

SCENE, CAMERA = "scene_camera.json", "camera.json"
_MILLIMETRES = 1000.0  # in a metre
_NEXT = 3  # folders above the scene's in which the dataset's camera.json may be


def _write(views: Sequence[View], centers: str) -> Files:
    sizes = {(view.camera.width, view.camera.height) for view in views}
    if len(sizes) > 1:
        raise SceneError("BOP has one size for all pictures of a dataset")
    offset = offset_of(centers)
    scene = {}
    for place, view in enumerate(views):
        number = place if view.frame is None else view.frame
        scene[str(number)] = _body(view, offset)
    fx, fy, cx, cy = frame.intrinsics(views[0].camera)
    ((width, height),) = sizes
    camera = {
        "cx": cx + offset,
        "cy": cy + offset,
        "depth_scale": 1.0,
        "fx": fx,
        "fy": fy,
        "height": height,
        "width": width,
        CENTERS_KEY: centers,
    }
    return {CAMERA: dumped(camera), SCENE: dumped(scene)}


def _body(view: View, offset: float) -> Content:
    pose = frame.camera_from_world(view.camera)
    return {
        "cam_K": frame.k_of(view.camera, offset).reshape(-1).tolist(),
        "cam_R_w2c": pose[:3, :3].reshape(-1).tolist(),
        "cam_t_w2c": (_MILLIMETRES * pose[:3, 3]).tolist(),
        "depth_scale": 1.0,
    }


def _file(source: Source) -> Source:
    """Return the scene's file, of its folder or itself."""
    path = source.path
    return Source(path / SCENE, source.size) if path.is_dir() else source


def _is_of(source: Source) -> bool:
    own = _file(source)
    first = [*own.object.values()][:1] if own.path.is_file() else []
    return any(isinstance(body, dict) and "cam_K" in body for body in first)


def _read(source: Source) -> list[View]:
    own = _file(source)
    camera: Content = {}
    for folder in own.path.resolve().parents[:_NEXT]:
        if (folder / CAMERA).is_file():
            camera = Source(folder / CAMERA).object
            break
    size = own.whole_size(camera, f"{CAMERA}: ")
    center = first_center(camera)
    every = own.object
    return [_view(number, part(every, number, "", dict), center, size) for number in every]


def _view(number: str, body: Content, center: float, size: Size) -> View:
    where = f"image {number}: "
    if "cam_R_w2c" not in body:
        raise SceneError(
            f"{where}cam_R_w2c is missing, as in scenes without a world: their poses are of objects"
        )
    k = flat(body, "cam_K", where, 9).reshape(3, 3)
    rotation = flat(body, "cam_R_w2c", where, 9).reshape(3, 3)
    pose = frame.pose(rotation, flat(body, "cam_t_w2c", where, 3) / _MILLIMETRES)
    name = f"{int(number):06d}.png" if number.isdigit() else number
    return frame.pinhole(k, pose, size, name, center=center)


BOP = Convention(
    "bop",
    "BOP",
    f"{SCENE} and {CAMERA} in a folder",
    (SHIFT, ASPECT),
    True,
    _write,
    _is_of,
    _read,
)
