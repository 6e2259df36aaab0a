"""Normals, positions and ids: which are right, what is told of their space, and what is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.rendering import render
from reference_tracer.scene import Plane

from .conftest import SOME

OPENCV = np.diag((1.0, -1.0, -1.0))
Y_UP = np.array(((1, 0, 0), (0, 0, 1), (0, -1, 0)))


@pytest.fixture(scope="session")
def placed(solids):
    """The scene with its box placed by its object's matrix, and its ball inside out."""
    box, ball = solids.instances[1], solids.meshes[0]
    inside_out = replace(ball, triangles=ball.triangles[:, ::-1])
    at = np.array(((1, 0.3, 0, 0.1), (-0.2, 0.6, 0, 0), (0, 0, 1.4, 0), (0, 0, 0, 1)))
    return replace(
        solids,
        meshes=(inside_out, *solids.meshes[1:]),
        instances=(solids.instances[0], replace(box, world_from_object=at), solids.instances[2]),
    )


@pytest.fixture(scope="session")
def seen(placed):
    """What is right, by kind and space."""
    frame = render(placed)
    axes = placed.camera.world_from_camera[:3, :3]
    away = frame.position - placed.camera.origin
    hit = (frame.object_index >= 0)[..., None]
    return {
        "normals": {"world": frame.normal, "camera": frame.normal @ axes},
        "positions": {"world": frame.position, "camera": np.where(hit, away @ axes, 0)},
        "frame": frame,
    }


@pytest.mark.parametrize("space", ["world", "camera"])
def test_the_space_and_the_range_are_told_from_the_data(judged, placed, seen, space):
    for kind, encode in (("normals", False), ("normals", True), ("positions", False)):
        values = seen[kind][space]
        values = (values / 2 + 0.5 if encode else values).astype(np.float32)
        found = judged(kind, values, placed)
        assert found.verdict == Verdict.AGREE
        way = f", from {0 if encode else -1} to 1" if kind == "normals" else ""
        said = f"its {kind} are taken to be in {space} space{way}, as most agree"
        assert any(said in note for note in found.manifest.notes)


def test_normals_as_colours_of_8_bits(judged, placed, seen):
    bytes_ = np.rint(255 * (seen["normals"]["world"] / 2 + 0.5)).astype(np.uint8)
    assert judged("normals", bytes_, placed).verdict == Verdict.AGREE
    bytes_[..., 0] += 1
    assert judged("normals", bytes_, placed).counts.unexplained > 50


def _facing(n, frame):
    away = frame.position - frame.scene.camera.origin
    return np.where(((n * away).sum(axis=-1) > 0)[..., None], -n, n)


def _untransformed(n, frame):
    out = n.copy()
    own = frame.object_index == 1
    m = frame.scene.instances[1].world_from_object[:3, :3]
    out[own] = n[own] @ m
    return out / np.maximum(np.linalg.norm(out, axis=-1, keepdims=True), 1e-9)


def _as_points(n, frame):
    own = frame.object_index == 1
    out = _untransformed(n, frame)
    out[own] = out[own] @ frame.scene.instances[1].world_from_object[:3, :3].T
    return out / np.maximum(np.linalg.norm(out, axis=-1, keepdims=True), 1e-9)


# By fault: the kind, what is known of its convention, and what makes a file of right values.
NORMALS = {
    "data_space": ({"space": "camera"}, lambda n, frame: n),
    "data_axes": ({}, lambda n, frame: n @ Y_UP.T),
    "flipped_winding": ({}, lambda n, frame: -n),
    "normal_range": ({"range": "signed"}, lambda n, frame: n / 2 + 0.5),
    "normal_facing": ({}, lambda n, frame: -_facing(n, frame)),
    "normal_transform": ({}, _untransformed),
}
POSITIONS = {
    "data_space": ({"space": "camera"}, lambda p, frame: p),
    "data_axes": ({}, lambda p, frame: p @ Y_UP.T),
    "data_sign": ({}, lambda p, frame: -p),
    "data_unit": ({}, lambda p, frame: 100 * p),
    "data_scale": ({}, lambda p, frame: 0.37 * p),
}
EVERY = [("normals", name, *how) for name, how in NORMALS.items()]
EVERY += [("positions", name, *how) for name, how in POSITIONS.items()]


