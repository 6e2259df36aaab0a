"""The metrics against scikit-image."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.pictures.metrics import image_metrics
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings


@pytest.fixture(scope="module")
def skimage():
    """scikit-image's metrics, which bring scipy.stats: a second that not all processes need."""
    from skimage import metrics

    return metrics


def pictures(kind, make, rng):
    """Return two pictures that differ a little."""
    if kind == "rendered":
        camera = make.camera(48, 32, eye=(3, -3, 2), target=(0, 0, 0))
        scene = make.scene(camera, make.mesh(trimesh.creation.icosphere(2)))
        return render(scene).color, render(scene, Settings(samples=3)).color
    first = rng.random((40, 30, 4), np.float32)
    if kind == "smooth":
        first = np.cumsum(np.cumsum(first, axis=0), axis=1) / first.size
    noise = rng.normal(0, 0.05, first.shape).astype(np.float32)
    return first, (np.zeros_like(first) if kind == "black" else first + noise)


@pytest.mark.parametrize("kind", ["noise", "smooth", "black", "rendered"])
def test_scikit_image_says_the_same(kind, make, rng, skimage):
    first, second = pictures(kind, make, rng)
    first, second = first.astype(float), second.astype(float)
    options = {"win_size": 7, "gaussian_weights": False, "channel_axis": 2, "data_range": 1}
    found = result_of(image_metrics(first, second))
    assert found.rmse == pytest.approx(np.sqrt(skimage.mean_squared_error(first, second)))
    assert found.psnr == pytest.approx(skimage.peak_signal_noise_ratio(first, second, data_range=1))
    assert found.ssim == pytest.approx(
        skimage.structural_similarity(first, second, **options), abs=1e-10
    )


def test_the_largest_difference_is_where_it_is(rng):
    first = rng.random((70, 11, 4))
    second = first + rng.uniform(-0.1, 0.1, first.shape)
    second[50, 8, 2] = first[50, 8, 2] - 0.7
    found = result_of(image_metrics(first, second)).largest_difference
    assert (found.pixel, found.channel) == ((8, 50), 2)
    assert found.value == pytest.approx(0.7)
