"""What a plot shows, read from its SVG alone: where words are, and what marks stand for."""

from __future__ import annotations

import math
import re
from itertools import combinations
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

_SVG = "{http://www.w3.org/2000/svg}"
_TAGS = {"svg", "title", "desc", "rect", "text", "circle", "polyline", "polygon", "path", "g"}
_LETTER, _BOLD, _HIGH = 0.64, 0.72, 0.8  # of a letter, in sizes of its font: widths, height


class Drawn(NamedTuple):
    """An element, where it is in the picture."""

    tag: str
    attributes: dict[str, str]
    words: str  # of a text; the title of any other
    x: float
    y: float


class Plot:
    """A picture that stands by itself: no scripts, no addresses, with words for those who hear."""

    def __init__(self, svg: str):
        root = ElementTree.fromstring(svg)
        assert root.tag == f"{_SVG}svg" and [e.tag for e in root[:2]] == [
            f"{_SVG}title",
            f"{_SVG}desc",
        ]
        assert root[0].text and root[1].text and root.get("role") == "img"
        self.width, self.height = map(float, root.get("viewBox").split()[2:])
        self.about = root[0].text
        self.elements: list[Drawn] = []
        self._read(root, 0.0, 0.0)
        self.texts = [e for e in self.elements if e.tag == "text"]

    def _read(self, parent, x: float, y: float) -> None:
        for e in parent:
            tag, held = e.tag.removeprefix(_SVG), dict(e.attrib)
            assert tag in _TAGS, tag
            assert not any(
                k.startswith("on") or "href" in k or "url(" in v for k, v in held.items()
            )
            moved = re.match(r"translate\((\S+) (\S+)\)", held.get("transform", ""))
            dx, dy = map(float, moved.groups()) if moved else (0.0, 0.0)
            at = [float(held.get(k, held.get(f"c{k}", 0))) for k in "xy"]
            words = e.text if tag == "text" else e.findtext(f"{_SVG}title")
            self.elements.append(Drawn(tag, held, words or "", x + dx + at[0], y + dy + at[1]))
            self._read(e, x + dx, y + dy)

    def titled(self, tag: str) -> list[Drawn]:
        """Return the elements that say what they are where one points at them."""
        return [e for e in self.elements if e.tag == tag and e.words]

    def text(self, words: str) -> Drawn:
        [found] = [t for t in self.texts if t.words == words]
        return found

    def said(self) -> str:
        return " ".join(t.words for t in self.texts)

    def assert_legible(self) -> None:
        """All words lie in the picture, and none over others, as far as is known without a font."""
        boxes = [corners(t) for t in self.texts]
        for text, box in zip(self.texts, boxes, strict=True):
            assert text.words and (box >= 0).all() and (box <= (self.width, self.height)).all(), (
                text
            )
        low, high = (np.array([f(b, axis=0) for b in boxes]) for f in (np.min, np.max))
        near = (low[:, None] < high).all(-1) & (low < high[:, None]).all(-1)
        for j, k in combinations(range(len(boxes)), 2):
            if near[j, k]:
                assert apart(boxes[j], boxes[k]), (self.texts[j].words, self.texts[k].words)


def corners(text: Drawn) -> np.ndarray:
    """The box (4, 2) of a text, turned as the text is."""
    held = text.attributes
    size = float(held["font-size"])
    letter = _BOLD if held.get("font-weight") == "bold" else _LETTER
    wide = size * sum(1.0 if "\u2e80" < c < "\ufff0" else letter for c in text.words)
    left = {"start": 0.0, "middle": -wide / 2, "end": -wide}[held["text-anchor"]]
    top, bottom = -_HIGH * size, 0.1 * size
    box = np.array([(left, top), (left + wide, top), (left + wide, bottom), (left, bottom)])
    box += text.x, text.y
    if turn := re.match(r"rotate\((\S+) (\S+) (\S+)\)", held.get("transform", "")):
        degrees, *centre = map(float, turn.groups())
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        box = (box - centre) @ [[c, s], [-s, c]] + centre
    return box


def apart(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether a line lies between two convex shapes: along a side of one of them."""
    for box in (one, other):
        for side in np.roll(box, -1, axis=0) - box:
            normal = side[::-1] * (1, -1)
            a, b = one @ normal, other @ normal
            if a.max() <= b.min() or b.max() <= a.min():
                return True
    return False


def scale(ticks: list[tuple[float, float]], log: bool):
    """The function from a place to the number there, found from the numbers along an axis."""
    places, values = np.array(sorted(ticks)).T
    values = np.log(values) if log else values
    slope, start = np.polyfit(places, values, 1)
    assert np.abs(slope * places + start - values).max() <= 1e-3 * np.ptp(values)
    return lambda at: (math.exp if log else float)(slope * at + start)
