"""trimesh: the tests of its rays, on a box, a cylinder, at any scale, and its known failure.

`contains_points`, an odd number of crossings along one direction, is what parity is for. A ray in
the plane of a face meets nothing of it. Duplicates are told apart there by their distance; here
nothing is met twice to begin with.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.any_rays import decide
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays

from ..rays import nearest_hits
from .meshes import box, corners_of, cylinder, on_sphere
from .shooting import crossings, decided

BOX, CYLINDER = corners_of(*box()), corners_of(*cylinder())


def test_on_vertex():
    """From the centre to the 8 corners of a box: exactly one hit each."""
    d = box()[0].T.copy()
    found = crossings(np.zeros((3, 1)), d, BOX, all_pairs=True)
    assert (found.counts == 1).all() and found.edge.all()
    assert (crossings(np.zeros((3, 1)), d, BOX, Method.WATERTIGHT).counts > 1).any()


@pytest.mark.parametrize("size", [1e-160, 1e-100, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e100])
def test_scales_from_outside_and_from_the_surface(rng, size):
    """Two hits from outside; from a face inwards, where the ray begins, it is not met: one."""
    corners = BOX * size
    through = on_sphere(rng, 400, 0.2)
    d = on_sphere(rng, 400)
    outside = crossings((through - 3 * d) * size, d * size, corners, all_pairs=True)
    assert (outside.counts == 2).all() and (outside.winding() == 0).all()
    top = np.stack((through[0], through[1], np.full(400, 0.5))) * size
    down = d * size * np.where(d[2] < 0, 1, -1)
    inwards = crossings(top, down, corners, all_pairs=True)
    assert (inwards.counts == 1).all()
    assert not crossings(top, -down, corners, all_pairs=True).counts.any()


def test_a_small_box_from_far_away(rng):
    """1 mm from 10 km, at points of it and at its corners and edges: two hits, of two triangles."""
    corners = 1e-3 * BOX
    o = on_sphere(rng, 500, 1e4)
    inside = 1e-3 * rng.uniform(-0.45, 0.45, (3, 500))
    found = crossings(o, inside - o, corners, all_pairs=True)
    assert (found.counts == 2).all()
    assert (np.diff(found.triangle[np.argsort(found.ray, kind="stable")].reshape(-1, 2)) != 0).all()
    vertices = 1e-3 * box()[0]
    found = crossings(o, vertices[rng.integers(8, size=500)].T - o, corners, all_pairs=True)
    assert (found.winding() == 0).all() and np.isin(found.counts, (0, 2)).all()


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e8])
def test_a_grid_of_rays_at_a_box(size):
    """40 x 40 from corner to corner, the silhouette's own edges among them."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, 41)[:-1], np.linspace(-0.5, 0.5, 41)[:-1])
    o = np.stack((x.ravel(), y.ravel(), np.full(x.size, -2.0))) * size
    d = np.tile([[0], [0], [1.0]], x.size)
    found = crossings(o, d, BOX * size, all_pairs=True)
    # The rule moves rays towards +X, then +Y: those on the lower edges enter the box.
    assert (found.counts == 2).all()
    assert not found.winding().any()
    seen = nearest_hits(Rays(o, d), BOX * size)
    assert np.array_equal(seen.t, np.full(x.size, 1.5 * size))
    at_upper = np.stack((0.5 + 0 * y.ravel(), y.ravel(), np.full(x.size, -2.0))) * size
    assert not crossings(at_upper, d, BOX * size, all_pairs=True).counts.any()


def test_a_cylinder(rng):
    """16 x 16 along its axis, and across it, at its vertices and cap centres too: two hits each."""
    x, y = np.meshgrid(np.linspace(-0.6, 0.6, 16), np.linspace(-0.6, 0.6, 16))
    o = np.stack((x.ravel(), y.ravel(), np.full(x.size, -5.0)))
    d = np.tile([[0], [0], [1.0]], x.size)
    assert (crossings(o, d, CYLINDER, all_pairs=True).counts == 2).all()
    across = np.stack((np.full(x.size, -5.0), x.ravel(), y.ravel()))
    assert (crossings(across, np.roll(d, 1, axis=0), CYLINDER, all_pairs=True).counts == 2).all()
    at_vertices = cylinder()[0].T
    inside = np.array([[0.125], [-0.25], [0.375]])
    found = crossings(inside, at_vertices - inside, CYLINDER, all_pairs=True)
    assert (found.counts == 1).all()
    through_the_axis = np.array([[0], [0], [-5.0]])
    assert (crossings(through_the_axis, d[:, :1], CYLINDER, all_pairs=True).counts == 2).all()


