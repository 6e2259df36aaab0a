"""A picture that cannot be held is refused before any work, in words that say what to do."""

from __future__ import annotations

import re
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
import trimesh
from reference_tracer.cli.main import main
from reference_tracer.files import png
from reference_tracer.files.images import save_png, to_display
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.tracer import memory
from reference_tracer.tracer.memory import (
    ALWAYS,
    COMPARED,
    TRACED,
    PictureTooLargeError,
    check_memory,
    free_memory,
)


def test_free_memory_is_known_here():
    """Within what a process may see: more than this test has, less than a PiB."""
    assert 1 << 24 < free_memory() < 1 << 50


def test_too_large_a_picture_is_refused(make):
    scene = make.scene(make.camera(60_000_000, 50_000_000))
    with pytest.raises(PictureTooLargeError) as refused:
        render(scene)
    text = str(refused.value)
    assert re.fullmatch(
        r"The picture has 60000000 x 50000000 pixels, which take [\d.]+ GiB with all outputs, and "
        r"[\d.]+ GiB of memory are free: choose a smaller size, a border, or --rows.",
        text,
    )


@pytest.mark.parametrize("free, fits", [(None, True), (ALWAYS + 799, False), (ALWAYS + 800, True)])
def test_what_is_free_decides(free, fits, monkeypatch):
    monkeypatch.setattr(memory, "free_memory", lambda: free)
    if fits:
        check_memory(10, 8, 10)
    else:
        with pytest.raises(PictureTooLargeError):
            check_memory(10, 8, 10)


def test_the_least_of_machine_and_container_counts(monkeypatch):
    for machine, container, expected in (([5], [], 5), ([], [3], 3), ([5], [3], 3), ([], [], None)):
        monkeypatch.setattr(memory, "_free_of_machine", lambda m=machine: m)
        monkeypatch.setattr(memory, "_free_of_container", lambda c=container: c)
        monkeypatch.setattr(memory, "_free_of_process", lambda: [])
        assert free_memory() == expected


CHILD = """
import resource, sys
from pathlib import Path
from reference_tracer.cli import main as cli

kind, room, *argv = sys.argv[1:]
cli.main([a.replace("large", "small") for a in argv])  # imports what the command needs
page, field = resource.getpagesize(), {"AS": 0, "DATA": 5}[kind]
used = int(Path("/proc/self/statm").read_text().split()[field]) * page
kind = getattr(resource, "RLIMIT_" + kind)
resource.setrlimit(kind, (used + int(room), resource.getrlimit(kind)[1]))
sys.exit(cli.main(argv))
"""
REFUSED = r"reftrace: The picture has \d+ x \d+ pixels, which take .*: choose a smaller size"
WIDTH, HEIGHT = 360, 240
TRACE_PNG = "trace", "large.npz", "--out", "large-traced.png"
TRACE_EXR = "trace", "large.npz", "--out", "large-traced.exr"
COMPARE = "compare", "large.npz", "--against", "large.png", "--out", "large-out"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has such limits")
@pytest.mark.parametrize(
    "kind, command, share",
    [
        ("AS", TRACE_PNG, TRACED),
        ("DATA", (*COMPARE, "--no-diagnosis"), COMPARED),
        pytest.param("DATA", COMPARE, COMPARED, marks=pytest.mark.torture),
        pytest.param("DATA", TRACE_EXR, TRACED, marks=pytest.mark.torture),
        pytest.param("AS", COMPARE, COMPARED, marks=pytest.mark.torture),
    ],
)
def test_what_fits_is_done_and_what_does_not_is_refused(make, tmp_path, kind, command, share):
    """In a process with a limit: two surfaces in one place, half of them hidden by a third."""
    quad = make.quad(-9, 9, -9, 9, -5)
    for name, width, height in (("small", 8, 6), ("large", WIDTH, HEIGHT)):
        scene = make.scene(make.camera(width, height), quad, quad, make.quad(-9, 0, -9, 9, -4))
        save_scene(tmp_path / f"{name}.npz", scene)
        shown = to_display(render(scene).color)
        shown[:4] = 99  # a few rows differ
        save_png(tmp_path / f"{name}.png", shown)
    needed = ALWAYS * (2 if share is COMPARED else 1) + WIDTH * HEIGHT * share
    for room, codes in ((needed - (1 << 22), {4}), (needed + (1 << 22), {0, 1, 2})):
        done = subprocess.run(
            [sys.executable, "-c", CHILD, kind, str(room), *command],
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )
        assert done.returncode in codes, done.stderr
        last = done.stderr.splitlines()[-1:] if 4 in codes else []
        assert all(re.match(REFUSED, line) for line in last) and len(last) == (4 in codes)
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize("command", ["trace", "compare"])
def test_the_largest_picture_that_blender_has_is_refused_at_once(tmp_path, command, capsys):
    trimesh.creation.box().export(tmp_path / "box.ply")
    header = png.encode(np.zeros((1, 1, 4), np.uint8))[12:29]  # a chunk's name and content
    header = header[:4] + struct.pack(">2I", 32767, 32767) + header[12:]
    chunk = struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header))
    (tmp_path / "other.png").write_bytes(png.SIGNATURE + chunk)  # no pixel is read
    own = ["--against", str(tmp_path / "other.png")] if command == "compare" else []
    out = str(tmp_path / ("out" if own else "out.png"))
    size = ["--set", "width=32767", "height=32767"]
    assert main([command, str(tmp_path / "box.ply"), *own, "--out", out, *size]) == 4
    assert re.match(REFUSED, capsys.readouterr().err.splitlines()[-1])
