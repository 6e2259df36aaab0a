"""The seven scenes of the test bed. None is symmetric; things stand on all sides."""

from __future__ import annotations

import colorsys
from collections.abc import Sequence
from functools import cache

import numpy as np

from . import shapes
from .description import RGBA, Description, Film, Item, Lens, Pose, Shape

Three = Sequence[float]


def placed(
    location: Three = (0, 0, 0), euler: Three = (0, 0, 0), scale: Three = (1, 1, 1)
) -> np.ndarray:
    """Return the matrix (4, 4) of location, XYZ angles in degrees, and scale."""
    x, y, z = np.radians(np.asarray(euler, np.float64))
    c, s = np.cos, np.sin
    about_x = np.array([[1, 0, 0], [0, c(x), -s(x)], [0, s(x), c(x)]])
    about_y = np.array([[c(y), 0, s(y)], [0, 1, 0], [-s(y), 0, c(y)]])
    about_z = np.array([[c(z), -s(z), 0], [s(z), c(z), 0], [0, 0, 1]])
    matrix = np.eye(4)
    matrix[:3, :3] = about_z @ about_y @ about_x * np.asarray(scale, np.float64)
    matrix[:3, 3] = location
    return matrix


def color(number: int) -> RGBA:
    """Return the number's own colour: hues a golden section apart, three brightnesses."""
    hue = (0.11 + number * 0.61803398875) % 1.0
    value = (0.85, 0.55, 0.35)[number % 3]
    return (*(round(c, 4) for c in colorsys.hsv_to_rgb(hue, 0.75, value)), 1.0)


def items(*parts: tuple) -> tuple[Item, ...]:
    """Return items of (name, shape, pose or matrix, further fields), each in its own colour."""
    out = []
    for number, (name, form, where, *more) in enumerate(parts):
        pose = where if isinstance(where, Pose) else Pose(where)
        out.append(Item(name, form, color(number), pose, **(more[0] if more else {})))
    return tuple(out)


def around(rng: np.random.Generator, count: int, near: float, far: float, prefix: str) -> list:
    """Return solids on all sides of the origin, above the floor."""
    out = []
    for n in range(count):
        angle = 2 * np.pi * (n + rng.uniform(-0.3, 0.3)) / count
        r = rng.uniform(near, far)
        size = rng.uniform(0.5, 1.3, 3)
        form = (shapes.box(*size), shapes.ball(size[0], 2), shapes.torus(size[0], 0.3 * size[0]))
        at = r * np.cos(angle), r * np.sin(angle), rng.uniform(1.4, 4.0)
        where = placed(at, rng.uniform(-60, 60, 3))
        out.append((f"{prefix}{n}", form[n % 3], where))
    return out


def shell(rng: np.random.Generator, count: int, radius: float) -> list:
    """Return solids in all directions, below the floor too: a wrong camera sees something."""
    out = []
    golden = np.pi * (3 - np.sqrt(5))
    for n in range(count):
        z = 1 - 2 * (n + 0.5) / count
        r = np.sqrt(1 - z * z)
        at = radius * np.array((r * np.cos(golden * n), r * np.sin(golden * n), z))
        at += rng.uniform(-0.1, 0.1, 3) * radius
        size = radius * rng.uniform(0.05, 0.14, 3)
        form = shapes.box(*size) if n % 2 else shapes.ball(size[0] / 2, 1)
        out.append((f"Sky{n}", form, placed(at, rng.uniform(-60, 60, 3))))
    return out


