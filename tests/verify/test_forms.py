"""What floats say of rays and surfaces is off by less than the checker's bound."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.files.certificates import save_certificate
from reference_tracer.rendering import render
from reference_tracer_verify import verify
from reference_tracer_verify.verify import Certificate, candidates, cross, dot, forms, levels

from .certificates import refusal, scene_of


def exact(vector) -> list[Fraction]:
    return [Fraction(float(x)) for x in np.ravel(vector)]


def minus(a, b) -> list[Fraction]:
    return [x - y for x, y in zip(a, b, strict=True)]


def truth(of: Certificate, surface: int, o, d) -> list[Fraction]:
    """The eight functions in fractions, from their definition; a plane has but T and D."""
    corners = [exact(c) for c in of.corners[..., surface]]
    a, b, c = (minus(corner, o) for corner in corners)
    normal = cross(minus(b, a), minus(c, a))
    if surface >= of.triangles:
        normal = corners[1]
    q = exact(of.aside)
    out = [dot(a, normal), dot(d, normal)]
    out += [dot(d, cross(p, minus(q, p))) for p, q in ((a, b), (b, c), (c, a))]
    return out + [dot(d, cross(p, q)) for p in (a, b, c)]


def prepared(of: Certificate):
    """Return the rays of all pixels, what of them varies, and the forms."""
    origins, directions = of.rays(np.arange(len(of.t)))
    is_parallel = of.kind == "orthographic"
    r = origins - of.eye if is_parallel else directions
    with np.errstate(all="ignore"):
        functions = forms(of, is_parallel, np.abs(r).max())
    return origins, directions, r.reshape(3, *of.t.shape), functions


def test_the_bound_holds(make, tmp_path):
    """At each pixel, and over squares of pixels: the share of the bound that is used is told."""
    used, decided, count = Fraction(0), 0, 0
    for seed in range(40):
        save_certificate(tmp_path / "c.npz", render(scene_of(make, seed)))
        of = Certificate(str(tmp_path / "c.npz"))
        origins, directions, r, functions = prepared(of)
        surfaces = len(of.names)
        squares = levels(r, of.t)
        rng = np.random.default_rng(seed)
        for _ in range(12):
            pixel, surface = int(rng.integers(of.t.size)), int(rng.integers(surfaces))
            y, x = divmod(pixel, of.t.shape[1])
            o, d = (exact(v[:, pixel % v.shape[1]]) for v in (origins, directions))
            true = truth(of, surface, o, d)
            for k, square in enumerate(squares):
                middle, half = square[:6, y >> k, x >> k].reshape(2, 3)
                constant, *slope, error = functions[..., surface]
                with np.errstate(all="ignore"):
                    value = constant + dot(slope, middle)
                    reach = dot(np.abs(slope), half) + error
                known = np.isfinite(value) & np.isfinite(reach)
                for n in np.flatnonzero(known).tolist():
                    off = abs(true[n] - Fraction(value[n]))
                    assert off <= Fraction(reach[n]), (seed, k, n)
                    if k == 0 and reach[n] > 2.0**-1000:
                        used = max(used, off / Fraction(reach[n]))
                        decided += abs(value[n]) > reach[n]
                        count += 1
    assert Fraction(1, 200) < used < Fraction(1, 5) and decided > 0.7 * count > 2000


def test_what_is_met_is_left(make, tmp_path):
    """No surface is dropped that a ray meets up to the farthest t, also where squares are large."""
    met = 0
    for seed in range(0, 16, 2):
        scene = scene_of(make, seed)
        save_certificate(tmp_path / "c.npz", render(scene))
        of = Certificate(str(tmp_path / "c.npz"))
        origins, directions, r, functions = prepared(of)
        surfaces = len(of.names)
        whole = np.outer((0, 0, 1), np.arange(surfaces))
        with np.errstate(all="ignore"):
            squares = levels(r, np.full(of.t.shape, of.clip[1]))
            left = list(candidates(functions, squares, of.clip[0], whole))
        pairs = {(y * of.t.shape[1] + x, s) for some in left for y, x, s in some.T.tolist()}
        rng = np.random.default_rng(seed)
        for pixel in rng.choice(of.t.size, min(10, of.t.size), replace=False).tolist():
            o, d = (exact(v[:, pixel % v.shape[1]]) for v in (origins, directions))
            for surface in range(surfaces):
                top, bottom, ab, bc, ca, *_ = truth(of, surface, o, d)
                if not bottom or min(ab, bc, ca) < 0 < max(ab, bc, ca):
                    continue
                t = top / bottom
                if of.clip[0] <= t <= of.clip[1]:
                    met += 1
                    assert (pixel, surface) in pairs, (seed, pixel, surface)
    assert met > 40


def test_what_overflows_has_no_sign(tmp_path):
    """Sums overflow here to an infinity of the other sign: the triangle must not be dropped."""
    size = 1.41 * 2.0**341
    camera = np.eye(4)
    camera[:3, 2] = np.array([-0.9, 1.0, -0.8]) * size
    arrays = dict(
        certificate="reference_tracer.certificate/2",
        camera="perspective",
        world_from_camera=camera,
        window=np.array([[-1.0, 1.0], [-1.0, 1.0]]),
        pixels=np.array([[0, 1, 1], [0, 1, 1]]),
        clip=np.array([0.1, 2.0]),
        vertices=np.array([[0.3, 0.0, 0.9], [-0.5, 0.7, 0.2], [0.6, -0.7, 0.4]]) * size,
        triangles=np.array([[0, 1, 2]]),
        instances=np.array([[0, 1]]),
        world_from_object=np.eye(4)[None],
        planes=np.empty((0, 2, 3)),
        seen=np.full((1, 1, 2), -1),
        t=np.full((1, 1), np.inf),
        ties=np.empty((0, 3), int),
    )
    np.savez(tmp_path / "c.npz", **arrays)
    assert "it sees ((0, 0), 0." in refusal(tmp_path / "c.npz")


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 1), (5, 6), (8, 16), (17, 33)])
def test_squares_have_their_pixels_and_lose_no_pair(shape, monkeypatch):
    """All surfaces come to each pixel once, if none is dropped; boxes and far are of all pixels."""
    monkeypatch.setattr(verify, "PAIRS", 50)
    rng = np.random.default_rng(shape)
    r, far = rng.normal(size=(3, *shape)), rng.uniform(1, 9, shape)
    squares = levels(r, far)
    for y, x in np.ndindex(shape):
        for k, square in enumerate(squares):
            middle, half = square[:6, y >> k, x >> k].reshape(2, 3)
            assert (np.abs(r[:, y, x] - middle) <= half).all()
            assert far[y, x] <= square[6, y >> k, x >> k]
    unknown = np.zeros((5, 8, 3))
    unknown[4] = np.inf
    whole = np.outer((0, 0, 1), np.arange(3))
    left = np.concatenate(list(candidates(unknown, squares, 0.1, whole)), axis=1)
    every = [(y, x, s) for y, x in np.ndindex(shape) for s in range(3)]
    assert sorted(map(tuple, left.T.tolist())) == every
