"""The exact oracle against closed forms, and against fractions worked out here in another way."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING, NOWHERE
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import transform_points

from .moved import may, touched
from .oracle import (
    EDGE,
    INSIDE,
    OUTSIDE,
    intersect_pairs,
    scaled_integers,
    scene_sights,
    sights,
)

TINY = Fraction(1, 2**2000)  # beside integers of a few digits


def det(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def fractions(*vectors):
    return [[Fraction(float(x)) for x in v] for v in vectors]


def met(o, d, corners, by=(0, 0, 0)):
    """Return (t, the least barycentric) by Cramer's rule in fractions; None for a miss."""
    o, d, p1, p2, p3 = fractions(o, d, *corners)
    e1, e2, q = ([a - b for a, b in zip(v, p1, strict=True)] for v in (p2, p3, o))
    against = [-x - b for x, b in zip(d, by, strict=True)]
    whole = det(e1, e2, against)
    if whole == 0:
        return None
    u, v, t = (n / whole for n in (det(q, e2, against), det(e1, q, against), det(e1, e2, q)))
    least = min(u, v, 1 - u - v)
    return None if least < 0 else (t, least)


def first_sign(o, d, a, b):
    """The sign of the edge a b by the rule as it is written: d . m, else m_x, m_y, m_z."""
    o, d, a, b = fractions(o, d, a, b)
    a, b = ([x - y for x, y in zip(v, o, strict=True)] for v in (a, b))
    m = [det(axis, a, b) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    values = [v for v in (sum(x * y for x, y in zip(d, m, strict=True)), *m) if v]
    return 0 if not values else 1 if values[0] > 0 else -1


def expected(scene):
    """Return what is touched by the rays of each pixel's centre: every ray, every triangle."""
    region = scene.camera.region
    rays = camera_rays(scene.camera, *film_positions(region, 0.0, 0.0))
    shape = (3, region.width * region.height)
    origins, directions = (np.broadcast_to(v, shape).T for v in (rays.origins, rays.directions))
    out = []
    for o, d in zip(origins, directions, strict=True):
        hits = []
        for i, instance in enumerate(scene.instances):
            mesh = scene.meshes[instance.mesh]
            world = transform_points(instance.world_from_object, mesh.vertices.T)
            for k, triangle in enumerate(mesh.triangles):
                found = met(o, d, world[:, triangle].T)
                if found:
                    hits.append((found[0], found[1] == 0, (i, k)))
        for i, plane in enumerate(scene.planes):
            n, p, origin, along = fractions(plane.normal, plane.point, o, d)
            towards = sum(a * b for a, b in zip(n, along, strict=True))
            if towards:
                t = sum(a * (b - c) for a, b, c in zip(n, p, origin, strict=True)) / towards
                hits.append((t, False, (len(scene.instances) + i, NOTHING)))
        near, far = scene.camera.clip_start, scene.camera.clip_end
        hits = [h for h in hits if near <= h[0] <= far]
        sure = min((t for t, edge, _ in hits if not edge), default=None)
        may = {name for t, edge, name in hits if sure is None or t == sure or (edge and t < sure)}
        out.append(may | ({NOWHERE} if sure is None else set()))
    return out


def matches(scene):
    """Check the oracle against fractions; return what may be seen."""
    answers = scene_sights(scene)
    assert [touched(a) for a in answers] == expected(scene)
    assert all(a.seen in may(a) and may(a) <= touched(a) for a in answers)
    return [may(a) for a in answers]


def small_integers(rng, count):
    """Pairs that often meet edges, corners, or nothing of any area."""
    o, d = (rng.integers(-2, 3, (3, count)).astype(float) for _ in range(2))
    return o, d, rng.integers(-2, 3, (3, 3, count)).astype(float)


def any_size(rng, count):
    o, d, c = (rng.normal(size=(*k, count)) for k in ((3,), (3,), (3, 3)))
    size = 2.0 ** rng.integers(-300, 300, count)
    d *= 2.0 ** rng.integers(-500, 500, count)
    c[:, 0] *= 2.0 ** rng.integers(-8, 8, count)
    return o * size, d, c * size


def test_the_unit_triangle_in_closed_form():
    """Rays straight down at multiples of 1/8: inside where x, y and 1 - x - y are positive.

    Moved by (e, e^2), a ray on the boundary is inside but at the edge x + y = 1.
    """
    x, y = (v.ravel() / 8 for v in np.meshgrid(np.arange(-2, 11), np.arange(-2, 11)))
    triangle = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.0)])[:, :, None].repeat(len(x), axis=2)
    down = np.array([[0], [0], [-2.0]]).repeat(len(x), axis=1)
    given = intersect_pairs(np.stack((x, y, np.full(len(x), 3.0))), down, triangle)
    assert np.array_equal(given.side, np.sign(np.minimum(np.minimum(x, y), 1 - x - y)))
    assert np.array_equal(given.hit, (x >= 0) & (y >= 0) & (x + y < 1))
    assert {given.t(k) for k in np.flatnonzero(given.side != OUTSIDE)} == {Fraction(3, 2)}
    assert (given.side == EDGE).sum() == 24


