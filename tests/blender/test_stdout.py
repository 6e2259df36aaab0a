"""What a command prints in a process of its own: our lines alone; Blender's log goes beside."""

from __future__ import annotations

import re
import subprocess
import sys

import bpy
from reference_tracer.cli import in_blender

LOGGED = "Saved:", "Read blend", "Read new", "Fra:"  # words of Blender's log


def test_standard_output_holds_our_lines_alone(build, tmp_path, capsys):
    build.room(64, 36, lens=40)
    path = str(tmp_path / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    options = "compare", path, "--judge", "cycles"
    command = [sys.executable, "-m", "reference_tracer.cli", *options, "--out", "a"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert any(word in done.stderr for word in LOGGED)
    # With the file open, it prints the same lines into whatever Python has for its output.
    capsys.readouterr()
    assert in_blender.run(["compare", *options[2:], "--out", str(tmp_path / "b")]) == 0
    ours = capsys.readouterr().out
    assert names(done.stdout.splitlines()) == names(ours.splitlines())


def names(lines: list[str]) -> list[str]:
    """Return lines without what another run changes: seconds, and folders."""
    return [
        line.split(":")[0]
        for line in lines
        if not re.search(r"\ds\b|\d s\b|^written to|^open", line)
    ]
