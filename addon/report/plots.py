"""Plots as data: axes, and what is drawn over them, which the page's `chart.js` draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

INK, GREY = "#222222", "#707070"


class Scale(NamedTuple):
    """The scale of a plot's side: the numbers at its ends, and those that are written.

    Its `kind` is "integers" or "log", with round numbers from `least` on (None: from the low end);
    or "named", without. `named` are the numbers that have words of their own.
    """

    low: float
    high: float
    kind: str
    named: Sequence[tuple[float, str]] = ()
    least: float | None = None


class Series(NamedTuple):
    """Points of one colour, with marks of a radius, joined by a line if it has a width."""

    color: str
    points: Sequence[tuple[float, float, str]] = ()  # along x and y, and what a point is
    hollow: bool = False  # hollow marks, a dotted line
    radius: float = 9
    width: float = 0
    opacity: float = 1  # of the line


class Entry(NamedTuple):
    """An entry of a legend: some words beside a mark or a line of a series."""

    words: str
    sample: Series


class Panel(NamedTuple):
    """Axes with their labels, and series over them, the later ones over the earlier."""

    title: str
    along: str
    up: str
    x: Scale
    y: Scale
    series: Sequence[Series]


class Plot(NamedTuple):
    """A picture of panels, below one another or small ones in rows, with one legend.

    Its title and what it is about are for those who hear it.
    """

    title: str
    about: str
    panels: Sequence[Panel]
    legend: Sequence[Entry]
    heading: str = ""
    note: str = ""
    small: bool = False
