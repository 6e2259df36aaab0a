"""The steps that are shown are the tracer's own, to the last bit."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.derivation.expressions import evaluate, parse, printed
from reference_tracer.derivation.formulas import TRIANGLE
from reference_tracer.derivation.textbook import (
    FLOATS,
    Arithmetic,
    camera_steps,
    judge,
    surface_steps,
)
from reference_tracer.projections import PROJECTIONS
from reference_tracer.tracer.camera import Rays, camera_rays
from reference_tracer.tracer.nearest import within_clip
from reference_tracer.tracer.triangle import textbook, textbook_literal

SCALES = (-30, -8, -1, 0, 1, 8, 30)


def hostile(rng, count):
    """Rays near triangles of all sizes and places: origins, directions, corners, (3, n)."""
    size = 10.0 ** rng.choice(SCALES, count)
    center = rng.normal(size=(3, count)) * 10.0 ** rng.choice(SCALES, count)
    corners = [center + size * rng.normal(size=(3, count)) for _ in range(3)]
    corners[2] = np.where(rng.random(count) < 0.1, corners[1], corners[2])  # degenerate
    weights = rng.dirichlet([0.5, 0.5, 0.5], count).T
    target = sum(w * c for w, c in zip(weights, corners, strict=True))
    origins = center + size * rng.normal(size=(3, count)) * 10.0 ** rng.choice((0, 4), count)
    return origins, target - origins, corners


@pytest.mark.parametrize("kind", FLOATS)
def test_triangles_are_the_tracers(make, rng, kind):
    origins, directions, corners = hostile(rng, 400)
    dtype = np.dtype(kind.value)
    with np.errstate(over="ignore"):
        rays = Rays(origins.astype(dtype), directions.astype(dtype))
        cast = [c.astype(dtype) for c in corners]
    camera = make.camera(clip_start=1e-300, clip_end=1e300)
    hit, t, s = textbook(rays, *cast)
    literal, _, _ = textbook_literal(rays, *cast)
    seen = within_clip(camera, t)
    assert 50 < (hit & seen).sum() < 390 and 0 < (literal & seen).sum() < (hit & seen).sum()
    for k in range(len(t)):
        o, d, *p = (kind.vector(v[:, k]) for v in (origins, directions, *corners))
        found = surface_steps(TRIANGLE, o, d, *p)
        shown = np.array([found["t"], found["s1"], found["s2"], found["s3"]], dtype)
        np.testing.assert_array_equal(shown, [t[k], *s[:, k]])
        said = judge(found, camera)
        assert said.accepted == (hit & seen)[k], said
        assert said.literal == (literal & seen)[k]
        assert said.accepted != bool(said.reasons)


@pytest.mark.parametrize("kind", FLOATS)
@pytest.mark.parametrize("projection", PROJECTIONS.values(), ids=PROJECTIONS)
def test_rays_are_the_cameras(make, kind, projection):
    camera = make.camera(37, 23, eye=(3, -4, 5), target=(0.1, 0.2, 0), projection=projection)
    for x, y in ((0, 0), (36, 22), (11, 7)):
        found = camera_steps(kind, camera, x, y)
        rays = camera_rays(camera, np.array([x + 0.5]), np.array([y + 0.5]), np.dtype(kind.value))
        np.testing.assert_array_equal(found["o"], rays.origins[:, 0])
        np.testing.assert_array_equal(found["d"], rays.directions[:, 0])


def test_exactly_a_panoramas_ray_is_of_unit_length(make):
    camera = make.camera(37, 23, projection=PROJECTIONS["equirectangular"])  # axes of integers
    for x, y in ((0, 0), (36, 22), (11, 7)):
        exact, near = (camera_steps(kind, camera, x, y) for kind in (Arithmetic.EXACT, FLOATS[1]))
        assert abs(sum(v * v for v in exact["d"]) - 1) < Fraction(1, 1 << 1500)
        for true, found in zip(exact["d"], near["d"].tolist(), strict=True):
            assert abs(true - Fraction(found)) < Fraction(1, 1 << 50)
    middle = camera_steps(Arithmetic.EXACT, camera, 18, 11)["d"]
    assert middle.tolist() == [0, 0, -1]


def test_exactly_the_weights_sum_to_one_and_make_x(rng):
    """x = s₁p₁ + s₂p₂ + s₃p₃ with sᵢ as here, not as printed; and sum = 1 says nothing."""
    for _ in range(20):
        vectors = rng.normal(size=(5, 3))
        o, d, *p = (Arithmetic.EXACT.vector(v) for v in vectors)
        found = surface_steps(TRIANGLE, o, d, *p)
        weights = found["s1"], found["s2"], found["s3"]
        assert sum(weights) == found["sum"] == Fraction(1)
        for axis in range(3):
            made = sum(w * q[axis] for w, q in zip(weights, p, strict=True))
            assert made == found["x"][axis]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a − b − c", -9),
        ("a / b / c", Fraction(1, 12)),
        ("a + b c − a b", 20),
        ("−(a − b) / c", Fraction(1, 8)),
        ("(a + b) (b + c) c", 440),
        ("u · v", 11),
        ("(u × v) · (v + b u)", 0),
        ("a u · b v", 66),
        ("(u · v) b c / ‖n‖²", Fraction(264, 7)),
    ],
)
def test_formulas_are_read_as_they_are_printed(text, value):
    exact = Arithmetic.EXACT
    names = {"a": 2, "b": 3, "c": 8, "‖n‖²": 7}
    names = {name: exact.number(number) for name, number in names.items()}
    names |= {"u": exact.vector((1, 2, 0)), "v": exact.vector((1, 5, 9))}
    tree = parse(text)
    assert evaluate(tree, names) == value
    assert parse(printed(tree)) == tree
