"""What the user has moved but not keyed survives a comparison whose judge is a render."""

from __future__ import annotations

import pytest


@pytest.fixture
def moved(build):
    """Animated values that were changed by hand since: of objects, bones, materials, properties."""
    build.scene()
    build.corner_camera(lens=40)
    material = build.material("Red", 0.8, 0.1, 0.1)
    cube = build.cube(material=material)
    cube["bend"] = 1.0
    for owner, path in ((cube, "location"), (material, "diffuse_color"), (cube, '["bend"]')):
        owner.keyframe_insert(path, frame=1)
    track = cube.animation_data.nla_tracks.new()
    track.strips.new("Strip", 1, cube.animation_data.action)
    cube.location = (0.5, 0.25, 0)
    material.diffuse_color = (0.1, 0.2, 0.3, 1)
    cube["bend"] = 3.0
    return cube, material


@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_unkeyed_edits_are_kept(moved, compare, judge):
    cube, material = moved
    compare(judge=judge)
    assert tuple(cube.location) == (0.5, 0.25, 0)
    assert tuple(material.diffuse_color) == pytest.approx((0.1, 0.2, 0.3, 1))
    assert cube["bend"] == 3.0
