"""The bounds on Blender's arithmetic, against that arithmetic done in float32."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.files.images import decoded, encoded
from reference_tracer.pictures import bounds
from reference_tracer.pictures.bounds import SNAPPING, U32, depth_step, pixel_error, view_error
from reference_tracer.pictures.storage import HALF_UNITS, LEAST_STEP, Storage, difference, differing
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.camera import film_of
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.vector import transform_points

F = np.float32


def times(matrix, points):
    """Return matrix (4, 4) . points (4, n), every product and sum rounded to float32."""
    m, p = matrix.astype(F), points.astype(F)
    rows = [m[i, 0] * p[0] + m[i, 1] * p[1] + m[i, 2] * p[2] + m[i, 3] * p[3] for i in range(4)]
    return np.stack(rows)


def blenders_film(camera, world_from_object, local):
    """Return film positions and depth as a rasteriser computes them, from a float32 pipeline."""
    view = np.linalg.inv(camera.world_from_camera.astype(F))
    w, n, f = camera.window, F(camera.clip_start), F(camera.clip_end)
    projection = np.zeros((4, 4), F)
    if camera.projection.shares_direction:
        projection[0] = (2 / (w.right - w.left), 0, 0, -(w.right + w.left) / (w.right - w.left))
        projection[1] = (0, 2 / (w.top - w.bottom), 0, -(w.top + w.bottom) / (w.top - w.bottom))
        projection[2], projection[3] = (0, 0, -2 / (f - n), -(f + n) / (f - n)), (0, 0, 0, 1)
    else:
        projection[0] = (2 / (w.right - w.left), 0, (w.right + w.left) / (w.right - w.left), 0)
        projection[1] = (0, 2 / (w.top - w.bottom), (w.top + w.bottom) / (w.top - w.bottom), 0)
        projection[2] = (0, 0, -(f + n) / (f - n), -2 * f * n / (f - n))
        projection[3] = (0, 0, -1, 0)
    points = np.vstack((local, np.ones(local.shape[1])))
    clip = times(projection, times(view, times(world_from_object, points)))
    with np.errstate(divide="ignore", invalid="ignore"):  # behind the eye
        x, y = (clip[:2] / clip[3] + F(1)) * F(0.5)
    return x * F(camera.width), y * F(camera.height)


def corner_hits(count):
    """Hits of `count` corners in turn: of triangle k its three."""
    index = np.arange(count)
    return Hits.of(np.ones(count), 0 * index, index // 3, np.eye(3)[index % 3].T)


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("place", [0, 1, 1e2, 1e4, 1e6])
def test_float32_stays_within_the_bound(make, orthographic, place, rng):
    """Random objects, cameras and places: no vertex moves farther than the bound says."""
    used = 0.0
    for _ in range(40):
        where = place * rng.normal(size=3)
        eye = (where + rng.normal(size=3) * 5).astype(F)
        camera = make.camera(
            640,
            360,
            half=3.0 if orthographic else 0.4,
            eye=eye,
            target=where,
            orthographic=orthographic,
        )
        camera = replace(camera, world_from_camera=camera.world_from_camera.astype(F))
        matrix = np.eye(4)
        matrix[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] * rng.uniform(0.2, 3, 3)
        matrix[:3, 3] = where + rng.normal(size=3)
        matrix = matrix.astype(F).astype(float)
        local = rng.normal(size=(3, 300)).astype(F).astype(float)
        world = transform_points(matrix, local)
        x, y, depth = film_of(camera, world)
        corners = np.arange(300).reshape(100, 3)
        scene = Scene(camera, (Mesh(local.T, corners),), (Instance(0, 0, matrix),), objects=("A",))
        bound = pixel_error(camera, depth, view_error(scene, corner_hits(300), world.T)) - SNAPPING
        px, py = blenders_film(camera, matrix, local)
        inside = (x > 0) & (x < 640) & (y > 0) & (y < 360) & (depth > camera.clip_start)
        assert inside.any()
        moved = np.maximum(np.abs(px - x), np.abs(py - y))[inside]
        assert (moved <= bound[inside]).all()
        used = max(used, float((moved / bound[inside]).max()))
    assert used > 0.02  # not so wide that it would excuse anything


def test_planes_have_a_place_too(make):
    scene = make.scene(make.camera(), make.quad(-1, 1, -1, 1, -5))
    scene = replace(scene, planes=(Plane(0, (1e6, 0, 0), (0, 0, 1)),))
    hits = Hits.of(np.full(2, 5.0), np.array([1, 1]), np.array([-1, -1]), np.zeros((3, 2)))
    near, far = view_error(scene, hits, np.array([[0, 0, -5.0], [1e6, 0, 0]]))
    assert far > 1e5 * U32 > near > 0


@pytest.mark.parametrize("orthographic", [False, True])
def test_a_depth_buffer_tells_apart_what_is_farther_than_the_resolution(make, orthographic, rng):
    """A depth buffer of 24 bits, its values computed in float32."""
    confused = 0
    for _ in range(300):
        near = 10.0 ** rng.uniform(-3, 0)
        far = near * 10.0 ** rng.uniform(1, 5)
        camera = make.camera(clip_start=near, clip_end=far, orthographic=orthographic)
        depth = np.exp(rng.uniform(np.log(near), np.log(far), 200))
        gap = depth_step(camera, depth)
        first, second, close = (
            buffer(camera, d, orthographic) for d in (depth, depth + gap, depth + 0.05 * gap)
        )
        inside = depth + gap < far
        assert (second > first)[inside].all()
        confused += int((close <= first)[inside].sum())
    assert confused > 100  # the bound is not far from what such a buffer does


def buffer(camera, depth, orthographic):
    """Return depth buffer values, (n,) integers."""
    n, f, z = F(camera.clip_start), F(camera.clip_end), depth.astype(F)
    if orthographic:
        value = (F(2) / (f - n)) * z + -(f + n) / (f - n)
    else:
        value = ((f + n) / (f - n) * z + -(F(2) * f * n) / (f - n)) / z
    return np.rint((value * F(0.5) + F(0.5)).astype(float) * (2**24 - 1))


def test_dark_colours_are_told_apart():
    """What is allowed goes with the value: near black, too, one colour is not another."""
    dark, darker = np.full((1, 1, 4), 0.0019), np.full((1, 1, 4), 0.0002)
    assert differing(dark, darker).all()
    assert not differing(dark * 1e3, dark * 1e3 * (1 - 2.0**-10)).any()
    assert differing(np.full((1, 1, 4), 1e9), np.full((1, 1, 4), 2e9)).all()


def test_differing_is_symmetric_and_strict(rng):
    first = (3 * rng.random((5, 6, 4)) + 0.01).astype(np.float16).astype(np.float64)
    unit = np.spacing(first.astype(np.float16)).astype(np.float64)
    allowed = np.maximum(HALF_UNITS * unit, LEAST_STEP)
    second = first - allowed * rng.choice([0, 0.9, 1.1], first.shape, p=[0.6, 0.3, 0.1])
    expected = (first - second > allowed).any(axis=-1)
    assert 0 < expected.sum() < 30
    assert np.array_equal(differing(first, second), expected)
    assert np.array_equal(differing(second, first), expected)


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_what_is_near_agrees_at_once(rng, dtype):
    """As if each were asked how far it may be: at any scale, at the least step, at no number."""
    scale = np.exp2(rng.uniform(-30, 15, (4000, 1)))
    first = (scale * rng.uniform(-1, 1, (4000, 4))).astype(dtype)
    step = rng.choice([0, 0.5, 1 - 2.0**-12, 1, 1 + 2.0**-12, 2], first.shape) * LEAST_STEP
    second = (first + step).astype(dtype)
    for values in (first, second):
        values[rng.random(values.shape) < 0.01] = rng.choice([np.inf, -np.inf, np.nan])
    apart, allowed = difference(first, second)
    with np.errstate(invalid="ignore"):
        expected = ~((apart <= allowed) & np.isfinite(first) & np.isfinite(second)).all(axis=-1)
    assert np.array_equal(differing(first, second), expected)
    assert 100 < expected.sum() < 3900


def test_half_floats_agree_and_bytes_do_not():
    """Three units of a half float are missing at most; one step of an 8-bit picture is a fault."""
    white = np.ones((1, 1, 4), np.float32)
    assert not differing(white, white - 3 * np.float32(2.0**-11)).any()
    assert differing(white, white - np.float32(1 / 255)).all()


@pytest.mark.parametrize("rows", [1, 3, 1000])
@pytest.mark.parametrize("shape", [(1, 1), (9, 13), (40, 7)])
def test_every_error_reaches_as_far_as_it_is_large(rng, monkeypatch, rows, shape):
    monkeypatch.setattr(bounds, "_ROWS", rows)
    for scale in (0.0, 0.5, 4.0, 60.0):
        own = np.where(rng.random(shape) < 0.3, scale * rng.random(shape) ** 4, 0.0)
        expected = np.full(shape, SNAPPING)
        for y, x in np.argwhere(own > 0):
            reach = int(2 ** np.ceil(np.log2(max(own[y, x], 1))))
            near = expected[max(0, y - reach) : y + reach + 1, max(0, x - reach) : x + reach + 1]
            np.maximum(near, own[y, x], out=near)
        assert np.array_equal(result_of(bounds.spread_error(own)), expected)


@pytest.mark.parametrize("missing", [0, 1, HALF_UNITS - 1])
def test_half_floats_in_a_png_of_16_bits_miss_as_many_units_as_in_an_exr(missing, rng):
    """At every brightness, as units are of the linear value; a colour twice as far off differs."""
    first = np.exp2(rng.uniform(-14, 0, (5000, 3)))
    half = first.astype(np.float16).astype(float)
    half = half - (half > first) * np.spacing(half.astype(np.float16)).astype(float)
    unit = np.spacing(half.astype(np.float16)).astype(float)

    def stored(color):
        return decoded(np.rint(encoded(color) * 65535) / 65535)

    assert not differing(first, stored(half - missing * unit), False, Storage(65535)).any()
    bright = (first > 2.0**-7).all(axis=-1)
    assert bright.sum() > 100
    wrong = stored(half - 4 * HALF_UNITS * unit)
    assert differing(first, wrong, False, Storage(65535))[bright].all()
    assert not differing(first, stored(first), False, Storage(65535)).any()
