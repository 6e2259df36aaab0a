"""`reftrace` with a .blend: in a process of its own, or in this one where that will do."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import bpy
import pytest
from reference_tracer.files.scenes import load_scene
from reference_tracer.rendering import render

from .scenes import save

SAMPLES = Path(__file__).resolve().parents[2] / "sample_scenes"


def shell(*argv: object) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", "reference_tracer.cli.main", *map(str, argv)],
        capture_output=True,
        text=True,
        timeout=300,
    )


@pytest.fixture
def small(build, tmp_path):
    """A file with a small scene, whose name no shell likes."""
    build.room(64, 36, lens=40)
    path = tmp_path / "a scene, with 'spaces' & ümläuts.blend"
    save(path)
    return path


def test_export_and_trace_give_the_same_picture(small, tmp_path, reftrace):
    """From the .blend and from the .npz, bit for bit."""
    exported, first, second = (tmp_path / n for n in ("scene.npz", "blend.exr", "npz.exr"))
    done = reftrace("export", small, "--out", exported)
    assert done.returncode == 0, done.stderr
    assert "4 of 5 objects exported" in done.stdout
    assert reftrace("trace", small, "--out", first).returncode == 0
    assert shell("trace", exported, "--out", second).returncode == 0
    assert first.read_bytes() == second.read_bytes()
    scene = load_scene(exported)
    assert (scene.camera.width, scene.camera.height) == (64, 36)
    assert set(scene.objects) == {"Floor", "Red", "Green", "Blue"}
    assert render(scene).color.any()


def test_trace_uses_what_the_scene_stores(small, tmp_path, reftrace):
    bpy.context.scene.reference_tracer.method = "moller_trumbore"
    bpy.ops.wm.save_mainfile()
    done = reftrace("trace", small, "--out", tmp_path / "deeper" / "picture.png")
    assert done.returncode == 0, done.stderr
    assert "moller_trumbore" in done.stdout
    assert (tmp_path / "deeper" / "picture.png").is_file()
    done = reftrace("trace", small, "--out", tmp_path / "picture.png", "--method", "textbook")
    assert "textbook" in done.stdout
    certificate = tmp_path / "certificate.npz"  # which proves something: it is not of this method
    done = reftrace("trace", small, "--certificate", certificate)
    assert done.returncode == 0 and "certified" in done.stdout and certificate.is_file()
    done = reftrace("trace", small, "--certificate", certificate, "--method", "textbook")
    assert "--certificate: textbook proves nothing" in done.stderr


@pytest.mark.parametrize("command", ["compare", "export", "trace"])
def test_input_errors(command, tmp_path, reftrace):
    """Each in one line that names the file, without a traceback."""
    out = tmp_path / {"compare": "out", "export": "scene.npz", "trace": "picture.png"}[command]
    broken = tmp_path / "broken.blend"
    broken.write_bytes(b"BLENDER-v402 and then nothing that belongs there")
    where = shell if command == "compare" else reftrace  # all that Blender says is heard
    for run, source in ((reftrace, tmp_path / "missing.blend"), (where, broken)):
        done = run(command, source, "--out", out)
        assert done.returncode == 4
        said = [line for line in done.stderr.splitlines() if line.startswith("reftrace: ")]
        assert len(said) == 1 and said[0] == done.stderr.splitlines()[-1]
        assert said[0].count(source.name) == 1
        assert "Traceback" not in done.stderr
        assert not out.exists() or command == "compare"


@pytest.mark.parametrize("command", ["compare", "trade"])
def test_interrupted_while_blender_is_imported(command, tmp_path):
    """What is swallowed there is heard all the same, and nothing is left."""
    code = (
        "import signal, sys, threading, time\n"
        "from reference_tracer.cli import main as cli\n"
        "from reference_tracer.tracer import signals\n"
        "def later():\n"
        "    while not signals._signals.are_held:\n"
        "        time.sleep(0.001)\n"
        "    time.sleep(0.05)\n"
        "    signal.raise_signal(signal.SIGINT)\n"
        "threading.Thread(target=later, daemon=True).start()\n"
        "sys.exit(cli.main(sys.argv[1:]))\n"
    )
    argv = [command, str(SAMPLES / "suzanne.blend"), "--out", str(tmp_path / "new" / "out")]
    done = subprocess.run(
        [sys.executable, "-c", code, *argv], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 130
    assert done.stderr.splitlines()[-1] == "reftrace: interrupted"
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "new").exists()


def test_explain_prints_markdown_and_nothing_else(tmp_path, reftrace):
    """What is exported, and what Blender says, goes elsewhere: `> pixel.md` holds the page."""
    again = tmp_path / "pixel.json"
    scene = SAMPLES / "exercise_triangle.blend"
    done = shell("explain", scene, "--pixel", "320", "180", "--reproducer", again)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("# The ray through pixel (320, 180) of exercise_triangle.blend")
    assert "objects exported" in done.stderr
    assert reftrace("explain", again).stdout == done.stdout


def test_a_file_of_a_newer_blender(tmp_path, monkeypatch, reftrace):
    """What that knows and this doesn't would be lost without a word."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"), compress=False)
    content = (tmp_path / "own.blend").read_bytes()
    major, minor, _ = bpy.app.version
    ours, theirs = b"%d%02d" % (major, minor), b"%d01" % (major + 1)
    newer = content[:20].replace(ours, theirs, 1) + content[20:]
    assert newer != content
    (tmp_path / "newer.blend").write_bytes(newer)
    monkeypatch.chdir(tmp_path)
    done = reftrace("export", "newer.blend", "--out", "a.npz")
    assert done.returncode == 4 and not (tmp_path / "a.npz").exists()
    said = f"'newer.blend' was saved by Blender {major + 1}.1; this is {major}.{minor}: open it"
    assert said in done.stderr.splitlines()[-1]