@pytest.mark.slow
@pytest.mark.parametrize("family", [small_integers, any_size])
def test_pairs_are_those_of_fractions(rng, family):
    o, d, c = family(rng, 3000)
    given = intersect_pairs(o, d, c)
    seen = dict.fromkeys((OUTSIDE, EDGE, INSIDE), 0)
    for k in range(3000):
        found = met(o[:, k], d[:, k], c[:, :, k])
        side = OUTSIDE if found is None else INSIDE if found[1] else EDGE
        assert given.side[k] == side
        assert found is None or given.t(k) == found[0]
        seen[side] += 1
    assert min(seen[OUTSIDE], seen[INSIDE]) > 100
    assert (seen[EDGE] > 200) == (family is small_integers)


@pytest.mark.slow
def test_the_moved_ray_is_that_of_the_rule_and_of_a_tiny_fraction(rng):
    o, d, c = small_integers(rng, 6000)
    given = intersect_pairs(o, d, c)
    on_edge = np.flatnonzero((given.side == EDGE) & [t != 0 for t in given.numerator])
    assert 0.1 < given.hit[on_edge].mean() < 0.9
    assert len(on_edge) > 300
    for k in on_edge:
        column = o[:, k], d[:, k]
        signs = {first_sign(*column, c[i, :, k], c[i - 2, :, k]) for i in range(3)}
        assert given.hit[k] == (len(signs) == 1)
        assert 0 not in signs  # nothing is left undecided where t is not 0
        moved = met(*column, c[:, :, k], (TINY, TINY**2, TINY**3))
        assert given.hit[k] == (moved is not None and moved[1] > 0)


def test_the_range_is_closed_and_a_ray_does_not_meet_where_it_begins():
    o, d = np.zeros((3, 4)), np.array([[0.0, 0, 1]] * 4).T
    c = np.array([[-1.0, -1, 0], [2, -1, 0], [0, 3, 0]])[:, :, None].repeat(4, axis=2)
    c[:, 2] = (0, 1, 1, 5e-324)
    c[:, 2, 2] = np.nextafter(1, 0)
    given = intersect_pairs(o, d, c)
    assert given.within(0, 1).tolist() == [False, True, True, True]
    assert given.within(1, 1).tolist() == [False, True, False, False]
    assert given.within(-1, 0).tolist() == [True, False, False, False]


def test_integers_are_the_floats(rng):
    values = rng.normal(size=(3, 50)) * 10.0 ** rng.integers(-300, 300, (3, 50))
    values[:, 0], values[:, 1] = (0, -0.0, 5e-324), 0
    whole, exponent = scaled_integers(values)
    assert exponent.min() < -1000
    for floats, ints, e in zip(values.T, whole.T, exponent, strict=True):
        assert [Fraction(n) * Fraction(2) ** int(e) for n in ints] == fractions(floats)[0]


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("exponent", [0, -150, 120, 200])
def test_random_triangles_at_any_scale(make, rng, orthographic, exponent):
    scale = 2.0**exponent
    corners = rng.normal(size=(24, 3)) * scale
    corners[:, 2] -= 4 * scale
    camera = make.camera(
        6,
        5,
        half=(scale if orthographic else 0.4),
        orthographic=orthographic,
        clip_start=scale,
        clip_end=5 * scale,
    )
    meshes = (Mesh(corners, np.arange(24).reshape(8, 3)),)
    planes = (Plane(0, (0, 0, -4.5 * scale), (0.1, 0.2, 1)),)
    matrix = np.eye(4)
    matrix[:3] = np.column_stack((rng.normal(size=(3, 3)), rng.normal(size=3) * scale))
    scene = Scene(
        camera, meshes, (Instance(0, 0, np.eye(4)), Instance(0, 0, matrix)), planes, objects=("A",)
    )
    answers = matches(scene)
    assert len(frozenset().union(*answers)) >= 4
    assert all(len(a) == 1 for a in answers)


