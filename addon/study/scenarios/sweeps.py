"""The scenarios of numerical stability: each a scene, and a scale that makes it harder and harder.

In comes a scale; out goes a `Scene`. Every sweep begins where nothing is hard. What each is to
show, and at which scale a method gives way, is worked out in the documentation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from . import shapes, views
from .maps import MAPS
from .scenario import QUICK_HEIGHT, QUICK_WIDTH, Scenario

_FAR = (0.0, 1e3, 148376.0, 1e6, 1e8, 1e10, 1e12, 1e14, 1e15)

SCENARIOS: tuple[Scenario, ...] = (
    Scenario(
        "far_from_origin",
        "Far from the origin",
        "A small sphere far from the world's origin: its coordinates have few digits left for it.",
        "distance",
        "m",
        _FAR,
        views.far_from_origin,
        odd=True,
    ),
    Scenario(
        "far_corners",
        "Corners and edges, far away",
        "Rays at the corners and edges of a closed surface, which moves away from the origin.",
        "distance",
        "m",
        _FAR,
        views.far_corners,
        odd=True,
        width=24,
        height=18,
    ),
    Scenario(
        "corners_and_edges",
        "Corners and edges",
        "Rays at the corners and edges of a closed surface, where neighbours must agree whose "
        "the ray is.",
        "farthest / nearest corner",
        "",
        (1.0, 1.5, 6.0, 100.0, 1e4, 1e8, 1e12),
        shapes.corners_and_edges,
        odd=True,
    ),
    Scenario(
        "closed_fan",
        "Closed fan",
        "Ever more triangles meet in one corner, and rays pass through it and along its edges.",
        "triangles",
        "",
        (4, 8, 16, 32, 64, 128),
        shapes.closed_fan,
        odd=True,
    ),
    Scenario(
        "integer_cube",
        "Whole numbers, perspective",
        "Cube and rays are whole numbers, so that rays meet edges and corners exactly.",
        "cells per side",
        "",
        (1, 2, 4, 8),
        shapes.integer_cube,
        odd=True,
    ),
    Scenario(
        "integer_cube_ortho",
        "Whole numbers, orthographic",
        "As before, from outside and along the cube's sides: outlines are met exactly, too.",
        "cells per side",
        "",
        (1, 2, 4, 8),
        shapes.integer_cube_ortho,
        odd=False,
    ),
    Scenario(
        "degenerate_faces",
        "Doubled and empty faces",
        "Every face again and again in the same plane, among faces without an area.",
        "copies of each face",
        "",
        (0, 1, 2, 3),
        shapes.degenerate_faces,
    ),
    Scenario(
        "needles",
        "Needles",
        "A strip of ever thinner triangles: their area is lost before their length is.",
        "length / width",
        "",
        (1e1, 1e3, 1e5, 1e7, 1e9, 1e11, 1e12, 1e13, 1e15),
        shapes.needles,
        odd=True,
    ),
    Scenario(
        "grazing",
        "Grazing rays",
        "A plane seen along itself, from ever closer above it.",
        "height",
        "m",
        (1.0, 1e-1, 1e-3, 1e-5, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15, 1e-16),
        shapes.grazing,
    ),
    Scenario(
        "close_planes",
        "Two planes, one before the other",
        "Two planes 5 m away, ever closer: the nearer one is to be seen, by the last digits of t.",
        "gap",
        "ulp",
        (2.0**40, 2.0**30, 2.0**20, 1024, 64, 16, 4, 2, 1, 0),
        shapes.close_planes,
        odd=False,
    ),
    Scenario(
        "tiny",
        "Tiny",
        "A sphere and all around it scaled down: products of lengths fall below the least number.",
        "scale",
        "",
        (1, 1e-6, 1e-12, 1e-20, 1e-38, 1e-60, 1e-80, 1e-110, 1e-150, 1e-200, 1e-300),
        views.uniform_scale,
        odd=True,
    ),
    Scenario(
        "huge",
        "Huge",
        "A sphere and all around it scaled up: products of lengths exceed the greatest number.",
        "scale",
        "",
        (1, 1e6, 1e10, 1e20, 1e38, 1e60, 1e80, 1e110, 1e150, 1e200, 1e300),
        views.uniform_scale,
        odd=True,
    ),
    Scenario(
        "far_camera",
        "Distant camera",
        "A camera of ever longer focal length, ever farther from a sphere of one metre.",
        "distance / size",
        "",
        (1e1, 1e3, 1e5, 1e6, 1e8, 1e10, 1e12, 1e14, 1e15),
        views.far_camera,
        odd=False,
    ),
    Scenario(
        "narrow_view",
        "Narrow angle of view",
        "A rough surface through an ever longer lens: its rays lie ever closer to one another.",
        "angle",
        "rad",
        (1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14),
        views.narrow_view,
        odd=True,
    ),
    Scenario(
        "wide_view",
        "Wide angle of view",
        "A rough surface through an ever wider lens: its rays come to lie in one plane.",
        "180° - angle",
        "degrees",
        (90.0, 10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9),
        views.wide_view,
        odd=True,
    ),
    Scenario(
        "ortho_small",
        "Small orthographic scale",
        "An orthographic picture of ever smaller width: rays come to lie in one.",
        "width",
        "m",
        (1.0, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 1e-14, 1e-16, 1e-20),
        views.ortho_scale,
        width=24,
        height=18,
    ),
    Scenario(
        "ortho_large",
        "Large orthographic scale",
        "An orthographic picture of ever greater width: depths are lost beside it.",
        "width",
        "m",
        (1.0, 1e3, 1e6, 1e8, 1e10, 1e12, 1e14, 1e16, 1e18, 1e20),
        views.ortho_scale,
    ),
    Scenario(
        "squashed",
        "Pressed flat",
        "A sphere mirrored and pressed flat by its object's matrix: front and back close in.",
        "thickness",
        "",
        (1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-16, 1e-30, 0.0),
        views.squashed,
        odd=False,
    ),
    Scenario(
        "sheared",
        "Sheared",
        "A sphere mirrored and sheared by its object's matrix, seen from inside.",
        "shear",
        "",
        (1.0, 1e3, 1e6, 1e9, 1e12, 1e15),
        views.sheared,
        odd=True,
    ),
    Scenario(
        "stored_float32",
        "Stored in float32",
        "A mesh far from its object's own origin, stored in float32 as Blender does.",
        "offset",
        "m",
        (0.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7),
        views.stored_float32,
        odd=False,
    ),
    Scenario(
        "non_finite",
        "Not finite",
        "Corners that the object's matrix takes to infinity: their triangles are refused and "
        "counted, and all else is seen.",
        "share of corners",
        "",
        (0.0, 0.01, 0.1, 0.5, 1.0),
        shapes.non_finite,
    ),
)


ALL: tuple[Scenario, ...] = (*SCENARIOS, *(row for some in MAPS for row in some.rows))


def quick(scenarios: Sequence[Scenario] = ALL) -> tuple[Scenario, ...]:
    """Return the scenarios with their first, middle and last scale only, in small pictures.

    Of a map's rows, too, the first, the middle and the last.
    """
    rows = {name: [s for s in scenarios if s.name == name] for name in {s.name for s in scenarios}}
    return tuple(
        replace(s, scales=_ends_and_middle(s.scales), width=QUICK_WIDTH, height=QUICK_HEIGHT)
        for s in scenarios
        if s in _ends_and_middle(rows[s.name])
    )


def _ends_and_middle(some: Sequence) -> tuple:
    return tuple(some[k] for k in sorted({0, len(some) // 2, len(some) - 1}))
