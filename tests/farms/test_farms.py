"""The templates for render farms, each run: Open Job Description, Slurm, Flamenco.

Blender is the whole one; a shim outside of its root folder calls it, `bin/blender`.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

PROJECT = Path(__file__).resolve().parents[2]
TEMPLATES = PROJECT / "docs" / "farms"
HERE = PROJECT / "tests" / "farms"
OUT = PROJECT / "out" / "farms"
FRAMES = ["-E", "REFERENCE_TRACER", "-F", "PNG", "--python-exit-code", "1"]
SCRIPT = ["-P", TEMPLATES / "frames.py", "--"]
WHOLE = ["0001.png", "0002.png", "0003.png"]

# Three frames, in each of which the camera stands elsewhere; in another file, the second has one
# that cannot be traced.
MAKE = """
import bpy
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = 32, 18
scene.frame_start, scene.frame_end = 1, 3
camera = scene.camera
for frame in (1, 3):
    camera.location.x += 0.2 * frame
    camera.keyframe_insert("location", frame=frame)
bpy.ops.wm.save_as_mainfile(filepath="/project/out/farms/three.blend")
fisheye = camera.copy()
fisheye.data = camera.data.copy()
fisheye.data.type = "PANO"
scene.collection.objects.link(fisheye)
for frame, seen in enumerate((camera, fisheye, camera), 1):
    scene.timeline_markers.new(str(frame), frame=frame).camera = seen
bpy.ops.wm.save_as_mainfile(filepath="/project/out/farms/faulty.blend")
"""

# The system ends Blender in the middle of a picture, which has more bytes. (5.2's Python has it go
# on, and Blender then takes half a picture for a whole one.)
KILLED = (
    "import resource as r, signal as s; s.signal(s.SIGXFSZ, s.SIG_DFL); "
    "r.setrlimit(r.RLIMIT_FSIZE, (500, 500))"
)


def run(*command, code=0, **options):
    """Run a command beside the shims, and look at its exit code; returns what it said."""
    path = f"{HERE / 'bin'}:{Path(sys.executable).parent}:{os.environ['PATH']}"
    done = subprocess.run(
        [*map(str, command)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"PATH": path},
        cwd=OUT if OUT.exists() else None,
        **options,
    )
    assert bool(done.returncode) == code, done.stdout
    return done.stdout


def names(folder):
    return sorted(path.name for path in (OUT / folder).glob("*"))


def pictures(folder):
    return [np.asarray(Image.open(OUT / folder / name)) for name in WHOLE]


@pytest.fixture(scope="module")
def farm():
    """Give Blender the extension, and the files to render; returns the three right frames."""
    check = subprocess.run(
        [PROJECT / "tools" / "whole_blender.sh", "check"], capture_output=True, text=True
    )
    if check.returncode:
        pytest.skip(check.stdout.strip())
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    install = "--command", "extension", "install-file", "-r", "user_default", "--enable"
    run("blender", *install, package)
    scene = PROJECT / "sample_scenes" / "exercise_triangle.blend"
    run("blender", "-b", scene, "--python-exit-code", "1", "--python-expr", MAKE)
    run("blender", "-b", OUT / "three.blend", *FRAMES, "-o", OUT / "plain" / "####", "-a")
    assert names("plain") == WHOLE
    right = pictures("plain")
    assert all((a != b).any() for a, b in pairwise(right))
    return right


@pytest.mark.parametrize("name", ["openjd.yaml", "slurm.sh", "flamenco.js", "frames.py"])
def test_short(name):
    assert len((TEMPLATES / name).read_text(encoding="utf-8").splitlines()) <= 30


@pytest.mark.gui
def test_a_frame_is_whole_or_absent_and_is_not_done_again(farm):
    """Blender by itself leaves half of one; a frame that fails does not keep others from it."""
    file, out = OUT / "three.blend", OUT / "whole" / "####"
    begin = ["blender", "-b", file, *FRAMES, "--python-expr", KILLED]
    run(*begin, "-o", OUT / "half" / "####", "-s", 1, "-e", 1, "-a", code=1)
    assert (OUT / "half" / WHOLE[0]).stat().st_size == 500
    run(*begin, "-o", out, *SCRIPT, "1-3", code=1)
    [left] = names("whole")
    assert left.startswith(".unfinished-")
    said = run("blender", "-b", OUT / "faulty.blend", *FRAMES, "-o", out, *SCRIPT, "1-3", code=1)
    assert "frame 2: " in said and "fisheye" in said
    assert names("whole") == [left, WHOLE[0], WHOLE[2]]
    before = (OUT / "whole" / WHOLE[0]).stat().st_mtime_ns
    again = run("blender", "-b", file, *FRAMES, "-o", out, *SCRIPT, "1,2-3")
    assert re.findall(r"(\w+.png) is there already", again) == [WHOLE[0], WHOLE[2]]
    assert names("whole") == [left, *WHOLE]
    assert (OUT / "whole" / WHOLE[0]).stat().st_mtime_ns == before
    np.testing.assert_array_equal(pictures("whole"), farm)
    assert "'3-1' names no frames" in run("blender", "-b", *FRAMES, *SCRIPT, "3-1", code=1)


@pytest.mark.gui
def test_open_job_description(farm):
    template = TEMPLATES / "openjd.yaml"
    options = ["--job-param", "Folder=openjd", "--job-param", "Frames=1-3"]
    faulty = ["openjd", "run", template, "--job-param", "File=faulty.blend", *options]
    assert "frame 2: " in run(*faulty, "--step", "Render", code=1)
    assert names("openjd") == [WHOLE[0], WHOLE[2]]
    run("openjd", "run", template, "--job-param", "File=three.blend", *options)
    np.testing.assert_array_equal(pictures("openjd"), farm)
    check_compared("openjd")


@pytest.mark.gui
def test_slurm(farm):
    """Arrays of two tasks: one of frames fails; others are whole, and of rows, a picture."""
    reftrace = (
        sys.executable,
        "-m",
        "reference_tracer.cli.main",
    )  # others have Blender here
    run(*reftrace, "export", OUT / "three.blend", "--out", OUT / "three.npz")
    run(*reftrace, "trace", OUT / "three.npz", "--out", OUT / "three.png")
    there = "/project/out/farms"
    arrays = (
        f"--array=0-1 slurm.sh render {there}/faulty.blend {there}/slurm 1 3 2",
        f"--array=0-1 slurm.sh compare {there}/three.blend {there}/slurm 1 3 2",
        f"--array=0-1 slurm.sh trace {there}/three.npz {there}/slurm 0 17 10",
    )
    script = "/project/tests/farms/slurm.sh"
    whole = PROJECT / "tools" / "whole_blender.sh"
    said = run(whole, "run", "bash", script, input="\n".join(arrays) + "\n", timeout=300)
    ended = re.findall(r"ArrayJobId=(\d) ArrayTaskId=(\d+).* ExitCode=(\d+):0", said)
    assert sorted(ended) == [
        ("1", "0", "1"),
        ("1", "1", "0"),
        ("2", "0", "0"),
        ("2", "1", "0"),
        ("3", "0", "0"),
        ("3", "1", "0"),
    ], said
    assert "frame 2: " in said
    rows = ["rows_00000.png", "rows_00010.png"]
    assert names("slurm") == [WHOLE[0], WHOLE[2], "compared", *rows]
    strips = [np.asarray(Image.open(OUT / "slurm" / name)) for name in reversed(rows)]
    np.testing.assert_array_equal(np.concatenate(strips), Image.open(OUT / "three.png"))
    check_compared("slurm")


def compiled(**settings):
    """Return what Flamenco would store of the job type, and of a job's tasks."""
    import playwright  # has a node of its own

    node = Path(playwright.__file__).parent / "driver" / "node"
    return json.loads(
        run(node, HERE / "flamenco.js", TEMPLATES / "flamenco.js", json.dumps(settings))
    )