def grid(holes=()):
    """An integer grid of triangles at z = -2, without some."""
    x, y = np.meshgrid(np.arange(-4, 4), np.arange(-4, 4))
    points = np.stack((x.ravel(), y.ravel(), np.full(64, -2)), axis=1).astype(float)
    k = (np.arange(7)[:, None] * 8 + np.arange(7)).ravel()[:, None]
    triangles = np.concatenate([k + np.array(c) for c in ((0, 1, 8), (1, 9, 8))])
    return Mesh(points, np.delete(triangles, holes, axis=0))


@pytest.mark.slow
def test_through_corners_and_edges(make):
    """Integer rays: each meets a corner. What is behind is seen only where something is missing."""
    camera = make.camera(8, 8, half=4, orthographic=True, eye=(0.5, 0.5, 0))
    behind = make.quad(-20, 40, -30, 70, -3)
    answers = matches(make.scene(camera, grid(), behind))
    inner = [a for a in answers if len(a) == 6 and (1, 0) not in a and (1, 1) not in a]
    assert len(inner) == 36
    torn = matches(make.scene(camera, grid([30]), behind))
    assert sum(any(i == 1 for i, _ in a) for a in torn) == 64 - 36 + 3


def test_what_may_be_seen_is_what_moved_rays_see(make, rng):
    """Rays moved by 2^-40, in hundreds of directions: no sector is missed, and none is made up."""
    fan = np.array([[np.cos(a), np.sin(a), -2] for a in rng.uniform(0, 2 * np.pi, 24)])
    order = np.argsort(np.arctan2(fan[:, 1], fan[:, 0]))
    fan = np.round(fan[order] * 16) / 16
    corners = np.stack([np.array([(0, 0, -2.0), fan[k - 1], fan[k]]) for k in range(24)], axis=2)
    corners = np.delete(corners, [3, 4, 11], axis=2)  # what is behind may be seen through these
    behind = np.array([[-9.0, -9, -3], [9, -9, -3], [0, 20, -3]])[:, :, None]
    slanted = np.array([[-9.0, -9, -3], [9, -9, -3], [0, 9, -3]])[:, :, None]
    corners = np.concatenate((corners, behind, slanted), axis=2)
    corners[:, 2, -1] += corners[:, 0, -1] / 4
    o, d = np.zeros((3, 1)), np.array([[0], [0], [-1.0]])
    [sight] = sights(o, d, corners)
    ways = rng.normal(size=(3, 800)) * 2.0**-40
    moved = sights(np.zeros((3, 800)), d + ways, corners)
    assert {s.seen for s in moved} == may(sight)
    assert len(may(sight)) > 20


def test_coincident_triangles_and_planes_tie(make):
    quad = make.quad(-20, 40, -30, 70, -2)
    scene = make.scene(make.camera(4, 3), quad, quad, planes=[((0, 0, -2), (0, 0, 3))])
    answers = scene_sights(scene)
    assert [touched(a) for a in answers] == expected(scene)
    assert all({i for i, _ in touched(a)} == {0, 1, 2} for a in answers)
    assert all(len(may(a)) == 1 and a.seen[0] == 0 for a in answers)  # of one plane, the lowest


def test_a_gap_of_one_ulp_is_told(make):
    behind = make.quad(-20, 40, -30, 70, np.nextafter(-2, -3))
    scene = make.scene(make.camera(4, 3), behind, make.quad(-20, 40, -30, 70, -2))
    assert all({i for i, _ in a} == {1} for a in matches(scene))


def test_what_has_no_area_or_is_seen_edge_on_is_not_there(make):
    flat = Mesh(
        [(-1, 0, -2), (0, 0, -2), (1, 0, -2), (0.0, 0, -3)],
        [[0, 1, 2], [0, 0, 0], [0, 2, 2], [0, 2, 3]],
    )
    camera = make.camera(5, 5)
    assert matches(make.scene(camera, flat)) == [{NOWHERE}] * 25


