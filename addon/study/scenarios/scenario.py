"""What a scenario is: a scene, and a scale that makes it harder and harder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...scene import Scene

WIDTH, HEIGHT = 32, 24  # pixels, so rays of a scene
MAP_WIDTH, MAP_HEIGHT = 16, 12
QUICK_WIDTH, QUICK_HEIGHT = 12, 9

Build = Callable[[float, int, int], Scene]


@dataclass(frozen=True)
class Scenario:
    """A scene to be swept over a scale.

    Parameters
    ----------
    name : str
        In snake case.
    title, explanation : str
        For a student; the explanation is one sentence.
    scale_name, unit : str
        What the scale means; the unit is empty where it has none.
    scales : tuple of float
        From harmless to extreme.
    build : callable
        Takes the scale, and width and height of the picture in pixels; returns the Scene.
    odd : bool, optional
        Whether every ray crosses the scene's surfaces an odd number of times (the camera is inside
        a closed one) or an even one (outside); None where that is not known beforehand.
    across : float, optional
        Of a row of a map: the value of its other scale.
    width, height : int
        Of the picture, in pixels.
    """

    name: str
    title: str
    explanation: str
    scale_name: str
    unit: str
    scales: tuple[float, ...]
    build: Build
    odd: bool | None = None
    across: float | None = None
    width: int = WIDTH
    height: int = HEIGHT


@dataclass(frozen=True)
class Map:
    """Two scales at once: a scenario for each value of the second."""

    name: str
    title: str
    explanation: str
    across_name: str
    rows: tuple[Scenario, ...]
