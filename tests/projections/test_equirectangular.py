"""The panorama: its rays in closed form, its boxes, and its certified pictures against integers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.rounding import rounding
from reference_tracer.projections import EQUIRECTANGULAR
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Region, Scene, SceneError, ViewWindow
from reference_tracer.tracer.camera import (
    camera_rays,
    corner_rays,
    film_beside,
    film_positions,
    pixel_size,
)
from reference_tracer.tracer.candidates import pixel_bounds
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

from ..oracle import scene_sights
from .test_sine import true_sine

WHOLE = ViewWindow(-np.pi, np.pi, -np.pi / 2, np.pi / 2)
BLENDERS = ViewWindow(*(float(np.float32(v)) for v in vars(WHOLE).values()))  # beyond the poles
EYE = (3.25, -4.5, 0.125)
PARTS = [0, *(pytest.param(n, marks=pytest.mark.torture) for n in (1, 2, 3, 4))]


def turned(rng) -> np.ndarray:
    return np.linalg.qr(rng.normal(size=(3, 3)))[0]


def panorama(make, width=32, height=16, window=WHOLE, **options):
    return make.camera(width, height, window=window, projection=EQUIRECTANGULAR, **options)


def hostile_panorama(make, rng):
    """Return a camera of any scale, place, border and clip range that may see parts twice."""
    kind = rng.integers(5)
    x, y = np.sort(rng.uniform(-7, 7, 2)), np.sort(rng.uniform(-2.2, 2.2, 2))
    if kind > 2:  # pixels that are small before the triangles
        x, y = (v[0] + 10.0 ** rng.uniform(-4, -1) * np.array((0, 1)) for v in (x, y))
    window = ViewWindow(*map(float, (*x, *y)))
    window = (WHOLE, BLENDERS, window, window, window)[kind]
    scale, (width, height) = 10.0 ** rng.uniform(-6, 6), (int(n) for n in rng.integers(3, 17, 2))
    axes = turned(rng)
    if rng.integers(4) == 0:
        axes = axes @ (np.eye(3) + rng.uniform(-0.3, 0.3, (3, 3)))
    start = scale * 10.0 ** rng.uniform(-4, 0)
    region = Region(1, 1, width, height) if rng.integers(2) else None
    return scale, panorama(
        make, width, height, window, region=region,
        eye=scale * rng.normal(size=3) * 10.0 ** rng.choice([-3, 0, 2]), axes=axes,
        clip_start=start, clip_end=start * 10.0 ** rng.uniform(0.3, 6),
    )  # fmt: skip


def hostile_triangles(camera, scale, rng, count=30) -> np.ndarray:
    """Return corners (3, 3, n): at poles, seams and pixel centres, around the eye, slivers."""
    rays = camera_rays(camera, *film_positions(camera.region)).directions
    middle = rays[:, rng.integers(rays.shape[1], size=count)]
    special = np.array([camera.up, -camera.up, -camera.forward]).T
    at = rng.random(count) < 0.4
    middle[:, at] = special[:, rng.integers(3, size=at.sum())]
    w = camera.window
    size = 10.0 ** rng.uniform(-3, 0.5, count) * min(1, w.right - w.left, w.top - w.bottom)
    far = scale * 10.0 ** rng.uniform(-2, 2, (3, 1, count))
    corners = middle + size * rng.normal(size=(3, 3, count))
    on = rng.random(count) < 0.3  # a corner in a ray, an edge through one
    corners[0][:, on] = middle[:, on]
    through = rng.random(count) < 0.2
    corners[1][:, through] = 2 * middle[:, through] - corners[2][:, through]
    flat = rng.random(count) < 0.5
    far[:, :, flat] = far[:1, :, flat]
    return camera.origin[:, None] + far * corners


def scene_of(camera, corners, planes=()) -> Scene:
    vertices = np.moveaxis(corners, 2, 0).reshape(-1, 3)
    mesh = Mesh(vertices, np.arange(len(vertices)).reshape(-1, 3))
    return Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), planes, objects=("It",))


def test_beside_a_ray_straight_lines_are_straight(make, rng):
    camera = panorama(make, 90, 45, eye=EYE, axes=turned(rng))
    px, py = rng.uniform(0, 90, 100), rng.uniform(0, 45, 100)
    dx, dy = rng.uniform(-1e-4, 1e-4, (2, 100))
    points = camera_rays(camera, px + dx, py + dy).at(3.0)
    # The plane leaves the sphere with the square of the offset; near a pole, sooner.
    np.testing.assert_allclose(film_beside(camera, points, px, py), (dx, dy), rtol=0, atol=1e-6)
    ends = camera.origin[:, None] + rng.normal(size=(2, 3, 100))
    line = [film_beside(camera, p, px, py) for p in (ends[0], ends.mean(axis=0), ends[1])]
    (ax, ay), (bx, by) = line[1] - line[0], line[2] - line[0]
    seen = np.isfinite(ax + bx)
    assert seen.sum() > 10
    area, size = (ax * by - ay * bx)[seen], (np.abs(line).max(axis=(0, 1)) ** 2)[seen]
    assert (np.abs(area) <= 1e-12 * (1 + size)).all()


@pytest.mark.slow
def test_the_bound_on_its_rounding_holds(make):
    """Against the unrounded rays, whose sines come from the whole series in integers."""
    for seed in range(40):
        rng = np.random.default_rng(seed)
        _, camera = hostile_panorama(make, rng)
        bound = rounding(Scene(camera)).ray
        w, axes = camera.window, (camera.right, camera.up, camera.forward)
        px, py = rng.integers(camera.width) + 0.5, rng.integers(camera.height) + 0.5
        left, right, bottom, top = (Fraction(v) for v in vars(w).values())
        u = left + Fraction(px) * (right - left) / camera.width
        v = bottom + Fraction(py) * (top - bottom) / camera.height
        east, ahead, north, level = (true_sine(a, q) for a, q in ((u, 0), (u, 1), (v, 0), (v, 1)))
        weights = level * east, north, level * ahead
        true = [
            sum(k * Fraction(float(axis[i])) for k, axis in zip(weights, axes, strict=True))
            for i in range(3)
        ]
        found = camera_rays(camera, np.array([px]), np.array([py])).directions[:, 0]
        assert sum(abs(Fraction(float(f)) - t) for f, t in zip(found, true, strict=True)) <= bound


def test_enclosing_rays_enclose(make):
    for seed in range(100):
        _, camera = hostile_panorama(make, np.random.default_rng(seed))
        rays = camera_rays(camera, *film_positions(camera.region, 0.5, -0.5)).directions
        most = np.abs(corner_rays(camera, 0.5, -0.5).directions).max(axis=1)
        assert (np.abs(rays).max(axis=1) <= most).all() and (most < 6).all()


def test_boxes_are_tight_but_at_poles_and_seams(make):
    camera = panorama(make, 400, 200, BLENDERS, axes=np.eye(3))
    for longitude, latitude, most in ((0.5, 0.3, 12), (2.5, -1.2, 30), (-3.0, 0.0, 12)):
        level = np.cos(latitude)
        at = [level * np.sin(longitude), np.sin(latitude), -level * np.cos(longitude)]
        corners = 7 * (np.array(at) + 0.05 * np.eye(3))[:, :, None]
        x0, x1, y0, y1 = pixel_bounds(camera, corners)[:, 0]
        assert 0 < x1 - x0 < most and 0 < y1 - y0 < 12
    behind = np.array([[0.1, 0.1, 5], [-0.1, 0.1, 5], [0, -0.1, 5.0]])[:, :, None]
    x0, x1, y0, y1 = pixel_bounds(camera, behind)[:, 0]
    assert (x0, x1) == (0, 400) and y1 - y0 < 12  # it is seen on both sides
    above = behind[:, [0, 2, 1]]
    x0, x1, y0, y1 = pixel_bounds(camera, above)[:, 0]
    assert (x0, x1, y1) == (0, 400, 200) and y0 > 190


@pytest.mark.slow
@pytest.mark.parametrize("part", PARTS)
def test_certified_is_what_the_integers_say(make, part):
    """Owner and t of every ray, against the oracle, which knows nothing of the tracer's own."""
    rays = hits = 0
    for seed in range(40 * part, 40 * (part + 1)):
        rng = np.random.default_rng(seed)
        scale, camera = hostile_panorama(make, rng)
        planes = [Plane(0, camera.origin + scale * rng.normal(size=3), rng.normal(size=3))]
        corners = hostile_triangles(camera, scale, rng, 12)
        corners = np.concatenate((corners, corners[:, :, :2]), axis=2)  # some twice
        scene = scene_of(camera, corners, planes * int(rng.integers(2)))
        frame = render(scene, Settings("certified"))
        found = zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True)
        sights = scene_sights(scene)
        for k, (sight, name, t) in enumerate(zip(sights, found, frame.t.ravel(), strict=True)):
            assert sight.seen == name, (seed, k)
            assert t == (np.inf if sight.t is None else float(sight.t)), (seed, k)
            rays, hits = rays + 1, hits + (name[0] != NOTHING)
    assert hits > 500 and hits < rays


def test_its_clip_range_begins_before_it(make):
    with pytest.raises(SceneError, match="equirectangular camera sees begins in front"):
        panorama(make, clip_start=0.0)


def test_the_size_of_its_pixels(make):
    assert pixel_size(panorama(make)) == pytest.approx((np.pi / 16, np.pi / 16))
