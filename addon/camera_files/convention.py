"""What a convention of camera files says of itself, what it writes, and what it reads."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..arrays import Floats
from ..checked_json import Content, numbers, part, whole
from ..scene import Camera, SceneError
from .features import FEATURES, Feature

HALF, INTEGER = "half", "integer"  # where a file has the centre of the first pixel: 0.5, or 0
_FIRST = {HALF: 0.5, INTEGER: 0.0}
CENTERS = tuple(_FIRST)
CENTERS_KEY = "pixel_centers"  # in a JSON file

Files = dict[str, str]  # what is written, by name; of the single file the name is empty


@dataclass(frozen=True, eq=False)
class View:
    """A camera with the name of its image."""

    camera: Camera
    name: str = ""
    frame: int | None = None  # of Blender, where it is one
    is_clipped: bool = True  # the file says the clip range; else it is one that clips nothing
    notes: tuple[str, ...] = ()  # what of the file is not applied, a sentence each
    extras: Content = field(default_factory=dict)  # what else a file of our own says of it


@dataclass(frozen=True, eq=False)
class Source:
    """A file, or a folder, that is read."""

    path: Path
    size: tuple[int | None, int | None] = (None, None)  # of the picture, where the file lacks it

    @property
    def text(self) -> str:
        """What the file holds."""
        return self.path.read_bytes().decode("utf-8-sig", errors="replace")

    @property
    def json(self) -> Any:
        """What the file holds as JSON; None if it is none."""
        if self.path.is_dir():
            return None
        try:
            return json.loads(self.text)
        except (ValueError, RecursionError):
            return None

    def whole_size(self, own: Mapping[str, Any], keys: Sequence[str], where: str = "") -> Any:
        """Return the width and height that a file's object says, or else those that were asked for.

        Raises
        ------
        SceneError
            If there are none.
        """
        if all(key in own for key in keys):
            sizes = [own[key] for key in keys]
            if all(isinstance(n, float) and n.is_integer() for n in sizes):
                return int(sizes[0]), int(sizes[1])  # as nerfstudio writes some
            return whole(dict(own), keys[0], where), whole(dict(own), keys[1], where)
        width, height = self.size
        if width is None or height is None:
            raise SceneError("it says no size of the picture: add --width and --height")
        return width, height


Write = Callable[[Sequence[View], str], Files]


@dataclass(frozen=True, eq=False)
class Convention:
    """One way to write a camera down."""

    name: str  # as it is typed
    title: str
    file: str  # what is written: the usual name of the file, or those in a folder
    says: frozenset[Feature]  # which of FEATURES its files can say
    # Whether a file may have the first pixel's centre at 0; False where its documents say 0.5, or
    # its files know no pixels.
    either_center: bool
    # Takes views that it can say, and HALF or INTEGER.
    write: Write
    # Whether a source is of this convention, and its views.
    is_of: Callable[[Source], bool]
    read: Callable[[Source], list[View]]

    def lacks(self, camera: Camera) -> list[str]:
        """Return what of a camera its files cannot say."""
        return [f.name for f in FEATURES if f not in self.says and f.is_of(camera)]


def first_center(content: Mapping[str, Any], default: str = HALF) -> float:
    """Return where a JSON file has the first pixel's centre, 0.5 or 0.

    Raises
    ------
    SceneError
        If it names neither.
    """
    named = content.get(CENTERS_KEY, default)
    if named not in _FIRST:
        raise SceneError(f"{CENTERS_KEY} is {named!r}; it must be {' or '.join(CENTERS)}")
    return _FIRST[named]


def offset_of(centers: str) -> float:
    """Return what is added to a principal point with pixel centres at + 0.5 to have it so."""
    return _FIRST[centers] - 0.5


def clip_of(content: Content, where: str, names: Sequence[str]) -> tuple[float, float] | None:
    """Return the clip range that an object says; None if it says none."""
    if not any(name in content for name in names):
        return None
    start, end = names
    far = float("inf") if content.get(end) in (None, "inf") else numbers(content, end, where, ())
    return float(numbers(content, start, where, ())), float(far)


def clip_end(camera: Camera) -> float | str:
    """Return a clip end as JSON can hold it."""
    return "inf" if camera.clip_end == float("inf") else camera.clip_end


def objects(content: Content, key: str) -> list[tuple[Content, str]]:
    """Return the objects of a list, each with its place as messages have it."""
    items: list[Any] = part(content, key, "", list)
    for number, item in enumerate(items):
        if not isinstance(item, dict):
            raise SceneError(f"{key}[{number}] must be an object in braces")
    return [(item, f"{key}[{number}].") for number, item in enumerate(items)]


def flat(content: Content, key: str, where: str, count: int) -> Floats:
    """Return so many finite numbers of a list, or of lists in it, (count,), row by row."""
    values = numbers(content, key, where, None).reshape(-1)
    if len(values) != count:
        raise SceneError(f"{where}{key} must be {count} finite numbers, not {len(values)}")
    return values


def dumped(content: Any) -> str:
    """Return JSON whose lists of numbers have a line each."""
    text = json.dumps(content, indent=2, allow_nan=False)
    flat = re.sub(r"\[\s+([^][{}]*?)\s+\]", lambda m: f"[{' '.join(m[1].split())}]", text)
    return flat + "\n"
