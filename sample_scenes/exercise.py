"""The exercise's four figures: orthographic camera, perspective camera, plane, triangle."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin
from typing import Any

import bpy

from . import parts, solids

EYE, TARGET = (7.5, -9.0, 6.2), (0.1, -0.05, 0.6)


def exercise_orthographic() -> None:
    """Constant shading, orthographic camera: parallels stay parallel, distance changes no size."""
    _start("Exercise: Orthographic", 640, 480)
    parts.camera(EYE, TARGET, ortho_scale=8.6)
    _solids()


def exercise_perspective() -> None:
    """The very same solids by a perspective camera at the same place: parallels converge."""
    _start("Exercise: Perspective", 640, 480)
    parts.camera(EYE, TARGET, lens=50)
    _solids()


def exercise_plane() -> None:
    """Ray/plane: an infinite plane up to its horizon; solids stand on it, sink into it, cut it."""
    _start("Exercise: Plane", 640, 360, colours="OBJECT", sky="#bfe3f2")
    parts.camera((0, -9, 1.9), (0, 0, 1.25), lens=40, clip_end=1000)
    square = [(-400, -400, 0), (400, -400, 0), (400, 400, 0), (-400, 400, 0)]  # for Blender's eyes
    ground = parts.add("Infinite Plane", solids.polygons(square, [(0, 1, 2, 3)]), "#7fb069")
    ground.reference_tracer.infinite_plane = True
    parts.add("Cube On The Plane", solids.box(1.3, 1.3, 1.3), "#e6aa68", (-3.1, 0.6, 0), (0, 0, 30))
    parts.add("Sphere Half Below", solids.sphere(1.1, 64, 32), "#ca3c25", (-0.9, 1.2, 0))
    parts.add("Torus Through It", solids.torus(1.1, 0.28), "#1d7874", (1.6, -0.4, 0), (75, 0, 25))
    parts.add("Cone On Its Tip", solids.cone(0.02, 0.9, 2.4, 48), "#5b4b8a", (3.6, 1.5, -0.4))
    parts.add("Tilted Slab", solids.box(0.35, 1.2, 4.0), "#2e4057", (-5.0, 5.5, -1.0), (0, 35, 20))
    parts.add("Far Tower", solids.cone(1.6, 0.9, 7, 24), "#8d6a9f", (14, 42, 0))
    parts.add("Far Dome", solids.sphere(4, 48, 24), "#d98880", (-16, 50, 0))


def exercise_triangle() -> None:
    """Ray/triangle: a fan with shared edges, three that pierce one another, three in a ring.

    Each of the ring is in front of the next: no order of painting them whole is right.
    """
    _start("Exercise: Triangle", 640, 360, sky="#f6f1e7")
    parts.camera((0, -12, 0), (0, 0, 0), lens=50)
    wheel = ["#e63946", "#f4a261", "#e9c46a", "#2a9d8f", "#457b9d", "#6d597a"]
    rim = [(1.15 * cos(k * pi / 3), 0, 1.15 * sin(k * pi / 3)) for k in range(6)]
    fan = solids.polygons(
        [(0.1, -0.5, 0.2), *rim], [(0, 1 + k, 1 + (k + 1) % 6) for k in range(6)], wheel
    )
    parts.link(bpy.data.objects.new("Fan With Shared Edges", fan), (-2.75, 0, 0))
    wall = [(-1.1, 0.1, -1.1), (1.15, 0.1, -1.0), (0, -0.2, 1.25)]
    dart = [(-1.35, -1.0, 0.65), (-1.3, -1.0, -0.15), (1.45, 1.2, -0.15)]
    spear = [(1.15, -1.0, -0.75), (1.35, -0.8, 0.3), (-1.4, 1.0, 0.75)]
    for k, (corners, css) in enumerate(((wall, "#264653"), (dart, "#e76f51"), (spear, "#2a9d8f"))):
        _triangle(f"Piercing {k + 1}", corners, css, 0)
    arrow = [(-1.3, -0.5, -0.45), (0.95, 0.5, -0.9), (0.95, 0.5, -0.1)]
    for k, css in enumerate(("#ffb703", "#219ebc", "#8e3b5c")):
        c, s = cos(2 * pi * k / 3), sin(2 * pi * k / 3)
        spun = [(c * x - s * z, y, s * x + c * z) for x, y, z in arrow]
        _triangle(f"Ring {k + 1}", spun, css, 2.75)


def _start(*args: Any, **options: Any) -> None:
    """Begin a scene that stores the exercise's own method."""
    parts.start(*args, **options).reference_tracer.method = "textbook"


def _triangle(name: str, corners: Sequence[Sequence[float]], css: str, x: float) -> None:
    mesh = solids.polygons(corners, [(0, 1, 2)], [css])
    parts.link(bpy.data.objects.new(name, mesh), (x, 0, 0))


def _solids() -> None:
    """Add a chessboard with a row of columns and one solid of each kind."""
    floor = solids.tiles(8, 0.75, "#f4efe6", "#c9bfae")
    parts.link(bpy.data.objects.new("Chessboard", floor))
    for k in range(5):
        parts.add(f"Column {k + 1}", solids.box(0.5, 0.5, 1.9), "#4a7c9b", (-2.2, 2.2 - 1.1 * k, 0))
    parts.add("Sphere", solids.sphere(0.7, 48, 24), "#d1495b", (0.2, 0.3, 0.7), tones=1)
    parts.add("Cube", solids.box(1.0, 1.0, 1.0), "#edae49", (1.7, -1.2, 0), (0, 0, 18))
    parts.add("Cone", solids.cone(0.6, 0, 1.6, 24), "#66a182", (1.8, 1.5, 0))
    parts.add("Torus", solids.torus(0.55, 0.2), "#8d5a97", (-0.4, -1.7, 0.2))
    parts.add("Icosahedron", solids.icosphere(0.6), "#2e4057", (0.1, 2.2, 0.5))


SCENES = (exercise_orthographic, exercise_perspective, exercise_plane, exercise_triangle)
