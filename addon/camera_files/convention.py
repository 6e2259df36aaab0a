"""The record of a convention of camera files, with its writer and its reader."""

from __future__ import annotations

import codecs
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from ..files.checked_json import Content, whole
from ..scene import Camera, SceneError
from .features import FEATURES, Feature

HALF, INTEGER = "half", "integer"  # where a file has the centre of the first pixel: 0.5, or 0
FIRST = {HALF: 0.5, INTEGER: 0.0}
CENTERS = tuple(FIRST)

_HEAD = 1024  # bytes, in which a file of text begins
_BEGINNINGS = b"{", b"[", b"<", b"extrinsic"  # of JSON, XML and MVSNet's text

Size = tuple[int, int]  # of a picture: width and height
Clip = tuple[float, float]  # where a camera begins to see, and where it ends
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

    @cached_property
    def text(self) -> str:
        """The file's text; "" for a folder, and for what begins as no file of cameras does."""
        if self.path.is_dir():
            return ""
        with self.path.open("rb") as file:
            if not file.read(_HEAD).lstrip(codecs.BOM_UTF8 + b" \t\r\n").startswith(_BEGINNINGS):
                return ""
            file.seek(0)
            return file.read().decode("utf-8-sig", errors="replace")

    @cached_property
    def json(self) -> Any:
        """The file's JSON, or None if it is none."""
        try:
            return json.loads(self.text)
        except (ValueError, RecursionError):
            return None

    @property
    def object(self) -> Content:
        """The file's JSON, if that is an object; else an empty one."""
        return self.json if isinstance(self.json, dict) else {}

    def whole_size(
        self,
        own: Mapping[str, Any],
        where: str = "",
        keys: tuple[str, str] = ("width", "height"),
    ) -> Size:
        """Return the width and height of a file's object, or else those requested.

        Raises
        ------
        SceneError
            If there are none.
        """
        if own.keys() >= {*keys}:
            sizes = [own[key] for key in keys]
            if all(isinstance(n, float) and n.is_integer() for n in sizes):
                return int(sizes[0]), int(sizes[1])  # as nerfstudio writes some
            return whole(dict(own), keys[0], where), whole(dict(own), keys[1], where)
        width, height = self.size
        if width is None or height is None:
            raise SceneError("it says no size of the picture: add --set width=PIXELS height=PIXELS")
        return width, height


Write = Callable[[Sequence[View], str], Files]


@dataclass(frozen=True, eq=False)
class Convention:
    """One way to write a camera down."""

    name: str  # as it is typed
    title: str
    file: str  # what is written: the usual name of the file, or those in a folder
    says: tuple[Feature, ...]  # which of FEATURES its files can say
    # Whether a file may have the first pixel's centre at 0; False where its documents say 0.5, or
    # its files know no pixels.
    either_center: bool
    # Takes views that it can say, and HALF or INTEGER; None where files are only read.
    write: Write | None
    # Whether a source is of this convention, and its views.
    is_of: Callable[[Source], bool]
    read: Callable[[Source], list[View]]

    def lacks(self, camera: Camera) -> list[str]:
        """Return what of a camera its files cannot say."""
        return [f.name for f in FEATURES if f not in self.says and f.is_of(camera)]
