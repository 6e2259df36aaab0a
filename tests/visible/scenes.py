"""Small scenes, and what is found of them held against the oracle."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from reference_tracer.certified.definition import seen_by
from reference_tracer.projections import PROJECTIONS
from reference_tracer.scene import (
    Camera,
    Instance,
    Mesh,
    Scene,
    ViewWindow,
)
from reference_tracer.tracer.camera import camera_rays, film_of
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED, visible

from .arrangement import seen_areas, world_faces

PERSPECTIVE, ORTHOGRAPHIC = PROJECTIONS["perspective"], PROJECTIONS["orthographic"]
GREY = np.full((1, 4), 0.5, np.float32)


def camera(projection=PERSPECTIVE, at=(0, 0, 4), axes=None, **others):
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if axes is None else axes
    matrix[:3, 3] = at
    half = 0.5 if projection is PERSPECTIVE else 2.0
    given = {"clip_start": 0.25, "clip_end": 64.0, "width": 16, "height": 16} | others
    window = given.pop("window", ViewWindow(-half, half, -half, half))
    return Camera(matrix, window, projection=projection, **given)


def scene_of(*meshes, camera=None, matrices=None, planes=()):
    """Return a scene of meshes (vertices, triangles), an instance each."""
    made = [Mesh(np.array(v, np.float64), np.array(t, np.int32)) for v, t in meshes]
    places = matrices or [np.eye(4)] * len(made)
    instances = [Instance(k, 0, place, GREY) for k, place in enumerate(places)]
    return Scene(camera, tuple(made), tuple(instances), planes, objects=("things",))


def triangles(points):
    """Return a mesh of triangles (n, 3, 3) that share no vertex."""
    points = np.asarray(points, np.float64).reshape(-1, 3)
    return points, np.arange(len(points)).reshape(-1, 3)


def cube(size=1.0):
    v = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * size
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def judged(scene, **options):
    """Return what is found, held against the oracle; every witness is traced again."""
    found = visible(scene, **options)
    check_areas(scene, found)
    for face, area in enumerate(seen_areas(scene)):
        state = found.seen[face]
        assert state != SEEN or area > 0, f"face {face} is seen, but hidden"
        assert state != HIDDEN or area == 0, (
            f"face {face} is hidden, but {float(area)} px² are seen"
        )
        if state == UNDECIDED:
            assert area <= Fraction(found.area[face]) + Fraction(1, 10**12), face
        else:
            assert found.area[face] == 0, face
    check_witnesses(scene, found)
    return found


def check_witnesses(scene, found):
    seen = np.flatnonzero(found.seen == SEEN)
    assert (
        np.isfinite(found.witness[seen]).all() and np.isnan(found.witness[found.seen != SEEN]).all()
    )
    rays = camera_rays(scene.camera, *found.witness[seen].T)
    clip = scene.camera.clip_start, scene.camera.clip_end
    for face, ray in zip(seen.tolist(), seen_by(scene, rays, clip), strict=True):
        instance = int(np.searchsorted(found.start, face, side="right")) - 1
        assert ray.name == (instance, face - found.start[instance])


def check_areas(scene, found):
    """No more is told of a face before the camera than all of it."""
    for face, corners in enumerate(world_faces(scene)):
        x, y, t = film_of(scene.camera, np.array(corners).T)
        if (t > 0.01).all():
            whole = abs(np.linalg.det([x, y, np.ones(3)])) / 2
            assert found.area[face] <= whole + 1e-6, face
