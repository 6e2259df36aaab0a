"""200 pictures with damage that is no fault which the diagnosis knows: it must name none.

Ten pictures of each of twenty kinds, of the first six scenes in turn; everything comes from the
picture's number.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .description import Description
from .making import once, right
from .renderer import Tracer
from .scenes import scenes

COUNT = 200
Rng = np.random.Generator
Damage = Callable[[np.ndarray, Rng], np.ndarray]


def straight(picture: np.ndarray) -> np.ndarray:
    """Return a copy to be damaged."""
    return picture.astype(np.float64).copy()


def noise(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Add normal noise to all pixels."""
    p[..., :3] += rng.normal(0, rng.uniform(0.03, 0.12), p[..., :3].shape)
    return np.clip(p, 0, None)


def salt(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Make pixels black or white."""
    where = rng.random(p.shape[:2]) < rng.uniform(0.01, 0.1)
    p[where, :3] = rng.integers(0, 2, (int(where.sum()), 1))
    return p


def speckle(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Multiply each pixel by its own factor."""
    p[..., :3] *= rng.uniform(0.6, 1.4, (*p.shape[:2], 1))
    return p


def window(p: np.ndarray, rng: Rng, least: float = 0.12, most: float = 0.3) -> tuple[slice, slice]:
    """Return a part of the picture, as shares of its sides."""
    size = [int(n * rng.uniform(least, most)) for n in p.shape[:2]]
    first = [int(rng.integers(0, n - s)) for n, s in zip(p.shape[:2], size, strict=True)]
    return slice(first[0], first[0] + size[0]), slice(first[1], first[1] + size[1])


def smeared(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Drag the left column of some blocks over all of the block."""
    for _ in range(int(rng.integers(4, 9))):
        block = p[window(p, rng)]
        block[:] = block[:, :1]
    return p


def shuffled(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Exchange square blocks."""
    side, places = 24, []
    for y in range(0, p.shape[0] - side, side):
        places += [(y, x) for x in range(0, p.shape[1] - side, side)]
    old = p.copy()
    chosen = rng.permutation(len(places))[: 2 * int(rng.integers(5, 15))]
    for a, b in zip(chosen, np.roll(chosen, 1), strict=True):
        (y, x), (v, u) = places[a], places[b]
        p[y : y + side, x : x + side] = old[v : v + side, u : u + side]
    return p


def blobs(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Draw discs of any colour."""
    y, x = np.mgrid[: p.shape[0], : p.shape[1]]
    for _ in range(int(rng.integers(3, 9))):
        v, u = rng.uniform(0, 1, 2) * p.shape[:2]
        p[np.hypot(y - v, x - u) < rng.uniform(5, 22)] = (*rng.random(3), 1)
    return p


def lines(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Draw slanted lines of any colour."""
    y, x = np.mgrid[: p.shape[0], : p.shape[1]]
    for _ in range(int(rng.integers(3, 8))):
        a, c = rng.uniform(0, np.pi), rng.uniform(0.2, 0.8, 2) * p.shape[:2]
        away = np.abs(np.cos(a) * (y - c[0]) + np.sin(a) * (x - c[1]))
        p[away < rng.uniform(0.7, 2.5)] = (*rng.random(3), 1)
    return p


def blur(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Blur some windows."""
    for _ in range(int(rng.integers(2, 5))):
        part = p[window(p, rng, 0.2, 0.5)]
        for _ in range(int(rng.integers(2, 6))):
            for axis in (0, 1):
                part[:] = (np.roll(part, 1, axis) + part + np.roll(part, -1, axis)) / 3
    return p


def looked_up(p: np.ndarray, y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return the nearest pixels to places (h, w), those at the border outside of it."""
    rows = np.clip(np.rint(y), 0, p.shape[0] - 1).astype(int)
    return p[rows, np.clip(np.rint(x), 0, p.shape[1] - 1).astype(int)]


def _grid(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    y, x = np.mgrid[: p.shape[0], : p.shape[1]].astype(float)
    return y, x


def radial(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Bend the picture as a lens does: barrel or cushion."""
    y, x = _grid(p)
    v, u = (np.array(p.shape[:2]) - 1) / 2
    k = rng.choice((-1, 1)) * rng.uniform(0.06, 0.2)
    r2 = ((y - v) ** 2 + (x - u) ** 2) / u**2
    return looked_up(p, v + (y - v) * (1 + k * r2), u + (x - u) * (1 + k * r2))


def waves(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Move pixels by waves."""
    y, x = _grid(p)
    a, b = rng.uniform(2, 6, 2)
    return looked_up(p, y + a * np.sin(x / rng.uniform(9, 30)), x + b * np.sin(y / 17))


def keystone(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Look at the picture aslant."""
    y, x = _grid(p)
    v, u = (np.array(p.shape[:2]) - 1) / 2
    a, b = rng.choice((-1, 1), 2) * rng.uniform(0.15, 0.4, 2)
    depth = 1 + a * (y - v) / u + b * (x - u) / u
    return looked_up(p, v + (y - v) / depth, u + (x - u) / depth)


def shutter(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Move each row farther than the one above it."""
    y, x = _grid(p)
    return looked_up(p, y, x + rng.choice((-1, 1)) * rng.uniform(0.08, 0.25) * y)


def rows_shifted(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Move each row by its own number of pixels."""
    y, x = _grid(p)
    return looked_up(p, y, x + rng.integers(-6, 7, (len(p), 1)))


def recolored(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Give pixels here and there any colour."""
    where = rng.random(p.shape[:2]) < rng.uniform(0.03, 0.3)
    p[where, :3] = rng.random((int(where.sum()), 3))
    return p


def vignette(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Darken the picture towards its corners."""
    y, x = _grid(p)
    v, u = (np.array(p.shape[:2]) - 1) / 2
    r2 = ((y - v) ** 2 + (x - u) ** 2) / (u**2 + v**2)
    p[..., :3] *= (1 - rng.uniform(0.4, 0.8) * r2)[..., None]
    return p


def dead_rows(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Make some rows black."""
    p[rng.permutation(len(p))[: int(rng.integers(5, 40))], :, :3] = 0
    return p


def interlaced(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Move every other row."""
    p[1::2] = np.roll(p[1::2], int(rng.choice((-1, 1)) * rng.integers(3, 12)), axis=1)
    return p


def banded(p: np.ndarray, rng: Rng) -> np.ndarray:
    """Let brightness swing from column to column."""
    x = _grid(p)[1]
    p[..., :3] *= (1 + 0.3 * np.sin(x / rng.uniform(4, 15) + rng.uniform(0, 6)))[..., None]
    return p


def jittered(scene: Description, rng: Rng) -> np.ndarray:
    """Return the picture with two objects turned about their middles."""
    made = right(scene)
    owners = Tracer(made.camera, made.solids).owners()
    count = np.bincount(owners[owners >= 0], minlength=len(made.solids))
    turning = [n for n, s in enumerate(made.solids) if count[n] > 250 and s.name not in ROUND]
    solids = list(made.solids)
    for n in rng.permutation(turning)[:2]:
        middle = solids[n].vertices.mean(axis=0)
        turn = turned(rng, np.radians(rng.uniform(12, 40)))
        solids[n] = replace(solids[n], vertices=middle + (solids[n].vertices - middle) @ turn.T)
    return once(replace(made, solids=tuple(solids)))


def crumpled(scene: Description, rng: Rng) -> np.ndarray:
    """Return the picture with every vertex moved by itself."""
    made = right(scene)
    amount = rng.uniform(0.03, 0.08)
    solids = tuple(
        replace(s, vertices=s.vertices + rng.normal(0, amount, s.vertices.shape))
        for s in made.solids
    )
    return once(replace(made, solids=solids))


def turned(rng: Rng, angle: float) -> np.ndarray:
    """Return the matrix (3, 3) that turns by an angle about any axis: Rodrigues' formula."""
    axis = rng.normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


ROUND = ("Floor", "Ball", "Wall")  # to turn these changes nothing, or everything
OF_PICTURES: tuple[Damage, ...] = (
    noise,
    salt,
    speckle,
    smeared,
    shuffled,
    blobs,
    lines,
    blur,
    radial,
    waves,
    keystone,
    shutter,
    rows_shifted,
    recolored,
    vignette,
    dead_rows,
    interlaced,
    banded,
)
OF_SCENES = (jittered, crumpled)


def damaged(number: int) -> tuple[str, Description, np.ndarray]:
    """Return the kind, the scene, and the picture (h, w, 4) of a number below COUNT."""
    kinds = len(OF_PICTURES) + len(OF_SCENES)
    scene = scenes()[(number + number // kinds) % 6]
    rng = np.random.default_rng([27, number])
    kind = number % kinds
    if kind >= len(OF_PICTURES):
        of_scene = OF_SCENES[kind - len(OF_PICTURES)]
        return of_scene.__name__, scene, of_scene(scene, rng)
    damage = OF_PICTURES[kind]
    picture = damage(straight(right(scene).picture()), rng)
    return damage.__name__, scene, np.asarray(picture, np.float32)
