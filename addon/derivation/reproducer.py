"""Writes and reads a pixel as a small file: `reftrace explain pixel.json` derives it again.

It is JSON: camera, ray and candidates. Reading gives every number back to the bit. The file holds
nothing that runs, and is checked when it is read, as it may come from anywhere.
"""

from __future__ import annotations

import json
from itertools import starmap
from pathlib import Path

import numpy as np

from ..arrays import Colors, Floats
from ..files import checked_json
from ..files.checked_json import ENDLESS, Content, camera_of, numbers, objects, part, whole
from ..scene import SceneError
from ..tracer.hits import NOTHING
from .pixel import Candidate, Pixel

SCHEMA = "reference_tracer.pixel/2"
_COUNTS = "first_plane", "triangles", "left_out", "refused"


def text(pixel: Pixel) -> str:
    """Return a pixel as the text of a file."""
    camera = pixel.camera.to_dict()
    if np.isinf(pixel.camera.clip_end):
        camera["clip_end"] = ENDLESS
    content = {
        "schema": SCHEMA,
        "rerun": "reftrace explain THIS_FILE.json",
        "source": pixel.source,
        "x": pixel.x,
        "y": pixel.y,
        "camera": camera,
        "ray": {"origin": pixel.origin.tolist(), "direction": pixel.direction.tolist()},
        "background": pixel.background.tolist(),
        **{name: getattr(pixel, name) for name in _COUNTS},
        "candidates": [
            vars(c) | {"points": c.points.tolist(), "colors": c.colors.tolist()}
            for c in pixel.candidates
        ],
    }
    return json.dumps(content, indent=1, ensure_ascii=False, default=np.generic.item) + "\n"


def read(path: str | Path) -> Pixel:
    """Read a pixel.

    Raises
    ------
    SceneError
        If there is no such file, it is no pixel's, or something in it is wrong, which is named.
    """
    return checked_json.read(Path(path), SCHEMA, "no pixel to explain", _pixel)


def _pixel(content: Content) -> Pixel:
    first_plane = whole(content, "first_plane", "")
    candidates = tuple(starmap(_candidate, objects(content, "candidates")))
    planes = [c.instance for c in candidates if c.is_plane]
    if planes != list(range(first_plane, first_plane + len(planes))):
        raise SceneError("its planes are not numbered one by one from first_plane")
    if any(c.instance >= first_plane for c in candidates if not c.is_plane):
        raise SceneError("a triangle's instance is not below first_plane")
    if len({c.name for c in candidates}) < len(candidates):
        raise SceneError("two of its candidates have the same instance and triangle")
    pixel = Pixel(
        camera_of(part(content, "camera", "", dict)),
        whole(content, "x", ""),
        whole(content, "y", ""),
        candidates,
        _colors(numbers(content, "background", "", (4,)), "background"),
        source=part(content, "source", "", str),
        **{name: whole(content, name, "") for name in _COUNTS},
    )
    _check_ray(pixel, part(content, "ray", "", dict))
    return pixel


def _check_ray(pixel: Pixel, ray: Content) -> None:
    """Raise a SceneError if the file's ray is not its camera's: one of them was changed."""
    for name, own in (("origin", pixel.origin), ("direction", pixel.direction)):
        if not np.array_equal(numbers(ray, name, "ray.", (3,)), own):
            raise SceneError(
                f"ray.{name} is not that of the camera's pixel, {own.tolist()}: change the camera, "
                "and write this there"
            )


def _candidate(c: Content, where: str) -> Candidate:
    is_plane = c.get("triangle") == NOTHING
    triangle = NOTHING if is_plane else whole(c, "triangle", where)
    colors = numbers(c, "colors", where, None)
    if colors.shape not in (((1, 4),) if is_plane else ((1, 4), (3, 4))):
        raise SceneError(f"{where}colors must be one RGBA, or one for each corner of a triangle")
    points = numbers(c, "points", where, (2, 3) if is_plane else (3, 3))
    if is_plane and not points[1].any():
        raise SceneError(f"{where}points[1], the plane's normal, is zero")
    return Candidate(
        part(c, "object", where, str),
        whole(c, "instance", where),
        triangle,
        points,
        _colors(colors, f"{where}colors"),
        part(c, "mesh", where, str),
        whole(c, "slot", where),
    )


def _colors(values: Floats, where: str) -> Colors:
    if np.abs(values).max() > np.finfo(np.float32).max:
        raise SceneError(f"{where} is beyond what a float32 holds")
    return values.astype(np.float32)
