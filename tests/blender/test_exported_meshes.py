"""What Blender's own exporters write is read here as the surface that Blender has."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import bpy
import numpy as np
import pytest
from reference_tracer_meshes.load import load_meshes

# With their default options, but for the axes: those of Blender's own.
Z_UP = {"forward_axis": "Y", "up_axis": "Z"}
EXPORTERS = {
    "obj": partial(bpy.ops.wm.obj_export, **Z_UP),
    "ply": partial(bpy.ops.wm.ply_export, **Z_UP),
    "ascii.ply": partial(bpy.ops.wm.ply_export, ascii_format=True, **Z_UP),
    "stl": partial(bpy.ops.wm.stl_export, **Z_UP),
}


def faces(rng, bend, least):
    """Return faces of 3 to 11 corners, each in its own plane, and none that crosses itself.

    Corners are multiples of 1/64, which six decimals hold. `bend` is how far they may be off their
    planes, in metres; `least` the smallest radius, and 40 the largest, in such units.
    """
    out = []
    while len(out) < 250:
        count = int(rng.integers(3, 12))
        angles = (np.arange(count) + rng.uniform(0, 0.3, count)) * 2 * np.pi / count
        radii = rng.uniform(least, 40, count)
        flat = np.column_stack((radii * np.cos(angles), radii * np.sin(angles))).round()
        axes = np.array(((2, 0, 1), (0, 2, -1)))[:, rng.permutation(3)]
        off = (64 * bend * rng.normal(size=(count, 1))).round() * np.cross(*axes) / 8
        place = 64 * 10 * np.array((len(out) % 16, len(out) // 16, 0))
        out.append((flat @ axes + off.round() + place) / 64)
    return out


def make(parts):
    """Make an object of faces in the scene; return the corners of its triangles in Blender."""
    mesh = bpy.data.meshes.new("Faces")
    starts = np.cumsum([0, *map(len, parts)])
    numbers = [tuple(range(a, b)) for a, b in pairwise(starts)]
    mesh.from_pydata(np.concatenate(parts).tolist(), [], numbers)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Faces", mesh))
    mesh.calc_loop_triangles()
    vertices = np.array([v.co for v in mesh.vertices])
    return vertices[[tuple(t.vertices) for t in mesh.loop_triangles]]


def as_set(triangles):
    """Return triangles (n, 3, 3) as a set, whichever corner each begins with."""
    out = set()
    for triangle in np.asarray(triangles, np.float64).round(9).tolist():
        first = triangle.index(min(triangle))
        out.add(tuple(map(tuple, triangle[first:] + triangle[:first])))
    return out


def read(name, tmp_path):
    path = tmp_path / f"faces.{name}"
    EXPORTERS[name](filepath=str(path))
    found = load_meshes(path)
    (placed,) = found.placed
    return placed.mesh.vertices[placed.mesh.triangles], found.notes


@pytest.mark.parametrize("name", EXPORTERS)
@pytest.mark.parametrize("bend", [0.0, 0.1])
def test_the_triangles_of_convex_faces_are_blenders(name, bend, tmp_path, rng):
    own = make(faces(rng, bend, 39.5))
    found, notes = read(name, tmp_path)
    assert len(found) == len(own) > 1000
    assert as_set(found) == as_set(own)
    assert name == "stl" or bool(bend) == any("not flat" in note for note in notes)


@pytest.mark.parametrize("name", EXPORTERS)
def test_concave_faces_have_blenders_areas(name, tmp_path, rng):
    """Whichever way each is cut: a face is where its place is, in squares of ten metres."""
    own = make(faces(rng, 0.0, 8))
    found, notes = read(name, tmp_path)
    assert not any("not flat" in note for note in notes)
    totals = []
    for triangles in (own, found):
        a, b, c = np.moveaxis(np.asarray(triangles, np.float64), 1, 0)
        squares = np.rint(a[:, :2] / 10).astype(int) @ (1, 100)
        total = np.zeros((squares.max() + 1, 3))
        np.add.at(total, squares, np.cross(b - a, c - a))
        totals.append(total)
    assert np.allclose(*totals, atol=1e-9) and np.abs(totals[0]).sum() > 100
    assert as_set(found) != as_set(own) or name == "stl"


@pytest.mark.parametrize("name", [name for name in EXPORTERS if name != "stl"])
def test_faces_beside_loose_edges_and_points_are_read(name, tmp_path):
    mesh = bpy.data.meshes.new("Loose")
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (5, 5, 5), (6, 6, 6)]
    mesh.from_pydata(points, [(4, 5)], [(0, 1, 2, 3), (0, 2, 3)])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Loose", mesh))
    EXPORTERS[name](filepath=str(tmp_path / f"a.{name}"))
    found = load_meshes(tmp_path / f"a.{name}")
    assert len(found.placed[0].mesh.triangles) == 3 and found.missing == ()
    up = [note for note in found.notes if "up=z" in note]
    assert all("not drawn" in note for note in found.notes if note not in up)
    assert bool(up) == (name == "obj")  # Blender writes that one with Y up
    assert name != "obj" or found.placed[0].object == "Loose"
