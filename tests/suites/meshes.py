"""The meshes of the suites, from their construction: corners (3 corners, 3 components, m).

Closed ones are counter-clockwise from outside, and closed by bit-identical positions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

EMBREE_CENTRE = np.array((148376.0, 1234.0, -223423.0))


def corners_of(vertices: NDArray, triangles: NDArray) -> NDArray[np.float64]:
    """Return the corners of an indexed mesh, (v, 3) and (m, 3)."""
    return np.asarray(vertices, np.float64)[np.asarray(triangles)].transpose(1, 2, 0)


def snapped(points: NDArray, digits: int = 20) -> NDArray[np.float64]:
    """Round to multiples of 2^-digits: sums and differences of such points are exact."""
    return np.round(np.asarray(points, np.float64) * 2.0**digits) / 2.0**digits


def on_sphere(rng: np.random.Generator, count: int, radius: float = 1.0) -> NDArray[np.float64]:
    """Return points (3, count) evenly distributed on a sphere."""
    points = rng.normal(size=(3, count))
    return radius * points / np.sqrt((points**2).sum(axis=0))


def bumpy_sphere(rng: np.random.Generator, snap: bool) -> tuple[NDArray, NDArray]:
    """Return pbrt's mesh, vertices (256, 3) and triangles (420, 3).

    16 x 16 (theta, phi): radius 1 at the poles, else 1 + 5 U; the column at phi = 2 pi is a copy of
    the one at 0. pbrt winds the fan at the bottom backwards, which is turned here.
    """
    side = 16
    theta = np.pi * np.arange(side) / (side - 1)
    phi = 2 * np.pi * np.arange(side) / (side - 1)
    radius = 1 + 5 * rng.random((side, side))
    shape = (
        np.sin(theta)[:, None] * np.cos(phi),
        np.sin(theta)[:, None] * np.sin(phi),
        np.cos(theta)[:, None] * np.ones(side),
    )
    vertices = np.stack([radius * x for x in shape], axis=-1)
    vertices[0], vertices[-1] = (0, 0, 1), (0, 0, -1)
    vertices[:, -1] = vertices[:, 0]
    k = np.arange(side - 1)
    quads = [np.stack((t * side + k, (t + 1) * side + k), axis=-1) for t in range(side - 1)]
    triangles = [np.stack((quads[0][:, 0] * 0, quads[0][:, 1], quads[0][:, 1] + 1), axis=-1)]
    for upper, lower in (q.T for q in quads[1:-1]):
        triangles.append(np.stack((upper, lower, lower + 1), axis=-1))
        triangles.append(np.stack((upper, lower + 1, upper + 1), axis=-1))
    upper = quads[-1][:, 0]
    triangles.append(np.stack((upper * 0 + (side - 1) * side, upper + 1, upper), axis=-1))
    vertices = vertices.reshape(-1, 3)
    return snapped(vertices) if snap else vertices, np.concatenate(triangles)


def embree_sphere(n: int, centre=EMBREE_CENTRE, radius: float = 2.0) -> NDArray[np.float64]:
    """Return corners of Embree's sphere, 4 n (n - 1) triangles, vertices stored in float32."""
    phi = np.arange(n + 1)[:, None] * np.pi / n
    theta = np.arange(2 * n) * np.pi / n
    directions = (np.sin(phi) * np.sin(theta), np.cos(phi) + 0 * theta, np.sin(phi) * np.cos(theta))
    vertices = np.stack([c + radius * x for c, x in zip(centre, directions, strict=True)], axis=-1)
    vertices[0], vertices[-1] = vertices[0, 0], vertices[-1, 0]  # as absorbed by a large centre
    upper = (np.arange(n)[:, None] * 2 * n + np.arange(2 * n)).reshape(n, 2 * n)
    lower, turn = upper + 2 * n, np.roll(np.arange(2 * n), -1)
    first = np.stack((upper, lower, lower[:, turn]), axis=-1)[:-1]
    second = np.stack((upper, lower[:, turn], upper[:, turn]), axis=-1)[1:]
    triangles = np.concatenate((first.reshape(-1, 3), second.reshape(-1, 3)))
    return corners_of(vertices.reshape(-1, 3).astype(np.float32), triangles)