def solids() -> Description:
    """Return a few solids over a floor, in perspective."""
    rng = np.random.default_rng(1)
    parts = items(
        ("Floor", shapes.floor(34), placed()),
        ("Cube", shapes.box(1.6, 1.2, 1.4), placed((-1.1, 0.4, 0.9), (0, 0, 24))),
        ("Ball", shapes.ball(0.8), placed((1.2, -0.6, 1.0))),
        ("Ring", shapes.torus(0.9, 0.25), placed((0.5, 1.9, 1.3), (70, 20, 10))),
        ("Slab", shapes.box(0.3, 2.0, 2.4), placed((-2.9, 1.6, 1.4), (8, -10, 35))),
        ("Post", shapes.box(0.4, 0.4, 2.2), placed((2.7, 1.3, 1.2), (0, 6, 12))),
        ("Sheet", shapes.floor(1.3), placed((-2.3, -1.3, 0.9), (-100, 8, 30))),
        *around(rng, 7, 9, 14, "Far"),
        *shell(rng, 80, 19),
    )
    eye = Pose(placed((5.2, -6.1, 3.7), (74, 0, 41)))
    other = ("Side", Lens(35.0), Pose(placed((-6.4, -4.0, 2.5), (75, 0, -57))))
    film = Film(384, 216)
    return Description(
        1, "solids", parts, Lens(40.0), film, eye, (0.05, 0.06, 0.08, 1.0), 1, (other,)
    )


def parallel() -> Description:
    """Return solids before an orthographic camera, on a transparent film."""
    rng = np.random.default_rng(2)
    parts = items(
        ("Wall", shapes.box(9, 0.2, 5), placed((0.7, 3.4, 2.6), (0, 0, -12))),
        ("Cube", shapes.box(1.5, 1.5, 1.5), placed((-1.9, -0.5, 1.1), (20, 15, 30))),
        ("Ball", shapes.ball(0.9), placed((1.4, 0.2, 1.3))),
        ("Ring", shapes.torus(1.0, 0.3), placed((-0.2, 1.0, 3.1), (50, 30, 0))),
        ("Post", shapes.box(0.5, 0.7, 2.6), placed((3.2, -1.0, 1.5), (0, 14, 40))),
        *around(rng, 8, 5, 8, "Far"),
        *shell(rng, 70, 17),
    )
    lens = Lens(50.0, parallel=True, ortho_scale=11.0, clip_end=60.0)
    eye = Pose(placed((6.0, -9.0, 6.5), (66, 0, 33)))
    other = ("Above", Lens(parallel=True, ortho_scale=14.0), Pose(placed((0, 0, 20), (3, 5, 17))))
    film = Film(320, 200)
    return Description(2, "parallel", parts, lens, film, eye, (0.1, 0.15, 0.2, 0.5), 1, (other,))


def shifted() -> Description:
    """Return a sensor fitted to the height, shifted, with pixels that are not square, at 50 %."""
    rng = np.random.default_rng(3)
    parts = items(
        ("Floor", shapes.floor(50), placed()),
        ("Cube", shapes.box(1.3, 1.3, 1.9), placed((-0.9, -0.8, 1.1), (0, 0, 15))),
        ("Ball", shapes.ball(0.9), placed((1.0, 0.6, 1.2))),
        ("Ring", shapes.torus(1.1, 0.3), placed((-1.4, 2.4, 1.6), (80, 0, 30))),
        ("Post", shapes.box(0.5, 0.5, 3.4), placed((2.9, 1.6, 1.8), (5, 0, 0))),
        ("Tilted", shapes.box(1.8, 0.4, 0.9), placed((0.3, -2.3, 0.8), (25, 12, -20))),
        ("Sheet", shapes.floor(1.3), placed((-2.6, 0.6, 1.2), (-100, 0, 20))),
        *around(rng, 9, 7, 11, "Far"),
        *shell(rng, 46, 19),
    )
    lens = Lens(22.0, 36.0, 20.0, "VERTICAL", 0.12, -0.08)
    film = Film(720, 400, 50, 1.0, 1.4)
    eye = Pose(placed((4.6, -6.6, 4.4), (72, 0, 34)))
    return Description(3, "shifted", parts, lens, film, eye, (0.3, 0.3, 0.32, 1.0))


