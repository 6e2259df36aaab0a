"""Many pairs at once are intersected as `IntegerBatch.hit` intersects each of them."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.many import hits
from reference_tracer.tracer.camera import Rays


@pytest.mark.parametrize("shared", ["origin", "direction", "nothing"])
@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e100])
@pytest.mark.parametrize("digits", [0, 53])  # with few, rays meet many edges and corners
def test_as_one_by_one(rng, shared, scale, digits):
    def vectors(*shape):
        return scale * np.round(rng.normal(size=shape) * 2 * 2.0**digits) * 2.0**-digits

    rays = Rays(vectors(3, 1 if shared == "origin" else 20), vectors(3, 20))
    if shared == "direction":
        rays = Rays(rays.origins, rays.directions[:, :1])
    planes = [(vectors(3), vectors(3))]
    batch = IntegerBatch(rays, vectors(3, 3, 30), planes, 0.0, np.inf)
    ray, surface = rng.integers(0, 20, 600), rng.integers(0, 31, 600)
    each = [batch.hit(*pair) for pair in zip(ray.tolist(), surface.tolist(), strict=True)]
    assert hits(batch, ray, surface) == each
    assert any(each) and not all(each)
    assert any(hit.on_edge for hit in each if hit) or digits == 53


def test_no_pairs():
    none = np.zeros(0, int)
    batch = IntegerBatch(Rays(np.zeros((3, 1)), np.ones((3, 1))), np.zeros((3, 3, 0)))
    assert hits(batch, none, none) == []
