"""Where float32 decides on which side of a clip plane a surface lies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.explain import CLIP_PLANE, UNEXPLAINED
from reference_tracer.pictures.bounds import depth_step
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Mesh

from ...cases import explained


def wall(make, camera: Camera, depth: float):
    """A wall across the view at a depth, and one far behind it; no edge is in the picture."""
    near, far = (
        Mesh(np.array([(-r, -r, -z), (3 * r, -r, -z), (-r, 3 * r, -z)]), [[0, 1, 2]])
        for r, z in ((5, depth), (9, 9.0))
    )
    return make.scene(camera, near, far)


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_wall_at_the_clip_start(make, orthographic, side):
    """Blender draws it or not; the tracer, a hair off, the other way."""
    camera = make.camera(clip_start=2.0, clip_end=100.0, orthographic=orthographic)
    off = 0.2 * float(depth_step(camera, np.array(2.0)))
    scene = wall(make, camera, 2.0 + side * off)
    other = render(wall(make, camera, 2.0 - side * off)).color
    assert (other != render(scene).color).any()
    found = explained(scene, other)
    assert (found.cause == CLIP_PLANE).all()
    assert (found.figure <= found.allowed).all()
    np.testing.assert_allclose(found.figure, off, rtol=1e-6)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_wall_at_the_clip_start_behind_the_eye(make, side):
    """As an orthographic view has it, which looks both ways."""
    camera = make.camera(clip_start=-50.0, clip_end=50.0, orthographic=True)
    off = 0.2 * float(depth_step(camera, np.array(-50.0)))
    scene = wall(make, camera, -50.0 + side * off)
    other = render(wall(make, camera, -50.0 - side * off)).color
    assert (other != render(scene).color).any()
    assert (explained(scene, other).cause == CLIP_PLANE).all()


@pytest.mark.parametrize("side", [-1, 1])
def test_a_wall_at_the_clip_end(make, side):
    camera = make.camera(clip_start=0.5, clip_end=5.0)
    off = 0.2 * float(depth_step(camera, np.array(5.0)))
    scene = wall(make, camera, 5.0 + side * off)
    other = render(wall(make, camera, 5.0 - side * off)).color
    found = explained(scene, other)
    assert (found.cause == CLIP_PLANE).all()


def test_farther_off_it_is_unexplained(make):
    camera = make.camera(clip_start=2.0, clip_end=100.0)
    off = 1e-3  # metres
    scene = wall(make, camera, 2.0 + off)
    other = render(wall(make, camera, 2.0 - off)).color
    assert (explained(scene, other).cause == UNEXPLAINED).all()


def test_another_clip_range_is_a_fault(make):
    camera = make.camera(clip_start=0.5, clip_end=100.0)
    scene = wall(make, camera, 3.0)
    other = render(replace(scene, camera=replace(camera, clip_start=3.5))).color
    assert (explained(scene, other).cause == UNEXPLAINED).all()


def test_what_is_at_the_clip_explains_only_what_lies_behind_it(make):
    """Not any other colour."""
    camera = make.camera(clip_start=2.0, clip_end=100.0)
    scene = wall(make, camera, 2.0)
    picture = render(scene).color.copy()
    picture[...] = (0.3, 0.9, 0.7, 1)
    assert (explained(scene, picture).cause == UNEXPLAINED).all()
