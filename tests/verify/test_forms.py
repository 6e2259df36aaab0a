"""What floats say of rays and surfaces is off by less than the checker's bound."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from reference_tracer.certificate_file import save_certificate
from reference_tracer.rendering import render
from reference_tracer_verify.verify import Certificate, Forms, candidates, cross, dot, levels

from .certificates import scene_of


def exact(vector) -> list[Fraction]:
    return [Fraction(float(x)) for x in np.ravel(vector)]


def minus(a, b) -> list[Fraction]:
    return [x - y for x, y in zip(a, b, strict=True)]


def truth(of: Certificate, surface: int, o, d) -> list[Fraction]:
    """The eleven functions in fractions, from their definition; a plane has but T and D."""
    corners = [minus(exact(c), o) for c in of.corners[..., surface]]
    a, b, c = corners
    if surface >= of.triangles:
        normal = exact(of.normals[:, surface - of.triangles])
        return [Fraction(0)] * 9 + [dot(a, normal), dot(d, normal)]
    out = [dot(d, cross(exact(q), p)) for q in (of.right, of.up) for p in corners]
    out += [dot(d, cross(p, minus(q, p))) for p, q in ((a, b), (b, c), (c, a))]
    normal = cross(minus(b, a), minus(c, a))
    return [*out, dot(a, normal), dot(d, normal)]


def test_the_bound_holds(make, tmp_path):
    """At each pixel, and over squares of pixels: the share of the bound that is used is told."""
    used, decided, count = Fraction(0), 0, 0
    for seed in range(40):
        save_certificate(tmp_path / "c.npz", render(scene_of(make, seed)))
        of = Certificate(str(tmp_path / "c.npz"))
        rows = np.arange(of.shape[0])
        origins, directions = of.rays(rows)
        ahead = directions if directions.shape[1] == 1 else None
        r = directions if ahead is None else origins - of.eye
        surfaces = of.corners.shape[2]
        with np.errstate(all="ignore"):
            forms = Forms(of, slice(0, surfaces), ahead, np.abs(r).max())
        squares = levels(r.reshape(3, *of.shape), of.t)
        rng = np.random.default_rng(seed)
        for _ in range(12):
            pixel, surface = int(rng.integers(of.t.size)), int(rng.integers(surfaces))
            y, x = divmod(pixel, of.shape[1])
            o, d = (exact(v[:, pixel % v.shape[1]]) for v in (origins, directions))
            true = truth(of, surface, o, d)
            for k, (shape, middle, half, _) in enumerate(squares):
                at = (y >> k) * shape[1] + (x >> k)
                with np.errstate(all="ignore"):
                    value = forms.constant[:, surface] + dot(
                        forms.slope[..., surface].T, middle[:, at]
                    )
                    spread = dot(np.abs(forms.slope[..., surface]).T, half[:, at])
                reach = spread + forms.error[:, surface]
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
        origins, directions = of.rays(np.arange(of.shape[0]))
        ahead = directions if directions.shape[1] == 1 else None
        r = directions if ahead is None else origins - of.eye
        surfaces = of.corners.shape[2]
        with np.errstate(all="ignore"):
            forms = Forms(of, slice(0, surfaces), ahead, np.abs(r).max())
            far = np.full(of.shape, of.clip[1])
            left = list(candidates(forms, levels(r.reshape(3, *of.shape), far), of.clip[0]))
        pairs = {pair for some in left for pair in zip(*(v.tolist() for v in some), strict=True)}
        rng = np.random.default_rng(seed)
        for pixel in rng.choice(of.t.size, min(10, of.t.size), replace=False).tolist():
            o, d = (exact(v[:, pixel % v.shape[1]]) for v in (origins, directions))
            for surface in range(surfaces):
                *_, ab, bc, ca, top, bottom = truth(of, surface, o, d)
                if not bottom or min(ab, bc, ca) < 0 < max(ab, bc, ca):
                    continue
                t = top / bottom
                if of.clip[0] <= t <= of.clip[1]:
                    met += 1
                    assert (pixel, surface) in pairs, (seed, pixel, surface)
    assert met > 40