def test_clip_range_is_inclusive_and_exact(make):
    for z, seen in ((2, True), (3, True), (np.nextafter(2, 0), False), (np.nextafter(3, 4), False)):
        camera = make.camera(3, 3, clip_start=2, clip_end=3)
        answers = matches(make.scene(camera, make.quad(-20, 40, -30, 70, -z)))
        assert all((a == {NOWHERE}) != seen for a in answers)


@pytest.mark.slow
def test_the_oracle_and_the_textbook_agree_away_from_edges(make):
    camera = make.camera(20, 15, eye=(2.3, -2.6, 1.9), target=(0, 0, 0))
    torus = trimesh.creation.torus(1.0, 0.4, major_sections=16, minor_sections=12)
    scene = make.scene(camera, make.mesh(torus))
    frame = render(scene, Settings("textbook"))
    given = zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True)
    assert all(name in may(s) for name, s in zip(given, scene_sights(scene), strict=True))


def moved_hits(o, d, corners):
    """What the ray d + (x, x^2, x^3) crosses, the nearest first: (t of it, index)."""
    by = TINY, TINY**2, TINY**3
    found = ((met(o, d, corners[:, :, k], by), k) for k in range(corners.shape[2]))
    return sorted((hit[0], k) for hit, k in found if hit)


def check(o, d, corners):
    """Check one ray against fractions: what it sees, its t, and how many it crosses."""
    o, d = np.asarray(o, float), np.asarray(d, float)
    [sight] = sights(o[:, None], d[:, None], corners)
    hits = [(t, k) for t, k in moved_hits(o, d, corners) if t > 0]
    assert sight.seen == ((0, hits[0][1]) if hits else NOWHERE)
    assert sight.t == (met(o, d, corners[:, :, hits[0][1]])[0] if hits else None)
    assert sight.crossings == len(hits)
    return sight


@pytest.fixture
def box():
    """A cube of 4 m about the origin: its vertices, and the corners of its triangles."""
    cube = trimesh.creation.box((4, 4, 4))
    return cube.vertices, cube.vertices[cube.faces].transpose(1, 2, 0)


def test_a_closed_surface_is_crossed_once_from_inside(box):
    """Integers: every ray meets a corner, an edge or a diagonal."""
    vertices, corners = box
    centers = corners.mean(axis=0).T
    for target in [*vertices, *centers, (2, 0, 0), (2, 2, 0)]:
        assert check((0, 0, 0), target, corners).crossings == 1
    for target in vertices:
        assert check((1, 0, 1), target - (1, 0, 1), corners).crossings == 1


def test_an_outline_is_crossed_twice_or_not_at_all(box):
    for x in (-2, 0, 2):
        for y in (-2, 1, 2):
            assert check((x, y, 9), (0, 0, -1), box[1]).crossings in (0, 2)


def test_two_that_meet_at_the_ray_are_ordered_by_the_moved_one():
    """Two planes through one point of the ray: to the side it is moved to, one is nearer."""
    slopes = [[[-9, -9, 5 + s * -9], [9, -9, 5 + s * 9], [0, 9, 5]] for s in (1, -1)]
    corners = np.array(slopes, float).transpose(1, 2, 0)
    assert check((0, 0, 0), (0, 0, 1), corners).seen == (0, 1)
    assert check((0, 0, 0), (0, 0, 1), corners[:, :, ::-1]).seen == (0, 0)


def test_what_is_not_finite_is_not_seen(make):
    """A corner that the object's matrix takes to infinity: its triangles are left out."""
    points, triangles = make.quad(-20, 40, -30, 70, -2).vertices.copy(), [[0, 1, 2], [0, 2, 3]]
    points[1, 0] = 1e200
    scene = make.scene(make.camera(4, 3), Mesh(points, triangles), make.quad(-20, 40, -30, 70, -3))
    far = replace(scene.instances[0], world_from_object=np.diag((1e200, 1, 1, 1.0)))
    seen = {s.seen for s in scene_sights(replace(scene, instances=(far, scene.instances[1])))}
    assert (0, 0) not in seen and any(i == 1 for i, _ in seen)


def test_some_pixels_are_those_of_all(make):
    scene = make.scene(make.camera(8, 8, half=4, orthographic=True, eye=(0.5, 0.5, 0)), grid([30]))
    all_of_them, some = scene_sights(scene), np.array([5, 27, 60])
    found = scene_sights(scene, some)
    expected = [(all_of_them[k].seen, all_of_them[k].t, may(all_of_them[k])) for k in some]
    assert [(s.seen, s.t, may(s)) for s in found] == expected
