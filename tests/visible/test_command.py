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

from .scenes import camera, cube, scene_of

FILES = "found.npz", "found.json"


@pytest.fixture
def reftrace(tmp_path, monkeypatch):
    """Run the command on a mesh of two triangles, in a folder that has a camera's file, too."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mesh.obj").write_text(
        "o Front\nv -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n"
        "o Back\nv -9 1 0\nv 0 1 .1\nv 0 1 -.1\nf 4 5 6\n"
    )

    def run(*words, scene="mesh.obj", out=FILES[0]):
        return main(["visible", scene, "--out", out, *words, "--set", "up=z"])

    return run


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_files_and_lines(reftrace, tmp_path, capsys):
    assert reftrace("--set", "eye=0,-4,0", "angle=40") == 0
    lines = capsys.readouterr().out
    assert "Front: 1 seen from the front, 0 from behind, 0 hidden, 0 undecided" in lines
    assert "all: 1 seen from the front, 1 from behind, 0 hidden, 0 undecided" in lines
    with np.load(FILES[0]) as found:
        arrays = dict(found)
    assert arrays["seen"].dtype == np.uint8 and arrays["seen"].shape == (2,)
    assert arrays["objects"][arrays["object"]].tolist() == ["Front", "Back"]
    assert np.isfinite(arrays["witness"]).all(axis=1).tolist() == (arrays["seen"] == SEEN).tolist()
    content = json.loads((tmp_path / FILES[1]).read_text())
    assert [row["seen_from_behind"] for row in content["objects"]] == arrays["behind"].tolist()
    assert content["all"]["seen_from_front"] == 1


def test_what_is_read_is_not_written_over(reftrace, tmp_path, capsys):
    (tmp_path / "scene.npz").touch()
    write_camera("camera.json", camera())
    before = contents(tmp_path)
    for words in ({"scene": "scene.npz"}, {"out": "camera.npz"}):
        assert reftrace("--camera", "camera.json", **({"out": "scene.npz"} | words)) == 4
        assert "choose another" in capsys.readouterr().err and contents(tmp_path) == before


@pytest.mark.parametrize("name", FILES)
def test_a_folder_where_a_file_is_to_be_written_is_named_first(name, reftrace, tmp_path, capsys):
    (tmp_path / name).mkdir()
    before = contents(tmp_path)
    assert reftrace() == 4
    assert f"{name}': it is a folder" in capsys.readouterr().err and contents(tmp_path) == before


def test_an_interrupt_leaves_what_was_there(reftrace, tmp_path, monkeypatch):
    assert reftrace() == 0
    before = contents(tmp_path)
    events = []

    def interrupted(*given):
        for event in steps(*given):
            events.append(event)
            if len(events) == 3:
                signal.raise_signal(signal.SIGINT)
            yield event

    monkeypatch.setattr(command, "steps", interrupted)
    assert reftrace("--limit", "1") == 128 + signal.SIGINT
    assert contents(tmp_path) == before and len(events) == 3


def test_frames_are_counted():
    """Seen in any frame is seen; else undecided in any is undecided, by the largest area."""
    points, faces = cube()

    def total(frame, states, area, *meshes):
        seen = np.array(states, np.uint8)
        at = np.full((len(seen), 2), float(frame))
        found = Visible(seen, at, np.array(area), seen == SEEN, np.array([0, len(seen)]))
        return Total(scene_of(*meshes, camera=camera()), found, frame)

    mesh = points, faces[:5]
    found = total(3, [SEEN, HIDDEN, UNDECIDED, UNDECIDED, UNDECIDED], [0, 0, 0.5, 0.5, 0.5], mesh)
    found.add(total(4, [SEEN, SEEN, HIDDEN, SEEN, UNDECIDED], [0, 0, 0, 0, 0.7], mesh))
    expected = {
        "seen": [SEEN, SEEN, UNDECIDED, SEEN, UNDECIDED],
        "frames": [2, 1, 0, 1, 0],
        "witness_frame": [3, 4, -1, 4, -1],
        "area": [0, 0, 0.5, 0, 0.7],
        "behind": [True, True, False, True, False],
    }
    assert {name: found.arrays[name].tolist() for name in expected} == expected
    assert found.arrays["witness"][[0, 1, 3], 0].tolist() == [3, 4, 4]
    for others in ([mesh, mesh], [(points, faces[4::-1])]):
        with pytest.raises(SceneError, match=r"frame 5 has other .* from 'things' on"):
            found.add(total(5, [HIDDEN] * 5, [0] * 5, *others))
