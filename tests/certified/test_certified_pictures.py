"""Whole pictures, certified: every pixel as exact arithmetic has it, at any scale."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh
from reference_tracer.tracer.hits import NOTHING, NOWHERE

from ..tracer.pictures import CERTIFIED, check, mess, names_of

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error")]
KINDS = pytest.mark.parametrize("whole", [False, True], ids=["any", "whole"])
CAMERAS = pytest.mark.parametrize("orthographic", [False, True], ids=["persp", "ortho"])


@CAMERAS
@KINDS
def test_brute_force(make, rng, orthographic, whole):
    seen, certainty = set(), np.zeros(4, int)
    for _ in range(3):
        scene = mess(make, rng, orthographic, whole)
        frame = check(scene)
        seen |= set(names_of(frame))
        certainty += np.bincount(frame.certainty.ravel(), minlength=4)
        assert frame.statistics.pairs_tested > 0
    assert len(seen) > 10 and (len(scene.instances), NOTHING) in seen
    assert certainty[Certainty.BOUND] > 50
    assert certainty[Certainty.AMBIGUOUS] > 50 or not whole


@cache
def checked_at_scale_1(make, orthographic, whole):
    return check(mess(make, np.random.default_rng(3), orthographic, whole))


@CAMERAS
@KINDS
@pytest.mark.parametrize(
    "scale",
    [
        *(2.0**e for e in (-996, -340, -300, 300, 340)),
        1e-300,
        1e300,
    ],
    ids="{:.0e}".format,
)
def test_no_scale_is_too_small_or_too_large(make, orthographic, whole, scale):
    """Culling, too, keeps every hit: the picture is the oracle's, or that of scale 1, which is."""
    scene = mess(make, np.random.default_rng(3), orthographic, whole, scale)
    if np.log2(scale) % 1:
        check(scene)
    else:
        frame, ordinary = render(scene, CERTIFIED), checked_at_scale_1(make, orthographic, whole)
        assert names_of(frame) == names_of(ordinary) and frame.ties == ordinary.ties
        assert np.array_equal(frame.t, ordinary.t * scale)


@CAMERAS
@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300])
def test_the_other_passes_at_any_scale(make, rng, orthographic, scale):
    frame = render(mess(make, rng, orthographic, False, scale), CERTIFIED)
    hit = frame.instance_index >= 0
    assert np.isfinite(frame.position).all() and np.isfinite(frame.barycentrics).all()
    on_mesh = frame.triangle_index >= 0
    assert np.allclose(frame.barycentrics.sum(axis=-1), on_mesh, rtol=0, atol=1e-9)
    assert np.allclose((frame.normal**2).sum(axis=-1), hit, rtol=0, atol=1e-9)


def test_far_from_the_origin(make, rng):
    """A scene of metres at 10^8 metres: vertices are rounded, and what they are is certified."""
    scene = mess(make, rng, False, False)
    place = np.array((1e8, -3e7, 2e8))
    moved = [
        replace(i, world_from_object=i.world_from_object + np.pad(place[:, None], ((0, 1), (3, 0))))
        for i in scene.instances
    ]
    planes = [replace(p, point=p.point + place) for p in scene.planes]
    camera = make.camera(12, 8, eye=place, clip_start=2, clip_end=7)
    check(replace(scene, camera=camera, instances=moved, planes=planes))


@CAMERAS
def test_planes_alone(make, orthographic):
    """Planes through one another, coincident, through the camera, parallel to its rays."""
    at = [
        ((0, 0, -4), (0, 0, 1)),
        ((0, 0, -4), (0, 0, -3)),
        ((1, 0, -4), (1, 0, 1)),
        ((0.5, 0.5, 0), (1, 1, 0)),
        ((0, 0, -2.0), (0.5, 1, 1)),
        ((0, 0, -5), (1, 0, 0)),
    ]
    camera = make.camera(
        12, 8, half=4 if orthographic else 0.5, orthographic=orthographic, eye=(0.5, 0.5, 0)
    )
    seen = set()
    for planes in (at[:2], at[:3], at[3:], at[::-1]):
        frame = check(make.scene(camera, planes=planes))
        seen |= set(names_of(frame))
        if planes == at[:2]:
            assert set(names_of(frame)) == {(0, NOTHING)}
            assert (frame.certainty == Certainty.AMBIGUOUS).all()
    assert len(seen) > 3


@CAMERAS
def test_a_plane_and_triangles_in_it(make, orthographic):
    camera = make.camera(8, 6, half=3 if orthographic else 0.5, orthographic=orthographic)
    quad = make.quad(-1, 9, -9, 9, -2)
    frame = check(make.scene(camera, quad, planes=[((5, 5, -2), (0, 0, 3))]))
    on_quad = frame.instance_index == 0
    assert 0 < on_quad.sum() < on_quad.size and (frame.t == 2).all()
    assert all(names >= {(1, NOTHING)} for names in frame.ties.values())


@CAMERAS
@pytest.mark.parametrize(
    "z, seen", [(2, 1), (3, 1), (np.nextafter(2, 0), 0), (3.0000000000000004, 0)]
)
def test_clip_planes_exactly_at_surfaces(make, orthographic, z, seen):
    camera = make.camera(
        6, 4, half=1.5, orthographic=orthographic, clip_start=2, clip_end=3, eye=(0.25, 0.125, 0)
    )
    for scene in (
        make.scene(camera, make.quad(-90, 90.5, -90, 91, -z)),
        make.scene(camera, planes=[((0, 0, -z), (0, 0, 1))]),
    ):
        frame = check(scene)
        assert ((frame.t == z) == seen).all() and frame.statistics.pairs_exact > 0


def test_a_ray_through_every_corner_of_a_grid(make):
    """Whole pixels, whole vertices: every ray meets a corner where six triangles meet."""
    x, y = np.meshgrid(np.arange(9.0), np.arange(7.0))
    points = np.stack((x.ravel(), y.ravel(), np.full(63, -2.0)), axis=1)
    k = (np.arange(6)[:, None] * 9 + np.arange(8)).ravel()[:, None]
    grid = Mesh(points, np.concatenate([k + np.array(c) for c in ((0, 1, 9), (1, 10, 9))]))
    camera = make.camera(7, 5, half=2.5, orthographic=True, eye=(4, 3, 0))
    frame = check(make.scene(camera, grid))
    assert (frame.instance_index == 0).all() and (frame.t == 2).all()
    assert (frame.certainty == Certainty.AMBIGUOUS).all()
    assert all(len(names) == 6 and NOWHERE not in names for names in frame.ties.values())
    assert (np.abs(np.sort(frame.barycentrics) - (0, 0, 1)) == 0).all()
