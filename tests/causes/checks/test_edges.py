"""Edges and depth ties: made on purpose, found; and no fault hides behind one.

What stands in for Blender's picture here is made by the tracer itself, from a scene with a fault.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.explain import AGREE, DEPTH_TIE, EDGE, UNEXPLAINED
from reference_tracer.pictures.bounds import SNAPPING
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ...cases import count, explained, find_causes, shifted


def test_a_shift_within_the_snapping_is_all_edges(stripes):
    picture = render(replace(stripes, camera=shifted(stripes.camera, 1 / 300, -1 / 300))).color
    found = explained(stripes, picture)
    assert count(found, EDGE) > 20
    assert count(found, EDGE) + count(found, AGREE) == found.cause.size
    edge = found.cause == EDGE
    assert (found.allowed[edge] >= SNAPPING).all() and (found.allowed[edge] < 1.1 * SNAPPING).all()


@pytest.mark.parametrize("shift", [(0.5, 0), (-0.5, 0.5), (0.05, 0.02)])
def test_a_larger_shift_is_unexplained(stripes, shift):
    picture = render(replace(stripes, camera=shifted(stripes.camera, *shift))).color
    found = explained(stripes, picture)
    edges, unexplained = count(found, EDGE), count(found, UNEXPLAINED)
    assert unexplained > 5 * edges and unexplained > 50


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("gap, cause", [(1e-5, DEPTH_TIE), (2e-2, UNEXPLAINED)])
def test_surfaces_nearer_than_the_depth_buffer_resolves(make, orthographic, gap, cause):
    camera = make.camera(20, 15, orthographic=orthographic)
    front, back = make.quad(-50, 50, -50, 50, -10), make.quad(-50, 50, -50, 50, -10 - gap)
    scene = make.scene(camera, front, back)
    swapped = render(replace(scene, instances=[scene.instances[1]])).color
    found = explained(scene, swapped)
    assert (found.cause == cause).all()
    if cause == DEPTH_TIE:
        assert np.allclose(found.figure, gap, rtol=1e-3)


def test_a_tie_some_layers_behind(make):
    quads = [make.quad(-50, 70, -50, 90, -10 - k * 1e-6) for k in range(4)]
    scene = make.scene(make.camera(8, 6), *quads)
    last = render(replace(scene, instances=[scene.instances[3]])).color
    assert (explained(scene, last).cause == DEPTH_TIE).all()


def test_coincident_surfaces_tie(make):
    scene = make.scene(make.camera(8, 6), make.quad(-9, 9, -9, 9, -2), make.quad(-9, 9, -9, 9, -2))
    found = explained(scene, render(replace(scene, instances=[scene.instances[1]])).color)
    assert (found.cause == DEPTH_TIE).all() and not found.figure.any()


def test_a_sample_radius_widens_the_band(stripes):
    picture = render(replace(stripes, camera=shifted(stripes.camera, 0.2, 0))).color
    assert count(explained(stripes, picture), UNEXPLAINED) > 50
    assert count(explained(stripes, picture, sample_radius=0.25), UNEXPLAINED) == 0


@pytest.mark.parametrize("behind", [False, True])
def test_a_sliver_that_no_sample_meets(make, behind):
    """Ten thousandths of a pixel wide: an edge where it is in front, a fault where it is hidden."""
    camera = make.camera(8, 6, half=3, orthographic=True, eye=(4, 3, 0))
    thin = Mesh([(4.50165, -9, -2), (4.50165, 99, -2), (4.50175, 45, -2)], [[0, 1, 2]])
    scene = make.scene(camera, thin, make.quad(-9, 19, -9, 40, -1 if behind else -3))
    picture = render(scene).color.copy()
    picture[:, 4] = scene.instances[0].colors[0]
    found = explained(scene, picture)
    assert (found.cause[:, 4] == (UNEXPLAINED if behind else EDGE)).all()
    if not behind:
        assert np.allclose(found.figure[:, 4], 0.0017, rtol=0, atol=2e-4)


def test_a_long_sliver_keeps_within_what_is_allowed(make):
    camera = make.camera(8, 6, half=3, orthographic=True, eye=(4, 3, 0))
    thin = Mesh([(4.50365, -3e4, -2), (4.50365, 9e4, -2), (4.50375, 3e4, -2)], [[0, 1, 2]])
    scene = make.scene(camera, thin, make.quad(-9, 9, -9, 9, -3))
    picture = render(scene).color.copy()
    picture[:, 4] = scene.instances[0].colors[0]
    assert (explained(scene, picture).cause[:, 4] == EDGE).all()


@pytest.mark.parametrize("radius", [0.0, 0.2])
def test_a_fine_mesh_hides_no_fault(make, radius):
    """Every centre is near some triangle's edge; that the mesh is missing stays a fault."""
    small = radius == 0.0
    ball = trimesh.creation.icosphere(6 if small else 5, radius=2.1 if small else 60.0)
    camera = make.camera(
        *((8, 6) if small else (40, 30)),
        half=3 if small else 15,
        orthographic=True,
        eye=(0.1, 0.2, 100),
    )
    scene = make.scene(camera, make.mesh(ball), make.quad(-99, 99, -99, 99, -99))
    inside = render(scene).object_index == 0
    picture = render(replace(scene, instances=scene.instances[1:])).color
    found = explained(scene, picture, sample_radius=radius)
    assert inside.sum() >= 12
    assert (found.cause[inside] == UNEXPLAINED).mean() > 0.9


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_what_the_literal_method_loses_is_no_edge(make, precision):
    """A third of a wall is lost; that is the tracer's doing, and must not pass as an edge."""
    turn = trimesh.transformations.rotation_matrix(0.7, (1, 2, 3))
    wall = trimesh.creation.box((40, 40, 0.1)).apply_transform(turn).apply_translation((0, 0, -9))
    scene = make.scene(make.camera(30, 20), make.mesh(trimesh.Trimesh(wall.vertices, wall.faces)))
    found = explained(scene, render(scene).color, settings=Settings("textbook_literal", precision))
    lost = (found.cause != AGREE).sum()
    assert lost > 0.05 * found.cause.size
    assert count(found, UNEXPLAINED) > 0.9 * lost


