"""Builds the scenarios' scenes, which surfaces, large or small numbers, camera or matrix make hard.

Each function takes the scale that is swept, and the size of the picture.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Floats
from ...camera_files.frame import pose
from ...projections import ORTHOGRAPHIC
from ...scene import Mesh, Scene, ViewWindow
from ...tracer.camera import camera_rays
from . import parts
from .parts import BESIDE, TURNED, camera, generator, grid, scene, sheet, sphere

RIGHT, UP, BACKWARD = TURNED.T
FORWARD = -BACKWARD
EYE = np.array((0.3, -0.2, 0.25))  # inside the sphere, not at its centre
AWAY = np.array((1.0, 0.0083, -1.506))  # the direction of the centre in Embree's own test
STRIP = 40  # quads of a strip of needles
ULP = 2.0**-52  # relative distance of the doubles next to 1


def corners_and_edges(ratio: float, width: int, height: int) -> Scene:
    """Return a closed surface met at its corners and edges, `ratio` times deeper in its pits."""
    view = replace(camera(width, height, eye=EYE), clip_end=1e3 * ratio)
    return scene(view, sheet(view, far=4 * ratio))


def closed_fan(count: float, width: int, height: int) -> Scene:
    """Return `count` triangles around one corner, between the rays of pixels around the picture.

    So the corner is on a pixel's ray, and so is the middle of every edge that leads to it.
    """
    view = camera(width, height, eye=EYE)
    x, y = width // 2 + 4, height // 2 + 4  # of the rim, from the middle; both even
    x, y = x + x % 2, y + y % 2
    rim = [(i, -y) for i in range(-x, x, 2)] + [(x, j) for j in range(-y, y, 2)]
    rim += [(-i, -j) for i, j in rim]
    chosen = np.linspace(0, len(rim), int(count), endpoint=False).astype(int)
    # Without the four corners of the picture, the fan would not cover it.
    chosen = np.union1d(chosen, [rim.index((i, j)) for i in (-x, x) for j in (-y, y)])
    x, y = np.array([(0, 0), *[rim[k] for k in chosen]]).T
    rays = camera_rays(view, x + width // 2 + 0.5, y + height // 2 + 0.5)
    points = rays.at(4 + generator().random(len(x))).T
    around = np.arange(1, len(x))
    triangles = np.stack((0 * around, around, np.roll(around, -1)), axis=1)
    return scene(view, parts.closed(points, triangles, around, EYE - 8 * FORWARD))


def needles(aspect: float, width: int, height: int) -> Scene:
    """Return a strip of quads of 1 x 1/aspect m, seen from straight above."""
    length = STRIP / aspect
    depth = max(1.0, length)  # so that no part of it is beside or behind the camera
    # At most 0.45 of the strip's length to either side.
    tall = 0.45 * length / (depth + 0.5 * length)
    window = ViewWindow(-0.4 / depth, 0.4 / depth, -tall, tall)
    view = replace(camera(width, height), window=window)
    corner = depth * FORWARD - 0.5 * RIGHT - 0.5 * length * UP
    apex = -depth * FORWARD  # behind the camera, which is so inside
    strip = grid(1, STRIP, corner, RIGHT, length * UP)
    rim = parts.lattice_rim(1, STRIP)
    return scene(view, parts.closed(strip.vertices, strip.triangles, rim, apex))


def grazing(height_above: float, width: int, height: int) -> Scene:
    """Return a plane of 20 x 20 cells, the camera closely above it and looking along it."""
    # It meets the plane at 1 to 10 m. Not symmetrical: no column of the picture is along a line.
    window = ViewWindow(-0.37, 0.43, -height_above, -0.1 * height_above)
    view = replace(camera(width, height), window=window)
    corner = -10 * RIGHT - 5 * FORWARD - height_above * UP
    split = generator().integers(0, 2, 400)
    return scene(view, grid(20, 20, corner, 20 * RIGHT, 20 * FORWARD, split))


def close_planes(ulps: float, width: int, height: int) -> Scene:
    """Return two planes across the view, 5 m away; the second is nearer by some ulp of that."""
    view = camera(width, height, eye=EYE)
    rng = generator()
    corners = (EYE + t * FORWARD - 3 * RIGHT - 3 * UP for t in (5 * (1 + ulps * ULP), 5.0))
    planes = (grid(6, 5, c, 6 * RIGHT, 6 * UP, rng.integers(0, 2, 30)) for c in corners)
    return scene(view, *planes)


def integer_cube(cells: float, width: int, height: int) -> Scene:
    """Return a cube with integer corners, its camera inside, with rays that are binary fractions.

    Pixels are 1/4 wide at depth 1, so that rays meet the wall 16 m away at even numbers.
    """
    view = camera(width, height, width / 8, axes=np.eye(3))
    return scene(view, _cube(int(cells), np.array((-8.0, -16.0, -16.0)), 32.0))


def integer_cube_ortho(cells: float, width: int, height: int) -> Scene:
    """Return such a cube from outside, with rays at integers along its sides."""
    eye = (0.5 * (width % 2 == 0), 0.5 * (height % 2 == 0), 40.0)
    view = camera(width, height, width / 2, np.array(eye), np.eye(3))
    view = replace(view, projection=ORTHOGRAPHIC)
    return scene(view, _cube(int(cells), np.array((-8.0, -8.0, -8.0)), 16.0))


def _cube(cells: int, least: Floats, side: float) -> Mesh:
    """Return a cube of six lattices, each with corners of its own."""
    walls: list[Mesh] = []
    rng = generator()
    for axis in range(3):
        across, u, v = side * np.roll(np.eye(3), axis, axis=1)
        for corner in (least, least + across):
            walls.append(grid(cells, cells, corner, u, v, rng.integers(0, 2, cells * cells)))
    points = np.concatenate([wall.vertices for wall in walls])
    each = (cells + 1) ** 2
    triangles = np.concatenate([wall.triangles + k * each for k, wall in enumerate(walls)])
    return Mesh(points, triangles, name="Cube")


def degenerate_faces(copies: float, width: int, height: int) -> Scene:
    """Return a wall, and `copies` of its faces split otherwise, with others of no area."""
    columns, rows, copies = 16, 12, int(copies)
    across, up, backward = parts.TURNED_39.T / 4  # a quarter cell: all corners are multiples of it
    corner = -20 * backward - columns / 2 * across - rows / 2 * up
    rng = generator()
    split = rng.integers(0, 2, columns * rows)
    # The cells' corners are sums of quarters: no product is rounded, unlike in `grid`.
    i, j = (v.ravel()[:, None] for v in np.mgrid[: rows + 1, : columns + 1])
    points = corner + j * across + i * up
    meshes = [Mesh(points, parts.lattice(columns, rows, split), name="Wall")]
    if copies:
        rim = parts.lattice_rim(columns, rows)[:columns]
        line = np.add.outer(rim[:-2], np.arange(rows) * (columns + 1)).ravel()
        empty = np.add.outer(line, (0, 1, 2))  # three corners in a row
        point = np.add.outer(line, (0, 1, 0))
        again = np.tile(parts.lattice(columns, rows, 1 - split), (copies, 1))
        meshes.append(Mesh(points, np.concatenate((empty, again, point)), name="Copies"))
    # Not symmetrical: no pixel's ray is on a diagonal.
    view = replace(camera(width, height), window=ViewWindow(-0.33, 0.3, -0.22, 0.25))
    return scene(view, *meshes)


def non_finite(share: float, width: int, height: int) -> Scene:
    """Return a wall before another, with some corners that its matrix takes to infinity."""
    view = camera(width, height)
    front = sheet(view, step=4, beside=BESIDE, around=False)
    power = 600  # 2^power x 2^500 overflows; all else is scaled forth and back without rounding
    points = np.ldexp(front.vertices, -power)
    rng = generator()
    chosen = rng.permutation(len(points))[: round(share * len(points))]
    points[chosen, rng.integers(0, 3, len(chosen))] = np.ldexp(1.0, 500)
    matrix = np.diag((*[np.ldexp(1.0, power)] * 3, 1.0))
    # Not symmetrical: no pixel's ray is on one of its edges.
    wall = grid(2, 2, 9 * FORWARD - 6.3 * RIGHT - 5.8 * UP, 12.5 * RIGHT, 12.3 * UP)
    return scene(view, Mesh(points, front.triangles, name="Front"), wall, matrix=matrix)


def far_from_origin(distance: float, width: int, height: int) -> Scene:
    """Return a sphere of radius 2, and the camera inside, far from the world's origin."""
    centre = distance * AWAY
    view = camera(width, height, 1.0, eye=centre + EYE)
    return scene(view, sphere(2.0, 8), matrix=pose(np.eye(3), centre))


