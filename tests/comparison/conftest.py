"""A room and some stripes to find faults in, and what finds them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.explain import AGREE, DEPTH_TIE, EDGE, NOT_DECIDABLE, UNEXPLAINED
from reference_tracer.pictures.bounds import differing
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, ViewWindow
from reference_tracer.tracer.camera import pixel_size
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from .cases import find_causes


def _explained(scene, picture, unmodelled=(), settings=None, sample_radius=0.0):
    """Return the causes of the pixels of a picture, having checked what holds for every one."""
    settings = settings or Settings()
    frame = render(scene, settings)
    found = result_of(find_causes(scene, frame, picture, unmodelled, sample_radius))
    differs = differing(frame.color, picture)
    assert ((found.cause == AGREE) <= ~differs).all()
    assert ((found.cause == AGREE) | differs | (found.cause == NOT_DECIDABLE)).all()
    measured = np.isin(found.cause, (EDGE, DEPTH_TIE))
    assert (found.figure <= found.allowed)[measured].all()
    assert np.isnan(found.figure[np.isin(found.cause, (AGREE, UNEXPLAINED))]).all()
    return found


@pytest.fixture
def explained():
    """Return what finds the causes of a picture."""
    return _explained


def _shifted(camera, dx, dy):
    """Return the camera with its picture moved by (dx, dy) pixels."""
    (w, h), v = pixel_size(camera), camera.window
    window = ViewWindow(v.left + dx * w, v.right + dx * w, v.bottom + dy * h, v.top + dy * h)
    return replace(camera, window=window)


@pytest.fixture
def shifted():
    """Return what moves a camera's picture by some pixels."""
    return _shifted


@pytest.fixture
def count():
    """Return what counts the pixels of a cause."""
    return lambda found, cause: int((found.cause == cause).sum())


@pytest.fixture(params=[False, True], ids=["perspective", "orthographic"])
def room(request, make):
    """Return some solids of different colours before a wall, without any symmetry."""
    camera = make.camera(
        60,
        45,
        half=2.0 if request.param else 0.4,
        eye=(3, -4, 2),
        target=(0, 0, 0),
        orthographic=request.param,
    )
    ball = trimesh.creation.icosphere(2, radius=0.7).apply_translation((-0.6, 0.3, 0.4))
    box = trimesh.creation.box((0.8, 0.6, 1.1)).apply_translation((0.7, -0.4, -0.3))
    wall = trimesh.creation.box((0.1, 4, 3)).apply_translation((-1.8, 0, -0.2))
    return make.scene(camera, *(make.mesh(s) for s in (ball, box, wall)))


@pytest.fixture
def stripes(make):
    """Return slanted stripes: an edge in almost every pixel of every row."""
    camera = make.camera(80, 60, half=30, orthographic=True, eye=(40, 30, 0))
    x = np.arange(0, 80, 2.003)
    low, high = (
        np.stack((x + s, np.full(len(x), y), np.full(len(x), -5.0)), 1)
        for s, y in ((-0.7, -1), (0.9, 61))
    )
    n, right = len(x), np.array([1, 0, 0])
    points = np.concatenate((low, low + right, high, high + right))
    k = np.arange(n)[:, None]
    faces = np.concatenate([k + np.array(corners) * n for corners in ((0, 1, 3), (0, 3, 2))])
    back = make.quad(-9, 99, -9, 99, -6)
    return make.scene(camera, Mesh(points, faces), back)
