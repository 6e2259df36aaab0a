"""`reftrace visible`: what it writes and says."""

from __future__ import annotations

import json
import signal

import numpy as np
import pytest
from reference_tracer import write_camera
from reference_tracer.cli.main import main
from reference_tracer.scene import SceneError
from reference_tracer.visible import steps
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED, Visible, command
from reference_tracer_visible.files import Total

from .test_visible import camera, cube, scene_of

OBJ = (
    "o Front\nv -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n"
    "o Back\nv -9 1 0\nv 0 1 .1\nv 0 1 -.1\nf 4 5 6\n"
)


def test_files_and_lines(tmp_path, capsys):
    mesh = tmp_path / "mesh.obj"
    mesh.write_text(OBJ)
    out = tmp_path / "found.npz"
    options = ["--set", "up=z", "eye=0,-4,0", "width=40", "height=40", "angle=40"]
    assert main(["visible", str(mesh), "--out", str(out), *options]) == 0
    lines = capsys.readouterr().out
    assert "Front: 1 of 1 faces seen" in lines and "2 faces: " in lines
    with np.load(out) as found:
        arrays = dict(found)
    assert arrays["seen"].dtype == np.uint8 and arrays["seen"].shape == (2,)
    assert arrays["objects"][arrays["object"]].tolist() == ["Front", "Back"]
    assert np.isfinite(arrays["witness"]).all(axis=1).tolist() == (arrays["seen"] == SEEN).tolist()
    content = json.loads((tmp_path / "found.json").read_text())
    assert [row["seen"] for row in content["objects"]] == arrays["seen"].tolist()


def test_a_camera_of_a_file(tmp_path):
    mesh, file, out = (tmp_path / name for name in ("mesh.obj", "camera.json", "found.npz"))
    mesh.write_text(OBJ)
    for way, expected in ((1, SEEN), (-1, HIDDEN)):  # towards the mesh, and away from it
        write_camera(file, camera(at=(0, -4, 0), axes=[[way, 0, 0], [0, 0, -way], [0, 1, 0]]))
        words = ["--camera", str(file), "--set", "up=z"]
        assert main(["visible", str(mesh), "--out", str(out), *words]) == 0
        with np.load(out) as found:
            assert found["seen"][0] == expected


def test_an_interrupt_leaves_what_was_there(tmp_path, monkeypatch):
    mesh, out = tmp_path / "mesh.obj", tmp_path / "found.npz"
    mesh.write_text(OBJ)
    words = ["visible", str(mesh), "--out", str(out), "--set", "up=z", "eye=0,-4,0"]
    assert main(words) == 0
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    events = []

    def interrupted(*given):
        for event in steps(*given):
            events.append(event)
            if len(events) == 3:
                signal.raise_signal(signal.SIGINT)
            yield event

    monkeypatch.setattr(command, "steps", interrupted)
    assert main([*words, "width=64"]) == 128 + signal.SIGINT
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before
    assert len(events) == 3


def test_a_scene_is_not_overwritten(tmp_path, capsys):
    scene = tmp_path / "scene.npz"
    scene.write_bytes(b"")
    assert main(["visible", str(scene), "--out", str(scene)]) == 4
    assert "choose another" in capsys.readouterr().err
    assert scene.read_bytes() == b""


def test_frames_are_counted():
    """Seen in any frame is seen; else undecided in any is undecided."""
    scene = scene_of(cube(), camera=camera())

    def of(states):
        seen = np.array(states + [HIDDEN] * 8, np.uint8)
        at = np.where(seen[:, None] == SEEN, 1.0, np.nan) * np.ones(2)
        area = np.where(seen == UNDECIDED, 0.5, 0.0)
        return Visible(seen, at, area, seen == SEEN, np.array([0, 12]))

    total = Total.of(scene, of([SEEN, HIDDEN, UNDECIDED, UNDECIDED]), 3)
    total = total.add(scene, of([SEEN, SEEN, HIDDEN, SEEN]), 4)
    assert total.found.seen[:4].tolist() == [SEEN, SEEN, UNDECIDED, SEEN]
    assert total.count[:4].tolist() == [2, 1, 0, 1]
    assert total.frame[:4].tolist() == [3, 4, -1, 4]
    assert total.found.area[:4].tolist() == [0, 0, 0.5, 0]
    with pytest.raises(SceneError, match="frame 5 has other objects or faces"):
        total.add(scene_of(cube(), cube(), camera=camera()), of([SEEN] * 4), 5)
