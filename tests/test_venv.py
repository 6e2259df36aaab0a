"""Which Python `make demo` takes, with a PATH of stand-ins for those that a machine may have."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]
BASH = shutil.which("bash")
# A Python is asked `-c CODE VERSION`. One that is too new can make an environment, whose pip
# brings uv.
IS = '[ "$1" = -c ] && [ "$3" = {} ]'
NEW = """case "$2" in
venv) mkdir -p "$4/bin" && cp "$0" "$4/bin/python" ;;
pip) cp "${0%python}"../../../path/hidden/uv "${0%/*}/uv" ;;
*) false ;;
esac"""
# uv has a Python, or can fetch one, or cannot.
HAS = 'echo "/uv/$2/python$3"'
FETCHES = """case "$2" in
install) touch "$UV_PYTHON_INSTALL_DIR" ;;
find) [ -e "$UV_PYTHON_INSTALL_DIR" ] && echo "/fetched/python$3" ;;
esac"""


@pytest.fixture
def which(tmp_path: Path):
    """Run `tools/venv.sh which` in a copy, where PATH has only these programs."""
    (tmp_path / "tools").mkdir()
    shutil.copy(PROJECT / "tools" / "venv.sh", tmp_path / "tools")
    path = tmp_path / "path"

    def run(programs: dict[str, str], **environment: str) -> subprocess.CompletedProcess[str]:
        path.mkdir()
        for name, text in programs.items():
            (path / name).parent.mkdir(parents=True, exist_ok=True)
            (path / name).write_text(f"#!{BASH}\n{text}\n")
            (path / name).chmod(0o755)
        for name in ("dirname", "mkdir", "cp", "touch"):
            (path / name).symlink_to(shutil.which(name))
        command = [BASH, tmp_path / "tools" / "venv.sh", "which"]
        return subprocess.run(
            command, env={"PATH": str(path), **environment}, capture_output=True, text=True
        )

    return run


@pytest.mark.parametrize(
    ("programs", "taken"),
    [
        ({"python3.13": IS.format(3.13), "python3.11": IS.format(3.11)}, "python3.13"),
        ({"python3.13": "false", "python3.11": IS.format(3.11)}, "python3.11"),
        ({"python3": IS.format(3.11), "python3.12": IS.format(3.12)}, "python3"),
        ({"python": IS.format(3.13), "python3.11": IS.format(3.11)}, "python"),
        (
            {
                "pyenv": "echo ${0%/*}/kept",
                "kept/versions/3.1.0/bin/python": IS.format("3.1"),
                "kept/versions/3.13.7/bin/python": IS.format(3.13),
                "python3.13": "false",
            },
            "{path}/kept/versions/3.13.7/bin/python",
        ),
        ({"python3.12": IS.format(3.12), "uv": HAS}, "/uv/find/python3.13"),
        ({"python3.11": IS.format(3.11), "uv": HAS}, "python3.11"),
        ({"python3": NEW, "hidden/uv": HAS}, "/uv/find/python3.13"),
    ],
    ids=["3.13", "3.11", "python3", "python", "pyenv", "uv", "no uv needed", "uv by pip"],
)
def test_what_is_taken(which, tmp_path, programs, taken):
    done = which(programs)
    assert done.stdout.strip() == taken.format(path=tmp_path / "path"), done.stderr
    assert done.returncode == 0


def test_uv_fetches_one_into_the_folder(which):
    done = which({"uv": FETCHES})
    assert (done.returncode, done.stdout.strip()) == (0, "/fetched/python3.13")


@pytest.mark.parametrize(
    ("programs", "environment", "missing"),
    [
        ({}, {}, "no Python 3.13 or 3.11 with"),
        ({"uv": "echo dns error >&2; false", "python3": IS.format(3.12)}, {}, "no Python 3.13 or"),
        ({"python3": NEW, "hidden/uv": "false"}, {}, "no Python 3.13 or 3.11 with"),
        (
            {"python3.13": IS.format(3.13), "mine": "false", "uv": HAS},
            {"PYTHON": "mine"},
            "no mine",
        ),
    ],
    ids=["nothing", "uv without a network", "uv by pip without a network", "named"],
)
def test_one_line_says_what_to_install(which, programs, environment, missing):
    done = which(programs, **environment)
    assert done.returncode == 1 and done.stdout == ""
    [line] = done.stderr.splitlines()
    assert missing in line and "apt install python3-venv" in line and "make PYTHON=" in line
