"""Reads JSON files, and numbers, texts and cameras of them, and names what is wrong there."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..arrays import Floats
from ..projections import PROJECTIONS, Projection
from ..scene import Camera, Region, SceneError, ViewWindow
from .file_kinds import check_is_file

Content = dict[str, Any]  # an object of JSON
T = TypeVar("T")

ENDLESS = "inf"  # JSON has no number for it


def read(path: Path, schema: str, no_such: str, of: Callable[[Content], T]) -> T:
    """Return what a function makes of a file's content; `no_such` says what it is not.

    Raises
    ------
    SceneError
        If there is no such file, its schema is another, or something in it is wrong, which is
        named.
    """
    check_is_file(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise SceneError(f"'{path}' is not JSON: {error}") from error
    try:
        said = content.get("schema") if isinstance(content, dict) else None
        if said != schema:
            raise SceneError(f"its schema is {said!r}, not {schema!r}: {no_such}")
        return of(content)
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error


def objects(content: Content, key: str) -> Iterator[tuple[Content, str]]:
    """Yield the objects of a list, each with its place as messages have it."""
    for number, item in enumerate(part(content, key, "", list)):
        if not isinstance(item, dict):
            raise SceneError(f"{key}[{number}] must be an object in braces")
        yield item, f"{key}[{number}]."


def camera_of(c: Content) -> Camera:
    """Return a camera; nothing of it may be missing."""
    window: Content = part(c, "window", "camera.", dict)
    region: Content = part(c, "region", "camera.", dict)
    sides = "left", "right", "bottom", "top"
    ends = "x0", "y0", "x1", "y1"
    if (clip_end := c.get("clip_end")) not in (ENDLESS, np.inf):
        clip_end = number(c, "clip_end", "camera.")
    return Camera(
        numbers(c, "world_from_camera", "camera.", (4, 4)),
        ViewWindow(**{k: number(window, k, "camera.window.") for k in sides}),
        whole(c, "width", "camera."),
        whole(c, "height", "camera."),
        _projection(c),
        number(c, "clip_start", "camera."),
        float(clip_end),
        Region(**{k: whole(region, k, "camera.region.") for k in ends}),
        part(c, "name", "camera.", str),
    )


def _projection(c: Content) -> Projection:
    name = c.get("projection")
    if not isinstance(name, str) or name not in PROJECTIONS:
        raise SceneError(f"camera.projection must be one of: {', '.join(PROJECTIONS)}")
    return PROJECTIONS[name]


def part(content: Content, key: str, where: str, kind: type[T]) -> T:
    """Return the value of a key, which must be of this type."""
    if key not in content:
        raise SceneError(f"{where}{key} is missing")
    value = content[key]
    if not isinstance(value, kind) or isinstance(value, bool):
        names = {dict: "an object in braces", list: "a list", str: "text", int: "an integer"}
        raise SceneError(f"{where}{key} must be {names[kind]}")
    return value


def whole(content: Content, key: str, where: str) -> int:
    """Return an integer that is not negative."""
    value = part(content, key, where, int)
    if not 0 <= value < 2**31:
        raise SceneError(f"{where}{key} is {value}; it must be between 0 and 2^31 - 1")
    return value


def number(content: Content, key: str, where: str) -> float:
    """Return a finite number."""
    return float(numbers(content, key, where, ()))


def numbers(content: Content, key: str, where: str, shape: tuple[int, ...] | None) -> Floats:
    """Return finite numbers of a shape, any if None."""
    if key not in content:
        raise SceneError(f"{where}{key} is missing")
    try:
        values = np.array(content[key])
    except ValueError:  # lists of different lengths
        values = np.array(None)
    is_number = values.dtype.kind in "iuf" and np.isfinite(values).all()
    if not is_number or (shape is not None and values.shape != shape):
        size = " x ".join(map(str, shape or ()))
        what = "a finite number" if shape == () else f"{size} finite numbers".lstrip()
        raise SceneError(f"{where}{key} must be {what}")
    return values.astype(np.float64)
