"""Each term of the bounds of edge functions by itself: corners off by as much as they may be.

A film that claims what the test says, instead of a camera's: what the errors of the corners move,
and what rounding does, do not hide behind each other.
"""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from reference_tracer.certified.sweep.edge_functions import set_up
from reference_tracer.certified.sweep.film import Vertices

from ...tracer.rational import rational

pytestmark = pytest.mark.filterwarnings("error")
COUNT = 400


def film(orthographic=False, place=(0.0, 0.0), weight=0.0, depth=(0.0, 0.0), ray=0.0):
    """Return a film with these claims; what it is of does not matter."""
    return SimpleNamespace(
        place=place,
        weight=weight,
        depth_error=depth,
        ray_error=ray,
        camera=SimpleNamespace(projection=SimpleNamespace(shares_direction=orthographic)),
    )


def corners_of(rng, count, orthographic):
    """Return p, q, w of corners, (corner, 3, count): as large as the bounds suppose, or any."""
    size = 2.0 ** rng.integers(-40, 40, count)
    signs = rng.choice([-1.0, 1.0], (3, 3, count)) * (
        1 - rng.choice([0, 0.01, 1], count) * rng.random((3, 3, count))
    )
    out = signs * np.stack((size, size, size * 2.0 ** rng.integers(-9, 9, count)))
    nearly = rng.random(count) < 0.5  # flat, but for little
    little = 2.0 ** rng.integers(-52, -8, count)
    flat = out[rng.integers(2)] * rng.choice([-1, 1], count) + little * out[2]
    out[2] = np.where(nearly, flat, out[2])
    if orthographic:
        out[:, 2] = 1
    return out


def found_of(claims, at, depth, reach, nearest=np.inf):
    """Return the edge functions of corners (corner, p q w, m), counted from where p, q do."""
    count = at.shape[2]
    p, q, w = (at[:, k].ravel() for k in range(3))
    vertices = Vertices.empty(3 * count, np.int32)
    vertices.p[:], vertices.q[:], vertices.w[:] = p, q, w
    vertices.depth[:], vertices.size[:] = depth.ravel(), 1.0
    origin = np.full((2, count), -0.5)  # so that nothing is taken away from p and q
    corners = np.arange(3 * count).reshape(3, count)
    with np.errstate(all="ignore"):
        return set_up(claims, vertices, corners, np.broadcast_to(nearest, count), origin, reach)


def truth(at, x, y):
    """Return e_bc, e_ca, e_ab and T of corners in fractions."""
    a, b, c = at
    ray = np.stack((x, y, x * 0 + 1))

    def volume(u, v, w):
        return (
            u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
        )

    return np.stack([volume(b, c, ray), volume(c, a, ray), volume(a, b, ray)]), volume(a, b, c)


def moved(at, x, y, by, which, rng):
    """Move corners by at most `by` (p q w, m): so that edge `which` (3: T) gets far smaller."""
    x, y, one = x * 1.0, y * 1.0, np.ones_like(x, float)
    a, b, c = at
    pairs = ((b, c), (c, a), (a, b))
    others = [a, b, c]
    push = np.zeros_like(at)
    if which == 3:
        for k, (u, v) in enumerate(pairs):
            push[k] = np.cross(u, v, axis=0)
    else:
        first, second = (which + 1) % 3, (which + 2) % 3
        ray = np.stack((x, y, one))
        push[first] = np.cross(others[second], ray, axis=0)
        push[second] = np.cross(ray, others[first], axis=0)
    sign = np.where(push == 0, rng.choice([-1, 1], push.shape), np.sign(push))
    return rational(at) - rational(sign * by)


def slope_of_nearness(at, x, y, depth):
    """Return how the sum of e times depth, over T, changes with each corner's p, q, w; its sign."""
    a, b, c = at
    ray = np.stack((x, y, np.ones_like(x)))
    of_volume = [np.cross(u, v, axis=0) for u, v in ((b, c), (c, a), (a, b))]
    volume = (a * of_volume[0]).sum(axis=0)
    edges = [(n * ray).sum(axis=0) for n in of_volume]
    total = sum(e * d for e, d in zip(edges, depth, strict=True))
    out = np.empty_like(at)
    for k in range(3):
        after, last = (k + 1) % 3, (k + 2) % 3
        of_total = np.cross(ray, depth[after] * at[last] - depth[last] * at[after], axis=0)
        out[k] = volume * of_total - total * of_volume[k]
    return out


PLACES = ({}, {"place": (2.0**-20, 0.0)}, {"place": (0.0, 2.0**-6)})
WEIGHTS = ({"weight": 2.0**-12}, {"place": (2.0**-30, 2.0**-30), "weight": 2.0**-30})


def for_all(perspective, orthographic):
    """Test perspective and orthographic cameras with these claims."""
    some = [(c, False) for c in perspective] + [(c, True) for c in orthographic]
    return pytest.mark.parametrize("claims, orthographic", some, ids=str)


