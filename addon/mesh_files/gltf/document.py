"""The JSON of a glTF file: objects that know what messages call them, and check what they hold."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...arrays import Floats
from ...checked_json import Content
from ...scene import SceneError

_LARGEST = 2**53  # a size or number beyond it is not exact in all readers (3.6.1.1)
_SHOWN = 60  # characters of a value in a message
_LABELS = {  # what messages call the things in the file's lists
    "scenes": "scene",
    "nodes": "node",
    "meshes": "mesh",
    "cameras": "camera",
    "skins": "skin",
    "accessors": "accessor",
    "bufferViews": "buffer view",
    "buffers": "buffer",
    "animations": "animation",
}


def printable(text: str) -> str:
    """Return a text that can stand in a line: what cannot be printed becomes a question mark."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else "?" for c in text)


def short(text: str) -> str:
    """Return the beginning of a text, as messages show it."""
    return printable(text[:_SHOWN])


def quoted(value: object) -> str:
    """Return the beginning of a value, as messages show it."""
    return short(repr(value))


@dataclass(frozen=True)
class Thing:
    """An object of the file's JSON.

    Each method raises a SceneError, which names the object and the key, if the value is not of
    the type that it should be.
    """

    content: Content
    label: str  # what messages call it: node 3 'Arm'

    @property
    def name(self) -> str:
        """The name that the file gives it, or ""."""
        name = self.content.get("name")
        return printable(name) if isinstance(name, str) else ""

    def whole(self, key: str, default: int | None = None) -> int:
        """Return an integer that is not negative; without a default it must be there.

        An integer may be written as 3.0 (specification 2.7.5).
        """
        value = self.content.get(key, default)
        if value is None:
            raise SceneError(f"{self.label} has no '{key}'")
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if type(value) is not int or not 0 <= value <= _LARGEST:
            raise self.wrong(key, "an integer that is not negative")
        return value

    def refers(self, key: str) -> int | None:
        """Return the number of the thing that a key names, or None."""
        return self.whole(key) if key in self.content else None

    def refers_all(self, key: str) -> list[int]:
        """Return the numbers of the things in a list."""
        numbered = Thing(dict(enumerate(self.items(key))), f"{self.label}, in '{key}'")  # type: ignore[arg-type]
        return [numbered.whole(k) for k in numbered.content]

    def items(self, key: str) -> list[Any]:
        """Return a list; an empty one if there is none."""
        value = self.content.get(key, [])
        if not isinstance(value, list):
            raise self.wrong(key, "a list")
        return value

    def things(self, key: str, label: str) -> list[Thing]:
        """Return the objects of a list."""
        return [
            _thing(item, f"{label} {k} of {self.label}") for k, item in enumerate(self.items(key))
        ]

    def part(self, key: str) -> Thing | None:
        """Return the object that a key holds, or None."""
        if key not in self.content:
            return None
        return _thing(self.content[key], f"'{key}' of {self.label}")

    def extension(self, name: str) -> Thing | None:
        """Return what an extension says of this object, or None."""
        extensions = self.part("extensions")
        return extensions.part(name) if extensions else None

    def flag(self, key: str, default: bool) -> bool:
        """Return true or false."""
        value = self.content.get(key, default)
        if not isinstance(value, bool):
            raise self.wrong(key, "true or false")
        return value

    def numbers(self, key: str, count: int | None = None) -> Floats | None:
        """Return finite numbers as float64, (count,), or None if there are none."""
        if key not in self.content:
            return None
        values = self.items(key)
        if (count is not None and len(values) != count) or not all(map(_is_finite, values)):
            raise self.wrong(key, f"{count} finite numbers" if count else "finite numbers")
        return np.array(values, np.float64)

    def wrong(self, key: str, wanted: str) -> SceneError:
        """Return the error of a value that is not what it should be."""
        value = quoted(self.content[key])
        return SceneError(f"{self.label} has the {key} {value}, which must be {wanted}")


class Document(Thing):
    """The whole of the file's JSON."""

    def count(self, kind: str) -> int:
        """Return how many things of a kind there are: "nodes", "meshes"."""
        return len(self.items(kind))

    def thing(self, kind: str, number: int, asker: str) -> Thing:
        """Return one of the file's nodes, meshes and so on, which `asker` names.

        Raises
        ------
        SceneError
            If there is none of this number, or it is no object.
        """
        items = self.items(kind)
        label = f"{_LABELS[kind]} {number}"
        if number >= len(items):
            raise SceneError(f"{asker} names {label}, and the file has {len(items)} of them")
        found = _thing(items[number], label)
        return Thing(found.content, f"{label} {quoted(found.name)}") if found.name else found

    def every(self, kind: str) -> Iterator[Thing]:
        """Yield all things of a kind."""
        for number in range(self.count(kind)):
            yield self.thing(kind, number, "the file")


def _thing(value: object, label: str) -> Thing:
    if not isinstance(value, dict):
        raise SceneError(f"{label} is {quoted(value)}, which must be an object")
    return Thing(value, label)


def _is_finite(value: Any) -> bool:
    try:
        return type(value) in (int, float) and math.isfinite(value)
    except OverflowError:  # an integer beyond float64
        return False
