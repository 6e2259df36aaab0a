"""Cycles as a second judge: its picture agrees, and what it cannot draw is known.

Its passes are compared by test_data_blend.py.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.cycles import FARTHEST
from reference_tracer.blender.drawing.judges import JUDGES
from reference_tracer.causes.cause import NOT_DECIDABLE
from reference_tracer.causes.embree import LARGEST
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.tracer.progress import result_of

from ..sampled import daily

RADIUS = JUDGES["cycles"].sample_radius
WIDTH = 128


@pytest.mark.parametrize(
    "name",
    [
        "exercise_perspective",
        "exercise_orthographic",
        "exercise_plane",
        "suzanne",
        "shifted_room",
        "geometry_nodes",
        "exercise_triangle",
        "forest",
        # It agrees in Workbench every day; its solids take a second each time.
        pytest.param("technical_view", marks=pytest.mark.torture),
        "text_and_curves",
    ],
)
def test_cycles_picture_has_no_unexplained_pixel(name, opened, compare):
    opened(name, WIDTH)
    comparison = compare(judge="CYCLES")
    assert comparison.case.picture.source.name == "cycles"
    assert comparison.case.picture.sampling.sample_radius == RADIUS
    pixels = comparison.counts
    assert pixels.unexplained == pixels.not_decidable == 0
    assert pixels.differ <= 0.02 * pixels.total
    shows = comparison.identity.shows()
    assert shows.not_known == 0 and shows.other_object <= 0.02 * pixels.total
    assert comparison.verdict == "agree"


def test_far_away_cycles_is_not_decidable(opened, compare):
    opened("far_away", WIDTH)
    comparison = compare(judge="CYCLES")
    assert comparison.counts.unexplained == 0 < comparison.counts.not_decidable
    assert comparison.verdict == "warnings"


FAR = (1e3, 1e5, 1e6, 1e12, 1.8e18, 1.9e18, 1e30)
VIEWS = (0.0, "PERSP"), (0.37, "PERSP"), (0.11, "ORTHO")


@pytest.mark.parametrize(
    ("at", "kind", "far"), daily(((*view, far) for view in VIEWS for far in FAR), 3)
)
def test_triangles_that_reach_far(far, at, kind, build, compare):
    """Cycles shows them a share of their size too large, and from a limit on not at all."""
    build.scene(96, 54, "OBJECT")
    build.camera(type=kind, ortho_scale=4.0)
    corners = [(-1 + at, -1, 0), (far, 0, 0), (-1 + at, 1, 0)]
    build.mesh("Far", corners, [(0, 1, 2)]).color = (1, 0, 0, 1)
    build.square("Behind", 30.0, location=(0, 0, -5), color=(0, 1, 0, 1))
    build.square("Near", 0.8, location=(0.2, 0, 1), color=(0, 0, 1, 1))
    found = compare(judge="CYCLES")
    seen = {n: found.frame.object_index == k for k, n in enumerate(found.scene.objects)}
    undecided = found.causes.cause == NOT_DECIDABLE
    assert found.counts.unexplained == 0
    assert seen["Near"].sum() > 100 and not undecided[seen["Near"]].any()
    shown = (found.picture[..., 0] > 0) & seen["Far"]
    if far > 1.844e18:
        assert not shown.any() and undecided[seen["Far"]].all()
    else:  # what it is is judged, and what is far from it
        assert shown[seen["Far"]].all()
        if far < 1e5:
            assert not undecided.any()
        if far < 1e7:
            assert not undecided[seen["Far"]].any() and not undecided[seen["Behind"]].all()


@pytest.mark.parametrize("half", [2.0, 9.0, 36.0, 360.0])
@pytest.mark.parametrize("share", [0.999, 1.001])
def test_triangles_of_a_large_area(half, share, build, compare):
    """Twice the area is the normal's length: Cycles shows nothing where its square overflows."""
    build.scene(96, 54, "OBJECT")
    build.camera()
    far = min(share * LARGEST / (2 * half), share * FARTHEST)
    build.mesh("Far", [(-1, -half, 0), (far, 0, 0), (-1, half, 0)], [(0, 1, 2)])
    found = compare(judge="CYCLES")
    seen = found.frame.object_index >= 0
    undecided = found.causes.cause == NOT_DECIDABLE
    assert found.counts.unexplained == 0 and seen.sum() > 500
    if share > 1:
        assert undecided[seen].all()
    else:  # a missing one would be found
        assert not undecided[seen].any()
        without = replace(found.case.picture, color=np.zeros_like(found.picture))
        wrong = result_of(trace_and_compare(replace(found.case, picture=without)))
        assert wrong.counts.unexplained > 0.9 * seen.sum()


WAYS = (1, 1, 0), (0, 1, -1), (0.3, 1, -0.2)


@pytest.mark.parametrize(
    ("kind", "to", "far"), daily(product(("PERSP", "ORTHO"), WAYS, (1e4, 1e7, 1e10)), 4)
)
def test_strips_that_reach_far_in_any_direction(far, to, kind, build, compare):
    """Float32 loses their weights in one another's products: then Cycles shows none of them."""
    build.scene(48, 27, "OBJECT")
    build.camera((0, 0, 8), type=kind, ortho_scale=9.0)
    corners = [(-3, -3, 0), (3, -3, 0), tuple(far * x for x in to)]
    build.mesh("Strip", corners, [(0, 1, 2)]).color = (1, 0, 0, 1)
    build.square("Behind", 60.0, location=(0, 0, -50), color=(0, 1, 0, 1))
    found = compare(judge="CYCLES")
    assert found.counts.unexplained == 0
    if far <= 1e4:  # but for some beside its edges
        assert found.counts.not_decidable < 10


def fog(scene) -> None:
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    absorption = tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorption.inputs["Density"].default_value = 0.1
    output = next(n for n in tree.nodes if n.type == "OUTPUT_WORLD")
    tree.links.new(absorption.outputs[0], output.inputs["Volume"])


def lamp(scene) -> None:
    light = bpy.data.lights.new("Lamp", "POINT")
    light.shadow_soft_size = 1.0
    lamp = bpy.data.objects.new("Lamp", light)
    lamp.location = 1.5, -1.5, 1.5
    lamp.visible_camera = True
    scene.collection.objects.link(lamp)


def own_exposure(scene) -> None:
    scene.cycles.film_exposure = 2.0


def clamped(scene) -> None:
    scene.cycles.sample_clamp_direct = 0.1


def own_samples(scene) -> None:
    scene.view_layers[0].samples = 8


def no_surfaces(scene) -> None:
    scene.view_layers[0].use_solid = False


@pytest.mark.parametrize(
    "change",
    [fog, lamp, own_exposure, clamped, own_samples, no_surfaces],
    ids=lambda change: change.__name__,
)
def test_settings_of_a_render_do_not_change_constant_colors(change, build, compare):
    scene = build.room(48, 27, lens=40)
    change(scene)
    world = scene.world
    found = compare(judge="CYCLES", identity=False)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert scene.world == world
    assert all(o.visible_camera for o in scene.objects if o.name == "Lamp")