def grid(n: int) -> tuple[NDArray, NDArray]:
    """Return n x n quads of two triangles each, over [0, 1]^2 at z = 0, facing +Z."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    k = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()[:, None]
    triangles = np.concatenate([k + c for c in ([0, 1, n + 2], [0, n + 2, n + 1])])
    return np.stack((x.ravel(), y.ravel(), 0 * x.ravel()), axis=-1), triangles


def split_square(seed: int, count: int) -> tuple[NDArray, NDArray]:
    """Return Vulkan's unit square, split at random into `count` triangles, facing +Z.

    A random triangle is split in three at a random point of it, which is moved to a random depth.
    The original forgets the winding; here it is kept.
    """
    rng = np.random.default_rng(seed)
    vertices = [(0.0, 0.0, -1.0), (0.0, 1.0, -1.0), (1.0, 0.0, -1.0), (1.0, 1.0, -1.0)]
    triangles = [(0, 2, 1), (3, 1, 2)]
    while len(triangles) < count:
        which = int(rng.integers(len(triangles)))
        p, q, r = triangles[which]
        a, b, z = rng.uniform(0.01, 0.99, 3)
        at = [
            (u * a + v * (1 - a)) * b + w * (1 - b)
            for u, v, w in zip(vertices[p], vertices[q], vertices[r], strict=True)
        ]
        new = len(vertices)
        vertices.append((at[0], at[1], -z))
        triangles[which] = (p, q, new)
        triangles += [(q, r, new), (r, p, new)]
    return np.array(vertices, np.float32), np.array(triangles)


def closed_fan(count: int, snap: int | None = None) -> tuple[NDArray, NDArray]:
    """Return `count` triangles around (0, 0, -1), a fan closed by its indices, facing +Z."""
    angle = 2 * np.pi * np.arange(count) / count
    rim = np.stack((np.cos(angle), np.sin(angle), np.full(count, -1.0)), axis=-1)
    vertices = np.concatenate(([(0, 0, -1)], rim))
    k = np.arange(count)
    triangles = np.stack((0 * k, 1 + k, 1 + (k + 1) % count), axis=-1)
    return (vertices if snap is None else snapped(vertices, snap)), triangles


def box(low=-0.5, high=0.5) -> tuple[NDArray, NDArray]:
    """Return a box of 12 triangles; with integers, rays to its corners are true ties."""
    low, high = np.broadcast_to(low, 3), np.broadcast_to(high, 3)
    bits = np.array([[k >> 2 & 1, k >> 1 & 1, k & 1] for k in range(8)])
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    return np.where(bits, high, low).astype(np.float64), np.array(triangles)


def stairs(steps: int) -> tuple[NDArray, NDArray]:
    """Return Mitsuba's stairs: `steps` treads and the risers between them, in [0, 1]^3."""
    size = 1 / steps
    vertices, triangles = [], []
    for i in range(steps):
        k = 4 * i
        for depth in (i * size, (i + 1) * size):
            vertices += [(0, depth, i * size), (1, depth, i * size)]
        triangles += [(k, k + 1, k + 2), (k + 1, k + 3, k + 2)]
        if i < steps - 1:
            triangles += [(k + 2, k + 3, k + 5), (k + 5, k + 4, k + 2)]
    return np.array(vertices, float), np.array(triangles)


def cylinder(sides: int = 32) -> tuple[NDArray, NDArray]:
    """Return a closed cylinder of radius 1 and height 2, its caps fans."""
    angle = 2 * np.pi * np.arange(sides) / sides
    rim = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    low, high = (np.column_stack((rim, np.full(sides, z))) for z in (-1.0, 1.0))
    vertices = np.concatenate((low, high, [(0, 0, -1), (0, 0, 1)]))
    k, n = np.arange(sides), (np.arange(sides) + 1) % sides
    bottom, top = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    parts = ((k, n, sides + n), (k, sides + n, sides + k), (bottom, n, k))
    parts += ((top, sides + k, sides + n),)
    return vertices, np.concatenate([np.stack(p, axis=-1) for p in parts])