def moving() -> Description:
    """Return a camera with a scale on a scaled, moving parent, and objects that move and bend."""
    rng = np.random.default_rng(4)
    cart = placed((2.0, -3.0, 1.0), (10, -8, 25), (2.0, 2.0, 2.0))
    stand = placed((-1.8, 0.9, 1.2), (0, 20, 40), (1.3, 1.3, 1.3))
    at_parenting = np.linalg.inv(placed((-0.7, 0.4, 0.3), (0, 0, 25), (1.3, 1.3, 1.3)))
    mast = shapes.tower(0.6, 8, 0.4)
    parts = items(
        ("Floor", shapes.floor(34), placed()),
        (
            "Runner",
            shapes.box(1.1, 0.8, 0.9),
            Pose(placed((-1.2, -1.1, 0.9)), (0.13, 0.07, 0.02), 0.05),
        ),
        (
            "Roller",
            shapes.torus(0.8, 0.3),
            Pose(placed((1.5, 0.9, 1.3), (60, 0, 0)), (-0.08, 0.1, 0.0)),
        ),
        ("Mast", shapes.bent(mast, 0.22), placed((2.6, 2.4, 0.1), (0, 0, 65)), {"rest": mast}),
        (
            "Child",
            shapes.box(0.9, 1.3, 0.7),
            Pose(placed((0.5, 0.6, 0.7), (10, 0, 0)), parent=stand, parent_inverse=at_parenting),
        ),
        ("Ball", shapes.ball(0.7), placed((0.2, 2.6, 1.0))),
        *around(rng, 8, 9, 14, "Far"),
        *shell(rng, 46, 24),
    )
    own = placed((1.4, -1.6, 1.1), (69, 4, 14), (0.5, 1.5, 0.7))
    eye = Pose(own, parent=cart)
    other = ("Low", Lens(28.0), Pose(placed((-5.5, -5.0, 1.6), (82, 0, -44))))
    lens, film = Lens(35.0), Film(400, 225)
    return Description(4, "moving", parts, lens, film, eye, (0.02, 0.02, 0.03, 1.0), 12.0, (other,))


def modelled() -> Description:
    """Return subdivided cages, warped quads, modifiers, instances, and what is not shown."""
    rng = np.random.default_rng(5)
    cage, slab = (
        shapes.levels(shapes.box(2.0, 1.6, 1.8), 5),
        shapes.levels(shapes.box(1.4, 2.2, 0.8), 5),
    )
    group = placed((1.6, 1.9, 0.5), (0, 15, 50), (1.4, 1.4, 1.4))
    parts = items(
        ("Floor", shapes.floor(34), placed()),
        ("Cage", cage[3], placed((-1.6, 0.0, 1.3), (15, 0, 20)), {"levels": cage, "level": 3}),
        ("Pebble", slab[2], placed((0.7, -1.6, 0.8), (0, 10, -35)), {"levels": slab, "level": 2}),
        ("Cloth", shapes.saddle(3.0, 0.35), placed((-2.8, 2.9, 1.6), (35, 0, 15))),
        (
            "Tower",
            shapes.tower(0.7, 6, 0.45, 0.2),
            placed((3.1, -0.2, 0.1)),
            {"viewport": shapes.tower(0.7, 4, 0.45, 0.2), "plain": shapes.tower(0.7, 1, 0.45)},
        ),
        (
            "Leaf",
            shapes.torus(0.5, 0.2),
            Pose(placed((0.3, 0.4, 1.2), (40, 0, 0)), instancer=group),
        ),
        (
            "Stem",
            shapes.box(0.25, 0.25, 1.6),
            Pose(placed((-0.4, 0.1, 0.8), (0, 12, 0)), instancer=group),
        ),
        (
            "Ghost",
            shapes.box(0.9, 0.9, 0.9),
            placed((-0.2, 0.9, 2.3), (30, 20, 0)),
            {"hidden": True},
        ),
        ("Secret", shapes.ball(0.5, 2), placed((2.2, -1.9, 0.9)), {"hidden": True}),
        (
            "Elsewhere",
            shapes.torus(0.7, 0.25),
            placed((-3.4, -1.2, 1.2), (70, 0, 40)),
            {"other_layer": True},
        ),
        *around(rng, 7, 10, 14, "Far"),
        *shell(rng, 70, 19),
    )
    eye = Pose(placed((5.6, -7.0, 4.6), (71, 0, 38)))
    lens, film = Lens(38.0), Film(400, 225)
    return Description(5, "modelled", parts, lens, film, eye, (0.15, 0.1, 0.1, 1.0))


