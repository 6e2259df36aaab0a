"""Cameras that frame or are placed: what is framed is seen, fills the picture, and no nearer."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.framing import FILLED, NEAREST, Choice, axes_of, framing
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.scene import SceneError
from reference_tracer.tracer.camera import film_of

SIZES = [(30, 20), (20, 30), (1, 1), (400, 10), (10, 400)]
# Stretched clouds of points: a ball, a rod, a card, what is tiny, what is far from the origin.
CLOUDS = [((1, 1, 1), 3), ((1e4, 1, 1), 0), ((1, 1, 0), 1), ((1e-5,) * 3, 1e-3), ((1,) * 3, 1e5)]


def spans(camera, points):
    """How much of the picture's width and height points take, and from where to where."""
    x, y, depth = film_of(camera, points.T)
    assert (depth > camera.clip_start).all() and (depth < camera.clip_end).all()
    x, y = x / camera.width, y / camera.height
    return (x.min(), x.max()), (y.min(), y.max())


@pytest.mark.parametrize("stretch, away", CLOUDS)
@pytest.mark.parametrize("angle", [2.0, 50.0, 170.0])
def test_what_is_framed_fills_nine_tenths_of_the_width_or_the_height(stretch, away, angle, rng):
    for width, height in SIZES:
        backward = rng.normal(size=3)
        points = rng.normal(size=(50, 3)) * stretch + away * rng.normal(size=3)
        tall = rng.choice([1.0, 0.5, 3.0])
        camera = framing(np.split(points, [1, 7]), axes_of(backward), width, height, angle, tall)
        both = np.array(spans(camera, points))
        axes, rounding = axes_of(backward), 1e-9 * max(1, away)
        assert np.abs(both - 0.5).max() <= FILLED / 2 + rounding
        # Else it is as near as may be: a point in front of all others would be where the eye is.
        nearest = NEAREST * np.ptp(points @ axes, axis=0).max()
        if 2 * camera.clip_start > 1.01 * nearest:
            assert np.ptp(both, axis=1).max() == pytest.approx(FILLED, abs=rounding)
        assert np.allclose(camera.forward, -backward / np.linalg.norm(backward))
        assert abs(camera.right[2]) < 1e-9
        high, wide = camera.window.top / camera.window.right, width / height
        assert high * wide == pytest.approx(tall)
        assert camera.window.top == pytest.approx(np.tan(np.radians(angle) / 2))


@pytest.mark.parametrize("along", [(0, 0, 0), (0, 0, 1), (0, 0, 1e-30)])
def test_what_has_no_width_is_seen_all_the_same(along):
    """A point, or a line that the eye looks along."""
    points = np.linspace((5, 6, 7), np.add((5, 6, 7), along), 4)
    camera = framing([points], np.eye(3), 20, 10)
    both = np.array(spans(camera, points))
    assert np.allclose(both, 0.5, atol=1e-3)


def test_nothing_to_frame():
    for nothing in ([], [np.zeros((0, 3))]):
        with pytest.raises(SceneError, match="nothing to frame"):
            framing(nothing, np.eye(3), 20, 10)


def test_axes_are_a_right_handed_frame(rng):
    axes = np.eye(3)
    for backward in [*rng.normal(size=(9, 3)), *(s * a for a in axes for s in (1, -2))]:
        found = axes_of(backward)
        assert np.allclose(found.T @ found, axes) and np.linalg.det(found) == pytest.approx(1)
        assert np.allclose(found[:, 2], backward / np.linalg.norm(backward))
        assert found[2, 1] > -1e-9
    for wrong in ((0, 0, 0), (np.nan, 0, 1)):
        with pytest.raises(SceneError, match="zero or not finite"):
            axes_of(wrong)


@pytest.mark.parametrize("scale", [None, 3.0])
def test_a_placed_camera_has_its_target_in_the_middle(scale, rng):
    eye, target = rng.normal(size=(2, 3))
    choice = Choice(eye=eye, target=target, angle=40.0, ortho_scale=scale)
    camera = choice.placed(30, 20, tall=2.0)
    x, y, depth = film_of(camera, target[:, None])
    assert (x[0], y[0]) == pytest.approx((15, 10))
    assert depth[0] == pytest.approx(np.linalg.norm(eye - target))
    assert camera.window.top == pytest.approx(1.5 if scale else np.tan(np.radians(20)))
    assert camera.window.right / camera.window.top == pytest.approx(30 / 40)
    assert (camera.projection is ORTHOGRAPHIC) == bool(scale)
    with pytest.raises(SceneError, match="target are the same point"):
        Choice(eye=eye, target=eye).placed(30, 20)


@pytest.mark.parametrize(
    "width, height, size",
    [(None, None, (960, 540)), (320, None, (320, 180)), (None, 270, (480, 270)), (7, 9, (7, 9))],
)
def test_of_a_size_one_side_follows_the_other(width, height, size):
    assert Choice(width=width, height=height).size((960, 540)) == size