@pytest.mark.gui
def test_flamenco(farm):
    """Its tasks are what Flamenco's worker would start."""
    folder, script = str(OUT / "flamenco"), str(TEMPLATES / "frames.py")
    given = {"blendfile": str(OUT / "three.blend"), "folder": folder, "script": script}
    job = compiled(**given, frames="1-3", chunk_size=3)
    assert {s["key"] for s in job["type"]["settings"]} == {*given, "frames", "chunk_size"}
    for task in job["tasks"]:
        assert task["type"] == "blender"
        for command in task["commands"]:
            p = command["parameters"]
            assert (command["name"], p["exe"], p["exeArgs"], p["argsBefore"]) == (
                "blender-render",
                "{blender}",
                "{blenderArgs}",
                [],
            )
            run("blender", "-b", "-y", p["blendfile"], *p["args"])
    np.testing.assert_array_equal(pictures("flamenco"), farm)
    check_compared("flamenco")


def test_flamencos_chunks():
    given = {"blendfile": "a b.blend", "folder": "/f", "script": "/s/frames.py"}
    tasks = compiled(**given, frames="1-5,8", chunk_size=2)["tasks"]
    assert [task["name"] for task in tasks] == [
        f"{does} {frames}" for frames in ("1,2", "3,4", "5,8") for does in ("render", "compare")
    ]
    assert [c["parameters"]["args"][-3] for c in tasks[5]["commands"]] == ["5", "8"]


def check_compared(folder):
    """All three frames have been compared, and agree."""
    for number in (1, 2, 3):
        found = OUT / folder / "compared" / f"frame_{number:04}" / "comparison.json"
        assert json.loads(found.read_text(encoding="utf-8"))["verdict"] == "agree"