def many() -> Description:
    """Return 70 objects, 50,000 triangles, a border, and clip distances that cut some of them."""
    rng = np.random.default_rng(6)
    forms: list[Shape] = [
        shapes.ball(1.0, 4),
        shapes.torus(0.9, 0.35, 48, 24),
        shapes.box(1.5, 1.1, 1.7),
    ]
    parts: list[tuple] = [("Floor", shapes.floor(70), placed())]
    for n in range(24):
        where = rng.uniform((-9, -8, 0.9), (9, 15, 3.2))
        scale = np.full(3, rng.uniform(0.6, 1.2))
        parts.append((f"Thing{n}", forms[n % 3], placed(where, rng.uniform(-80, 80, 3), scale)))
    parts[5] = (*parts[5], {"other_layer": True})
    parts[9] = (*parts[9], {"hidden": True})
    parts.append(("Near", shapes.box(1.2, 1.0, 1.0), placed((3.9, -8.2, 4.3), (10, 30, 20))))
    parts += around(rng, 6, 17, 24, "Far")
    parts += shell(rng, 40, 26)
    lens = Lens(24.0, clip_start=4.0, clip_end=27.0)
    film = Film(480, 270, border=(40, 400, 30, 258))
    eye = Pose(placed((6.5, -11.0, 6.2), (68, 3, 27)))
    other = ("Back", Lens(30.0), Pose(placed((-9.0, 17.0, 5.0), (70, 0, 205))))
    return Description(
        6, "many", items(*parts), lens, film, eye, (0.25, 0.35, 0.5, 1.0), 1, (other,)
    )


def room() -> Description:
    """Return a camera inside a room, whose walls and furniture have several material slots."""
    rng = np.random.default_rng(7)
    forms = shapes.box(0.5, 0.4, 0.7), shapes.ball(0.3, 2), shapes.torus(0.3, 0.1)
    inside = [
        (f"Thing{n}", forms[n % 3], placed(rng.uniform((-2.6, -1.4, 0.3), (2.6, 2.1, 2.2)), angles))
        for n, angles in enumerate(rng.uniform(-60, 60, (15, 3)))
    ]
    parts = items(
        (
            "Room",
            shapes.box(7.0, 6.0, 2.8),
            placed((0, 0, 1.4)),
            {"more": tuple(map(color, range(40, 45)))},
        ),
        (
            "Shelf",
            shapes.tower(0.7, 4, 0.5),
            placed((-1.3, 1.9, 0.0), (0, 0, 20)),
            {"more": (color(45), color(46))},
        ),
        ("Table", shapes.box(1.6, 0.9, 0.1), placed((0.9, 0.6, 0.8), (0, 0, -15))),
        *inside,
    )
    eye, lens = Pose(placed((2.4, -2.3, 1.7), (80, 2, 33))), Lens(22.0)
    other = ("Door", Lens(28.0), Pose(placed((-2.9, -2.4, 1.5), (84, 0, -38))))
    film = Film(360, 216)
    return Description(7, "room", parts, lens, film, eye, (0.02, 0.02, 0.03, 1.0), 1, (other,))


@cache
def scenes() -> tuple[Description, ...]:
    """Return the seven scenes."""
    return solids(), parallel(), shifted(), moving(), modelled(), many(), room()
