"""Colours that show the shape: constant shading, by closed forms and by exact triangles."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.files.images import curve
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Mesh
from reference_tracer.tracer.coloring import BACK, FARTHEST
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

from ..cases import rising

ROUNDING = 1e-6  # of float32, in which a frame has its colours


def shown(frame):
    """What a screen shows of a frame, (h, w, 3), before it is rounded to 8 bits."""
    return curve(frame.color[..., :3])


@pytest.fixture
def room(make):
    """Return a ball, a ring and a plane before a background that is half transparent."""
    camera = make.camera(30, 20, eye=(3, -4, 2), target=(0, 0, 0))
    ball = make.mesh(trimesh.creation.icosphere(1))
    ring = make.mesh(trimesh.creation.torus(1.7, 0.2, major_sections=9, minor_sections=5))
    return make.scene(
        camera, ball, ring, planes=[((0, 9, -2), (0, 1, 9))], background=(0.1, 0.2, 0, 0.5)
    )


@pytest.mark.parametrize("flipped", [False, True])
@pytest.mark.parametrize("orthographic", [False, True])
def test_facing_is_the_cosine_and_a_back_is_reddish(make, flipped, orthographic):
    quad = make.quad(-9, 9, -9, 9, -2)
    if flipped:
        quad = replace(quad, triangles=quad.triangles[:, ::-1])
    camera = make.camera(orthographic=orthographic)
    x, y = (np.arange(n) + 0.5 for n in (24, 18))
    x, y = np.meshgrid((x - 12) / 18, (y - 9) / 18)
    cosine = np.ones((18, 24)) if orthographic else 1 / np.sqrt(1 + x * x + y * y)
    found = render(make.scene(camera, quad), Settings(color="facing"))
    expected = cosine[..., None] * (BACK if flipped else np.ones(3))
    np.testing.assert_allclose(shown(found), expected, rtol=0, atol=ROUNDING)
    assert (found.color[..., 3] == 1).all()


@pytest.mark.parametrize("scale", [1e-300, 1e-6, 1, 1e6, 1e300])
@pytest.mark.filterwarnings("error")
def test_normals_are_those_of_the_exact_triangles(make, rng, scale):
    """In world space: of triangles that no transformation has moved, in fractions."""
    points = rng.normal(size=(12, 3)) * scale
    points[:, 2] -= 5 * scale
    mesh = Mesh(points, np.arange(12).reshape(-1, 3))
    camera = make.camera(clip_start=1e-3 * scale, clip_end=1e3 * scale)
    frame = render(make.scene(camera, mesh), Settings(color="normal"))
    expected = []
    for corners in points.reshape(-1, 3, 3):
        a, b, c = (np.array([Fraction(v) for v in corner]) for corner in corners)
        p, q = b - a, c - a
        n = [p[i - 2] * q[i - 1] - p[i - 1] * q[i - 2] for i in range(3)]
        size = max(map(abs, n))
        n = np.array([float(v / size) for v in n])
        expected.append((n / np.linalg.norm(n) + 1) / 2)
    hit = frame.instance_index != NOTHING
    assert len(np.unique(frame.triangle_index[hit])) > 2
    known = np.array(expected)[frame.triangle_index[hit]]
    np.testing.assert_allclose(shown(frame)[hit], known, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("method", ["certified", "textbook"])
def test_depth_falls_evenly_from_the_nearest_hit_to_the_farthest(room, method):
    frame = render(room, Settings(method, color="depth"))
    t, hit = frame.t, frame.instance_index != NOTHING
    grey = shown(frame)[hit]
    assert (grey == grey[:, :1]).all()
    assert grey.max() == pytest.approx(1) and grey.min() == pytest.approx(FARTHEST, abs=ROUNDING)
    share = (t[hit] - t[hit].min()) / np.ptp(t[hit])
    np.testing.assert_allclose(grey[:, 0], 1 - (1 - FARTHEST) * share, rtol=0, atol=ROUNDING)


@pytest.mark.filterwarnings("error")
def test_depths_that_are_all_one_or_none_or_beyond_a_difference(make):
    flat = make.quad(-9, 9, -9, 9, -2)
    camera = make.camera(orthographic=True)
    assert (render(make.scene(camera, flat), Settings(color="depth")).color == 1).all()
    assert not render(make.scene(camera), Settings(color="depth", samples=2)).color.any()
    huge = make.camera(orthographic=True, half=1, clip_start=-1.7e308, clip_end=1.7e308)
    near, far = make.quad(-9, 0, -9, 9, 1.6e308), make.quad(-9, 9, -9, 9, -1.6e308)
    grey = shown(render(make.scene(huge, near, far), Settings(color="depth")))
    assert grey[:, :12] == pytest.approx(1) and grey[:, 12:] == pytest.approx(
        FARTHEST, abs=ROUNDING
    )


@pytest.mark.parametrize("samples", [1, 2])
def test_progress_of_depth_rises_to_1(room, samples):
    settings = Settings(color="depth", samples=samples)
    shares, _ = rising(steps(room, settings, Frame.empty(room)))
    assert shares[-1] == 1 and shares[-2] < 1
