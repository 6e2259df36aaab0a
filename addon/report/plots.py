"""Draws plots as SVG: scales with round numbers, axes, marks, lines and words.

A plot is text that every browser draws, without a library. Each function returns elements of it, in
pixels, y down.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from .svg import element as element
from .svg import said as said
from .svg import width_of as width_of

WIDTH, HEIGHT = 1920, 1080  # what a projector shows
# Sizes of a title, the labels and the numbers at the axes: legible from the back row, or as large
# as small multiples have room for.
LARGE, SMALL = (32.0, 27.0, 23.0), (22.0, 19.0, 17.0)
INK, GREY, FAINT = "#222222", "#707070", "#c8c8c8"

_LINE = 1.25  # from one line of words to the next, in sizes of the font
Place = tuple[float, float]
Box = tuple[float, float, float, float]  # left, top, width, height


def picture(width: float, height: float, title: str, about: str, inside: str) -> str:
    """Return a whole white picture; its title and what it is about are for those who hear it."""
    head = said("title", title), said("desc", about)
    paper = element("rect", width=width, height=height, fill="white")
    drawn = element(
        "svg",
        *head,
        paper,
        inside,
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {width:g} {height:g}",
        role="img",
        font_family="sans-serif",
    )
    return drawn + "\n"


def text(
    at: Place, words: str, size: float, color: str = INK, anchor: str = "start", **more: str
) -> str:
    """Return lines of words with their middle at a place, where they start (or end)."""
    lines = words.split("\n")
    x, middle = at
    foot = middle + size * (0.35 - _LINE * (len(lines) - 1) / 2)  # of the first line's letters
    return "".join(
        said(
            "text",
            words,
            x=x,
            y=foot + _LINE * size * k,
            font_size=size,
            fill=color,
            text_anchor=anchor,
            **more,
        )
        for k, words in enumerate(lines)
        if words
    )


def turned(at: Place, words: str, size: float, degrees: float, anchor: str) -> str:
    """Return a line of words that is turned about its place."""
    turn = "rotate({:g} {:.2f} {:.2f})".format(degrees, *at)
    return text(at, words, size, INK, anchor, transform=turn)


def mark(at: Place, radius: float, color: str, hollow: bool = False, title: str = "") -> str:
    """Return a round mark, which says its title where it is pointed at."""
    x, y = at
    return element(
        "circle",
        said("title", title) if title else "",
        cx=x,
        cy=y,
        r=radius,
        fill="white" if hollow else color,
        stroke=color,
        stroke_width=0.3 * radius,
    )


def line(
    places: Sequence[Place], color: str, width: float, dotted: bool = False, opacity: float = 1
) -> str:
    """Return a line through places."""
    return element(
        "polyline",
        points=" ".join(f"{x:.2f},{y:.2f}" for x, y in places),
        stroke=color,
        stroke_width=width,
        fill="none",
        opacity=opacity,
        stroke_dasharray=f"{1.2 * width:g}" if dotted else "none",
    )


def cell(x: float, y: float, width: float, height: float, color: str, title: str = "") -> str:
    """Return a coloured rectangle, which says its title where it is pointed at."""
    return element(
        "rect",
        said("title", title) if title else "",
        x=x,
        y=y,
        width=width,
        height=height,
        fill=color,
        shape_rendering="crispEdges",  # no seam between cells that touch
    )


class Scale(NamedTuple):
    """What a side of a plot stands for: the numbers at its ends, and those that are written."""

    low: float
    high: float
    ticks: Mapping[float, str]
    log: bool = False

    def share(self, value: float) -> float:
        """Return where a number is: 0 at the low end, 1 at the high one."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


def linear(low: float, high: float) -> Scale:
    """Return a scale with about five to ten round numbers."""
    return Scale(low, high, {v: f"{v:g}" for v in _round(low, high, 8)})


def integers(low: int, high: int) -> Scale:
    """Return a scale with at most nine round integers, written with commas."""
    ticks = [v for v in _round(low, high, 8) if v == round(v)]
    return Scale(low, high, {v: f"{round(v):,}" for v in ticks})


def logarithmic(low: float, high: float) -> Scale:
    """Return a logarithmic scale with about five to ten round numbers."""
    if high < 5 * low:  # there may be no 1, 2 or 5 in between
        ticks = _round(low, high, 6)
    else:
        powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        steps = (1, 2, 5) if high < 500 * low else (1,)
        ticks = [s * 10.0**k for k in powers[:: math.ceil(len(powers) / 10)] for s in steps]
    return Scale(low, high, {v: f"{v:g}" for v in ticks if low <= v <= high}, log=True)


