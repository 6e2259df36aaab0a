"""Every scenario is a scene that can be traced, and is what it says."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from reference_tracer.scene import Scene
from reference_tracer.study.scenarios import parts, scenes
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.study.truth import pixel_rays
from reference_tracer.tracer.camera import film_of
from reference_tracer.tracer.settings import Precision
from reference_tracer.tracer.vector import transform_points

from ..scenarios import quick


def world(scene, instance=0):
    found = scene.instances[instance]
    return transform_points(found.world_from_object, scene.meshes[found.mesh].vertices.T)


def directions(scene):
    camera = scene.camera
    return pixel_rays(camera, Precision.FLOAT64).directions.T.reshape(camera.height, -1, 3)


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
def test_every_scale_is_a_scene(scenario):
    """Without a warning: what overflows on purpose does so in the tracer."""
    assert len(scenario.scales) == len(set(scenario.scales)) >= 4
    for scale in scenario.scales:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scene = scenario.build(scale, scenario.width, scenario.height)
        assert isinstance(scene, Scene)
        assert (scene.camera.width, scene.camera.height) == (scenario.width, scenario.height)
        assert 6 <= scene.triangle_count < 2000
        rays = pixel_rays(scene.camera, Precision.FLOAT64)
        assert np.isfinite(rays.origins).all() and np.isfinite(rays.directions).all()


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
@pytest.mark.parametrize("size", [(1, 1), (7, 5)])
def test_other_sizes_of_the_picture(scenario, size):
    assert scenario.build(scenario.scales[1], *size).camera.height == size[1]


def test_words():
    names = [s.name for s in SCENARIOS]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[a-z0-9]+(_[a-z0-9]+)*", name) for name in names)
    for thing in SCENARIOS:
        assert thing.title and thing.explanation.endswith(".") and "\n" not in thing.explanation
        assert len(thing.explanation) < 120


def test_the_same_each_time():
    for scenario in SCENARIOS:
        one, two = (scenario.build(scenario.scales[1], 8, 6) for _ in range(2))
        for a, b in zip(one.meshes, two.meshes, strict=True):
            assert np.array_equal(a.vertices, b.vertices)
            assert np.array_equal(a.triangles, b.triangles)


def test_quick_has_all_scenarios_and_their_ends():
    some = quick()
    assert [s.name for s in some] == [s.name for s in SCENARIOS]
    for whole, few in zip(SCENARIOS, some, strict=True):
        assert len(few.scales) == 3 and few.width * few.height < 200
        assert (few.scales[0], few.scales[-1]) == (whole.scales[0], whole.scales[-1])


def test_axes_of_the_view():
    assert np.allclose(parts.TURNED.T @ parts.TURNED, np.eye(3), atol=1e-15)
    assert np.linalg.det(parts.TURNED) == pytest.approx(1)


@pytest.mark.parametrize("mesh", [parts.sphere(), parts.sphere(0.5, 5)], ids=["12", "5"])
def test_the_sphere_is_closed(mesh):
    edges = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    a, b, c = mesh.vertices[mesh.triangles].transpose(1, 0, 2)
    assert ((np.cross(b - a, c - a) * a).sum(axis=1) > 0).all()  # wound to the outside


@pytest.mark.parametrize("step", [2, 4])
def test_the_sheet_is_closed_and_has_a_corner_on_every_ray(step):
    view = parts.camera(16, 12)
    mesh = parts.sheet(view, step)
    edges = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    px, py, depth = film_of(view, mesh.vertices[:-1].T)
    steps = (np.stack((px, py)) - 0.5) / step
    assert np.abs(steps - np.rint(steps)).max() < 1e-12
    assert px.min() < 0 and px.max() > 16 and py.min() < 0 and py.max() > 12
    assert depth.min() > 3.99 and depth.max() < 5.01
    assert film_of(view, mesh.vertices[-1:].T)[2] < 0


def test_corners_of_a_fan_meet_in_one():
    scene = scenes.closed_fan(32, 32, 24)
    front = scene.meshes[0].triangles[: len(scene.meshes[0].triangles) // 2]
    assert (front[:, 0] == 0).all() and 32 <= len(front) <= 36
    px, py, _ = film_of(scene.camera, world(scene)[:, :1])
    assert (px[0], py[0]) == pytest.approx((16.5, 12.5))


@pytest.mark.parametrize("build", [scenes.integer_cube, scenes.integer_cube_ortho])
def test_cubes_and_their_rays_are_whole_numbers(build):
    for cells in (1, 8):
        scene = build(cells, 32, 24)
        rays = pixel_rays(scene.camera, Precision.FLOAT64)
        assert (scene.meshes[0].vertices % 1 == 0).all()
        assert (rays.origins % 1 == 0).all() and (8 * rays.directions % 1 == 0).all()


def test_copies_are_in_one_plane_exactly():
    scene = scenes.degenerate_faces(2, 32, 24)
    points = 4 * scene.meshes[0].vertices
    assert (points % 1 == 0).all()
    normal = np.cross(parts.TURNED_39[:, 0], parts.TURNED_39[:, 1])
    assert len({sum(int(a) * int(b) for a, b in zip(p, normal, strict=True)) for p in points}) == 1
    a, b, c = points[scene.meshes[1].triangles].transpose(1, 0, 2)
    empty = (np.cross(b - a, c - a) == 0).all(axis=1)
    assert 0 < empty.sum() < len(empty) - 2 * len(scene.meshes[0].triangles) + 1


def test_needles_are_as_thin_as_told():
    for aspect in (10, 1e6):
        points = world(scenes.needles(aspect, 8, 6))[:, :4]
        sides = np.linalg.norm(points[:, 1:3] - points[:, :1], axis=0)
        assert sides[0] / sides[1] == pytest.approx(aspect, rel=1e-6)


def test_the_plane_is_below_the_camera():
    for height in (1.0, 1e-9):
        scene = scenes.grazing(height, 8, 6)
        above = (scene.camera.up[:, None] * world(scene)).sum(axis=0)
        assert np.allclose(above, -height, atol=1e-14)


def test_the_second_plane_is_nearer():
    scene = scenes.close_planes(2.0**30, 8, 6)
    far, near = (film_of(scene.camera, world(scene, k))[2] for k in (0, 1))
    assert np.allclose(far - near, 5 * 2.0**-22, rtol=1e-6)


def test_what_is_not_finite_is_so_in_the_world():
    for share, some in ((0.0, 0), (0.1, None), (1.0, None)):
        scene = scenes.non_finite(share, 32, 24)
        with np.errstate(over="ignore"):
            finite = np.isfinite(world(scene)).all(axis=0)
        count = len(finite) - finite.sum()
        assert count == (round(share * len(finite)) if some is None else some)
        assert np.isfinite(world(scene, 1)).all()


def test_the_wide_view_is_that_wide():
    row = directions(scenes.wide_view(1.0, 32, 24))[0]
    window = scenes.wide_view(1.0, 32, 24).camera.window
    assert np.degrees(2 * np.arctan(window.right)) == pytest.approx(179)
    assert np.linalg.norm(row[-1] - row[0]) == pytest.approx(2 * window.right * 31 / 32)


def test_pressing_and_shearing_mirror():
    for build in (scenes.squashed, scenes.sheared):
        assert np.linalg.det(build(0.5, 8, 6).instances[0].world_from_object[:3, :3]) < 0
