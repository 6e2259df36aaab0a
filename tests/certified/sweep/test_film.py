"""Places on the film are off by no more than is claimed, and boxes hold all that is hit."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.sweep.film import Film, Vertices
from reference_tracer.scene import Camera
from reference_tracer.tracer.candidates import has_sound_axes

from ...oracle import OUTSIDE, intersect_pairs
from ...sampled import sampled
from ...tracer.exact_film import ExactFilm
from ...tracer.hostile import hostile_camera, hostile_triangles
from ...tracer.hostile_scenes import offsets, scaled_camera
from ...tracer.rational import rational

CAMERAS = 250
SCALES = (0, 0, 0, -300, -60, 60, 300)  # powers of two


def sound_camera(make, rng) -> tuple[Camera, np.ndarray]:
    """Return a camera whose bounds hold, at any scale, with triangles."""
    while True:
        scale, camera = hostile_camera(make, rng)
        if has_sound_axes(camera):
            break
    corners = hostile_triangles(camera, scale, rng).astype(np.float64)
    factor = 2.0 ** rng.choice(SCALES)
    return scaled_camera(camera, factor), corners * factor


def project(film: Film, world) -> Vertices:
    vertices = Vertices.empty(world.shape[1], np.int32)
    with np.errstate(all="ignore"):
        film.enter(vertices, 0, world)
    return vertices


def some_pixels(camera, count, rng):
    """Return x, y of pixels: the picture's corners, then any."""
    x, y = (rng.integers(0, n, count) for n in (camera.width, camera.height))
    x[:2], y[:2] = (0, camera.width - 1), (0, camera.height - 1)
    return x, y


@sampled(4)
@pytest.mark.parametrize("orthographic", [False, True])
def test_every_ray_sees_a_vertex_within_the_bounds(make, orthographic, every):
    largest = {"place": 0.0, "weight": 0.0, "depth": 0.0}
    for seed in range(0, CAMERAS, every):
        rng = np.random.default_rng(seed)
        camera, corners = sound_camera(make, rng)
        if camera.projection.shares_direction != orthographic:
            continue
        film = Film(camera, *offsets(rng))
        world = np.concatenate(list(corners), axis=1)[:, rng.permutation(120)[:12]]
        world[:, :2] *= 2.0 ** rng.choice([-40, 40, 200], 2)
        far = rng.normal(size=(2, 4)) * camera.clip_start * 10.0 ** rng.integers(0, 9, 4)
        beside = (camera.right, camera.up, camera.forward * camera.clip_start * 1.5)
        moves = (*far, np.ones(4))  # hardly before the eye, far to the side
        world[:, -4:] = camera.origin[:, None] + sum(
            v[:, None] * k for v, k in zip(beside, moves, strict=True)
        )
        at = project(film, world)
        exact = ExactFilm(camera, film.dx, film.dy)
        x, y = some_pixels(camera, 12, rng)
        p, q, w, t = exact.seen_by(x, y, world)
        for name, found, true, (constant, slope) in (
            ("place", at.p, p, film.place),
            ("place", at.q, q, film.place),
            ("weight", at.w, w, (0.0, film.weight)),
            ("depth", at.depth, t, film.depth_error),
        ):
            if name == ("weight" if orthographic else "depth"):
                continue
            bound = constant + slope * at.size
            assert np.isfinite(bound).all()
            ratio = [
                float(abs(exact_value - Fraction(value)) / Fraction(limit))
                for value, exact_value, limit in zip(
                    found.tolist(), true, bound.tolist(), strict=True
                )
            ]
            assert max(ratio) <= 1, (seed, name)
            largest[name] = max(largest[name], *ratio)
        for nearest, depth in zip(at.nearest.tolist(), t, strict=True):
            if depth >= camera.clip_start:
                assert Fraction(nearest) >= (-depth if orthographic else 1 / depth), seed
        assert (at.size >= np.abs(world).max(axis=0) + np.abs(camera.origin).max()).all()
    # They are no wild guesses, either.
    assert largest["place"] > 2.0**-10
    assert orthographic or largest["weight"] > 2.0**-10
    assert not orthographic or largest["depth"] > 2.0**-10