def _round(low: float, high: float, most: int) -> list[float]:
    """Return the multiples between two numbers of 1, 2 or 5 times a power of ten."""
    least = (high - low) / most
    power = 10.0 ** math.floor(math.log10(least))
    step = next(s * power for s in (1, 2, 5, 10) if s * power >= least)
    return [k * step for k in range(math.ceil(low / step), math.floor(high / step) + 1)]


class Axes(NamedTuple):
    """A rectangle of a picture, and what its sides stand for."""

    left: float
    top: float
    width: float
    height: float
    x: Scale
    y: Scale

    def at(self, x: float, y: float) -> Place:
        """Return where a pair of numbers is in the picture."""
        down = 1 - self.y.share(y)
        return self.left + self.width * self.x.share(x), self.top + self.height * down

    def drawn(self, title: str, x: str, y: str = "", small: bool = False) -> str:
        """Return the sides, a faint grid and all that is written: slanted below small axes."""
        of_title, of_labels, of_ticks = SMALL if small else LARGE
        left, bottom, right = self.left, self.top + self.height, self.left + self.width
        above = self.top - 14 - of_title * _LINE * (title.count("\n") + 1) / 2
        wide = max(width_of(words, of_ticks) for words in self.y.ticks.values()) + 12
        deep = max(width_of(words, of_ticks) for words in self.x.ticks.values()) / math.sqrt(2)
        under = bottom + 0.7 * of_labels + (deep + 2 * of_ticks if small else 1.9 * of_ticks)
        beside = left - wide - 10 - 0.7 * of_labels, (self.top + bottom) / 2
        out = [
            text((left - wide * small, above), title, of_title),
            text((left + self.width / 2, under), x, of_labels, anchor="middle"),
            turned(beside, y, of_labels, -90, "middle"),
        ]
        for value, words in self.x.ticks.items():
            at = left + self.width * self.x.share(value)
            slant = (-45, "end") if small else (0, "middle")
            out.append(line([(at, self.top), (at, bottom)], FAINT, 1, opacity=0.6))
            out.append(turned((at, bottom + 1.1 * of_ticks), words, of_ticks, *slant))
        for value, words in self.y.ticks.items():
            at = bottom - self.height * self.y.share(value)
            out.append(line([(left, at), (right, at)], FAINT, 1, opacity=0.6))
            out.append(text((left - 12, at), words, of_ticks, anchor="end"))
        sides = [(left, self.top), (left, bottom), (right, bottom)]
        return "".join(out) + line(sides, FAINT, 1.5)


class Series(NamedTuple):
    """Points of one colour, joined by a line if it has a width."""

    color: str
    points: Sequence[tuple[float, float, str]]  # numbers along x and y, and what a point is
    hollow: bool = False  # hollow marks, a dotted line
    radius: float = 9
    width: float = 0

    @property
    def sample(self) -> str:
        """A mark on a piece of the line, about (0, 0), for the legend."""
        drawn = line([(-20, 0), (20, 0)], self.color, self.width, self.hollow) if self.width else ""
        return drawn + mark((0, 0), self.radius, self.color, self.hollow)


def chart(axes: Axes, series: Iterable[Series]) -> str:
    """Return series drawn over axes, the later ones over the earlier; a point says what it is."""
    out = ""
    for s in series:
        places = [axes.at(x, y) for x, y, _ in s.points]
        if s.width:
            out += line(places, s.color, s.width, s.hollow)
        for at, (*_, words) in zip(places, s.points, strict=True):
            out += mark(at, s.radius, s.color, s.hollow, words)
    return out


def legend(entries: Mapping[str, str], y: float, size: float = LARGE[2]) -> str:
    """Explain marks, drawn about (0, 0), in one row in the middle of the picture's width."""
    side = 1.4 * size  # from the middle of a mark to its words
    widths = [side + width_of(words, size) + 2 * size for words in entries]
    if sum(widths) > WIDTH:
        return legend(entries, y, size * (WIDTH - 1) / sum(widths))
    x, out = WIDTH / 2 - sum(widths) / 2 + size, []
    for (words, drawn), width in zip(entries.items(), widths, strict=True):
        out.append(element("g", drawn, transform=f"translate({x:.1f} {y:.1f})"))
        out.append(text((x + side, y), words, size))
        x += width
    return "".join(out)


def page(title: str, drawn: str) -> str:
    """Return a picture as a page for a browser; an SVG by itself may be opened by an editor."""
    style = "svg { display: block; width: 100%; max-height: 100vh; }"
    head = '<meta charset="utf-8">' + said("title", title) + element("style", style)
    return "<!doctype html>\n" + element("html", head, drawn, lang="en")
