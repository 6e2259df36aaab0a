"""3D Gaussian splatting: the `cameras.json` beside a trained model, a list of views.

Source: graphdeco-inria/gaussian-splatting, `utils/camera_utils.py` (`camera_to_JSON`): `rotation`
(3 x 3) and `position` take OpenCV's camera space, +Y down and +Z forward, to the world; `fx` and
`fy` are in pixels. No principal point is written: it is in the picture's middle, as the trainer
has it. Pixel (i, j) of its rasteriser has its centre at (i + 0.5, j + 0.5).
"""

from __future__ import annotations

from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Source, View
from reference_tracer.camera_files.features import ASPECT
from reference_tracer.camera_files.json_files import dumped, flat
from reference_tracer.files.checked_json import Content, number, numbers, objects

_LIST = "cameras"  # what messages call the list, which has no name in the file


def _body(view: View, number: int) -> Content:
    camera = view.camera
    fx, fy, _, _ = frame.intrinsics(camera)
    pose = frame.inverse(frame.camera_from_world(camera))
    return {
        "id": number,
        "img_name": view.name,
        "width": camera.width,
        "height": camera.height,
        "position": pose[:3, 3].tolist(),
        "rotation": pose[:3, :3].tolist(),
        "fx": fx,
        "fy": fy,
    }


def _is_of(source: Source) -> bool:
    content = source.json
    first = content[0] if isinstance(content, list) and content else None
    return isinstance(first, dict) and first.keys() >= {"position", "rotation"}


def _view(body: Content, where: str, source: Source) -> View:
    width, height = source.whole_size(body, where)
    fx, fy = (number(body, key, where) for key in ("fx", "fy"))
    k = frame.matrix_of(fx, fy, width / 2, height / 2)
    rotation = numbers(body, "rotation", where, (3, 3))
    pose = frame.pose(rotation, flat(body, "position", where, 3))
    name = str(body.get("img_name", ""))
    return frame.pinhole(k, frame.inverse(pose), (width, height), name)


SPLATTING = Convention(
    "splatting",
    "3D Gaussian splatting",
    "cameras.json",
    (ASPECT,),
    False,
    lambda views, _: {"": dumped([_body(view, n) for n, view in enumerate(views)])},
    _is_of,
    lambda source: [_view(b, where, source) for b, where in objects({_LIST: source.json}, _LIST)],
)
