"""Whether a mesh is closed and wound alike, and which of its faces are no use."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.comparison.mesh_diagnosis import diagnose
from reference_tracer.scene import Mesh


def diagnosed(shape, **changes):
    whole = {"vertices": np.array(shape.vertices), "triangles": np.array(shape.faces)} | changes
    return diagnose(Mesh(**whole))


def test_closed():
    expected = {
        "closed": True,
        "consistent_winding": True,
        "degenerate_faces": 0,
        "duplicate_faces": 0,
    }
    assert diagnosed(trimesh.creation.box()) == expected


def test_split_corners_are_still_closed():
    shape = trimesh.creation.box()
    split = diagnosed(
        shape, vertices=shape.triangles.reshape(-1, 3), triangles=np.arange(36).reshape(-1, 3)
    )
    assert split["closed"] and split["consistent_winding"]


def test_open():
    shape = trimesh.creation.box()
    assert not diagnosed(shape, triangles=shape.faces[1:])["closed"]


def test_flipped_winding():
    faces = np.array(trimesh.creation.box().faces)
    faces[0] = faces[0][::-1]
    found = diagnosed(trimesh.creation.box(), triangles=faces)
    assert found["closed"] and not found["consistent_winding"]


def test_degenerate_and_duplicate():
    shape = trimesh.creation.box()
    faces = np.concatenate(
        (shape.faces, [[0, 1, 1]], shape.faces[:2, [1, 2, 0]], shape.faces[:1, ::-1])
    )
    found = diagnosed(shape, triangles=faces)
    assert (found["degenerate_faces"], found["duplicate_faces"]) == (1, 3)


def test_nothing():
    found = diagnose(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))
    assert not found["closed"] and not found["degenerate_faces"]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-310, 1e150, 1e307])
def test_what_is_tiny_or_huge_is_closed_too(scale):
    found = diagnosed(trimesh.creation.box(), vertices=trimesh.creation.box().vertices * scale)
    assert found["closed"] and found["consistent_winding"]
