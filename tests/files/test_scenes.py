"""Scenes and meshes in files: what is written is read, and nothing else is."""

from __future__ import annotations

import json
import os
import tracemalloc
import warnings

import numpy as np
import pytest
from reference_tracer.files import npz
from reference_tracer.files.scenes import load_account, load_scene, save_scene
from reference_tracer.manifest import Effect, Manifest, ObjectEntry, Unmodelled
from reference_tracer.scene import Instance, Mesh, Plane, Region, Scene, SceneError
from reference_tracer_meshes.load import load_meshes


@pytest.fixture
def scene(make, rng):
    camera = make.camera(
        20,
        10,
        eye=rng.normal(size=3),
        target=(0.1, 0.2, 0.3),
        clip_start=1 / 3,
        clip_end=1e300,
        region=Region(3, 2, 11, 7),
        name="Käm 'ra'",
        orthographic=True,
    )
    meshes = (
        Mesh(
            rng.normal(size=(9, 3)).astype(np.float32),
            rng.integers(0, 9, (5, 3)),
            rng.integers(0, 3, 5),
            rng.random((5, 3, 4)),
            "with colours",
        ),
        Mesh(rng.normal(size=(4, 3)), [[0, 1, 2]], name="plain"),
        Mesh(np.zeros((0, 3)), np.zeros((0, 3), int), name="empty"),
    )
    instances = [
        Instance(k % 3, k % 2, rng.normal(size=(4, 4)), rng.random((2, 4))) for k in range(4)
    ]
    planes = [Plane(1, rng.normal(size=3), rng.normal(size=3), rng.random(4))]
    return Scene(camera, meshes, instances, planes, rng.random(4), ("A", "B/../B"))


def test_round_trip_is_bit_identical(scene, tmp_path):
    save_scene(tmp_path / "scene.npz", scene)
    again = load_scene(tmp_path / "scene.npz")
    for name in (
        "window",
        "width",
        "height",
        "projection",
        "clip_start",
        "clip_end",
        "region",
        "name",
    ):
        assert getattr(again.camera, name) == getattr(scene.camera, name)
    assert again.objects == scene.objects
    pairs = [
        (scene.camera, again.camera),
        (scene, again),
        *zip(scene.meshes, again.meshes, strict=True),
        *zip(scene.instances, again.instances, strict=True),
        *zip(scene.planes, again.planes, strict=True),
    ]
    compared = 0
    for first, second in pairs:
        for name, value in vars(first).items():
            other = getattr(second, name)
            if isinstance(value, np.ndarray):
                assert (value.dtype, value.shape, value.tobytes()) == (
                    other.dtype,
                    other.shape,
                    other.tobytes(),
                )
                compared += 1
            elif isinstance(value, (int, str)) or value is None:
                assert value == other
    assert compared == 1 + 1 + 3 * 3 + 1 + 4 * 2 + 3


def test_the_name_given_is_the_file_written(scene, tmp_path):
    save_scene(tmp_path / "SCENE.NPZ", scene)
    assert [p.name for p in tmp_path.iterdir()] == ["SCENE.NPZ"]


class Trap:
    def __reduce__(self):
        return print, ("a pickle ran",)


def test_pickle_is_refused(tmp_path, capsys):
    np.savez(tmp_path / "scene.npz", scene=np.array([Trap()], dtype=object))
    with pytest.raises(SceneError, match=r"scene\.npz"):
        load_scene(tmp_path / "scene.npz")
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    "head",
    [
        "[]",
        "3",
        "null",
        "{}",
        "not JSON",
        '{"schema": "reference_tracer.scene/3"}',
        '{"schema": "reference_tracer.scene/2"}',
        '{"schema": "reference_tracer.scene/3", "camera": []}',
    ],
)
def test_wrong_head_is_named(head, tmp_path):
    np.savez(tmp_path / "bad.npz", scene=np.array(head))
    with pytest.raises(SceneError, match=r"bad\.npz"):
        load_scene(tmp_path / "bad.npz")


def test_what_the_source_lacked_is_kept(scene, tmp_path):
    box = np.array([(-1.0, -2.0, -3.0), (1.0, 2.0, 3.0)])
    lacks = Unmodelled("Text", "font", "old", box, Effect.DRAWN, ("Nodes",))
    entry = ObjectEntry("Box", "MESH", exported=True, left_out=2)
    manifest = Manifest("x", "x", "", 0, "FILE", "", (entry,), (lacks,), ("of it",))
    save_scene(tmp_path / "scene.npz", scene, manifest)
    kept = load_account(tmp_path / "scene.npz")
    assert kept.notes == ("of it",) and kept.lacks[0].to_dict() == lacks.to_dict()
    assert kept.lacks[1].line() == "triangles that are not finite: Box (2)"
    save_scene(tmp_path / "scene.npz", scene)
    assert load_account(tmp_path / "scene.npz") == ((), ())


@pytest.fixture
def rewritten(scene, tmp_path):
    """Write the scene with arrays, or values of its head, replaced; returns the path."""

    def write(arrays=(), unmodelled=(), **head):
        save_scene(tmp_path / "scene.npz", scene)
        stored = dict(np.load(tmp_path / "scene.npz"))
        own = json.loads(str(stored["scene"])) | {"unmodelled": [*unmodelled]}
        own["camera"] |= head
        stored |= {"scene": np.array(json.dumps(own))} | dict(arrays)
        np.savez_compressed(tmp_path / "bad.npz", **stored)
        return tmp_path / "bad.npz"

    return write


