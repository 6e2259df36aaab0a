"""Who reads what a command prints, and who ends it: results stay, and nothing is said twice."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR
from reference_tracer.files import images
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render

COMMAND = [sys.executable, "-m", "reference_tracer.cli.main"]
posix = pytest.mark.skipif(os.name != "posix", reason="signals and descriptors of POSIX")


@pytest.fixture(scope="module")
def compared(make, tmp_path_factory):
    """Return the options that compare a scene with its own picture, all but the folder."""
    folder = tmp_path_factory.mktemp("compared")
    scene = make.scene(make.camera(12, 8), make.quad(-1, 1, -1, 0.1, -3))
    save_scene(folder / "scene.npz", scene)
    images.save_png(folder / "picture.png", images.to_display(render(scene).color))
    return ["compare", folder / "scene.npz", "--against", folder / "picture.png"]


def closed_pipe() -> int:
    """Return where nobody reads, as after `| head -1`."""
    reader, writer = os.pipe()
    os.close(reader)
    return writer


def verdict(out: Path) -> str:
    """Return that of the results, which are all there, and nothing beside them."""
    names = "blender.png", "comparison.json", "difference.png", "frame.npz", "page.html"
    assert sorted(p.name for p in out.iterdir()) == [*names, "traced.png"]
    return json.loads((out / "comparison.json").read_text("utf-8"))["verdict"]


@posix
def test_wrong_options_change_nothing(compared, tmp_path, exit_code):
    """Results of an earlier run stay, and what is compared is not replaced by its result."""
    out = tmp_path / "out"
    assert main([*map(str, compared), "--out", str(out)]) == AGREE
    before = {p.name: p.read_bytes() for p in out.iterdir()}
    shown, scene = out / "traced.png", str(compared[1])
    for options in (["--judge", "cycles"], ["--set", "eye=all", "eye=1,2,3"]):
        assert exit_code([*map(str, compared), *options, "--out", str(out)]) == INPUT_ERROR
    shutil.copy(shown, out / "Traced.PNG")  # one file, where the case of names does not count
    for file in (shown, out / "Traced.PNG"):
        own = ["compare", scene, "--against", str(file), "--out", str(out)]
        assert main(own) == INPUT_ERROR
    (out / "Traced.PNG").unlink()
    assert {p.name: p.read_bytes() for p in out.iterdir()} == before


def test_what_nobody_reads_is_no_error(compared, tmp_path):
    pipe = closed_pipe()
    command = [*COMMAND, *compared, "--out", tmp_path / "out"]
    done = subprocess.run(command, stdout=pipe, stderr=subprocess.PIPE, text=True)
    os.close(pipe)
    assert verdict(tmp_path / "out") == "agree"
    assert (done.returncode, done.stderr) == (AGREE, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full disk is at hand")
def test_a_full_disk_is_said_and_the_results_stay(compared, tmp_path):
    command = [*COMMAND, *compared, "--out", tmp_path / "out"]
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert verdict(tmp_path / "out") == "agree"
    assert done.returncode == INPUT_ERROR
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("reftrace: standard output: No space left on device")


@pytest.mark.slow
@posix
@pytest.mark.parametrize(
    ("closed", "code"),
    [(">&- 2>&- <&-", AGREE), ("2>&-", INPUT_ERROR), ("2>/dev/full", INPUT_ERROR)],
)
def test_closed_streams(closed, code, compared, tmp_path):
    """No traceback, the right exit code; and what is printed goes into no file of ours."""
    scene = compared[1] if code == AGREE else tmp_path / "missing.npz"
    argv = [*COMMAND, "compare", scene, *compared[2:], "--out", tmp_path / "out"]
    done = subprocess.run(["sh", "-c", f'"$@" {closed}', "sh", *argv], capture_output=True)
    assert (done.returncode, done.stdout, done.stderr) == (code, b"", b"")
    assert code == INPUT_ERROR or verdict(tmp_path / "out") == "agree"


def hears(pid: int, number: int) -> bool:
    """Whether a process has a handler of its own for a signal."""
    lines = Path(f"/proc/{pid}/status").read_text("utf-8").splitlines()
    (caught,) = (int(line.split()[1], 16) for line in lines if line.startswith("SigCgt"))
    return bool(caught >> (number - 1) & 1)


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="it says what is handled")
@pytest.mark.parametrize(
    ("name", "word"), [("SIGINT", "interrupted"), ("SIGTERM", "terminated"), ("SIGHUP", "hung up")]
)
def test_a_signal_while_all_is_imported(name, word, compared, tmp_path):
    """In the first moments, in which numpy is imported: one line, and nothing is left."""
    number = getattr(signal, name)
    command = [*COMMAND, *compared, "--out", tmp_path / "new" / "out"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not hears(process.pid, signal.SIGTERM) and process.poll() is None:
        time.sleep(0.001)
    process.send_signal(number)
    said = process.communicate()[1]
    assert (process.returncode, said) == (128 + number, f"reftrace: {word}\n")
    assert not (tmp_path / "new").exists()
