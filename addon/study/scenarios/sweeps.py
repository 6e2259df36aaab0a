"""Reads the scenarios of numerical stability: each a scene, and a scale that makes it ever harder.

`sweeps.toml` lists them, and says what each of its words means. The documentation works out what
each is to show, and at which scale a method gives way.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ...files.checked_json import Content
from ...scene import Scene
from . import scenes


@dataclass(frozen=True)
class Scenario:
    """A scene to be swept over a scale: `sweeps.toml` says what its words mean."""

    name: str
    title: str
    scale_name: str
    explanation: str
    scales: tuple[float, ...]
    build: Callable[[float, int, int], Scene]  # of the scale, and the picture's width and height
    unit: str = ""  # of the scale; empty where it has none
    odd: bool | None = None  # None where it is not known beforehand
    width: int = 32  # of the picture, in pixels
    height: int = 24

    @property
    def scale_and_unit(self) -> str:
        """The scale's name, and its unit if it has one."""
        return f"{self.scale_name}, {self.unit}" if self.unit else self.scale_name


def _scenario(listed: Content) -> Scenario:
    build = getattr(scenes, listed.get("build") or listed["name"])
    return Scenario(**listed | {"scales": tuple(listed["scales"]), "build": build})


_LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SCENARIOS: tuple[Scenario, ...] = tuple(map(_scenario, _LISTED["scenario"]))
BY_NAME = {scenario.name: scenario for scenario in SCENARIOS}
