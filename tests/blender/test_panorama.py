"""Blender's equirectangular camera: exported with all its settings, and judged by Cycles."""

from __future__ import annotations

import math

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.blender.drawing.judges import JUDGES, judge_named
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.versions import lens
from reference_tracer.projections import EQUIRECTANGULAR

RADIUS = JUDGES["cycles"].sample_radius
TURNED = {"rotation": (1.1, 0.3, 2.2), "location": (0.5, 0.5, -0.3)}
LEVEL = {"rotation": (math.pi / 2, 0, 0)}


def panorama(build, rotation=(0, 0, 0), location=(0, 0, 0), scale=(1, 1, 1), window=(), **data):
    """A panoramic camera; its `window` is west, east, south, north."""
    obj = build.camera(location, rotation, type="PANO", **data)
    obj.scale = scale
    own = lens(obj.data)
    own.panorama_type = "EQUIRECTANGULAR"
    names = "longitude_min", "longitude_max", "latitude_min", "latitude_max"
    for name, value in zip(names, window, strict=False):
        setattr(own, name, value)
    return obj


def surroundings(build) -> None:
    """Things all around the origin, some at the poles and behind."""
    rng = np.random.default_rng(3)
    for k in range(12):
        away = rng.normal(size=3)
        away *= rng.uniform(3, 8) / np.linalg.norm(away)
        color = build.material(str(k), *rng.uniform(0.1, 1, 3))
        build.cube(f"Cube {k}", 1.6, location=away, rotation=rng.uniform(0, 6, 3), material=color)
    build.square("Floor", 40, location=(0, 0, -6), material=build.material("F", 0.3, 0.3, 0.4))
    build.square("Roof", 20, location=(0, 0, 9), material=build.material("R", 0.8, 0.7, 0.4))


SETTINGS = {
    "whole": LEVEL,
    "turned": TURNED,
    "part": LEVEL | {"window": (-1, 2, -0.3, 1.2)},
    "shifted": LEVEL | {"shift_x": 0.1, "shift_y": -0.05},
    "around again": TURNED | {"window": (-4, 5, -1.2, 1.5)},
    "mirrored": TURNED | {"scale": (2, -3, 0.5)},
    "clipped": LEVEL | {"clip_start": 4, "clip_end": 9},
    "lens and sensor": TURNED | {"lens": 20, "sensor_width": 11, "sensor_fit": "VERTICAL"},
}


@pytest.mark.parametrize("name", SETTINGS)
def test_cycles_sees_the_same(name, build, compare):
    build.scene(128, 64 if name != "lens and sensor" else 90)
    bpy.context.scene.render.pixel_aspect_x = 1 + (name == "part")
    surroundings(build)
    panorama(build, **SETTINGS[name])
    comparison = compare(identity=True)
    assert comparison.case.picture.source.name == "cycles" and comparison.case.certificate is None
    pixels = comparison.counts
    assert pixels.unexplained == pixels.not_decidable == 0
    assert pixels.differ <= 0.002 * pixels.total
    assert set(comparison.causes.cause[comparison.causes.cause > 0].tolist()) <= {1}  # edges
    assert comparison.verdict == "agree"
    seen = comparison.frame.instance_index >= 0
    assert len(np.unique(comparison.frame.instance_index)) > 3 and seen.any()


@pytest.mark.parametrize("name", SETTINGS)
def test_a_camera_of_its_window_is_made(name, build):
    build.scene(128, 64)
    panorama(build, **SETTINGS[name])
    camera = export_camera(bpy.context.scene)
    assert camera.projection == EQUIRECTANGULAR
    add_camera(bpy.context.scene, camera)
    again = export_camera(bpy.context.scene)
    assert again.projection == EQUIRECTANGULAR
    for found, expected in zip(
        vars(again.window).values(), vars(camera.window).values(), strict=True
    ):
        # float32, and Blender's latitudes end at the poles
        assert found == pytest.approx(expected, rel=2.0**-23) or abs(expected) > math.pi / 2


def test_an_infinite_plane_has_a_stand_in_all_around(build, compare):
    build.scene(128, 64)
    build.cube("Cube", 2, location=(3, 0, 0), material=build.material("C", 0.9, 0.2, 0.1))
    floor = build.square("Floor", 2, location=(0, 0, -2), rotation=(0.1, 0, 0))
    floor.reference_tracer.infinite_plane = True
    panorama(build, **LEVEL, clip_end=50)
    comparison = compare()
    assert comparison.verdict == "agree" and comparison.counts.unexplained == 0
    assert 0.3 < (comparison.frame.instance_index == 1).mean() < 0.5  # up to the clip range's end


@pytest.mark.parametrize("judge", ["WORKBENCH", "VIEWPORT"])
def test_what_draws_no_panoramas_is_refused(judge, build, compare):
    build.scene()
    build.solids()
    panorama(build, **LEVEL)
    with pytest.raises(ValueError, match=r"draws no panoramas: compare with Cycles"):
        compare(judge=judge)
    assert judge_named("AUTO", background=True, is_panorama=True) is JUDGES["cycles"]


def test_other_panoramas_are_refused_by_name(build):
    build.scene()
    own = lens(panorama(build).data)
    kinds = type(own).bl_rna.properties["panorama_type"].enum_items.keys()
    assert len(kinds) > 3
    for kind in set(kinds) - {"EQUIRECTANGULAR"}:
        own.panorama_type = kind
        with pytest.raises(ValueError, match=rf"of type {kind.lower()}; .* and equirectangular"):
            export_camera(bpy.context.scene)
