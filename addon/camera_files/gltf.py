"""glTF: a camera of a node, in a `.gltf` or a `.glb`.

Source: Khronos, glTF 2.0 specification, 3.10: the camera looks along its node's -Z with +Y up; "the
view matrix is derived from the global transform of the node containing the camera with the scaling
ignored"; `yfov` is the whole vertical angle, `aspectRatio` that of the field of view, `xmag` and
`ymag` are half the orthographic width and height. The world has Y up: (x, y, z) is Blender's
(x, -z, y).

There is no shift, and no size of the picture: what is written stands in the camera's `extras`, and
a file without has a picture 960 pixels wide unless another is asked for. Where `aspectRatio` is not
the picture's, a client "should not crop or perform non-uniform scaling": so pixels are squares. Of
an orthographic camera the shift is written as its place, which is the same picture.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats
from ..files.checked_json import Content
from ..framing import SIZE
from ..projections import ORTHOGRAPHIC, PERSPECTIVE
from ..scene import SceneError, ViewWindow
from . import frame
from .convention import Convention, Files, Size, Source, View
from .features import PARALLEL
from .gltf_file import as_specified, item, open_gltf, read_tree
from .json_files import dumped, radians_of


def _write(views: Sequence[View], centers: str) -> Files:
    numbers = range(len(views))
    content = {
        "asset": {"version": "2.0", "generator": "Reference Tracer"},
        "scene": 0,
        "scenes": [{"nodes": [*numbers]}],
        "nodes": [node_of(view, number) for view, number in zip(views, numbers, strict=True)],
        "cameras": [camera_of(view) for view in views],
    }
    return {"": dumped(content)}


def node_of(view: View, number: int) -> Content:
    """Return a view's node, which names its camera by the number."""
    camera = view.camera
    if camera.projection is ORTHOGRAPHIC:
        camera = frame.centred(camera)
    matrix = frame.Y_UP_FROM_Z_UP @ camera.world_from_camera
    return {"name": view.name, "camera": number, "matrix": matrix.T.reshape(-1).tolist()}


def camera_of(view: View) -> Content:
    """Return a camera that glTF can say."""
    camera = view.camera
    width, height = camera.window.size
    if camera.projection is ORTHOGRAPHIC:
        kind, own = "orthographic", {"xmag": width / 2, "ymag": height / 2}
    else:
        kind, own = (
            "perspective",
            {"yfov": 2 * np.arctan(height / 2), "aspectRatio": width / height},
        )
    if camera.clip_end < np.inf:
        own["zfar"] = camera.clip_end
    own["znear"] = camera.clip_start
    extras = {"width": camera.width, "height": camera.height}
    return {"name": camera.name, "type": kind, kind: own, "extras": extras}


def _is_of(source: Source) -> bool:
    if source.path.is_dir():
        return False
    return "asset" in source.object or source.path.read_bytes()[:4] == b"glTF"


def _read(source: Source) -> list[View]:
    with as_specified():
        content, _ = open_gltf(source.path)
        tree = read_tree(content)
        found = []
        for node, world in zip(tree.nodes, tree.worlds, strict=True):
            if "camera" in node:
                own = item(content, "cameras", node["camera"])
                name = str(node.get("name") or own.get("name", ""))
                label = f"camera {node['camera']}"
                world = frame.Y_UP_FROM_Z_UP.T @ world
                found.append(_view(own, label, name, world, source))
    if not found:
        raise SceneError("no node of it has a camera")
    return found


def _view(own: Content, label: str, name: str, world: Floats, source: Source) -> View:
    kind = own.get("type")
    if kind not in ("perspective", "orthographic") or kind not in own:
        raise SceneError(f"{label} is neither a perspective camera nor an orthographic one")
    lens: Content = own[kind]
    parallel = kind == "orthographic"
    if parallel:
        across, up = _number(lens, label, "xmag"), _number(lens, label, "ymag")
        aspect: float | None = across / up
    else:
        _number(lens, label, "yfov")
        up = np.tan(radians_of(lens, "yfov", f"{label}: ") / 2)
        aspect = _number(lens, label, "aspectRatio") if "aspectRatio" in lens else None
    size = _size(own, label, aspect, source)
    across = up * size[0] / size[1]
    axes = np.linalg.norm(world[:3, :3], axis=0)
    if not axes.all() or np.linalg.det(world[:3, :3]) < 0:
        raise SceneError(
            f"the node of {label} has a scale that is zero or negative, and glTF ignores a "
            "scale: export the camera without"
        )
    world = world / (*axes, 1.0)
    far = _number(lens, label, "zfar") if "zfar" in lens else np.inf
    return frame.seen_from(
        world,
        ViewWindow(-across, across, -up, up),
        size,
        name,
        ORTHOGRAPHIC if parallel else PERSPECTIVE,
        (_number(lens, label, "znear"), far),
    )


def _number(lens: Content, label: str, key: str) -> float:
    value = lens.get(key)
    if not isinstance(value, int | float) or not 0 < value < np.inf:
        raise SceneError(f"{label} needs '{key}', a finite number above 0")
    return float(value)


def _size(own: Content, label: str, aspect: float | None, source: Source) -> Size:
    """Return the picture's size: of the extras, or the requested one, with the aspect ratio."""
    extras = own.get("extras")
    width, height = source.size
    ratio = aspect or SIZE[0] / SIZE[1]  # without one it is the picture's, whatever that is
    if width is None:
        width = SIZE[0] if height is None else max(1, round(height * ratio))
    height = height or max(1, round(width / ratio))
    asked = Source(source.path, (width, height))
    size = asked.whole_size(extras if isinstance(extras, dict) else {})
    if aspect is not None and abs(size[0] / size[1] / aspect - 1) > 1 / min(size):
        raise SceneError(
            f"{label} has the aspect ratio {aspect:.6g}, not that of {size[0]} x {size[1]} "
            "pixels: choose width or height alone"
        )
    return size


GLTF = Convention(
    "gltf",
    "glTF",
    "camera.gltf",
    (PARALLEL,),
    False,
    _write,
    _is_of,
    _read,
)
