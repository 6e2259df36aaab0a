"""Triangles as functions of the pixel are off by no more than they say, and say what is sure.

What is expected has fractions of the stored rays and the world vertices (`exact_film.py`).
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.sweep.edge_functions import EdgeFunctions, set_up
from reference_tracer.certified.sweep.film import Film, Vertices

from ...sampled import sampled
from ...tracer.exact_film import ExactFilm
from ...tracer.hostile_scenes import offsets
from .test_film import project, sound_camera

CASES = 300  # cameras
EACH = 10  # triangles


def prepare(film: Film, corners) -> tuple[EdgeFunctions, np.ndarray, np.ndarray, np.ndarray]:
    """Return the edge functions of triangles (3, 3, m) as a sweep has them, with their boxes' ends.

    Lowest x and y, and highest, (2, m); the whole picture where no box is known.
    """
    at = project(film, np.concatenate(list(corners), axis=1))
    return of_vertices(film, at)


def of_vertices(film: Film, at: Vertices):
    count = len(at.p) // 3
    box, nearest = at.box.reshape(3, count, 4).min(axis=0), at.nearest.reshape(3, count).max(axis=0)
    ends = np.array([[film.camera.width - 1], [film.camera.height - 1]])
    low, high = np.maximum(box[:, :2].T, 0), np.minimum(-box[:, 2:].T, ends)
    ahead = at.ahead.reshape(3, count).all(axis=0)
    low, high = np.where(ahead, low, 0), np.where(ahead, high, ends)
    corners = np.arange(3 * count).reshape(3, count)
    reach = np.maximum(*(high - low)) + 1.0
    with np.errstate(all="ignore"):
        return set_up(film, at, corners, nearest, low, reach), low, high, corners


def evaluated(found: EdgeFunctions, row, x, y):
    """Return the four edge functions (4, n) at pixels, in the order of `rasterise.py`."""
    of_1, of_y, of_x = found.coefficients[:, :, row]
    x0, y0 = found.origin[:, row]
    with np.errstate(all="ignore"):
        return (of_1 + of_y * (y - y0)) + of_x * (x - x0)


def ordinary(camera, corners, rng):
    return corners


def slivers(camera, corners, rng):
    """The third corner on the line of the others, but for rounding or a little."""
    a, b, c = corners
    c = a + rng.uniform(-1, 2, a.shape[1]) * (b - a) + 10.0 ** rng.uniform(-18, -8) * (c - a)
    return np.stack((a, b, c))


def edge_on(camera, corners, rng):
    """In a plane with the rays of a line on the film, as near as floats get."""
    a, b, _ = corners
    parallel = camera.projection.shares_direction
    towards = camera.forward[:, None] if parallel else a - camera.origin[:, None]
    return np.stack((a, b, b + rng.uniform(-1, 1, a.shape[1]) * towards))


def whole(camera, corners, rng):
    """Corners at the camera's origin and on its axes: zeros that are exact."""
    some = [camera.origin, *(camera.origin + v for v in (camera.right, camera.up, camera.forward))]
    out = corners.copy()
    for k in range(corners.shape[2]):
        out[rng.integers(3), :, k] = some[rng.integers(4)]
    return out


def without_area(camera, corners, rng):
    return corners[rng.integers(3, size=3)]


KINDS = (ordinary, ordinary, slivers, edge_on, whole, without_area)


def cases(make, every: int):
    """Yield hostile cameras with triangles of every kind, and some pixels of each one's box."""
    for seed in range(0, CASES, every):
        rng = np.random.default_rng(seed)
        camera, corners = sound_camera(make, rng)
        corners = corners[..., rng.permutation(corners.shape[2])[:EACH]]
        corners = KINDS[rng.integers(len(KINDS))](camera, corners, rng)
        film = Film(camera, *offsets(rng))
        found, low, high, _ = prepare(film, corners)
        triangle, x, y = [], [], []
        for k in np.flatnonzero((low <= high).all(axis=0)):
            ends = np.stack((low, high))[:, :, k]
            triangle += [k] * 8
            for pixels, n in ((x, 0), (y, 1)):
                pixels += [*ends[:, n].tolist(), *rng.integers(ends[0, n], ends[1, n] + 1, 6)]
        if triangle:
            yield seed, film, corners, found, *map(np.array, (triangle, x, y))


