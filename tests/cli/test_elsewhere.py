"""What differs on Windows and macOS, as far as it can be had here."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import trimesh
from reference_tracer.cli.parser import AGREE
from reference_tracer_grading import command as grading

# What Windows lacks, gone before anything is imported; and the console's letters of Western Europe.
WITHOUT = """
import os, signal, sys
for name in ("fcntl", "grp", "pwd", "resource", "termios"):
    sys.modules[name] = None
for name in ("fork", "forkpty", "getuid", "killpg", "register_at_fork", "sched_getaffinity",
             "sched_setaffinity", "sysconf"):
    delattr(os, name)
for name in ("SIGALRM", "SIGHUP", "SIGQUIT", "SIGUSR1", "alarm", "pthread_sigmask", "setitimer"):
    delattr(signal, name)
"""
STORED = Path(grading.__file__).parent / "scenes" / "exercise_triangle.npz"
SMALL = "--set", "width=24", "height=16"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A folder as Windows' users have them, with a mesh."""
    folder = tmp_path_factory.mktemp("My C: drive") / "Ünser\\folder (1)"
    folder.mkdir()
    (folder / "site").mkdir()
    (folder / "site" / "sitecustomize.py").write_text(WITHOUT, "utf-8")
    trimesh.creation.icosphere(1).export(folder / "a ball\\1.ply")
    return folder


def reftrace(folder: Path, *words: object) -> str:
    """Run a command as it would be there; return what it prints."""
    of_windows = {"PYTHONIOENCODING": "cp1252", "PYTHONUTF8": "0", "PYTHONPATH": "site"}
    command = [sys.executable, "-m", "reference_tracer.cli", *map(str, words)]
    done = subprocess.run(command, cwd=folder, env=os.environ | of_windows, capture_output=True)
    said = done.stderr.decode("cp1252")
    assert done.returncode == AGREE and "Traceback" not in said, said
    return done.stdout.decode("cp1252")


def test_commands_need_nothing_that_windows_lacks(folder):
    ball = "a ball\\1.ply"
    reftrace(folder, "trace", ball, *SMALL, "--out", "a picture\\1.png")
    said = reftrace(
        folder, "compare", ball, *SMALL, "--against", "a picture\\1.png", "--out", "C:\\out"
    )
    assert "C:\\out" in said and (folder / "C:\\out" / "page.html").exists()
    said = reftrace(folder, "explain", ball, *SMALL, "--pixel", "12", "8")
    assert "×" in said and "\\u" in said  # what the console has, and what it does not
    student = Path(__file__).parents[2] / "docs" / "students" / "textbook.py"
    reftrace(folder, "judge", student, STORED, "--out", "judged")


@pytest.mark.parametrize("command", ["trade", "export", "extremes", "bench", "trace", "compare"])
def test_help_is_readable_on_such_a_console(folder, command):
    assert "usage: reftrace" in reftrace(folder, command, "--help")
