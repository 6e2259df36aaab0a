"""COLMAP: `cameras.txt` and `images.txt` in a folder.

Source: COLMAP, "Output Format": the quaternion (w, x, y, z) and t take the world to a camera space
with +X right, +Y down, +Z forward; "the local camera coordinate system", and "the upper left image
corner has coordinate (0, 0), the center of the upper left most pixel (0.5, 0.5)". "Camera Models":
PINHOLE is fx, fy, cx, cy, and u = fx x/z + cx, v = fy y/z + cy. COLMAP's world has no axes of its
own: the one that is written is Blender's, in metres.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..scene import SceneError
from . import frame
from .convention import Convention, Files, Size, Source, View
from .features import ASPECT, SHIFT

CAMERAS, IMAGES, POINTS = "cameras.txt", "images.txt", "points3D.txt"
_POINT = 3  # numbers of a point: x, y, and the number of its point in space
# By model: where fx, fy, cx, cy stand among the parameters, and how many there are. All that follow
# cy are distortions: only zeros are read.
_MODELS = {
    "SIMPLE_PINHOLE": ((0, 0, 1, 2), 3),
    "PINHOLE": ((0, 1, 2, 3), 4),
    "SIMPLE_RADIAL": ((0, 0, 1, 2), 4),
    "RADIAL": ((0, 0, 1, 2), 5),
    "OPENCV": ((0, 1, 2, 3), 8),
    "FULL_OPENCV": ((0, 1, 2, 3), 12),
}


def _write(views: Sequence[View], centers: str) -> Files:
    lenses = [_lens(view) for view in views]
    numbers = {lens: n for n, lens in enumerate(dict.fromkeys(lenses), 1)}
    cameras = ["# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]: fx, fy, cx, cy"]
    cameras += [f"{n} {lens}" for lens, n in numbers.items()]
    images = ["# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; then a line of points"]
    for number, (view, lens) in enumerate(zip(views, lenses, strict=True), 1):
        r = frame.rotation_of(frame.camera_from_world(view.camera)[:3, :3])
        pose = [*frame.quaternion(r), *(-r @ view.camera.origin)]
        said = " ".join(repr(float(v)) for v in pose)
        images += [f"{number} {said} {numbers[lens]} {view.name}", ""]
    files = {CAMERAS: cameras, IMAGES: images, POINTS: ["# no points"]}
    return {name: "\n".join(lines) + "\n" for name, lines in files.items()}


def _lens(view: View) -> str:
    camera = view.camera
    params = " ".join(map(repr, map(float, frame.intrinsics(camera))))
    return f"PINHOLE {camera.width} {camera.height} {params}"


def rotation(q: Floats) -> Floats:
    """Return the rotation (3, 3) of a quaternion (w, x, y, z), which need not have length 1.

    Raises
    ------
    SceneError
        If it is zero.
    """
    length = np.linalg.norm(q)
    if not length:
        raise SceneError(f"{IMAGES}: a quaternion is zero")
    return frame.of_quaternion(*(q / length))


def _is_of(source: Source) -> bool:
    path = source.path
    if path.is_dir():
        return any((path / f"cameras{end}").is_file() for end in (".txt", ".bin"))
    return path.name.lower() in (CAMERAS, IMAGES)


def _read(source: Source) -> list[View]:
    path = source.path
    folder = path if path.is_dir() else path.parent
    if not (folder / CAMERAS).is_file():
        raise SceneError(
            f"it has no {CAMERAS}: `colmap model_converter --output_type TXT` writes it of a binary"
        )
    lines = _lines(folder / CAMERAS)
    lenses = dict(_camera(line.split(), where) for where, line in lines if line.strip())
    images = _first_of_two(_lines(folder / IMAGES))
    return [_image(line.split(None, 9), where, lenses) for where, line in images if line.strip()]


_Line = tuple[str, str]  # what messages call it, and its text


def _lines(path: Path) -> list[_Line]:
    """Return the lines that are no comments."""
    text = path.read_bytes().decode("utf-8-sig", errors="replace")
    numbered = enumerate(text.splitlines(), 1)
    return [(f"{path.name}, line {n}", line) for n, line in numbered if not line.startswith("#")]


def _first_of_two(lines: list[_Line]) -> list[_Line]:
    """Return the first line of each image; the second, which may be empty, has its points.

    Raises
    ------
    SceneError
        If a second line has none.
    """
    while lines and not lines[0][1].strip():
        del lines[0]
    for where, line in lines[1::2]:
        if len(line.split()) % _POINT:
            raise SceneError(
                f"{where}: an image's second line has its points, three numbers each, or is empty"
            )
    return lines[::2]


def _numbers(words: Sequence[str], where: str) -> Floats:
    try:
        values = np.array([float(word) for word in words])
    except ValueError as error:
        raise SceneError(f"{where}: {error}") from None
    if not np.isfinite(values).all():
        raise SceneError(f"{where}: a number is not finite")
    return values


_Lens = tuple[Floats, Size]


def _camera(words: list[str], where: str) -> tuple[str, _Lens]:
    """Return a camera's number, its K and its size."""
    model = words[1] if len(words) > 1 else ""
    if model not in _MODELS:
        raise SceneError(f"{where}: the model '{model}' is none of {', '.join(_MODELS)}")
    places, count = _MODELS[model]
    values = _numbers(words[2:], where)
    params = values[2:]
    if len(params) != count or not all(v >= 1 and v == int(v) for v in values[:2]):
        raise SceneError(f"{where}: {model} has a width, a height and {count} parameters")
    if params[max(places) + 1 :].any():
        raise SceneError(
            f"{where}: {model} has lens distortion, which is not modelled: "
            "`colmap image_undistorter` writes pictures and cameras without"
        )
    k = frame.matrix_of(*params[[*places]])
    return words[0], (k, (int(values[0]), int(values[1])))


def _image(words: list[str], where: str, lenses: dict[str, _Lens]) -> View:
    if len(words) != 10:
        raise SceneError(f"{where}: an image has a number, 7 numbers of its pose, CAMERA_ID, NAME")
    if words[8] not in lenses:
        raise SceneError(f"{where}: there is no camera {words[8]} in {CAMERAS}")
    pose = _numbers(words[1:8], where)
    matrix = frame.pose(rotation(pose[:4]), pose[4:])
    k, size = lenses[words[8]]
    name = words[9].strip()
    return frame.pinhole(k, matrix, size, name)


COLMAP = Convention(
    "colmap",
    "COLMAP",
    f"{CAMERAS}, {IMAGES} and {POINTS} in a folder",
    (SHIFT, ASPECT),
    False,
    _write,
    _is_of,
    _read,
)
