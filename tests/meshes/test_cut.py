"""Whatever cuts a face into triangles: they cover it once, wound as it is, or it is refused."""

from __future__ import annotations

import time

import numpy as np
import pytest
from reference_tracer.scene import SceneError
from reference_tracer_meshes import cut as cutting
from reference_tracer_meshes.cut import cut
from reference_tracer_meshes.load import load_meshes

from . import shapes


def covered(points, triangles):
    """Return the vector area of triangles of points (n, 3), and the sum of their sizes."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a) / 2
    return normals.sum(axis=0), np.linalg.norm(normals, axis=1).sum()


@pytest.mark.parametrize("kind", ["star", "spiral"])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_flat_faces_are_covered_once(kind, scale, rng):
    """The sizes of the triangles add up to the length of their vector area: none is turned over."""
    for _ in range(30):
        flat = {
            "star": lambda: shapes.star(rng, int(rng.integers(5, 60))),
            "spiral": lambda: shapes.spiral(rng, 2 * int(rng.integers(4, 20))),
        }[kind]()
        points = shapes.in_space(rng, flat, scale)
        count = len(points)
        found = cut(points, np.arange(count), np.array([count]))
        vector, size = covered(points, found.triangles)
        assert np.linalg.norm(vector) == pytest.approx(abs(shapes.area(flat)) * scale**2, rel=1e-9)
        assert size == pytest.approx(np.linalg.norm(vector), rel=1e-9)
        backwards = cut(points[::-1], np.arange(count), np.array([count])).triangles
        assert np.allclose(covered(points[::-1], backwards)[0], -vector, rtol=1e-9)


CROSSING = {
    "a bow-tie": [(0, 0), (1, 1), (1, 0), (0, 1)],
    "an uneven one": [(0, 0), (3, 3), (3, 0), (0, 1)],
    "five corners": [(0, 0), (2, 2), (2, 0), (0, 2), (-1, 1)],
    "a star of five points": [(np.sin(k * 0.8 * np.pi), np.cos(k * 0.8 * np.pi)) for k in range(5)],
}


@pytest.mark.parametrize("flat", CROSSING.values(), ids=CROSSING)
def test_a_face_that_crosses_itself_is_refused_by_its_number(flat, rng):
    points = shapes.in_space(rng, np.array(flat, float))
    with pytest.raises(SceneError, match="the edges of face 2 cross"):
        cut(points, np.concatenate(([0, 1, 2], np.arange(len(flat)))), np.array([3, len(flat)]))


def test_a_cut_that_is_wrong_is_refused(monkeypatch, rng):
    """A library that turns a triangle over, leaves one out, or doubles one is not believed."""
    import mapbox_earcut

    real = mapbox_earcut.triangulate_float64
    points = shapes.in_space(rng, shapes.star(rng, 12))
    for spoil in (
        lambda t: np.concatenate((t[:1, ::-1], t[1:])),
        lambda t: t[1:],
        lambda t: np.concatenate((t, t[:1])),
    ):
        monkeypatch.setattr(
            mapbox_earcut,
            "triangulate_float64",
            lambda p, e, spoil=spoil: spoil(real(p, e).reshape(-1, 3)).reshape(-1),
        )
        with pytest.raises(SceneError, match="face 1"):
            cut(points, np.arange(12), np.array([12]))


def test_convex_faces_are_cut_as_blender_cuts_them_and_all_alike():
    """An ear, then the one after the next: of six corners 5 0 1, 1 2 3, 3 4 5, and what is left."""
    assert cutting._of_convex(6).tolist() == [[5, 0, 1], [1, 2, 3], [3, 4, 5], [1, 3, 5]]
    for count in range(5, 30):
        angles = np.arange(count) * 2 * np.pi / count
        points = np.column_stack((np.cos(angles), np.sin(angles), 0 * angles))
        triangles = cut(points, np.arange(count), np.array([count])).triangles
        assert len(triangles) == count - 2
        vector, size = covered(points, triangles)
        assert size == pytest.approx(vector[2]) == pytest.approx(shapes.area(points[:, :2]))


def test_a_face_along_a_line_has_no_surface_and_is_no_error():
    points = np.array([(k, 2 * k, 0) for k in (0, 3, 1, 2, 5)], float)
    triangles = cut(points, np.arange(5), np.array([5])).triangles
    assert covered(points, triangles)[1] == 0


def test_a_face_that_is_not_flat_is_named_but_not_what_digits_do():
    flat = np.array([(0, 0, 0), (10, 0, 0), (10, 10, 1e-6), (0, 10, 0)])
    assert cut(flat, np.arange(4), np.array([4])).notes == ()
    bent = np.array([(0, 0, 0), (10, 0, 0), (10, 10, 1), (0, 10, 0)], float)
    (note,) = cut(bent, np.arange(4), np.array([4])).notes
    assert "1 face of more than three corners is not flat" in note


HOSTILE = {
    "star.obj": lambda: [
        "".join(
            f"v {(1 + k % 2) * np.cos(a):.6f} {(1 + k % 2) * np.sin(a):.6f} 0\n"
            for k, a in enumerate(np.linspace(0, 2 * np.pi, 20000, endpoint=False))
        ),
        "f " + " ".join(str(k + 1) for k in range(20000)),
    ],
    "repeated.obj": lambda: ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 ", "1 " * 802],
    "large.obj": lambda: [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv .1 .1 0\n",
        "f 1 2 4 3" + " 1" * 70_000,
    ],
    "repeated.stl": lambda: [
        "solid s\nfacet normal 0 0 1\nouter loop\n",
        "vertex -0.5 -0.5 -0.5\n" * 1003,
        "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n",
    ],
    "objects.obj": lambda: [
        f"o {k}\nv 0 0 {k}\nv 1 0 {k}\nv 0 1 {k}\nf {3 * k + 1} {3 * k + 2} {3 * k + 3}\n"
        for k in range(25_600)
    ],
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_hung_is_read_or_refused_at_once(name, tmp_path):
    (tmp_path / name).write_text("".join(HOSTILE[name]()))
    began = time.process_time()
    try:
        found = load_meshes(tmp_path / name)
        assert sum(len(p.mesh.triangles) for p in found.placed) > 0
    except SceneError as error:
        assert name in str(error) and "\n" not in str(error) and len(str(error)) < 300
    assert time.process_time() - began < 5
