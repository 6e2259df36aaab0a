"""The manifest: whatever is not as in the scene is named, to people and in JSON."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.manifest import Effect, Manifest, ObjectEntry, Unmodelled


@pytest.fixture
def manifest():
    return Manifest(
        "room.blend",
        "Scene",
        "ViewLayer",
        12,
        "VIEWPORT",
        "Cam.001",
        objects=(
            ObjectEntry(
                "Cube",
                "MESH",
                True,
                triangles=12,
                vertices=8,
                instances=100,
                traced_triangles=1200,
                empty_slots=2,
                diagnosis={"closed": True},
            ),
            ObjectEntry(
                "Torn",
                "MESH",
                True,
                triangles=30,
                vertices=20,
                instances=1,
                traced_triangles=30,
                left_out=7,
            ),
            ObjectEntry("Hair", "CURVES", False, "has no triangles"),
            ObjectEntry("Behind", "MESH", False, "outside the view", outside=3000),
        ),
        unmodelled=(
            Unmodelled("Glass", "transparency", "alpha 0.5", np.array([[0, 0, 0], [1, 2, 3.0]])),
            Unmodelled("Cam.001", "depth of field", effect=Effect.NONE),
        ),
        notes=("the sequencer is not part of it",),
    )


def test_lines_name_everything(manifest):
    first, *rest = manifest.lines()
    for word in ("2 of 4 objects", "1,230 triangles", "viewport", "'Cam.001'"):
        assert word in first
    for words in (
        ("Torn", "7 triangles left out"),
        ("Cube", "2 empty material slots"),
        ("skipped Hair (CURVES)", "has no triangles"),
        ("outside the view", "3,000 instances of 1 object, with nothing of 1 object in view"),
        ("Glass", "transparency", "alpha 0.5"),
        ("Cam.001", "depth of field"),
        ("sequencer",),
    ):
        assert sum(all(word in line for word in words) for line in rest) == 1
    assert len(rest) == 7


def test_json_holds_everything(manifest):
    again = json.loads(json.dumps(manifest.to_dict(), allow_nan=False))
    assert {
        k: again[k] for k in ("file", "scene", "view_layer", "frame", "evaluation", "camera")
    } == {
        "file": "room.blend",
        "scene": "Scene",
        "view_layer": "ViewLayer",
        "frame": 12,
        "evaluation": "VIEWPORT",
        "camera": "Cam.001",
    }
    assert [o["name"] for o in again["objects"]] == ["Cube", "Torn", "Hair", "Behind"]
    assert again["objects"][0]["diagnosis"] == {"closed": True}
    assert (
        again["objects"][2] | {"exported": False, "reason": "has no triangles"}
        == again["objects"][2]
    )
    assert again["unmodelled"][0]["bounds"] == [[0, 0, 0], [1, 2, 3]]
    assert again["unmodelled"][1] == {
        "object": "Cam.001",
        "feature": "depth of field",
        "detail": "",
        "by": [],
        "effect": "none",
        "everywhere": False,
        "bounds": None,
    }
    assert again["notes"] == ["the sequencer is not part of it"]


def test_json_is_strict_whatever_the_bounds(manifest):
    """An object with a matrix that is not finite must not cost the whole report."""
    for value in (np.nan, np.inf):
        hair = Unmodelled("Hair", "hair", bounds=np.full((2, 3), value))
        held = replace(manifest, unmodelled=(hair,)).to_dict()
        assert "Hair" in json.dumps(held, allow_nan=False)


def test_an_empty_scene_has_a_manifest():
    empty = Manifest("", "Scene", "ViewLayer", 1, "FILE", "Camera")
    assert empty.lines() == [
        "0 of 0 objects exported, 0 triangles, file evaluation, camera 'Camera'",
        "  nothing is exported, so the picture is empty",
    ]
    assert empty.to_dict()["objects"] == []


def test_what_the_picture_lacks_is_a_warning_whatever_it_is_called(manifest):
    """Objects may bear any name."""
    cube, *others = manifest.objects
    called = replace(manifest, objects=(replace(cube, name="left out, not modelled"), *others))
    warned = [line for line, warns in called.facts() if warns]
    assert [line.split()[0] for line in warned] == ["Torn:", "not"]  # depth of field is no matter
    assert [line for line, _ in called.facts()] == called.lines()
