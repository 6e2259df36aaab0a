"""What finds causes, moves pictures and counts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.explain import AGREE, DEPTH_TIE, EDGE, NOT_DECIDABLE, UNEXPLAINED
from reference_tracer.pictures.bounds import differing
from reference_tracer.rendering import render
from reference_tracer.scene import ViewWindow
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
