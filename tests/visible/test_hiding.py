"""What is known of faces in cells of the film: never more than is sure."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from reference_tracer.certified.any_rays import decide
from reference_tracer.scene import Plane
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.progress import result_of
from reference_tracer.visible.faces import Faces
from reference_tracer.visible.hiding import patches
from reference_tracer.visible.planes import before_planes
from reference_tracer.visible.polygons import cut, middles, on_film

from .scenes import GREY, ORTHOGRAPHIC, camera, scene_of, triangles


def test_a_face_nearly_edge_on_is_beside_no_cell_that_it_covers():
    """In planes that pass by the eye at its rounding, the side that is seen is not known."""
    random = np.random.default_rng(0)
    share = random.uniform(-3, 3, (1000, 3, 2, 1))
    points = (share * random.normal(size=(1000, 1, 2, 3))).sum(axis=2)
    points[..., 2] += 4
    points += random.normal(size=points.shape) * 2.0**-52
    scene = scene_of(triangles(points), camera=camera())
    faces = result_of(Faces.of(scene))
    some = np.flatnonzero(faces.may_show)
    at = random.uniform(0, 16, (2, len(some)))
    missed = faces.within(some, at, at + 2.0**-6).beside
    rays = camera_rays(scene.camera, *(at + 2.0**-7))
    met = decide(rays, faces.points[:, faces.corners[:, some]].swapaxes(0, 1)).crossed
    assert met.sum() > 9 and missed.any() and not missed[met].any()


def test_what_is_traced_for_a_cell_is_in_it():
    """Also if hardly more than a corner of the face is there."""
    random = np.random.default_rng(0)
    tip = random.uniform(-1, 1, (1, 2, 200))
    corners = np.concatenate((tip, tip + random.normal(size=(2, 2, 200))))
    points = np.concatenate((corners, np.zeros((3, 1, 200))), axis=1).transpose(2, 0, 1)
    faces = result_of(Faces.of(scene_of(triangles(points), camera=camera(ORTHOGRAPHIC))))
    every = np.arange(200)
    low = (tip[0] + 2) * 4 + random.choice([-1e-11, 1e-11], (2, 200))
    at = middles(faces, every, low, low + 0.25)
    assert (low <= at).all() and (at <= low + 0.25).all()


def test_joined_faces_cover_a_box_but_none_with_a_hole():
    random = np.random.default_rng(0)
    corners = np.stack(np.meshgrid(np.arange(8), np.arange(8)), axis=-1).reshape(-1, 1, 2)
    halves = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]])
    film = 4 + np.concatenate([corners + half for half in halves])  # in pixels
    hole, film = film[30], np.delete(film, 30, axis=0)
    points = np.concatenate((film / 4 - 2, np.zeros((len(film), 3, 1))), axis=2)
    faces = result_of(Faces.of(scene_of(triangles(points), camera=camera(ORTHOGRAPHIC))))
    some = random.integers(0, len(film), 400)
    low = film[some].mean(axis=1).T
    size = random.uniform(0, 3, low.shape)
    found = patches(faces, some, low, low, low + size)
    at = low + random.random((200, 2, 400)) * size
    (x, y), (x0, y0) = (at - hole[0][:, None]).swapaxes(0, 1), hole[2] - hole[0]
    assert (x0, y0) == (1, 1)
    missed = (at > 12).any(axis=1) | ((y > 0) & (x > y) & (x < 1))
    covered = found > -np.inf
    assert not (missed.any(axis=0) & covered).any()
    assert (covered & (size.min(axis=0) > 1)).any() and (missed.any(axis=0) & ~covered).any()
    assert (found[covered] <= -4).all() and (found[covered] > -4.001).all()


def test_what_is_cut_by_a_function_that_overflows_is_left():
    """It is not known where it is cut: so the corner that is not surely cut off stays."""
    random = np.random.default_rng(0)
    polygons = random.normal(size=(3, 2, 3))
    value = np.array([[np.inf, np.nan, 1.0], [-1.0, -1.0, -1.0], [-1.0, -1.0, -1.0]])
    with np.errstate(all="ignore"):
        left = cut(polygons, value)
    assert (left == polygons[0]).all(axis=1).any(axis=0).all()
    assert np.isnan(cut(polygons, -np.ones((3, 3)))).all()


def test_what_a_plane_leaves_of_a_face_that_goes_on_behind_the_eye_is_in_its_box():
    """Where the plane cuts it may be far nearer to the eye than its corner before that is."""
    random = np.random.default_rng(0)
    height = 2.0**-20  # of the eye above the plane
    plane = Plane(0, np.array((0, -height, 0)), np.array((0.0, 1.0, 0.0)), GREY[0])
    count = 200
    crossing = random.uniform((-2, -1, -20), (2, -1, -4), (2, count, 3)) * height
    behind = random.uniform((-1, -3, 1), (1, -1, 5), (count, 3))
    points = np.concatenate((2 * crossing - behind, behind[None])).swapaxes(0, 1)
    own = camera(at=(0, 0, 0), clip_start=2.0**-30)
    scene = scene_of(triangles(points), camera=own, planes=(plane,))
    faces = result_of(Faces.of(scene))
    every = np.arange(count)
    box = np.array(((0.0,), (0.0,))).repeat(count, 1), np.array(((16.0,), (7.0,))).repeat(count, 1)
    polygons = faces.points[:, faces.corners].swapaxes(0, 1)
    low, high, _ = on_film(faces, every, before_planes(scene, faces, polygons, *box))
    for face, corners in enumerate(points):
        a, b, c = ([Fraction(x) for x in corner] for corner in corners.tolist())
        for before in (a, b):
            share = (before[1] + Fraction(height)) / (before[1] - c[1])
            x, y, z = (p + share * (q - p) for p, q in zip(before, c, strict=True))
            for at, least, most in zip((x, y), low[:, face], high[:, face], strict=True):
                film = 16 * (at / -z + Fraction(1, 2))
                assert not (film < least or film > most)