def far_corners(distance: float, width: int, height: int) -> Scene:
    """Return a closed surface met at its corners and edges, far from the world's origin."""
    view = camera(width, height, eye=distance * AWAY)
    return scene(view, sheet(view))


def uniform_scale(size: float, width: int, height: int) -> Scene:
    """Return a sphere with the camera inside, all of it scaled."""
    view = camera(width, height, 1.0, eye=size * EYE, unit=size)
    return scene(view, sphere(), matrix=np.diag((size, size, size, 1.0)))


def far_camera(distance: float, width: int, height: int) -> Scene:
    """Return a sphere of 1 m at the origin, and a camera of long focal length far from it."""
    half = 0.6 / distance
    view = camera(width, height, eye=distance * BACKWARD, unit=distance)
    view = replace(view, window=ViewWindow(-half, half, -half, half))
    return scene(view, sphere(0.5, 8))


def narrow_view(angle: float, width: int, height: int) -> Scene:
    """Return a rough surface through a camera with this horizontal angle of view, in radians."""
    view = camera(width, height, np.tan(0.5 * angle), eye=EYE)
    return scene(view, sheet(view, 4, beside=BESIDE))


def wide_view(rest: float, width: int, height: int) -> Scene:
    """Return a rough surface through a camera with an angle of view of 180 - `rest`, degrees."""
    view = camera(width, height, 1 / np.tan(np.radians(0.5 * rest)), eye=EYE)
    return scene(view, sheet(view, 4, beside=BESIDE))