@pytest.mark.slow
@for_all(PLACES + WEIGHTS, PLACES)
@pytest.mark.parametrize("which", range(4))
def test_edges_and_the_sign_of_t(rng, claims, which, orthographic):
    """What is claimed holds, and nearly all of it may be needed."""
    at = corners_of(rng, COUNT, orthographic)
    reach = 2.0 ** rng.integers(-3, 40, COUNT)
    x, y = reach * rng.choice([-1.0, 1.0, 0.5, 0], (2, COUNT))
    claim = film(orthographic, **claims)
    found = found_of(claim, at, at[:, 2], reach)
    place = sum(claim.place)
    by = np.array([place, place, claim.weight])[:, None] * np.ones((3, COUNT))
    side = rng.choice([-1.0, 1.0], COUNT)
    exact = moved(at, x, y, by * side, which, rng)
    edges, volume = truth(exact, rational(x), rational(y))
    sure = found.sure[:COUNT]
    of_1, of_y, of_x = found.coefficients[:, :3, :COUNT]
    values = (of_1 + of_y * y) + of_x * x
    worst = 0.0
    for k in range(COUNT):
        sign = 1 if volume[k] > 0 else -1
        if sure[k]:
            assert volume[k] != 0
        limit = Fraction(found.edge_error[k])
        signs = (sign,) if sure[k] else (1, -1)
        off = min(
            max(
                abs(Fraction(v) - s * e)
                for v, e in zip(values[:, k].tolist(), edges[:, k], strict=True)
            )
            for s in signs
        )
        assert off <= limit
        worst = max(worst, float(off / limit))
    assert sure.sum() > COUNT // 8 and (~sure).any()
    # Of rounding itself, a random case has a fifth of what may be.
    assert which == 3 or worst > (0.9 if claims and not orthographic else 0.1), worst


@pytest.mark.slow
@for_all((*PLACES[:2], WEIGHTS[0], {"ray": 2.0**-9}), (*PLACES[:2], {"depth": (0.0, 2.0**-12)}))
def test_nearness_of_what_is_hit(rng, claims, orthographic):
    """Inside the triangle, and no nearer than `nearest` says; the ray's own depth may be off."""
    count = 1000  # one in hundreds comes near to its bound
    at = corners_of(rng, count, orthographic)
    if not orthographic:  # some corners far nearer to the eye than others
        at[:, 2] = np.abs(at[:, 2])
        at *= 2.0 ** rng.integers(-9, 1, (3, 1, count))
        at[:, :2] *= 2.0 ** rng.integers(-9, 1, (3, 1, count))
    depth = rng.choice([-1.0, 1.0], (3, count)) * 2.0 ** rng.integers(-9, 9, (3, count))
    # A pixel inside: the sum of the corners with weights of one sign, on the film.
    weights = rng.dirichlet((1, 1, 1), count).T
    x, y, w = (weights[:, None] * at).sum(axis=0)
    x, y = x / w, y / w
    reach = np.maximum(1, np.maximum(np.abs(x), np.abs(y)))
    claim = film(orthographic, **claims)
    place, own, ray = sum(claim.place), sum(claim.depth_error), claim.ray_error
    by = np.array([place, place, claim.weight])[:, None] * np.ones((3, count))
    push = slope_of_nearness(at, x, y, -depth if orthographic else np.ones_like(depth))
    push *= rng.choice([-1.0, 1.0], count)  # nearer or farther
    exact = rational(at) - rational(np.sign(push) * by)
    edges, volume = truth(exact, rational(x), rational(y))
    if orthographic:
        true_depth = rational(depth) + rational(own * rng.choice([-1.0, 1.0], count))
        near = -(edges * true_depth).sum(axis=0)
    else:
        near = edges.sum(axis=0) * rational(1 + ray * rng.choice([-1.0, 1.0], count))
    hit = [v and min(e * v) >= 0 for e, v in zip(edges.T, volume, strict=True)]
    near = [n / v if h else None for n, v, h in zip(near, volume, hit, strict=True)]
    nearest = [max(float(n), -1e300) if n is not None else 1.0 for n in near]
    found = found_of(claim, at, depth, reach, np.nextafter(nearest, np.inf))
    of_1, of_y, of_x = found.coefficients[:, 3, :count]
    values = (of_1 + of_y * y) + of_x * x
    checked, worst = 0, 0.0
    for k in np.flatnonzero(hit):
        error = found.nearness_error[k]
        if np.isfinite(error):
            assert found.sure[k]
            ratio = abs(Fraction(values[k]) - near[k]) / Fraction(error)
            assert ratio <= 1
            checked, worst = checked + 1, max(worst, float(ratio))
    assert checked > count // 8
    assert worst > 2.0**-7, worst
