"""A whole Blender with the built extension installed, in a root folder and home of its own."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
WHOLE_BLENDER = PROJECT / "tools" / "whole_blender.sh"
OUT = PROJECT / "out" / "gui"  # what a run leaves: screenshots, logs, pictures
MODULE = "bl_ext.user_default.reference_tracer"


class Blender:
    """Runs commands in the root folder; there the project lies at /project."""

    out = OUT

    def __init__(self):
        shutil.rmtree(OUT, ignore_errors=True)
        OUT.mkdir(parents=True)

    def run(self, *arguments, timeout=300):
        """Run `blender` with these arguments; returns the finished process, its output as text."""
        command = [
            WHOLE_BLENDER,
            "run",
            "env",
            "BLENDER_USER_RESOURCES=/project/out/gui/user",
            "blender",
            *map(str, arguments),
        ]
        return subprocess.run(command, capture_output=True, text=True, timeout=timeout)

    def story(self, name, scene="suzanne", file="stories"):
        """Play a story of a file in the real window; returns what it noted."""
        result = OUT / f"{name}.json"
        done = self.run(
            f"/project/sample_scenes/{scene}.blend",
            "--python-exit-code",
            "9",
            "--python",
            f"/project/tests/gui/{file}.py",
            "--",
            name,
        )
        log = done.stdout + done.stderr
        (OUT / f"{name}.log").write_text(log)
        assert result.exists(), log[-3000:]
        noted = json.loads(result.read_text())
        assert "error" not in noted, noted["error"]
        return noted


@pytest.fixture(scope="session")
def blender():
    """Give the whole Blender, with the extension from dist/ installed by Blender itself."""
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    blender = Blender()
    done = blender.run(
        "--command",
        "extension",
        "install-file",
        "-r",
        "user_default",
        "--enable",
        f"/project/dist/{package.name}",
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return blender
