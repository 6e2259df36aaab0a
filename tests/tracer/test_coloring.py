"""Colours that show the shape: constant shading, by closed forms and by exact triangles."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.files.images import curve, to_display
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Instance, Mesh, Region
from reference_tracer.tracer.coloring import BACK, FARTHEST, Color
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

SHAPES = [c for c in Color if c != Color.OBJECT]
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


def test_a_plane_that_faces_the_camera_is_white_and_its_normal_is_the_normal_maps_blue(make):
    camera = make.camera(orthographic=True)
    scene = make.scene(camera, planes=[((0, 0, -2), (0, 0, 7))])
    for color, expected in (("facing", (255, 255, 255)), ("normal", (128, 128, 255))):
        assert (to_display(render(scene, Settings(color=color)).color) == (*expected, 255)).all()


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


@pytest.mark.parametrize("color", Color)
def test_all_but_the_colour_of_surfaces_is_the_same(room, color):
    """What is seen, what is known of it, what it took; and the background."""
    plain, frame = render(room), render(room, Settings(color=color))
    for name, values in vars(plain).items():
        assert (
            name == "color"
            or not isinstance(values, np.ndarray)
            or np.array_equal(values, getattr(frame, name))
        ), name
    assert dict(plain.ties) == dict(frame.ties)
    assert plain.statistics.pairs_tested == frame.statistics.pairs_tested
    hit = plain.instance_index != NOTHING
    assert 0 < hit.sum() < hit.size
    assert np.array_equal(plain.color[~hit], frame.color[~hit])
    assert (frame.color[hit, 3] == 1).all()
    assert np.array_equal(plain.color, frame.color) == (color is Color.OBJECT)


@pytest.mark.parametrize("color", Color)
def test_samples_are_the_mean_of_a_finer_picture(room, color):
    settings = Settings(color=color, samples=3)
    camera = room.camera
    fine = replace(room, camera=replace(camera, width=90, height=60, region=None))
    found, finer = render(room, settings), render(fine, Settings(color=color))
    each = finer.color.astype(float)
    if color is Color.DEPTH:  # which is between the hits of the picture's own rays
        near, far = found.depths()
        share = (np.clip(finer.t, near, far) - near) / (far - near)
        hit = finer.instance_index != NOTHING
        grey = 1 - (1 - FARTHEST) * share[hit]
        each[hit, :3] = (((grey + 0.055) / 1.055) ** 2.4)[:, None]
    mean = each.reshape(20, 3, 30, 3, 4).mean(axis=(1, 3))
    np.testing.assert_allclose(found.color, mean, rtol=0, atol=4 * ROUNDING)


@pytest.mark.parametrize("color", [Color.NORMAL, Color.FACING])
def test_a_border_is_a_part_of_the_picture(room, color):
    whole = render(room, Settings(color=color)).color
    part = replace(room, camera=replace(room.camera, region=Region(5, 3, 21, 17)))
    assert np.array_equal(render(part, Settings(color=color)).color, whole[3:17, 5:21])


@pytest.mark.parametrize("signs", [(-1, 1, 1), (1, -1, -1), (-1, -1, -1)])
def test_a_mirrored_instance_shows_its_front(make, signs):
    ball = make.mesh(trimesh.creation.icosphere(1))
    scene = make.scene(make.camera(eye=(3, -4, 2), target=(0, 0, 0)), ball)
    mirrored = [Instance(0, 0, np.diag([*signs, 1.0]))]
    color = render(replace(scene, instances=mirrored), Settings(color="facing")).color
    seen = color[..., 3] == 1
    assert seen.any() and (color[seen, 0] == color[seen, 1]).all()


@pytest.mark.parametrize("samples", [1, 2])
def test_progress_of_depth_rises_to_1(room, samples):
    settings = Settings(color="depth", samples=samples)
    shares = list(steps(room, settings, Frame.empty(room)))
    assert shares == sorted(shares) and shares[-1] == 1 and shares[-2] < 1


@pytest.mark.parametrize("samples", [1, 2])
def test_what_is_done_of_a_depth_that_is_cancelled_is_of_the_whole(room, samples):
    """Wherever it is stopped: a pixel is as in the whole picture, or empty in a row to be done."""
    settings, part, done = Settings(color="depth", samples=samples), Frame.empty(room), []
    whole = render(room, settings).color
    for _ in steps(room, settings, part):
        rows, other = part.rows_done, part.color != whole
        assert not other[rows].any() and not part.color[other].any()
        done.append(int(rows.sum()))
    assert done[0] == 0 and done[-1] == len(rows) and done == sorted(done)
