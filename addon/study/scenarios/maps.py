"""Maps of stability: scenes with two scales at once."""

from __future__ import annotations

from functools import partial

from . import shapes, views
from .scenario import MAP_HEIGHT, MAP_WIDTH, Build, Map, Scenario


def _map_rows(
    name: str,
    title: str,
    explanation: str,
    scale_name: str,
    scales: tuple[float, ...],
    builds: dict[float, Build],
    odd: bool | None,
) -> tuple[Scenario, ...]:
    return tuple(
        Scenario(
            name,
            title,
            explanation,
            scale_name,
            "",
            scales,
            build,
            odd,
            across,
            MAP_WIDTH,
            MAP_HEIGHT,
        )
        for across, build in builds.items()
    )


def _map(name, title, explanation, scale_name, scales, across_name, builds, odd) -> Map:
    rows = _map_rows(name, title, explanation, scale_name, scales, builds, odd)
    return Map(name, title, explanation, across_name, rows)


MAPS: tuple[Map, ...] = (
    _map(
        "size_and_distance",
        "Size and distance",
        "A sphere of some size, at some distance from the world's origin, with the camera inside.",
        "distance from the origin in m",
        tuple(10.0**e for e in range(0, 17, 2)),
        "size in m",
        {
            size: partial(views.far_from_origin, size=size)
            for size in (1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6)
        },
        None,
    ),
    _map(
        "angle_and_aspect",
        "Angle and aspect",
        "A strip of triangles of some length over width, seen at some angle to its plane.",
        "length / width",
        tuple(10.0**e for e in range(0, 15, 2)),
        "angle in radians",
        {
            angle: partial(shapes.needles, angle=angle)
            for angle in (1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
        },
        None,
    ),
)
