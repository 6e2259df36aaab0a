"""Mitsuba 3: a sensor of each view in a scene's XML.

Source: Mitsuba 3, "Sensors" and `src/sensors/perspective.cpp`: camera space has +X to the left, +Y
up and +Z forward. With f = width / (2 tan(fov_x / 2)) pixels and the offset (px, py) of the
principal point, which is added to a sample's place in shares of the film,

    u = width (1/2 - px) - f x/z        v = height (1/2 - py) - f y/z

and of `orthographic`: its film is from -1 to 1 across,

    u = width (1 - x) / 2                v = (height - width y) / 2

The documents say of the offset only that it is "relative to the center of the film": its sign and
its unit are those of the code. A perspective sensor refuses scale in `to_world`, and both have
square pixels. Of an orthographic one the shift is written as its place: the same picture.

Mitsuba's world has no axis that is up: the one that is written is Blender's, in metres.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from xml.etree import ElementTree

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Files, Source, View
from reference_tracer.camera_files.features import PARALLEL, SHIFT
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import SceneError

_KINDS = {"perspective": PERSPECTIVE, "orthographic": ORTHOGRAPHIC}
_CLIP = {"near_clip": 1e-2, "far_clip": 1e4}  # with what Mitsuba takes where a file says none
_FILM = "hdrfilm"
_SPACES = re.compile(r"[\s,]+")


def _write(views: Sequence[View], centers: str) -> Files:
    sensors = [line for view in views for line in _sensor(view)]
    return {"": "\n".join(['<scene version="3.0.0">', *sensors, "</scene>", ""])}


def _sensor(view: View) -> list[str]:
    from xml.sax.saxutils import quoteattr  # late: it imports urllib, ssl and http

    camera = view.camera
    parallel = camera.projection is ORTHOGRAPHIC
    camera = frame.centred(camera) if parallel else camera
    fx, _, cx, cy = frame.intrinsics(camera)
    width, height = camera.width, camera.height
    matrix = camera.world_from_camera @ frame.LEFT_UP
    floats = {"near_clip": camera.clip_start, "far_clip": camera.clip_end}
    axis = []
    if parallel:
        matrix[:3, :2] *= camera.window.size[0] / 2
    else:
        axis = ['    <string name="fov_axis" value="x"/>']
        floats |= {
            "fov": float(np.degrees(2 * np.arctan(width / 2 / fx))),
            "principal_point_offset_x": 0.5 - cx / width,
            "principal_point_offset_y": 0.5 - cy / height,
        }
    numbers = " ".join(repr(float(v)) for v in matrix.reshape(-1))
    return [
        f'  <sensor type="{camera.projection.name}" id={quoteattr(view.name)}>',
        '    <transform name="to_world">',
        f'      <matrix value="{numbers}"/>',
        "    </transform>",
        *axis,
        *(f'    <float name="{name}" value="{value!r}"/>' for name, value in floats.items()),
        f'    <film type="{_FILM}">',
        f'      <integer name="width" value="{width}"/>',
        f'      <integer name="height" value="{height}"/>',
        "    </film>",
        "  </sensor>",
    ]


def _read(source: Source) -> list[View]:
    text = source.text
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise SceneError("its XML has a DOCTYPE, which no scene of Mitsuba's needs")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise SceneError(f"its XML cannot be read ({error})") from error
    defaults = {d.get("name", ""): d.get("value", "") for d in root.iter("default")}
    for element in root.iter():
        for key, text in element.attrib.items():
            for name, value in sorted(defaults.items(), reverse=True):
                text = text.replace(f"${name}", value)
            element.set(key, text)
    return [_view(sensor) for sensor in root.iter("sensor")]


def _values(elements: Iterable[ElementTree.Element]) -> dict[str, str]:
    """Return the values of elements by their names."""
    return {element.get("name", ""): element.get("value", "") for element in elements}


def _number(own: Mapping[str, str], name: str, default: float | str = "") -> float:
    """Return a number, which must be there if it has no default."""
    return float(_floats(own.get(name, str(default)), 1, name)[0])


def _floats(text: str, count: int, what: str) -> Floats:
    try:
        values = np.array([float(word) for word in _SPACES.split(text.strip())])
    except ValueError:
        values = np.zeros(0)
    if len(values) != count or not np.isfinite(values).all():
        raise SceneError(f"its {what} is '{text}', which must be {count} finite numbers")
    return values


def _view(sensor: ElementTree.Element) -> View:
    kind, name = sensor.get("type", ""), sensor.get("id", "")
    if kind not in _KINDS:
        raise SceneError(f"its sensor is of the type '{kind}', none of {', '.join(_KINDS)}")
    own, pixels = _values(sensor), _values(sensor.iterfind("film/*"))
    # What Mitsuba takes where the file says none.
    width, height = _number(pixels, "width", 768), _number(pixels, "height", 576)
    left, top = (_number(pixels, f"crop_offset_{axis}", 0) for axis in "xy")
    crop = _number(pixels, "crop_width", width), _number(pixels, "crop_height", height)
    if not all(n == int(n) and n >= 1 for n in (width, height, *crop)):
        raise SceneError("its film's width and height must be integers of at least 1")
    world: Floats = np.eye(4)
    for child in sensor:
        if child.tag == "animation":
            raise SceneError("its to_world is animated, which is not read: write one frame's")
        if child.tag == "transform" and child.get("name") == "to_world":
            for part in child:  # the first is applied first
                world = _part(part.tag, part.attrib) @ world
    if kind == "orthographic":
        f = cx = width / 2
        cy = height / 2
    else:
        f = width / 2 / _half_tangent(own, width, height)
        cx = width * (0.5 - _number(own, "principal_point_offset_x", 0))
        cy = height * (0.5 - _number(own, "principal_point_offset_y", 0))
    size = int(crop[0]), int(crop[1])
    near, far = (_number(own, key, default) for key, default in _CLIP.items())
    k = frame.matrix_of(f, f, cx - left, cy - top)
    pose = frame.inverse(world)
    return frame.pinhole(k, pose, size, name, frame.LEFT_UP, _KINDS[kind], clip=(near, far))


def _half_tangent(own: Mapping[str, str], width: float, height: float) -> float:
    """Return the tangent of half the horizontal angle of view, as `parse_fov` has it."""
    aspect = width / height
    if own.get("fov"):
        axis = own.get("fov_axis", "x")
        fov = _number(own, "fov")
        if not 0 < fov < 180:
            raise SceneError(f"its fov is {fov}, which must be between 0 and 180 degrees")
        half = np.tan(np.radians(fov) / 2)
    else:  # of a film of 36 x 24 mm, along its diagonal
        axis = "diagonal"
        length = own.get("focal_length", "50mm").removesuffix("mm")
        half = np.hypot(36, 24) / 2 / _floats(length, 1, "focal_length")[0]
    if axis == "smaller":
        axis = "y" if aspect > 1 else "x"
    elif axis == "larger":
        axis = "x" if aspect > 1 else "y"
    factors = {"x": 1.0, "y": aspect, "diagonal": aspect / np.hypot(aspect, 1)}
    if axis not in factors:
        raise SceneError(f"its fov_axis is '{axis}', none of {', '.join(factors)}, smaller, larger")
    return half * factors[axis]


def _part(tag: str, given: Mapping[str, str]) -> Floats:
    """Return the matrix (4, 4) of a part of a transform."""
    if tag == "matrix":
        return _floats(given.get("value", ""), 16, "matrix").reshape(4, 4)
    if tag in ("look_at", "lookat"):
        eye, target, up = (_floats(given.get(k, ""), 3, k) for k in ("origin", "target", "up"))
        forward = (target - eye) / np.linalg.norm(target - eye)
        left = np.cross(up, forward)
        left = left / np.linalg.norm(left)
        return frame.pose(np.stack((left, np.cross(forward, left), forward), axis=1), eye)
    if "value" in given:
        words = _SPACES.split(given["value"].strip())
    else:
        words = [given.get(axis, "1" if tag == "scale" else "0") for axis in "xyz"]
    xyz = np.broadcast_to(np.array(words, np.float64), 3)
    if tag == "scale":
        return np.diag((*xyz, 1.0))
    if tag == "translate":
        return frame.pose(np.eye(3), xyz)
    if tag == "rotate":
        from trimesh.transformations import rotation_matrix  # late: other files need no trimesh

        return rotation_matrix(np.radians(float(given.get("angle", 0))), xyz)
    raise SceneError(f"its to_world has '{tag}', which is not read")


MITSUBA = Convention(
    "mitsuba",
    "Mitsuba 3",
    "sensors.xml",
    (SHIFT, PARALLEL),
    False,
    _write,
    lambda source: "<sensor" in source.text,
    _read,
)