def ortho_scale(size: float, width: int, height: int) -> Scene:
    """Return a rough surface through an orthographic camera of this width, in metres."""
    view = replace(camera(width, height, 0.5 * size, EYE), projection=ORTHOGRAPHIC)
    return scene(view, sheet(view, 4, beside=BESIDE, around=False))


def squashed(thickness: float, width: int, height: int) -> Scene:
    """Return a sphere from outside, mirrored and pressed flat by its object's matrix."""
    matrix = pose(TURNED * (1.0, 1.0, -thickness), parts.ORIGIN)
    c, s = np.cos(0.3), np.sin(0.3)  # the camera is a little rolled about the view's direction
    axes = np.stack((c * RIGHT + s * UP, c * UP - s * RIGHT, BACKWARD), axis=1)
    view = camera(width, height, 0.4, eye=6 * BACKWARD, axes=axes)
    return scene(view, sphere(), matrix=matrix)


def sheared(factor: float, width: int, height: int) -> Scene:
    """Return a sphere with the camera inside, mirrored and sheared by its object's matrix."""
    shear = np.array([[1.0, factor, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]])
    axes = [[sum(TURNED[i, j] * shear[j, k] for j in range(3)) for k in range(3)] for i in range(3)]
    view = camera(width, height, 1.0, 1e-3 * EYE / factor, np.eye(3))
    view = replace(view, clip_start=1e-6 / factor, clip_end=1e3 * factor)
    return scene(view, sphere(), matrix=pose(np.array(axes), parts.ORIGIN))


def stored_float32(offset: float, width: int, height: int) -> Scene:
    """Return a sphere stored in float32, far from its object's own origin.

    The object stands at the opposite of that offset, so that the sphere appears where it should:
    with the digits that float32 has left of it. What is certified is this mesh, as it is stored.
    """
    centre = offset * AWAY
    view, ball = camera(width, height, 0.5, eye=6 * BACKWARD), sphere()
    stored = replace(ball, vertices=(ball.vertices + centre).astype(np.float32))
    return scene(view, stored, matrix=pose(np.eye(3), -centre))
