"""Whole pictures against the oracle: every pixel's surface, its t, and what else it may be.

The oracle takes every ray with every triangle, so candidates, tiles and batches are tested, too.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.certainty import Certainty
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Region, Scene
from reference_tracer.study.oracle import intersect_pairs, scene_sights
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings

from ..moved import may, touched
from .meshes import box, closed_fan, grid


def matches(scene):
    """Check a certified picture against the oracle; return the picture and the oracle's answers."""
    frame, answers = render(scene, Settings("certified")), scene_sights(scene)
    names = list(zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True))
    assert [tuple(map(int, name)) for name in names] == [a.seen for a in answers]
    certainty = frame.certainty.ravel()
    assert not (certainty == Certainty.NOT_CERTIFIED).any()
    ambiguous = np.flatnonzero(certainty == Certainty.AMBIGUOUS)
    assert set(frame.ties) == set(ambiguous.tolist())
    assert all(len(touched(a)) == 1 for k, a in enumerate(answers) if k not in frame.ties)
    check_t(scene, frame)
    return frame, answers


def check_ties(frame, answers):
    """Nothing that a moved ray sees is missing, and nothing is there that none could."""
    assert frame.ties
    for pixel, ties in frame.ties.items():
        assert may(answers[pixel]) <= ties <= touched(answers[pixel])


def check_t(scene, frame):
    """Check that the t of every triangle that is seen is the exact one, correctly rounded."""
    region = scene.camera.region
    x, y = np.meshgrid(np.arange(region.x0, region.x1), np.arange(region.y0, region.y1))
    rays = camera_rays(scene.camera, x.ravel() + 0.5, y.ravel() + 0.5)
    o, d = (np.broadcast_to(v, (3, x.size)) for v in (rays.origins, rays.directions))
    instance, triangle, t = (
        v.ravel() for v in (frame.instance_index, frame.triangle_index, frame.t)
    )
    assert (t[instance == NOTHING] == np.inf).all()
    for k in np.flatnonzero(triangle != NOTHING):
        which = scene.instances[instance[k]]
        mesh = scene.meshes[which.mesh]
        m = which.world_from_object
        corners = mesh.vertices[mesh.triangles[triangle[k]]].astype(np.float64)
        a, b, c = corners.T
        world = np.stack([m[i, 0] * a + m[i, 1] * b + m[i, 2] * c + m[i, 3] for i in range(3)])
        result = intersect_pairs(o[:, [k]], d[:, [k]], world.T[:, :, None])
        assert t[k] == float(result.t(0))


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("exponent", [0, -300, -110, 90, 300])
def test_random_triangles_instances_and_planes_at_any_scale(make, rng, orthographic, exponent):
    scale = 2.0**exponent
    corners = rng.normal(size=(24, 3)) * scale
    corners[:, 2] -= 4 * scale
    camera = make.camera(
        14,
        11,
        half=(scale if orthographic else 0.4),
        orthographic=orthographic,
        clip_start=scale,
        clip_end=5 * scale,
    )
    matrix = np.eye(4)
    matrix[:3] = np.column_stack((rng.normal(size=(3, 3)), rng.normal(size=3) * scale))
    instances = (Instance(0, 0, np.eye(4)), Instance(0, 0, matrix))
    planes = (Plane(0, (0, 0, -4.5 * scale), (0.1, 0.2, 1)),)
    mesh = Mesh(corners, np.arange(24).reshape(8, 3))
    frame, _ = matches(Scene(camera, (mesh,), instances, planes, objects=("A",)))
    assert len(np.unique(frame.instance_index)) >= 2


def torn_grid(make, orthographic):
    """A grid whose vertices and edges are met by the rays exactly, torn, with something behind."""
    vertices, triangles = grid(8)
    vertices = vertices * 8 - (4, 4, 2)
    torn = np.delete(triangles, [20, 41, 43, 90], axis=0)
    options = {"half": 4, "eye": (0.5, 0.5, 0)} if orthographic else {"half": 2}
    camera = make.camera(8, 8, orthographic=orthographic, **options)
    if not orthographic:  # pixels at multiples of 1/2 of the plane at depth 1
        window = type(camera.window)(-2.25, 1.75, -2.25, 1.75)
        camera = replace(camera, window=window)
    behind = make.quad(-20, 40, -30, 70, -3)
    return make.scene(camera, Mesh(vertices, torn), behind)


@pytest.mark.parametrize("orthographic", [False, True])
def test_every_ray_through_a_vertex_or_an_edge(make, orthographic):
    frame, answers = matches(torn_grid(make, orthographic))
    assert (frame.certainty == Certainty.AMBIGUOUS).sum() > 40
    assert max(len(may(a)) for a in answers) >= 6
    assert set(np.unique(frame.instance_index)) == {0, 1}


