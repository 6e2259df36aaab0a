"""A messy scene."""

from __future__ import annotations

import numpy as np
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.settings import Settings

CERTIFIED = Settings("certified")


def mess(make, rng, orthographic: bool, whole: bool, scale: float = 1.0) -> Scene:
    """Return instances through one another, duplicates, planes twice, all times `scale`.

    With integers many rays meet edges, corners, surfaces in one plane, and the clip range's
    ends; the rays' own origins and directions are on the grid, too.
    """
    points = rng.integers(-2, 3, (24, 3)) * 1.0 if whole else rng.normal(size=(24, 3))
    meshes = [Mesh(points * scale, rng.integers(0, 24, (n, 3))) for n in (8, 14)]
    instances = []
    for k in range(4):
        matrix = np.eye(4)
        if not whole:
            matrix[:3, :3] = 0.6 * rng.normal(size=(3, 3))
        matrix[:3, 3] = (*rng.integers(-2, 3, 2) * scale, rng.integers(-8, -3) * scale)
        instances += [Instance(k % 2, 0, matrix)] * (1 + k % 2)
    slanted = (0, 0, 1) if whole else (0.1, 0.2, 1)
    planes = [
        Plane(0, np.array(point) * scale, normal)
        for point, normal in (
            ((0, 0, -6), slanted),
            ((0, -1, 0), (0, 1, 0)),
            ((3, -1, 2), (0, -2, 0)),
            ((0, 0, -7), (1, 0, 1)),
        )
    ]
    camera = make.camera(
        12,
        8,
        half=4 * scale if orthographic else 0.5,
        orthographic=orthographic,
        eye=np.array((0.5, 0.5, 0)) * scale,
        clip_start=2 * scale,
        clip_end=7 * scale,
    )
    return Scene(camera, meshes, instances, planes, objects=("Mess",))


def names_of(frame: Frame) -> list[tuple[int, int]]:
    names = zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True)
    return [(int(i), int(k)) for i, k in names]
