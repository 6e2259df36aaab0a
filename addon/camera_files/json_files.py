"""Camera files in JSON: what several conventions share of writing and reading them."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import Floats
from ..files.checked_json import ENDLESS, Content, number, numbers, objects
from ..scene import Camera, SceneError
from .convention import CENTERS, FIRST, Clip, Files, Source, View

CENTERS_KEY = "pixel_centers"
_DISTORTIONS = (  # by the names of OpenCV, and of those who use its lenses
    "k1",
    "k2",
    "k3",
    "k4",
    "k5",
    "k6",
    "p1",
    "p2",
    "is_fisheye",
    "D",
    "dist",
    "dist_coeffs",
    "distCoeffs",
    "distortion",
    "distortion_coefficients",
    "distortion_params",
)


def first_center(content: Mapping[str, Any]) -> float:
    """Return where a JSON file has the first pixel's centre, 0.5 or 0.

    Raises
    ------
    SceneError
        If it names neither.
    """
    return FIRST[one_of(content, CENTERS_KEY, "", CENTERS)]


def one_of(content: Mapping[str, Any], key: str, where: str, known: Sequence[str]) -> str:
    """Return one of some words that a key may have, the first where it is not there."""
    word = content.get(key, known[0])
    if word not in known:
        raise SceneError(f"{where}{key} is {word!r}; it must be {' or '.join(known)}")
    return str(word)


def offset_of(centers: str) -> float:
    """Return what is added to a principal point with pixel centres at + 0.5 to have it so."""
    return FIRST[centers] - 0.5


def clip_of(content: Content, where: str) -> Clip | None:
    """Return the clip range that an object says; None if it says none."""
    if content.keys().isdisjoint(("clip_start", "clip_end")):
        return None
    is_endless = content.get("clip_end") in (None, ENDLESS)
    far = np.inf if is_endless else number(content, "clip_end", where)
    return number(content, "clip_start", where), far


def clip_end(camera: Camera) -> float | str:
    """Return a clip end as JSON can hold it."""
    return ENDLESS if camera.clip_end == np.inf else camera.clip_end


def has(source: Source, *keys: str) -> bool:
    """Return whether a JSON object, or the first of its list `frames`, has these keys."""
    content: Any = source.object
    if isinstance(many := content.get("frames"), list):
        content = many[0] if many else None
    return isinstance(content, dict) and content.keys() >= {*keys}


def refuse_lens(body: Content, where: str, others: Sequence[str] = ()) -> None:
    """Refuse an object that says a lens' distortion; `others` are its keys of other projections.

    Raises
    ------
    SceneError
        If it does, or there are others.
    """
    bent = [key for key in _DISTORTIONS if _is_any(body.get(key))] + [*others]
    if bent:
        raise SceneError(
            f"{where.removesuffix('.') or 'it'} has lens distortion or another projection "
            f"({bent[0]} = {body[bent[0]]!r}), which is not modelled: undistort the "
            "pictures, and write the camera of these"
        )


def _is_any(value: Any) -> bool:
    """Return whether something is not 0, in lists and objects, too."""
    if isinstance(value, dict):
        value = list(value.values())
    return any(map(_is_any, value)) if isinstance(value, list) else bool(value)


def bodies(content: Content) -> list[tuple[Content, str]]:
    """Return the objects of the list `frames`, or the whole one, each as messages call it."""
    return list(objects(content, "frames")) if "frames" in content else [(content, "")]


def written(head: Content, views: Sequence[View], body: Callable[[View], Content]) -> Files:
    """Return JSON of our own, which :func:`bodies` reads: each view with its name and its size."""
    every: list[Content] = []
    for view in views:
        own = {} if view.frame is None else {"frame": view.frame}
        size = {"width": view.camera.width, "height": view.camera.height}
        every.append({**own, "name": view.name, **size, **body(view), **view.extras})
    head = head | {"world": "Blender's: metres, Z up"}
    return {"": dumped(head | (every[0] if len(every) == 1 else {"frames": every}))}


def of_frame(body: Content, view: View) -> View:
    """Return the view of such an object, with its frame."""
    number = body.get("frame")
    return replace(view, frame=number) if isinstance(number, int) else view


def flat(content: Content, key: str, where: str, count: int) -> Floats:
    """Return `count` finite numbers of a list, or of lists in it, (count,), row by row."""
    values = numbers(content, key, where, None).reshape(-1)
    if len(values) != count:
        raise SceneError(f"{where}{key} must be {count} finite numbers, not {len(values)}")
    return values


def radians_of(content: Content, key: str, where: str) -> float:
    """Return the whole angle of a lens.

    Raises
    ------
    SceneError
        If it is half a turn or more, as an angle in degrees is.
    """
    angle = number(content, key, where)
    if angle >= np.pi:
        raise SceneError(f"{where}{key} is {angle:g}: it must be in radians, not in degrees")
    return angle


def dumped(content: Any) -> str:
    """Return JSON with a line for each list of numbers."""
    text = json.dumps(content, indent=2, allow_nan=False)
    flat = re.sub(r"\[\s+([^][{}]*?)\s+\]", lambda m: f"[{' '.join(m[1].split())}]", text)
    return flat + "\n"