def test_together_as_one_by_one(rng):
    """What shares a batch, an origin or a direction does not matter to any ray."""
    o = on_sphere(rng, 60, 3.0)
    target = rng.uniform(-0.7, 0.7, (3, 60))
    together = nearest_hits(Rays(o, target - o), BOX)
    assert 10 < (together.triangle < 0).sum() < 50
    for k in range(60):
        one = nearest_hits(Rays(o[:, [k]], (target - o)[:, [k]]), BOX)
        assert (one.triangle, one.t) == (together.triangle[k], together.t[k])
    shared = o[:, :1], target - o[:, :1]
    spread = np.broadcast_to(shared[0], shared[1].shape)
    given, wanted = nearest_hits(Rays(*shared), BOX), nearest_hits(Rays(spread, shared[1]), BOX)
    assert np.array_equal(given.triangle, wanted.triangle) and np.array_equal(given.t, wanted.t)
    parallel = np.array([[0.25], [0.5], [1]])
    spread = np.broadcast_to(parallel, o.shape)
    given, wanted = nearest_hits(Rays(o, parallel), BOX), nearest_hits(Rays(o, spread), BOX)
    assert np.array_equal(given.triangle, wanted.triangle) and np.array_equal(given.t, wanted.t)


def test_in_the_plane_of_a_face(rng):
    """Coplanar rays meet nothing of the face; those in the plane of a box's side no side at all."""
    triangle = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])[:, :, None]
    d = np.stack((*rng.integers(-5, 6, (2, 200)), np.zeros(200))).astype(float)
    d[0, (d == 0).all(axis=0)] = 1
    o = np.stack((*rng.integers(-3, 4, (2, 200)), np.zeros(200))) / 4
    decision = decide(Rays(o, d), triangle.repeat(200, axis=2))
    assert not decision.crossed.any() and not decision.edge.any()
    o = np.array([[0.5], [-3], [0.125]])  # in the plane x = 0.5, just outside by the rule
    assert not crossings(o, np.array([[0], [1.0], [0]]), BOX, all_pairs=True).counts.any()


def test_utm_coordinates(rng):
    """A box of 10 m at UTM (528980, 183526): trimesh logs that as a known failure."""
    place = np.array([[528980.0], [183526], [0]])
    vertices, triangles = box(-5, 5)
    vertices = vertices + place.T
    corners = corners_of(vertices, triangles)
    o = place + on_sphere(rng, 600, 40.0)
    inside = place + rng.uniform(-4.9, 4.9, (3, 600))
    for target in (inside, vertices[rng.integers(8, size=600)].T):
        found = crossings(o, target - o, corners, all_pairs=True)
        assert np.isin(found.counts, (0, 2) if target is not inside else (2,)).all()
        assert (found.winding() == 0).all()


def test_issue_48_rays_that_start_beside_a_large_surface(rng):
    """Size 1e5, 1 mm off: outwards, none meets what it starts from; in float32 many do."""
    triangles = on_sphere(rng, 3 * 3000, 1e5).reshape(3, 3, 3000).transpose(1, 0, 2)
    n = np.cross(triangles[1] - triangles[0], triangles[2] - triangles[0], axis=0)
    n /= np.sqrt((n**2).sum(axis=0))
    weights = rng.dirichlet((1, 1, 1), 3000).T
    o = (weights[:, None] * triangles).sum(axis=0) + 1e-3 * n
    d = on_sphere(rng, 3000)
    d *= np.sign((d * n).sum(axis=0))
    assert not decided(Rays(o, d), triangles, Method.CERTIFIED)[0].any()
    single = [v.astype(np.float32) for v in (o, d, triangles)]
    assert decided(Rays(*single[:2]), single[2], Method.MOLLER_TRUMBORE)[0].mean() > 0.1
