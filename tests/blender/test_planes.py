"""Infinite planes: what is exported, and the polygons that stand in for them with Blender."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.reading.view_volume import polygon
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import Camera, Plane, ViewWindow
from reference_tracer.tracer.camera import film_of

MODES = ("VIEWPORT", "RENDER")


@pytest.fixture
def ground(build):
    """A scene with a marked object, turned and scaled, and a solid that it cuts."""
    build.scene()
    build.camera((3, -5, 2.5), (np.radians(70), 0, np.radians(30)))
    ground = build.square(
        "Ground",
        1,
        location=(0.2, 0.1, -0.4),
        rotation=(0.2, 0.1, 0.3),
        scale=(2, 0.5, 3),
        material=build.material("Earth", 0.5, 0.3, 0.1),
    )
    ground.reference_tracer.infinite_plane = True
    build.cube("Cube", 1, material=build.material("Red", 0.9, 0.1, 0.1))
    return ground


@pytest.mark.parametrize("kind", ["EMPTY", "LIGHT", "CAMERA"])
@pytest.mark.parametrize("mode", MODES)
def test_an_object_without_a_surface_can_be_a_plane(kind, mode, build, export):
    camera = build.camera()
    marked = {
        "EMPTY": lambda: build.empty("Marked"),
        "LIGHT": lambda: build.link(
            bpy.data.objects.new("Marked", bpy.data.lights.new("L", "SUN"))
        ),
        "CAMERA": lambda: camera,
    }[kind]()
    marked.reference_tracer.infinite_plane = True
    scene, _ = export.modes[mode]()
    assert [scene.objects[p.object] for p in scene.planes] == [marked.name]


@pytest.mark.parametrize("color_type", ["MATERIAL", "OBJECT", "SINGLE", "VERTEX", "RANDOM"])
@pytest.mark.parametrize("bare", [False, True], ids=["material", "bare"])
@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_agrees_with_its_stand_in(judge, bare, color_type, ground, compare):
    bpy.context.scene.display.shading.color_type = color_type
    ground.color = (0.2, 0.4, 0.9, 1)
    if bare:
        ground.data.materials.clear()
    before = set(bpy.data.objects)
    comparison = compare(judge=judge)
    assert set(bpy.data.objects) == before
    assert comparison.verdict == "agree"
    assert comparison.counts.differ <= 0.01 * comparison.counts.total
    index = comparison.frame.object_index
    assert {comparison.scene.objects[i] for i in np.unique(index) if i >= 0} == {"Ground", "Cube"}


def collected(build, ground):
    """Nested collections, one of them hidden from the picture by a flag of its own."""
    bpy.context.scene.collection.objects.unlink(ground)
    outer = build.collection(
        "Outer", build.cube("In Outer", 0.5, link=False, location=(1, 1, 1)), link=True
    )
    inner = build.collection(
        "Inner", ground, build.cube("In Inner", 0.5, link=False, location=(-1, 1, 1))
    )
    outer.children.link(inner)
    hidden = build.collection("Hidden", build.cube("In Hidden", 2, link=False))
    hidden.hide_render = True
    inner.children.link(hidden)
    excluded = build.collection("Excluded", build.cube("In Excluded", 2, link=False))
    inner.children.link(excluded)
    layer = bpy.context.view_layer.layer_collection.children["Outer"].children["Inner"]
    layer.children["Excluded"].exclude = True


def two_collections(build, ground):
    build.collection("A", ground, link=True)
    build.collection("B", ground, link=True)


def edge_on(build, ground):
    """The eye lies in the plane."""
    ground.matrix_basis.identity()
    ground.location = bpy.context.scene.camera.location


def out_of_view(build, ground):
    ground.rotation_euler = (0, 0, 0)
    ground.location.z = 4000


def parented(build, ground):
    ground.parent = build.empty("Parent", rotation=(0.1, 0.2, 0), scale=(1, 2, 1))


def with_children(build, ground):
    build.cube("Child", 0.6, location=(0.5, 0.5, 1)).parent = ground


def instanced(build, ground):
    """In a collection that only an empty shows."""
    collection = build.collection("Kit", ground)
    bpy.context.scene.collection.objects.unlink(ground)
    build.instances("Empty", collection, location=(0, 0, -0.3))


def hidden_in_renders(build, ground):
    ground.hide_render = True


@pytest.mark.parametrize(
    "arrange",
    [
        collected,
        two_collections,
        edge_on,
        out_of_view,
        parented,
        with_children,
        instanced,
        hidden_in_renders,
    ],
    ids=lambda arrange: arrange.__name__,
)
def test_agrees_however_the_scene_is_arranged(arrange, ground, build, compare):
    arrange(build, ground)
    collections = {c.name: sorted(o.name for o in c.objects) for c in bpy.data.collections}
    names = sorted(o.name for o in bpy.data.objects)
    comparison = compare()
    assert comparison.counts.unexplained == comparison.counts.not_decidable == 0
    assert comparison.verdict == "agree"
    assert comparison.frame.color.any()
    assert any(e.name == "Ground" for e in comparison.manifest.objects)  # not lost in silence
    assert collections == {c.name: sorted(o.name for o in c.objects) for c in bpy.data.collections}
    assert names == sorted(o.name for o in bpy.data.objects)


def test_the_polygon_covers_the_view_volumes_cut():
    rng = np.random.default_rng(8)
    for trial in range(90):
        start = (0.5, 0.5, -20)[trial % 3]  # an orthographic view looks both ways
        axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = axes, rng.normal(size=3)
        camera = Camera(
            matrix,
            ViewWindow(-0.5, 0.7, -0.4, 0.3),
            64,
            48,
            projection=ORTHOGRAPHIC if trial % 2 or start < 0 else PERSPECTIVE,
            clip_start=start,
            clip_end=20,
        )
        depth = rng.uniform(start + 0.5, 15)
        inside = matrix[:3, 3] + camera.forward * depth + 0.05 * rng.normal(size=3)
        plane = Plane(0, inside, rng.normal(size=3))
        corners = polygon(camera, plane)
        assert 3 <= len(corners) <= 6
        away = (corners - plane.point) @ plane.normal
        assert np.abs(away).max() < 1e-11 * np.linalg.norm(plane.normal) * 20
        # No part of its rim lies inside the picture and the clip range.
        rim = [corners + k / 8 * (np.roll(corners, 1, axis=0) - corners) for k in range(8)]
        x, y, depth = film_of(camera, np.concatenate(rim).T)
        seen = (x > 0) & (x < 64) & (y > 0) & (y < 48) & (depth > start) & (depth < 20)
        assert not seen.any()
