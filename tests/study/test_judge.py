"""The exact judge against fractions, worked out here in another way."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.study import judge as module
from reference_tracer.study.judge import TooLargeError, integers, judge
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.render import render
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import transform_points
from reference_tracer.tracer.visibility import NOTHING, film_positions

NONE = (NOTHING, NOTHING)


def det(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def fractions(*vectors):
    return [[Fraction(float(x)) for x in v] for v in vectors]


def met(o, d, corners):
    """Return (t, whether on an edge) by Cramer's rule in fractions; None for a miss."""
    o, d, p1, p2, p3 = fractions(o, d, *corners)
    e1, e2, q = ([a - b for a, b in zip(v, p1, strict=True)] for v in (p2, p3, o))
    against = [-x for x in d]
    whole = det(e1, e2, against)
    if whole == 0:
        return None
    u, v, t = (n / whole for n in (det(q, e2, against), det(e1, q, against), det(e1, e2, q)))
    least = min(u, v, 1 - u - v)
    return None if least < 0 else (t, least == 0)


def expected(scene):
    """Return what may be seen through each pixel's centre: every ray with every triangle."""
    region = scene.camera.region
    rays = camera_rays(scene.camera, *film_positions(region, 0.0, 0.0))
    count = region.width * region.height
    origins, directions = (
        np.broadcast_to(v, (3, count)).T for v in (rays.origins, rays.directions)
    )
    out = []
    for o, d in zip(origins, directions, strict=True):
        hits = []
        for i, instance in enumerate(scene.instances):
            mesh = scene.meshes[instance.mesh]
            world = transform_points(instance.world_from_object, mesh.vertices.T)
            for k, triangle in enumerate(mesh.triangles):
                found = met(o, d, world[:, triangle].T)
                if found:
                    hits.append((*found, (i, k)))
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
        out.append(may | ({NONE} if sure is None else set()))
    return out


def judged(scene):
    return [names for tile in judge(scene) for names in tile]


def matches(scene):
    """Check the judge against fractions; return the answers."""
    answers = judged(scene)
    assert answers == expected(scene)
    return answers


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
    assert len(set().union(*answers)) >= 4
    assert all(len(a) == 1 for a in answers)


def test_through_corners_and_edges(make):
    """Integer rays into an integer grid of triangles: each meets a corner or an edge."""
    camera = make.camera(8, 8, half=4, orthographic=True, eye=(0.5, 0.5, 0))
    x, y = np.meshgrid(np.arange(-4, 4), np.arange(-4, 4))
    points = np.stack((x.ravel(), y.ravel(), np.full(64, -2)), axis=1).astype(float)
    k = (np.arange(7)[:, None] * 8 + np.arange(7)).ravel()[:, None]
    mesh = Mesh(points, np.concatenate([k + np.array(c) for c in ((0, 1, 8), (1, 9, 8))]))
    behind = make.quad(-20, 40, -30, 70, -3)
    answers = matches(make.scene(camera, mesh, behind))
    on_edge = [a for a in answers if any(i == 0 for i, _ in a)]
    assert len(on_edge) > 40
    assert all(any(i == 1 for i, _ in a) for a in on_edge)  # what is behind may be seen, too
    assert max(map(len, answers)) >= 7


def test_coincident_triangles_and_planes_tie(make):
    quad = make.quad(-20, 40, -30, 70, -2)
    scene = make.scene(make.camera(4, 3), quad, quad, planes=[((0, 0, -2), (0, 0, 3))])
    assert all({i for i, _ in a} == {0, 1, 2} for a in matches(scene))


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
    assert judged(make.scene(camera, flat)) == [{NONE}] * 25


def test_clip_range_is_inclusive_and_exact(make):
    for z, seen in ((2, True), (3, True), (np.nextafter(2, 0), False), (np.nextafter(3, 4), False)):
        camera = make.camera(3, 3, clip_start=2, clip_end=3)
        answers = matches(make.scene(camera, make.quad(-20, 40, -30, 70, -z)))
        assert all((a == {NONE}) != seen for a in answers)


def test_integers_are_the_floats(rng):
    values = rng.normal(size=(50, 3)) * 10.0 ** rng.integers(-300, 300, (50, 3))
    values[0] = (0, -0.0, 5e-324)
    whole, exponent = integers(*values)
    assert exponent < -1000
    for row, ints in zip(values, whole, strict=True):
        assert [Fraction(n) * Fraction(2) ** exponent for n in ints] == fractions(row)[0]


def test_the_judge_and_the_textbook_agree_away_from_edges(make):
    camera = make.camera(24, 18, eye=(2.3, -2.6, 1.9), target=(0, 0, 0))
    scene = make.scene(camera, make.mesh(trimesh.creation.torus(1.0, 0.4)))
    frame = render(scene, Settings())
    given = list(
        zip(
            frame.instance_index.ravel().tolist(),
            frame.triangle_index.ravel().tolist(),
            strict=True,
        )
    )
    assert all(name in may for name, may in zip(given, judged(scene), strict=True))


def test_too_large(make, monkeypatch):
    monkeypatch.setattr(module, "MOST_PAIRS", 10)
    with pytest.raises(TooLargeError, match="--width"):
        judged(make.scene(make.camera(), make.quad(-9, 9, -9, 9, -2)))
