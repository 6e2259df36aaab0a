"""The scenarios of numerical stability: each a scene, and a scale that makes it harder and harder.

In comes a scale; out goes a `Scene`. Every sweep begins where nothing is hard. What each is to
show, and at which scale a method gives way, is worked out in the documentation.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from ...scene import Scene
from . import scenes


@dataclass(frozen=True)
class Scenario:
    """A scene to be swept over a scale."""

    name: str  # in snake case
    title: str
    scale_name: str  # what the scale means
    unit: str  # of the scale; empty where it has none
    explanation: str  # for a student, in one sentence
    scales: tuple[float, ...]  # from harmless to extreme
    build: Callable[[float, int, int], Scene]  # of the scale, and the picture's width and height
    # Whether every ray crosses the scene's surfaces an odd number of times (the camera is inside a
    # closed one) or an even one (outside); None where that is not known beforehand.
    odd: bool | None = None
    across: float | None = None  # of a row of a map: the value of its other scale
    width: int = 32  # of the picture, in pixels
    height: int = 24


@dataclass(frozen=True)
class Map:
    """Two scales at once: a scenario for each value of the second."""

    name: str
    title: str
    explanation: str
    across_name: str
    rows: tuple[Scenario, ...]


_FAR = (0.0, 1e3, 148376.0, 1e6, 1e8, 1e10, 1e12, 1e14, 1e15)

SCENARIOS: tuple[Scenario, ...] = (
    Scenario(
        *("far_from_origin", "Far from the origin", "distance", "m"),
        "A small sphere far from the world's origin: its coordinates have few digits left for it.",
        _FAR,
        scenes.far_from_origin,
        odd=True,
    ),
    Scenario(
        *("far_corners", "Corners and edges, far away", "distance", "m"),
        "Rays at the corners and edges of a closed surface, which moves away from the origin.",
        _FAR,
        scenes.far_corners,
        odd=True,
        width=24,
        height=18,
    ),
    Scenario(
        *("corners_and_edges", "Corners and edges", "farthest / nearest corner", ""),
        "Rays at the corners and edges of a closed surface, where neighbours must agree whose "
        "the ray is.",
        (1.0, 1.5, 6.0, 100.0, 1e4, 1e8, 1e12),
        scenes.corners_and_edges,
        odd=True,
    ),
    Scenario(
        *("closed_fan", "Closed fan", "triangles", ""),
        "Ever more triangles meet in one corner, and rays pass through it and along its edges.",
        (4, 8, 16, 32, 64, 128),
        scenes.closed_fan,
        odd=True,
    ),
    Scenario(
        *("integer_cube", "Integers, perspective", "cells per side", ""),
        "Cube and rays are integers, so that rays meet edges and corners exactly.",
        (1, 2, 4, 8),
        scenes.integer_cube,
        odd=True,
    ),
    Scenario(
        *("integer_cube_ortho", "Integers, orthographic", "cells per side", ""),
        "As before, from outside and along the cube's sides: outlines are met exactly, too.",
        (1, 2, 4, 8),
        scenes.integer_cube_ortho,
        odd=False,
    ),
    Scenario(
        *("degenerate_faces", "Doubled and empty faces", "copies of each face", ""),
        "Every face again and again in the same plane, among faces without an area.",
        (0, 1, 2, 3),
        scenes.degenerate_faces,
    ),
    Scenario(
        *("needles", "Needles", "length / width", ""),
        "A strip of ever thinner triangles: their area is lost before their length is.",
        (1e1, 1e3, 1e5, 1e7, 1e9, 1e11, 1e12, 1e13, 1e15),
        scenes.needles,
        odd=True,
    ),
    Scenario(
        *("grazing", "Grazing rays", "height", "m"),
        "A plane seen along itself, from ever closer above it.",
        (1.0, 1e-1, 1e-3, 1e-5, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15, 1e-16),
        scenes.grazing,
    ),
    Scenario(
        *("close_planes", "Two planes, one before the other", "gap", "ulp"),
        "Two planes 5 m away, ever closer: the nearer one is to be seen, by the last digits of t.",
        (2.0**40, 2.0**30, 2.0**20, 1024, 64, 16, 4, 2, 1, 0),
        scenes.close_planes,
        odd=False,
    ),
    Scenario(
        *("tiny", "Tiny", "scale", ""),
        "A sphere and all around it scaled down: products of lengths fall below the least number.",
        (1, 1e-6, 1e-12, 1e-20, 1e-38, 1e-60, 1e-80, 1e-110, 1e-150, 1e-200, 1e-300),
        scenes.uniform_scale,
        odd=True,
    ),
    Scenario(
        *("huge", "Huge", "scale", ""),
        "A sphere and all around it scaled up: products of lengths exceed the greatest number.",
        (1, 1e6, 1e10, 1e20, 1e38, 1e60, 1e80, 1e110, 1e150, 1e200, 1e300),
        scenes.uniform_scale,
        odd=True,
    ),
    Scenario(
        *("far_camera", "Distant camera", "distance / size", ""),
        "A camera of ever longer focal length, ever farther from a sphere of one metre.",
        (1e1, 1e3, 1e5, 1e6, 1e8, 1e10, 1e12, 1e14, 1e15),
        scenes.far_camera,
        odd=False,
    ),
    Scenario(
        *("narrow_view", "Narrow angle of view", "angle", "rad"),
        "A rough surface through an ever longer lens: its rays lie ever closer to one another.",
        (1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14),
        scenes.narrow_view,
        odd=True,
    ),
    Scenario(
        *("wide_view", "Wide angle of view", "180° - angle", "degrees"),
        "A rough surface through an ever wider lens: its rays come to lie in one plane.",
        (90.0, 10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9),
        scenes.wide_view,
        odd=True,
    ),
    Scenario(
        *("ortho_small", "Small orthographic scale", "width", "m"),
        "An orthographic picture of ever smaller width: rays come to lie in one.",
        (1.0, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 1e-14, 1e-16, 1e-20),
        scenes.ortho_scale,
        width=24,
        height=18,
    ),
    Scenario(
        *("ortho_large", "Large orthographic scale", "width", "m"),
        "An orthographic picture of ever greater width: depths are lost beside it.",
        (1.0, 1e3, 1e6, 1e8, 1e10, 1e12, 1e14, 1e16, 1e18, 1e20),
        scenes.ortho_scale,
    ),
    Scenario(
        *("squashed", "Pressed flat", "thickness", ""),
        "A sphere mirrored and pressed flat by its object's matrix: front and back close in.",
        (1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-16, 1e-30, 0.0),
        scenes.squashed,
        odd=False,
    ),
    Scenario(
        *("sheared", "Sheared", "shear", ""),
        "A sphere mirrored and sheared by its object's matrix, seen from inside.",
        (1.0, 1e3, 1e6, 1e9, 1e12, 1e15),
        scenes.sheared,
        odd=True,
    ),
    Scenario(
        *("stored_float32", "Stored in float32", "offset", "m"),
        "A mesh far from its object's own origin, stored in float32 as Blender does.",
        (0.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7),
        scenes.stored_float32,
        odd=False,
    ),
    Scenario(
        *("non_finite", "Not finite", "share of corners", ""),
        "Corners that the object's matrix takes to infinity: their triangles are refused and "
        "counted, and all else is seen.",
        (0.0, 0.01, 0.1, 0.5, 1.0),
        scenes.non_finite,
    ),
)


def _map(
    name: str,
    title: str,
    explanation: str,
    scale_name: str,
    scales: tuple[float, ...],
    across_name: str,
    builds: dict[float, Callable[[float, int, int], Scene]],
) -> Map:
    words = name, title, scale_name, "", explanation
    rows = (Scenario(*words, scales, build, None, x, 16, 12) for x, build in builds.items())
    return Map(name, title, explanation, across_name, tuple(rows))


_SIZES = 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6
_ANGLES = 1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12

MAPS: tuple[Map, ...] = (
    _map(
        *("size_and_distance", "Size and distance"),
        "A sphere of some size, at some distance from the world's origin, with the camera inside.",
        "distance from the origin in m",
        tuple(10.0**e for e in range(0, 17, 2)),
        "size in m",
        {size: partial(scenes.far_from_origin, size=size) for size in _SIZES},
    ),
    _map(
        *("angle_and_aspect", "Angle and aspect"),
        "A strip of triangles of some length over width, seen at some angle to its plane.",
        "length / width",
        tuple(10.0**e for e in range(0, 15, 2)),
        "angle in radians",
        {angle: partial(scenes.needles, angle=angle) for angle in _ANGLES},
    ),
)
ALL: tuple[Scenario, ...] = (*SCENARIOS, *(row for some in MAPS for row in some.rows))
