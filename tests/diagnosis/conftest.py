"""Scenes to find faults in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.scene import Instance, Mesh, Scene, ViewWindow

SEED = 27


OBJECTS = "Box", "Ball", "Ring", "Drum"


@pytest.fixture
def solids(make):
    """Return solids of different colours over a floor, seen through a shifted window."""
    rng = np.random.default_rng(SEED)
    eye = (5, -6, 4)
    camera = make.camera(160, 90, half=0.3, eye=eye, target=(0, 0, 0))
    w = camera.window
    camera = replace(camera, window=ViewWindow(w.left + 0.03, w.right + 0.03, w.bottom, w.top))
    camera = replace(
        camera, window=replace(camera.window, top=w.top + 0.02, bottom=w.bottom + 0.02)
    )
    shapes = {
        "Floor": trimesh.creation.box((9, 9, 0.2)).apply_translation((0, 0, -1.2)),
        "Box": trimesh.creation.box((1.1, 0.7, 1.3)),
        "Ball": trimesh.creation.icosphere(3, radius=0.6),
        "Ring": trimesh.creation.torus(0.6, 0.22),
        "Drum": trimesh.creation.cylinder(0.45, 1.0),
    }
    places = ((0, 0, 0), (-1.2, -0.6, -0.3), (1.1, 0.6, 0.2), (0.2, 1.6, -0.2), (0.6, -1.4, -0.4))
    instances, meshes = [], []
    for n, (shape, place) in enumerate(zip(shapes.values(), places, strict=True)):
        matrix = trimesh.transformations.euler_matrix(
            *(rng.uniform(-0.4, 0.4, 3) if n else (0, 0, 0))
        )
        matrix[:3, 3] = place
        color = [*rng.uniform(0.1, 0.9, 3), 1.0]
        meshes.append(Mesh(shape.vertices, shape.faces))
        instances.append(Instance(n, n, matrix, [color]))
    scene = make.scene(camera, *meshes)
    return replace(scene, instances=tuple(instances), objects=tuple(shapes))


@pytest.fixture
def pair(make):
    """Return two boxes, few pixels: a diagnosis of them takes a second."""
    camera = make.camera(48, 27, half=0.3, eye=(5, -6, 4), target=(0, 0, 0))
    shape = trimesh.creation.box((1.2, 0.8, 1.0))
    scene = make.scene(camera, *(Mesh(shape.vertices, shape.faces) for _ in range(2)))
    matrices = [trimesh.transformations.translation_matrix(v) for v in ((-0.8, 0, 0), (0.8, 0, 0))]
    colors = ((0.9, 0.1, 0.1, 1.0), (0.1, 0.2, 0.9, 1.0))
    instances = [
        Instance(n, n, m, [c]) for n, (m, c) in enumerate(zip(matrices, colors, strict=True))
    ]
    return replace(scene, instances=tuple(instances), objects=("Left", "Right"))


@pytest.fixture
def few(make):
    """Return what makes some solids over a floor, seen through a shifted window."""

    def made(width=64, height=40, parallel=False, seed=27) -> Scene:
        rng = np.random.default_rng(seed)
        camera = make.camera(width, height, eye=(5, -6, 4), target=(0, 0, 0))
        x = 2.3 if parallel else 0.32
        y = x * height / width
        window = ViewWindow(0.03 - x, 0.03 + x, 0.02 - y, 0.02 + y)
        if parallel:
            camera = replace(camera, projection=ORTHOGRAPHIC)
        camera = replace(camera, window=window)
        shapes = (
            trimesh.creation.box((9, 9, 0.2)).apply_translation((0, 0, -1.2)),
            trimesh.creation.box((1.1, 0.7, 1.3)),
            trimesh.creation.icosphere(2, radius=0.6),
            trimesh.creation.torus(0.6, 0.22, 16, 12),
            trimesh.creation.cylinder(0.45, 1.0, 16),
        )
        places = (0, 0, 0), (-1.2, -0.6, -0.3), (1.1, 0.6, 0.2), (0.2, 1.6, -0.2), (0.6, -1.4, -0.4)
        instances = []
        for n, place in enumerate(places):
            angles = rng.uniform(-0.4, 0.4, 3) if n else (0, 0, 0)
            matrix = trimesh.transformations.euler_matrix(*angles)
            matrix[:3, 3] = place
            instances.append(Instance(n, n, matrix, [[*rng.uniform(0.1, 0.9, 3), 1.0]]))
        meshes = tuple(Mesh(s.vertices, s.faces) for s in shapes)
        return Scene(camera, meshes, tuple(instances), objects=("Floor", *OBJECTS))

    return made
