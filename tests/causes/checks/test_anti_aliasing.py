"""Anti-aliasing: mixes of what is seen nearby are found, other colours are not."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.causes.checks.anti_aliasing import NEAR, is_mix
from reference_tracer.causes.explain import AGREE, ANTI_ALIASING, UNEXPLAINED
from reference_tracer.causes.hull import distance_to_triangles
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ...cases import find_causes, shifted
from ...sampled import sampled


@pytest.mark.parametrize("count", [1, 2, 3, 4, 9])
def test_every_mix_is_found(rng, count):
    points = rng.random((count, 300, 4))
    weights = rng.dirichlet(np.full(count, 0.4), 300).T[..., None]
    assert result_of(is_mix((weights * points).sum(axis=0), points)).all()
    logs = 2 ** (weights * np.log2(1 + points)).sum(axis=0) - 1
    logs[:, 3] = (weights * points).sum(axis=0)[:, 3]  # of Workbench, alpha is mixed as it is
    assert result_of(is_mix(logs, points)).all()
    older = 2 ** (weights * np.log2(0.5 + points)).sum(axis=0) - 0.5  # before 5.0, alpha, too
    assert result_of(is_mix(older, points)).all()


def test_colours_almost_on_a_line(rng):
    """Where Frank and Wolfe's steps are short."""
    dark, light = np.array([0.016, 0.016, 0.044, 1]), np.array([1, 0.638, 0.133, 1])
    between = 0.6 * light + 0.4 * dark + (0, 0.003, -0.002, 0)
    points = np.stack([dark] * 9 + [light] * 5 + [between] * 3)[:, None].repeat(50, axis=1)
    share = rng.random((50, 1))
    assert result_of(is_mix(share * dark + (1 - share) * light, points)).all()


def test_what_is_no_mix_is_not_found(rng):
    points = rng.uniform(0.2, 0.5, (6, 400, 3))
    away = rng.normal(size=(400, 3))
    away /= np.linalg.norm(away, axis=1)[:, None]
    beyond = (points * away).sum(axis=-1).max(axis=0)[:, None]  # the hull ends here, this way
    inside = points.mean(axis=0)
    outside = inside + away * (beyond - (inside * away).sum(axis=-1)[:, None] + 8 * NEAR)
    assert not result_of(is_mix(outside, points)).any()


def test_distances_to_points_sides_and_triangles():
    corners = np.eye(3)
    assert distance_to_triangles(np.array([1 / 3, 1 / 3, 1 / 3]), corners) == pytest.approx(0)
    assert distance_to_triangles(np.array([0.5, 0.5, 0.2]), corners) > 0.1
    assert distance_to_triangles(np.array([0.5, 0.5, 0.0]), corners[:2]) == pytest.approx(0)
    assert distance_to_triangles(np.array([2.0, 0, 0]), corners[:1]) == pytest.approx(1)


def filtered(scene, picture, radius):
    frame = render(scene)
    return frame, result_of(find_causes(scene, frame, picture, (), 0.0, radius))


def test_a_smoothed_picture_is_explained_and_has_its_radius(room):
    smooth = render(room, Settings(samples=4)).color
    _, found = filtered(room, smooth, 1.0)
    differ = found.cause != AGREE
    assert differ.sum() > 50
    assert (found.cause[differ] == ANTI_ALIASING).all()
    assert (found.figure[differ] <= found.allowed[differ]).all()
    assert (found.allowed[differ] == 1).all() and (found.figure[differ] < 1).any()


def test_without_a_filter_it_is_not(room):
    smooth = render(room, Settings(samples=4)).color
    _, found = filtered(room, smooth, 0.0)
    assert (found.cause == UNEXPLAINED).sum() > 50
    assert not (found.cause == ANTI_ALIASING).any()


@pytest.mark.slow
@sampled(4)
def test_a_filter_excuses_no_fault_inside(room, every):
    color = render(room).color
    color[::every] *= np.float32((1, 0.8, 1, 1))
    frame, found = filtered(room, color, 2.0)
    surface = frame.instance_index[::every] >= 0
    assert (found.cause[::every][surface] == UNEXPLAINED).mean() > 0.8


@pytest.mark.slow
def test_a_shift_is_found_through_a_filter(room):
    from dataclasses import replace

    moved = replace(room, camera=shifted(room.camera, 4, 0))
    _, found = filtered(room, render(moved, Settings(samples=4)).color, 1.0)
    assert (found.cause == UNEXPLAINED).sum() > 100


def test_sums_of_half_floats_lose_a_little(room):
    frame = render(room)
    low = frame.color * np.float32(1 - 32 * 2.0**-12)
    for sums, cause in ((0, UNEXPLAINED), (32, AGREE)):
        found = result_of(find_causes(room, frame, Picture(low, storage=Storage(sums=sums))))
        assert (found.cause[frame.instance_index >= 0] == cause).all()
