"""The closed meshes of the suites are closed, and counter-clockwise from outside."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from .meshes import box, bumpy_sphere, corners_of, cylinder, embree_sphere

RNG = np.random.default_rng(1)
CLOSED = {
    "bumpy": corners_of(*bumpy_sphere(RNG, False)),
    "snapped": corners_of(*bumpy_sphere(RNG, True)),
    "sphere": embree_sphere(20),
    "box": corners_of(*box()),
    "cylinder": corners_of(*cylinder()),
}


@pytest.mark.parametrize("name", CLOSED)
def test_every_edge_is_met_by_its_reverse_bit_for_bit(name):
    edges = Counter()
    for triangle in CLOSED[name].transpose(2, 0, 1):
        points = [p.tobytes() for p in triangle + 0.0]
        edges.update((points[k - 1], points[k]) for k in range(3))
    assert max(edges.values()) == 1
    assert all((b, a) in edges for a, b in edges)


@pytest.mark.parametrize("name", CLOSED)
def test_faces_outwards(name):
    a, b, c = CLOSED[name] - CLOSED[name].mean(axis=(0, 2))[:, None]
    assert (a * np.cross(b, c, axis=0)).sum() > 0