@pytest.mark.parametrize(
    ("array", "says"),
    [
        (("triangles", np.zeros((6, 3))), "triangles must be integers, not float64"),
        (("triangles", np.full((6, 3), 99)), "triangles must be at least 0 and below 9"),
        (("triangles", np.full((6, 3), -1)), "triangles must be at least 0 and below 9"),
        (("slots", np.zeros(6)), "slots must be integers, not float64"),
        (("slots", np.full(6, 2**32)), "slots must be"),
        (
            ("vertices", np.zeros((13, 3), "U3")),
            r"vertices holds .* not \(n, 3\) numbers",
        ),
        (
            ("vertices", np.zeros((13, 3), complex)),
            r"vertices holds .* not \(n, 3\) numbers",
        ),
        (("vertices", np.zeros((13, 2))), r"vertices holds \(13, 2\)"),
        (("vertices", np.full((13, 3), np.nan)), "not finite"),
        (
            ("vertices", np.zeros(39)),
            r"vertices holds .* not \(n, 3\) numbers",
        ),
        (("world_from_object", np.zeros((4, 4, 3))), r"holds \(4, 4, 3\)"),
        (("vertices", np.zeros((14, 3))), "vertices has 14 rows, and 13 are used"),
        (("instances", [(0, 0, -2), *[(0, 0, 2)] * 5]), "colors has 8 rows, and 8 are used"),
        (("instances", np.zeros((4, 3))), r"instances holds \(4, 3\) of float64"),
    ],
)
def test_a_wrong_array_is_named(array, says, rewritten):
    with pytest.raises(SceneError, match=says) as error:
        load_scene(rewritten([array]))
    assert "bad.npz" in str(error.value)


@pytest.mark.parametrize(
    ("head", "says"),
    [
        ({"width": -5}, "camera.width is -5"),
        ({"width": 10**30}, "camera.width is 1000000"),
        ({"width": 20.0}, "camera.width must be an integer"),
        ({"region": {"x0": 0.5, "y0": 0, "x1": 2, "y1": 2}}, "camera.region.x0 must be an int"),
        ({"clip_start": "0.1"}, "camera.clip_start must be a finite number"),
        ({"projection": True}, "camera.projection must be one of: perspective, "),
        ({"projection": "fisheye"}, "camera.projection must be one of: perspective, "),
        ({"clip_end": float("nan")}, "camera.clip_end must be a finite number"),
    ],
)
def test_a_wrong_camera_is_named(head, says, rewritten):
    with pytest.raises(SceneError, match=says) as error:
        load_scene(rewritten(**head))
    assert "bad.npz" in str(error.value)


@pytest.mark.parametrize(
    ("key", "value", "says"),
    [
        ("effect", "all is well", "unmodelled.effect is 'all is well'; it must be one of none, "),
        ("bounds", [1, 2], "unmodelled.bounds"),
        ("by", "me", "unmodelled.by must be a list"),
        ("object", None, "unmodelled.object must be text"),
    ],
)
def test_what_the_source_lacked_is_checked(rewritten, key, value, says):
    lacks = [Unmodelled("A", "b").to_dict() | {key: value}]
    with pytest.raises(SceneError, match=rf"bad\.npz.*{says}"):
        load_account(rewritten(unmodelled=lacks))


def test_what_nobody_asks_for_is_not_read(rewritten):
    """A small file with an array of 64 MiB in it, which is none of ours."""
    path = rewritten([("more", np.zeros(2**23))])
    assert path.stat().st_size < 2**17
    tracemalloc.start()
    load_scene(path)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 2**22


def test_no_warning_of_numpy_reaches_users(rewritten):
    colors = np.full((8, 4), 1e300)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_scene(rewritten([("colors", colors)]))


@pytest.mark.parametrize("name", ["a.npz", "a.obj"])
def test_what_is_no_file_is_said(name, tmp_path):
    load = load_scene if name == "a.npz" else load_meshes
    (tmp_path / name).mkdir()
    with pytest.raises(SceneError, match=r"^'[^']*a\.\w+' is no file but a folder"):
        load(tmp_path / name)
    (tmp_path / name).rmdir()
    os.mkfifo(tmp_path / name)
    with pytest.raises(SceneError, match=r"^'[^']*a\.\w+' is no file but a folder, or a pipe"):
        load(tmp_path / name)
    with pytest.raises(SceneError, match="cannot be read: File name too long"):
        load(tmp_path / ("x" * 300))


def test_what_is_larger_than_the_free_memory_is_refused(make, tmp_path, monkeypatch):
    """A small file may say that it holds much: systems kill a process that takes too much."""
    vertices = np.zeros((200_000, 3))
    save_scene(tmp_path / "a.npz", make.scene(make.camera(), Mesh(vertices, [[0, 1, 2]])))
    assert len(load_scene(tmp_path / "a.npz").meshes[0].vertices) == 200_000
    monkeypatch.setattr(npz, "free_memory", lambda: 1 << 21)
    with pytest.raises(SceneError, match="more than is free"):
        load_scene(tmp_path / "a.npz")