@pytest.mark.slow
@sampled(4)
def test_functions_are_off_by_no_more_than_they_say(make, every):
    """Edges, the sign of T and nearness; and what is surely inside is."""
    count, worst = Counter(), Counter()
    for seed, film, corners, found, triangle, x, y in cases(make, every):
        exact = ExactFilm(film.camera, film.dx, film.dy)
        edges, volume, t = exact.functions(x, y, corners[..., triangle])
        for row in range(len(found.row)):
            asked = np.flatnonzero(triangle == found.row[row])
            own = np.full(len(asked), row)
            values = evaluated(found, own, x[asked], y[asked])
            limit = found.edge_error[row]
            sure = bool(found.sure[row])
            for n, k in enumerate(asked.tolist()):
                side = 1 if volume[k] > 0 else -1 if volume[k] < 0 else 0
                count["sure" if sure else "not sure"] += 1
                assert side or not sure, seed
                if not sure:
                    assert (
                        found.nearness_error[row] == np.inf
                        and not found.coefficients[:, 3, row].any()
                    )
                true = [e * (side or 1) for e in edges[:, k].tolist()]
                off = max(abs(Fraction(v) - e) for v, e in zip(values[:3, n], true, strict=True))
                if not sure:  # either sign may be the right one
                    turned = (
                        abs(Fraction(v) + e) for v, e in zip(values[:3, n], true, strict=True)
                    )
                    off = min(off, max(turned))
                worst["edge"] = max(worst["edge"], float(off / Fraction(limit)))
                assert off <= limit, (seed, row)
                inside = side and min(true) >= 0
                if sure and min(values[:3, n]) > limit:
                    assert inside and min(true) > 0, seed
                    count["surely inside"] += 1
                start = film.camera.clip_start
                if sure and inside and (t[k] >= start or film.camera.projection.shares_direction):
                    near = -t[k] if film.camera.projection.shares_direction else 1 / t[k]
                    error = found.nearness_error[row]
                    assert near <= found.nearest[row], seed
                    if np.isfinite(error):
                        ratio = abs(Fraction(values[3, n]) - near) / Fraction(error)
                        worst["nearness"] = max(worst["nearness"], float(ratio))
                        count["nearness"] += 1
                        assert ratio <= 1, seed
    some = min(count[k] for k in ("sure", "not sure", "surely inside", "nearness"))
    assert some > 500 / every, count
    # They are no wild guesses, either.
    assert worst["edge"] > 2.0**-12 and worst["nearness"] > 2.0**-14, worst


@sampled(4)
def test_where_the_sign_of_t_is_unknown_there_are_both(make, every):
    doubtful = 0
    for seed, _, corners, found, *_ in cases(make, every):
        count = corners.shape[2]
        assert found.row[:count].tolist() == list(range(count)), seed
        twins = found.row[count:]
        assert sorted(twins) == np.flatnonzero(~found.sure[:count]).tolist()
        assert not found.sure[count:].any()
        first, second = found.take(twins), found.take(np.arange(count, len(found.row)))
        assert np.array_equal(first.coefficients[:, :3], -second.coefficients[:, :3])
        for name in ("origin", "edge_error", "nearness_error", "nearest"):
            assert np.array_equal(getattr(first, name), getattr(second, name)), name
        doubtful += len(twins)
    assert doubtful > 200 / every


@pytest.mark.parametrize("power", [-1000, -700, -345, 345, 500, 700, 1000])
@pytest.mark.parametrize("orthographic", [False, True])
def test_what_over_or_underflows_is_not_claimed(make, rng, orthographic, power):
    """A sign is sure only where the volume is far from both ends of the floats."""
    unit = 2.0**power
    half = min(unit, 2.0**900) if orthographic else 0.5
    camera = make.camera(
        half=half, orthographic=orthographic, clip_start=0.01 * unit, clip_end=100 * unit
    )
    film = Film(camera)
    corners = np.stack([rng.uniform(-1, 1, (3, 50)) - [[0], [0], [3]] for _ in range(3)]) * unit
    at = project(film, np.concatenate(list(corners), axis=1))
    found, *_ = of_vertices(film, at)
    exact = ExactFilm(camera)
    nowhere = np.zeros(50, int)
    _, volume, _ = exact.functions(nowhere, nowhere, corners)
    signs = np.sign([1 if v > 0 else -1 for v in volume])
    x, y = np.full((2, 50), 5)
    edges, _, _ = exact.functions(x, y, corners)
    values = evaluated(found, np.arange(50), x, y)
    for k in range(50):
        limit = found.edge_error[k]
        if np.isfinite(limit):
            off = [
                min(
                    abs(Fraction(v) - s * e) for s in ((1, -1) if not found.sure[k] else signs[[k]])
                )
                for v, e in zip(values[:3, k], edges[:, k].tolist(), strict=True)
            ]
            assert max(off) <= limit
        else:
            assert not found.sure[k] and not found.coefficients[..., k].any()
            assert not np.isfinite(found.edge_error[k]) and found.nearness_error[k] == np.inf
    if abs(power) >= 345 and not orthographic:
        assert not found.sure.any()


def test_the_floats_do_not_depend_on_the_division(make, rng):
    """All together, by ones, in any order: bit for bit."""
    for seed in range(40):
        some = np.random.default_rng(seed)
        camera, corners = sound_camera(make, some)
        film = Film(camera)
        whole_found, *_ = prepare(film, corners)
        sizes = [1] * 5 + [7, 11, 17]
        order = some.permutation(40)
        for part in np.split(order, np.cumsum(sizes)[:-1]):
            found, *_ = prepare(film, corners[..., part])
            first = whole_found.take(part)
            for name in ("origin", "coefficients", "edge_error", "nearness_error", "sure"):
                value = getattr(found.take(np.arange(len(part))), name)
                assert value.tobytes() == getattr(first, name).tobytes(), name