def test_duplicates_and_planes_in_one_place(make):
    """All in one plane: the lowest instance, then the lowest triangle, then the plane."""
    quad = make.quad(-20, 40, -30, 70, -2)
    plane = ((0, 0, -2), (0, 0, 3))
    frame, _ = matches(make.scene(make.camera(6, 5), quad, quad, planes=[plane, plane]))
    assert (frame.instance_index == 0).all() and (frame.t == 2).all()
    frame, _ = matches(make.scene(make.camera(6, 5), planes=[plane, plane]))
    assert (frame.instance_index == 0).all() and (frame.t == 2).all()


def crossing_quads(make):
    """Tilted quads through one line, which rays meet exactly: the moved ray says who is nearer."""
    flat = make.quad(-4, 4, -4, 4, -2)
    tilted = Mesh([(-4, -4, -4.0), (4, -4, -4), (4, 4, 0), (-4, 4, 0)], [[0, 1, 2], [0, 2, 3]])
    slanted = Mesh([(-4, -4, -6.0), (4, -4, 2), (4, 4, 2), (-4, 4, -6)], [[0, 1, 2], [0, 2, 3]])
    camera = make.camera(9, 9, half=2.25, orthographic=True, clip_start=-9)
    plane = ((0, 0, -2), (1, -1, 2))
    return make.scene(camera, flat, tilted, slanted, planes=[plane])


def test_surfaces_that_cross_in_the_picture(make):
    frame, answers = matches(crossing_quads(make))
    assert set(np.unique(frame.instance_index)) >= {1, 2}
    assert max(len({i for i, _ in may(a)}) for a in answers) >= 2


def test_ties_name_all_that_may_be_seen(make):
    for scene in (torn_grid(make, False), torn_grid(make, True), crossing_quads(make)):
        check_ties(*matches(scene))


@pytest.mark.parametrize("z", [2.0, 3.0])
@pytest.mark.parametrize("by", [-1, 0, 1])
def test_the_clip_range_to_the_ulp(make, z, by):
    depth = np.nextafter(z, z + by) if by else z
    camera = make.camera(5, 4, clip_start=2, clip_end=3)
    frame, _ = matches(make.scene(camera, make.quad(-20, 40, -30, 70, -depth)))
    assert (frame.instance_index == (0 if 2 <= depth <= 3 else NOTHING)).all()


def test_the_clip_range_at_the_depths_of_pixels(make):
    """A tilted surface, clipped at the rounded depth of one pixel: its true depth decides."""
    corners = [(-3, -2.7, -2.1), (4.1, -2, -3.3), (0.3, 5.2, -4.7)]
    scene = make.scene(make.camera(9, 8), Mesh(np.array(corners), [[0, 1, 2]]))
    depths = np.unique(render(scene, Settings("certified")).t)
    depths = depths[np.isfinite(depths)]
    assert len(depths) > 6
    lost = set()
    for depth in depths[1:-1:3]:
        for end in ("clip_start", "clip_end"):
            clipped = replace(scene, camera=replace(scene.camera, **{end: float(depth)}))
            frame, _ = matches(clipped)
            lost.add(bool((frame.t == depth).any()))
    assert lost == {True, False}


@pytest.mark.parametrize("far", [1.0, 1e6, 1e12])
def test_solids_from_near_and_far(make, far):
    """A torus, a box and a fan; at 10^12 sizes away a pixel's rounding is a ten thousandth."""
    torus = trimesh.creation.torus(1.0, 0.4, major_sections=16, minor_sections=10)
    eye = np.array((2.3, -2.6, 1.9)) * far
    camera = make.camera(
        16, 12, half=0.4 / far, eye=eye, target=(0, 0, 0), clip_end=9 * far, clip_start=far / 2
    )
    meshes = make.mesh(torus), Mesh(*box()), Mesh(*closed_fan(12))
    frame, _ = matches(make.scene(camera, *meshes))
    assert len(np.unique(frame.instance_index)) >= 3


@pytest.mark.parametrize("height", [-1.0, 0.0, 1.0])
def test_no_hole_where_rays_begin_on_the_edges_of_what_they_see(make, height):
    """An orthographic camera that sees behind itself, as Blender's viewport does.

    Its rays meet each edge of the grid exactly; at height 0 they begin there (t = 0). All the same,
    each meets one triangle.
    """
    vertices, triangles = grid(8)
    camera = make.camera(7, 7, half=3.5, eye=(0, 0, 0), orthographic=True, clip_start=-5)
    mesh = Mesh(vertices * 8 - (4, 4, height), triangles)
    frame = render(make.scene(camera, mesh), Settings("certified"))
    assert (frame.instance_index == 0).all() and (frame.t == height).all()


def test_a_border_sees_what_the_whole_picture_does(make):
    camera = make.camera(20, 16, eye=(2.3, -2.6, 1.9), target=(0, 0, 0))
    scene = make.scene(camera, Mesh(*box(-1, 1)))
    whole = render(scene, Settings("certified"))
    part = replace(scene, camera=replace(camera, region=Region(3, 5, 17, 11)))
    frame, _ = matches(part)
    assert np.array_equal(frame.triangle_index, whole.triangle_index[5:11, 3:17])
    assert np.array_equal(frame.t, whole.t[5:11, 3:17])