@pytest.mark.parametrize("kind, fault, known, of", EVERY, ids=lambda v: v if type(v) is str else "")
def test_a_fault_has_its_name_alone(told, placed, seen, kind, fault, known, of):
    made = of(seen[kind]["world"], seen["frame"]).astype(np.float32)
    assert told(kind, made, placed, faults=SOME, **known) == [fault]


def test_opencvs_axes_are_named_in_camera_space(told, placed, seen):
    made = seen["normals"]["camera"] @ OPENCV
    assert told("normals", made, placed, space="camera", faults=SOME) == ["data_axes"]
    made = _as_points(seen["normals"]["world"], seen["frame"])
    assert told("normals", made, placed, faults=SOME) == ["normal_transform"]


def test_vectors_that_are_rounded_or_cut_off(told, placed, seen):
    for kind in ("normals", "positions"):
        half = seen[kind]["world"].astype(np.float16).astype(np.float32)
        assert told(kind, half, placed, faults=SOME) == ["data_rounded"]
    cut = (255 * (seen["normals"]["world"] / 2 + 0.5)).astype(np.uint8)
    assert told("normals", cut, placed, faults=SOME) == ["data_cut_off"]
    cut = np.floor(1000 * seen["positions"]["world"]).astype(np.int32)
    assert told("positions", cut, placed, scale=0.001, faults=SOME) == ["data_cut_off"]


def test_no_name_for_what_is_none_of_these(told, placed, seen, rng):
    noise = rng.normal(0, 0.05, seen["normals"]["world"].shape)
    for kind in ("normals", "positions"):
        assert told(kind, seen[kind]["world"] + noise, placed, faults=SOME) == []


def test_a_plane_has_no_matrix_that_its_normals_lack(told, placed):
    """Where there are no instances either."""
    floor = Plane(0, (0, 0, -1), (0.1, 0, 1))
    scene = replace(placed, meshes=(), instances=(), planes=(floor,))
    assert told("normals", -render(scene).normal, scene, faults=SOME)[0] == "normal_facing"


def test_ids_may_be_any_numbers_or_colours(judged, placed, seen, rng):
    index = seen["frame"].object_index
    numbers = np.array([7, 300, 12, 0])[index]  # the last is of nothing
    assert judged("ids", numbers, placed).verdict == Verdict.AGREE
    colors = rng.integers(0, 255, (4, 3), np.uint8)[index]
    assert judged("ids", colors, placed).verdict == Verdict.AGREE
    colors[12, 16] = 99
    assert judged("ids", colors, placed).counts.unexplained == 1


def test_ids_may_be_of_64_bits_or_nan_where_nothing_is(judged, placed, seen):
    own = seen["frame"].object_index
    assert judged("ids", np.where(own < 0, np.nan, own), scene=placed).verdict == Verdict.AGREE
    colors = np.where(own < 0, np.nan, own)[..., None] * np.ones(3)
    assert judged("ids", colors, scene=placed).verdict == Verdict.AGREE
    own = own.astype(np.int64)
    large = 2**60 + own  # all the same in float64
    assert judged("ids", large, scene=placed).verdict == Verdict.AGREE
    far = np.where(own == 0, 2**60, own)
    rows, columns = np.nonzero(own == 0)
    far[rows[:3], columns[:3]] += 1
    assert judged("ids", far, scene=placed).counts.unexplained == 3


def test_objects_that_share_an_id(told, placed, seen):
    index = seen["frame"].object_index
    assert told("ids", np.array([3, 3, 5, 0])[index], placed, faults=SOME) == ["id_shared"]
    ground = np.array([3, 4, 0, 0])[index]  # the floor has the number of nothing
    assert told("ids", ground, placed, faults=SOME) == ["id_shared"]


def test_ids_of_another_scene_are_not_said_to_be_shared(told, placed, rng):
    other = render(replace(placed, instances=placed.instances[1:]))
    ids = np.array([3, 4, 5, 0])[other.object_index]
    assert told("ids", ids, placed, faults=SOME) == ["object_missing"]
    noise = rng.integers(0, 4, other.shape)
    assert told("ids", noise, placed, faults=SOME) == []
