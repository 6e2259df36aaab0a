"""Polygons for tests: (n, 2) float64, wound to the left, with their areas."""

from __future__ import annotations

import numpy as np

SIDES = ((0, -1), (1, 0), (0, 1), (-1, 0))  # of a cell, to its neighbours
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))


def star(rng, count):
    """Return corners around the origin, which sees them all, and is inside."""
    angles = (np.arange(count) + rng.uniform(0, 0.9, count)) * 2 * np.pi / count
    radii = rng.uniform(0.2, 1, count)
    return np.column_stack((radii * np.cos(angles), radii * np.sin(angles)))


def spiral(rng, count):
    """Return a band round the origin: of 40 corners, more than once."""
    angles = np.linspace(0, rng.uniform(0.2, 0.25) * count, count // 2)
    radii = 1 + angles
    outer = np.column_stack((radii * np.cos(angles), radii * np.sin(angles)))
    return np.concatenate((outer, 0.8 * outer[::-1]))


def maze(rng, wide, high):
    """Return the boundary of a maze without circles: its walls are edges that are passed twice.

    It touches itself at most of its corners, and its area is that of all the cells.
    """
    doors = {cell: [] for cell in np.ndindex(wide, high)}
    seen, open_ends = {(0, 0)}, [(0, 0)]
    while open_ends:
        cell = open_ends[rng.integers(len(open_ends))]
        sides = [s for s in range(4) if (to := _beyond(cell, s)) in doors and to not in seen]
        if not sides:
            open_ends.remove(cell)
            continue
        side = int(rng.choice(sides))
        doors[cell].append(side)
        seen.add(_beyond(cell, side))
        open_ends.append(_beyond(cell, side))
    return np.array(list(_around(doors, (0, 0), 0, 4)), float)


def _beyond(cell, side):
    return cell[0] + SIDES[side][0], cell[1] + SIDES[side][1]


def _around(doors, cell, first, count):
    """Yield the corners of a cell and of those behind its doors, from its side `first` on."""
    for side in (k % 4 for k in range(first, first + count)):
        if side in doors[cell]:
            yield from _around(doors, _beyond(cell, side), side + 3, 3)
        else:
            yield cell[0] + CORNERS[side][0], cell[1] + CORNERS[side][1]


def area(points):
    """Return the area, with its sign."""
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - np.roll(x, -1) @ y)


def in_space(rng, points, scale=1.0, offset=0.0):
    """Return the corners (n, 3) in a random plane."""
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return scale * (points @ axes[:, :2].T + offset * rng.normal(size=3))