@pytest.mark.slow
@pytest.mark.parametrize("needles, radius", [(20_000, 0.0), (200, 0.3)])
def test_a_fan_of_needles_hides_no_fault(make, needles, radius):
    """Long triangles, but thin ones: every centre is near an edge, as in a fine mesh."""
    angle = np.linspace(0, 2 * np.pi, needles, endpoint=False)
    rim = np.stack((6 * np.cos(angle), 6 * np.sin(angle), np.full(needles, -5.0)), axis=1)
    k = np.arange(needles)
    disc = Mesh(
        np.vstack((rim, [(0, 0, -5)])), np.stack((k, (k + 1) % needles, 0 * k + needles), axis=1)
    )
    camera = make.camera(20, 16, half=8, orthographic=True, eye=(0.1, 0.2, 0))
    scene = make.scene(camera, disc, make.quad(-99, 120, -99, 130, -9))
    inside = render(scene).object_index == 0
    picture = render(replace(scene, instances=scene.instances[1:])).color
    found = explained(scene, picture, sample_radius=radius)
    assert (found.cause[inside] == UNEXPLAINED).mean() > 0.8


def test_a_mean_of_samples_is_no_depth_tie(stripes):
    """The picture shows what the centre sees; the traced colour is another, on one surface."""
    settings = Settings(samples=4)
    picture = render(stripes).color
    work = find_causes(stripes, render(stripes, settings), picture, settings=settings)
    found = result_of(work)
    assert count(found, DEPTH_TIE) == 0 and count(found, UNEXPLAINED) > 50
