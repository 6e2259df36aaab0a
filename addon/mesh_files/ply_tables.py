"""The tables of a PLY file: rows of numbers and of lists of numbers, in text or in bytes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

import numpy as np

from ..arrays import Array, Places
from ..scene import SceneError
from ..wording import count_of
from .words import cut_off, floats, numbers


class Property(NamedTuple):
    """A number of each row of an element, or a list of them."""

    name: str
    type: str  # as numpy names it
    length_type: str = ""  # of a list: that of its length, which comes first


@dataclass(frozen=True)
class Element:
    """A table of the file."""

    name: str
    count: int  # of rows
    properties: tuple[Property, ...]


class Lists(NamedTuple):
    """The lists of a property, one after the other."""

    values: Array  # (n,)
    sizes: Places  # (rows,)


Columns = dict[str, Array | Lists]


class Body(Protocol):
    """What follows the head, a row of units: bytes, or the numbers of a text."""

    end: int  # units

    def width(self, kind: str) -> int:
        """Return how many units a number takes."""

    def length(self, at: int, kind: str) -> int:
        """Return the integer at a unit."""

    def numbers(self, at: Places, kind: str) -> Array:
        """Return the numbers at units (n,)."""


class Text:
    """A body in text."""

    def __init__(self, content: bytes, first_line: int) -> None:
        def line_of(word: int) -> int:
            behind = np.cumsum([len(line.split()) for line in content.splitlines()])
            return first_line + int(np.searchsorted(behind, word, "right"))

        self.values = numbers(floats, content.split(), line_of)
        self.end = len(self.values)

    def width(self, kind: str) -> int:
        """Return one: a unit is a number."""
        return 1

    def length(self, at: int, kind: str) -> int:
        """Return the integer at a place."""
        found = float(self.values[at])
        if not found.is_integer():
            raise SceneError(f"'{found:g}' is no integer")
        return int(found)

    def numbers(self, at: Places, kind: str) -> Array:
        """Return the numbers at places (n,)."""
        found = self.values[at]
        if kind[0] != "f" and len(other := found[found != np.rint(found)]):
            raise SceneError(f"'{other[0]:g}' is no integer")
        return found.astype(kind if kind[0] == "f" else np.int64)


class Binary:
    """A body in bytes, of a byte order that numpy names."""

    def __init__(self, content: bytes, order: str) -> None:
        self.content = content
        self.order = order
        self.bytes = np.frombuffer(content, np.uint8)
        self.end = len(content)

    def width(self, kind: str) -> int:
        """Return how many bytes a number takes."""
        return int(kind[1])

    def length(self, at: int, kind: str) -> int:
        """Return the integer at a byte."""
        order: Literal["little", "big"] = "little" if self.order == "<" else "big"
        found = self.content[at : at + self.width(kind)]
        return int.from_bytes(found, order, signed=kind[0] == "i")

    def numbers(self, at: Places, kind: str) -> Array:
        """Return the numbers at bytes (n,)."""
        found = self.bytes[at[:, None] + np.arange(self.width(kind))]
        stored = found.reshape(-1).view(self.order + kind)
        return stored.astype(kind)


def read_tables(body: Body, elements: list[Element]) -> tuple[list[Columns], int]:
    """Return the columns of each element, and how many units follow the last one.

    Raises
    ------
    SceneError
        If the body is cut off, or a list has a length below zero.
    """
    out, start = [], 0
    for element in elements:
        table, start = _table(body, element, start)
        out.append(table)
    return out, body.end - start


def _table(body: Body, element: Element, start: int) -> tuple[Columns, int]:
    """Return the columns of an element that begins at a unit, and where the next one begins."""
    count = element.count
    if not element.properties:
        return {}, start  # rows of nothing, however many
    short = f"it should have {count_of(count, 'row')} of '{element.name}'"
    least = sum(body.width(p.length_type or p.type) for p in element.properties)
    if start + least * count > body.end:
        raise cut_off(short)
    if not any(p.length_type for p in element.properties):
        rows = _Rows(start + least * np.arange(count), [], [], start + least * count)
    else:
        rows = _rows_of_lists(body, element, start, short)
    return _columns(body, element, rows), rows.stop


class _Rows(NamedTuple):
    """Where the rows of an element are, in units."""

    begin: Places  # (rows,)
    lists: list[Places]  # where the values of each list begin, (rows,)
    sizes: list[Places]  # how many each has, (rows,)
    stop: int  # where the last row ends


def _rows_of_lists(body: Body, element: Element, start: int, short: str) -> _Rows:
    """Walk through rows whose lists say how long they are, one after the other."""
    steps: list[tuple[int, str, int, int]] = []  # of each list: what is before it, and its types
    gap = 0
    for p in element.properties:
        if p.length_type:
            steps.append((gap, p.length_type, body.width(p.length_type), body.width(p.type)))
        gap = 0 if p.length_type else gap + body.width(p.type)
    places: list[int] = []
    at, end, length_at = start, body.end, body.length
    for _ in range(element.count):
        places.append(at)
        for before, kind, width, value_width in steps:
            at += before
            length = length_at(at, kind) if at + width <= end else -1
            if length < 0:
                raise cut_off(short)
            at += width
            places += (at, length)
            at += length * value_width
        at += gap
    if at > end:
        raise cut_off(short)
    table = np.array(places, np.intp).reshape(element.count, 1 + 2 * len(steps)).T
    return _Rows(table[0], list(table[1::2]), list(table[2::2]), at)


def _columns(body: Body, element: Element, rows: _Rows) -> Columns:
    out: Columns = {}
    at = rows.begin
    lists = iter(zip(rows.lists, rows.sizes, strict=True))
    for p in element.properties:
        width = body.width(p.type)
        if p.length_type:
            begin, sizes = next(lists)
            first = np.repeat(begin - width * (np.cumsum(sizes) - sizes), sizes)
            values = body.numbers(first + width * np.arange(len(first)), p.type)
            out[p.name] = Lists(values, sizes)
            at = begin + width * sizes
        else:
            out[p.name] = body.numbers(at, p.type)
            at = at + width
    return out
