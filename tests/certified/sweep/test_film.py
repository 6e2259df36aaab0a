"""Boxes on the film hold all that is hit."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.sweep.film import Film, Vertices
from reference_tracer.scene import Camera
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.candidates import has_sound_axes

from ...oracle import OUTSIDE, intersect_pairs
from ...sampled import sampled
from ...tracer.hostile import hostile_camera, hostile_triangles
from ...tracer.hostile_scenes import offsets, scaled_camera

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


def rays_of(film: Film, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return stored origins and directions of pixels, (3, n) each."""
    rays = camera_rays(film.camera, x + 0.5 + film.dx, y + 0.5 + film.dy)
    shape = 3, len(x)
    return np.broadcast_to(rays.origins, shape), np.broadcast_to(rays.directions, shape)


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
        found = intersect_pairs(*rays_of(film, x, y), corners[..., k])
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
