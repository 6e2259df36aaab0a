"""Scenes as hostile as they come: every pixel's derivation has the proven answer, and is whole."""

from __future__ import annotations

import numpy as np
from reference_tracer.derivation.derivation import derive
from reference_tracer.rendering import trace
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.settings import Settings


def test_a_box_beyond_all_numbers_hides_no_triangle(make):
    """The corners of a mesh's box may overflow in the world where its triangles' are small."""
    mesh = Mesh(np.array([(1, -1, 2), (-1, 1, -2), (-1, 1, 2)], float), [[0, 1, 2]])
    matrix = np.array([(1e308, 1e308, 1, 0), (1, 0, 0, 0), (0, 0, 0, -5), (0, 0, 0, 1)], float)
    camera = make.camera(width=24, height=18)
    scene = Scene(camera, (mesh,), (Instance(0, 0, matrix),), objects=("far",))
    hits = trace(scene, Settings())
    seen = int(np.flatnonzero(hits.instance == 0)[0])
    assert derive(scene, seen % 24, seen // 24).certified.seen == (0, 0)
