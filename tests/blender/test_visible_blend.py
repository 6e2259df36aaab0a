"""`reftrace visible scene.blend`: its frames, and its cameras by name."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest

from .scenes import save


@pytest.fixture
def saved(build, tmp_path):
    """A square that a lid covers until it is moved in frame 3; another camera is beside it."""
    scene = build.scene(32, 18)
    scene.frame_start, scene.frame_end = 1, 4
    build.square("Low", size=1)
    lid = build.square("Lid", size=3, location=(0, 0, 1))
    for frame, x in ((2, 0), (3, 30)):
        lid.location.x = x
        lid.keyframe_insert("location", frame=frame)
    build.camera()
    beside = build.camera((90, 0, 5))
    beside.name = "Beside"
    scene.camera = bpy.data.objects["Camera"]
    path = tmp_path / "scene.blend"
    save(path)
    return path


def rows(out):
    found = json.loads(out.with_suffix(".json").read_text())
    return {row["object"]: row["seen_from_front"] for row in found["objects"]}, found["frames"]


def test_frames_and_cameras(saved, reftrace, tmp_path):
    out = tmp_path / "found.npz"
    for options, expected, frames in (
        ((), {"Low": 0, "Lid": 2}, [0]),
        (("--camera", "Beside"), {"Low": 0, "Lid": 0}, [0]),
        (("--frames", "1-2"), {"Low": 0, "Lid": 2}, [1, 2]),
        (("--frames", "all"), {"Low": 2, "Lid": 2}, [1, 2, 3, 4]),
    ):
        done = reftrace("visible", saved, "--out", out, *options)
        assert done.returncode == 0, done.stderr
        assert rows(out) == (expected, frames), options
    with np.load(out) as found:
        of = np.repeat(found["objects"][found["object"]], np.diff(found["start"]))
        assert dict(zip(of, found["frames"], strict=True)) == {"Low": 2, "Lid": 2}
        first = dict(zip(of, found["witness_frame"], strict=True))
        assert first == {"Low": 3, "Lid": 1}
    done = reftrace("visible", saved, "--out", out, "--camera", "Nobody")
    assert done.returncode == 4 and "'Beside', 'Camera'" in done.stderr