@sampled(4)
def test_rays_are_off_by_no_more_than_is_claimed(make, every):
    largest = 0.0
    for seed in range(0, CAMERAS, every):
        rng = np.random.default_rng(seed)
        camera, _ = sound_camera(make, rng)
        film = Film(camera, *offsets(rng))
        exact = ExactFilm(camera, film.dx, film.dy)
        x, y = some_pixels(camera, 6, rng)
        o, d = exact.rays(x, y)
        stored, base = (
            (o, camera.origin) if camera.projection.shares_direction else (d, np.zeros(3))
        )
        right, up, ahead = exact.of(rational(stored) - rational(base)[:, None])
        along = camera.projection.shares_direction
        errors = [abs(ahead - (0 if along else 1))]
        for value, start, size, pixel, beside in (
            (right, exact.start[0], exact.size[0], x, film.dx),
            (up, exact.start[1], exact.size[1], y, film.dy),
        ):
            wanted = [start + (Fraction(beside) + int(k) + Fraction(1, 2)) * size for k in pixel]
            errors.append(abs(value - wanted))
        worst = max(float(e / Fraction(film.ray_error)) for e in np.concatenate(errors))
        assert worst <= 1, seed
        largest = max(largest, worst)
    assert largest > 2.0**-9


@pytest.mark.slow
@sampled(4)
def test_boxes_hold_every_pixel_that_is_hit(make, every):
    """Every pixel of the picture outside the box is judged; so is how near what is hit comes."""
    outside_boxes, hits, unseen, ahead_of_all = 0, 0, 0, 0
    for seed in range(0, CAMERAS, every):
        rng = np.random.default_rng(seed)
        camera, corners = sound_camera(make, rng)
        film = Film(camera, *offsets(rng))
        corners = corners[..., :16]
        at = project(film, np.concatenate(list(corners), axis=1))
        box, nearest = at.box.reshape(3, -1, 4).min(axis=0), at.nearest.reshape(3, -1).max(axis=0)
        ahead = np.flatnonzero(at.ahead.reshape(3, -1).all(axis=0))
        y, x, k = np.indices((camera.height, camera.width, len(ahead))).reshape(3, -1)
        k = ahead[k]
        low, high = box[k, :2].T, -box[k, 2:].T
        inside = (x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1])
        some = np.flatnonzero(~inside | (rng.random(len(k)) < 0.2))
        x, y, k, inside = x[some], y[some], k[some], inside[some]
        found = intersect_pairs(*ExactFilm(camera, film.dx, film.dy).rays(x, y), corners[..., k])
        hit = found.side != OUTSIDE
        assert not (hit & ~inside).any(), seed
        for n in np.flatnonzero(hit):
            t = found.t(n)
            if t >= camera.clip_start:
                bound = Fraction(nearest[k[n]])
                assert bound >= (-t if camera.projection.shares_direction else 1 / t), seed
                hits += 1
        outside_boxes += (~inside).sum()
        unseen += 16 - len(ahead)
        ahead_of_all += len(ahead)
    assert hits > 1000 / every and outside_boxes > 50_000 / every
    assert unseen > 200 / every and ahead_of_all > 1000 / every


def test_a_box_is_tight_and_ends_beyond_the_picture(make):
    film = Film(make.camera(40, 40, half=1))
    corners = make.quad(-0.5, 0.25, -0.25, 0.75, -1).vertices[:3].T  # in pixels: 10..25, 15..35
    box = project(film, corners).box.min(axis=0)
    assert (np.abs(box - (10, 15, -24, -34)) <= 1).all()
    far = project(film, 1e9 * corners + np.array([[1e9], [-1e9], [0]])).box
    assert (np.abs(far) <= 42).all()
    assert (far[:, 0] > 39).any() and (far[:, 3] > 0).any()  # wholly beside it


@pytest.mark.parametrize("orthographic", [False, True])
def test_nothing_is_claimed_of_axes_that_are_not_sound(make, rng, orthographic):
    for axes in (
        np.diag((1, 1e-3, 1)),
        np.diag((3, 1, 1)),
        np.array([[1, 0.999, 0], [0, 0.04, 0], [0, 0, 1]]),
    ):
        camera = make.camera(axes=axes, orthographic=orthographic)
        assert not has_sound_axes(camera)
        film = Film(camera)
        assert film.place[0] == film.weight == film.depth_error[0] == np.inf
        at = project(film, rng.normal(size=(3, 50)))
        assert not at.ahead.any()
    assert Film(replace(camera, world_from_camera=np.eye(4))).is_sound


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_is_not_finite_or_overflows_has_no_box(make, orthographic):
    film = Film(make.camera(orthographic=orthographic))
    world = np.array(
        [
            [0, 0, -3],
            [np.nan, 0, -3],
            [0, np.inf, -3],
            [1, 2, -np.inf],
            [1.7e308, 1.7e308, -1.7e308],
        ]
    ).T
    at = project(film, world)
    assert at.finite.tolist() == [True, False, False, False, True]
    assert not at.ahead[1:4].any() and at.ahead[0]
