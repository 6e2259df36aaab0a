"""A whole Blender with the built extension installed, in a root folder and home of its own.

One start of it plays the stories of all tests that are to be run: `@pytest.mark.story(NAME)`.
"""

import json
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
WHOLE_BLENDER = PROJECT / "tools" / "whole_blender.sh"
OUT = PROJECT / "out" / "gui"  # what a run leaves: screenshots, logs, pictures
MODULE = "bl_ext.user_default.reference_tracer"


def documented():
    """The commands of installing that docs/button.md names: from disk, and from an address, two."""
    text = (PROJECT / "docs" / "button.md").read_text(encoding="utf-8")
    commands = re.findall(r"^ *(blender .*extension .*)$", text, re.M)
    assert len(commands) == 3, commands
    return commands


class Blender:
    """Runs commands in the root folder; there the project lies at /project."""

    out = OUT

    def __init__(self):
        shutil.rmtree(OUT, ignore_errors=True)
        # Where the folder is not there, Blender takes the preferences of the home, which stays.
        (OUT / "user").mkdir(parents=True)

    def run(self, *arguments, timeout=300):
        """Run `blender` with these arguments; returns the finished process, its output as text."""
        command = [
            WHOLE_BLENDER,
            "run",
            "env",
            "BLENDER_USER_RESOURCES=/project/out/gui/user",
            "python3",
            "/project/tests/gui/with_window_manager.py",
            "blender",
            *map(str, arguments),
        ]
        return subprocess.run(command, capture_output=True, text=True, timeout=timeout)

    def play(self, stories):
        """Play stories in the window, one after another; those that end Blender are the last.

        The others are then played by another Blender. What is missing is found by `noted`.
        """
        self.ended = {}  # how Blender ended after each
        waiting = sorted(stories, key=lambda name: name in ("closed", "quitted"))
        for name in waiting:
            (OUT / f"{name}.json").unlink(missing_ok=True)
        while waiting:
            script = "--python-exit-code", "3", "--python", "/project/tests/gui/play.py"
            done = self.run(*script, "--", *waiting, timeout=1800)
            played = [name for name in waiting if (OUT / f"{name}.json").exists()]
            self.ended |= dict.fromkeys(played, done.returncode)
            log = done.stdout + done.stderr
            assert done.returncode != 3, log[-3000:]  # no story could be played
            for name in waiting[: len(played) + 1]:
                (OUT / f"{name}.log").write_text(log)
            ended = done.returncode != 0 or not played  # by the next one, which noted nothing
            waiting = waiting[len(played) + ended :]

    def noted(self, story):
        """Return what a story that was played has noted."""
        result = OUT / f"{story}.json"
        assert result.exists(), (OUT / f"{story}.log").read_text()[-3000:]
        noted = json.loads(result.read_text())
        assert "error" not in noted, noted["error"]
        return noted


@pytest.fixture(scope="session")
def blender():
    """Give the whole Blender, with the extension from dist/ installed as the document says."""
    check = subprocess.run([WHOLE_BLENDER, "check"], capture_output=True, text=True)
    if check.returncode:
        pytest.skip(check.stdout.strip())
    subprocess.run([WHOLE_BLENDER, "setup"], check=True)  # minutes, once
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    from_disk, *_ = documented()
    assert from_disk.endswith(f" {package.name}")
    blender = Blender()
    done = blender.run(
        *shlex.split(from_disk.replace(package.name, f"/project/dist/{package.name}"))[1:]
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return blender


@pytest.fixture(scope="session")
def played(blender, request):
    """Play the stories of all tests of this run, in one Blender."""
    marks = (item.get_closest_marker("story") for item in request.session.items)
    blender.play(dict.fromkeys(mark.args[0] for mark in marks if mark))
    return blender


@pytest.fixture
def noted(played, request):
    """Give what the test's story has noted."""
    return played.noted(request.node.get_closest_marker("story").args[0])
