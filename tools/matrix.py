"""Runs the tests that need Blender in each version of it that is promised: one table.

    make test-matrix                   every cell, one after the other
    make test-matrix ONLY="4.2 window"  those whose names begin so

A wheel has an environment of its own in .venv/matrix, made once, and runs what needs bpy. The
window runs what needs one. out/matrix gets each cell's log and results, and table.md. The exit code
is 1 if a test failed or a cell could not be run.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

PROJECT = Path(__file__).resolve().parent.parent
OUT = PROJECT / "out" / "matrix"
WINDOW = PROJECT / "tools" / "whole_blender.sh"

# What is to be found by comparisons is the same in each Blender, and takes a third of the time.
LEFT_OUT = tuple(
    f"blender/test_{name}.py" for name in ("attacks", "digests", "mutations", "self_check")
)
# 4.2's wheel, any, crashes at the end of a process that has registered a property group with a
# function: so does all that runs in a process of its own, and the command `reftrace`.
CRASHES = (
    "blender/test_cli_blend.py",
    "blender/test_engine_faults.py::test_a_picture_that_does_not_fit_is_refused_in_words",
    "blender/test_engine_faults.py::test_a_script_ends_with_an_exit_code[none]",
    "blender/test_handlers.py::test_data_may_come_and_go",
    "blender/test_hard_cases.py::test_rigid_bodies_fall_on_after_a_comparison",
)
# The wheels of 4.5 and 5.0 are made for numpy 1: with 2 their module of sound complains once, with
# a traceback, and these want none.
COMPLAINS = (
    "blender/test_cli_blend.py::test_input_errors",
    "blender/test_engine_faults.py::test_a_picture_that_does_not_fit_is_refused_in_words",
    "test_extension.py::test_installs_works_and_leaves_its_folder_as_it_is",
)
WHEEL_TESTS = ("tests/blender", "tests/test_extension.py", "-m", "not gui and not torture")
WINDOW_TESTS = ("tests/gui", "-m", "gui and not torture")


@dataclass(frozen=True)
class Cell:
    """A Blender and a numpy; a wheel where it has a Python of ours, else the window."""

    blender: str
    bpy: str = ""
    python: str = ""
    numpy: str = ""
    left_out: tuple[str, ...] = LEFT_OUT

    @property
    def name(self) -> str:
        return f"{self.blender}-{self.numpy}" if self.bpy else f"window-{self.blender}"


CELLS = (
    Cell("4.2", "4.2.23", "3.11", "1.26.4", LEFT_OUT + CRASHES),
    Cell("4.2", "4.2.23", "3.11", "2.4.6", LEFT_OUT + CRASHES),
    Cell("4.5", "4.5.15", "3.11", "1.26.4"),
    Cell("4.5", "4.5.15", "3.11", "2.4.6", LEFT_OUT + COMPLAINS),
    Cell("5.0", "5.0.1", "3.11", "1.26.4"),
    Cell("5.0", "5.0.1", "3.11", "2.4.6", LEFT_OUT + COMPLAINS),
    Cell("5.2", "5.2.3", "3.13", "2.5.5"),
    Cell("4.3"),
    Cell("5.2"),
)

# What a Blender says of itself: a row of the table begins with it.
VERSIONS = "import sys, bpy, numpy; print('IS', bpy.app.version_string, \
sys.version.split()[0], numpy.__version__, flush=True)"
HEAD = ("Blender", "Python", "numpy", "passed", "failed", "skipped", "seconds")


class CannotRunError(Exception):
    """A cell cannot be run on this machine, and why."""


def run(*command: str | Path) -> str:
    """Run a command, and return what it prints."""
    done = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True)
    if done.returncode:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()[-5:]
        raise CannotRunError("\n".join([f"{Path(command[0]).name} failed:", *said]))
    return done.stdout


def environment(cell: Cell) -> Path:
    """Return the Python of a cell's environment, which is made if it is not there."""
    folder = PROJECT / ".venv" / "matrix" / cell.name
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    pins = (PROJECT / "constraints.txt").read_text("utf-8")
    stamp = folder / ".pins"  # what is complete; whatever was interrupted is done again
    complete = f"bpy=={cell.bpy} numpy=={cell.numpy}\n{pins}"
    if stamp.exists() and stamp.read_text("utf-8") == complete:
        return python
    print(f"making {folder.relative_to(PROJECT)}", flush=True)
    found = run(PROJECT / "tools" / "venv.sh", "which", cell.python).strip()
    run(found, "-m", "venv", "--clear", "--without-pip", folder)
    constraints = folder / "constraints.txt"
    others = [pin for pin in pins.splitlines() if not pin.startswith("bpy==")]
    constraints.write_text("\n".join(others), "utf-8")
    pip = (sys.executable, "-m", "pip", "--python", python, "install", "--quiet")
    run(*pip, "--constraint", constraints, "setuptools", f"bpy=={cell.bpy}")
    run(*pip, "--constraint", constraints, "--no-build-isolation", "--editable",
        ".[images,progress,test]")  # fmt: skip
    # Last and alone: a user may have numpy 2 also where a wheel asks for 1.
    run(*pip, "--no-deps", "--only-binary=:all:", f"numpy=={cell.numpy}")
    if sys.platform == "linux":  # elsewhere a wheel brings them all
        run(PROJECT / "tools" / "venv.sh", "libraries", python)
    stamp.write_text(complete, "utf-8")
    return python


def prepared(cell: Cell) -> tuple[list[str], list[str | Path], tuple[str, ...]]:
    """Return what a cell's Blender says of its versions, the Python for its tests, and these."""
    if cell.bpy:
        python = environment(cell)
        left_out = (f"--deselect=tests/{name}" for name in cell.left_out)
        said, tests = run(python, "-c", VERSIONS), ("-n", "2", *WHEEL_TESTS, *left_out)
    else:
        os.environ["BLENDER_VERSION"] = cell.blender  # what WINDOW runs, by itself and in tests
        run(WINDOW, "check")
        python, tests = Path(sys.executable), WINDOW_TESTS
        said = run(WINDOW, "run", "blender", "--background", "--python-expr", VERSIONS)
    [line] = [line for line in said.splitlines() if line.startswith("IS ")]
    *words, interpreter, numpy = line.split()[1:]
    return [" ".join(words), interpreter, numpy], [python, "-m", "pytest"], tests


def counts(results: Path) -> Iterator[int]:
    """Yield how many tests have passed, failed, were skipped."""
    [suite] = ElementTree.parse(results).getroot()
    tests, failures, errors, skipped = (
        int(suite.attrib[name]) for name in ("tests", "failures", "errors", "skipped")
    )
    yield from (tests - failures - errors - skipped, failures + errors, skipped)


def row(cell: Cell) -> tuple[list[str], bool]:
    """Run a cell; return its row of the table, and whether all is well."""
    start = time.monotonic()
    log, results = OUT / f"{cell.name}.log", OUT / f"{cell.name}.xml"
    try:
        versions, pytest, tests = prepared(cell)
    except CannotRunError as error:
        print(f"{cell.name} cannot be run: {error}", file=sys.stderr)
        return [cell.name, "", "", "not run", "", "", ""], False
    print(f"{cell.name}: Blender {versions[0]}; log: {log.relative_to(PROJECT)}", flush=True)
    results.unlink(missing_ok=True)
    with log.open("w") as file:
        command = [*pytest, "-q", "-rfEs", f"--junitxml={results}", *tests]
        code = subprocess.run(command, cwd=PROJECT, stdout=file, stderr=file).returncode
    found = list(counts(results)) if results.exists() else ["", "no result", ""]
    seconds = round(time.monotonic() - start)
    return [*versions, *map(str, found), str(seconds)], code == 0


def table(rows: list[list[str]], head: tuple[str, ...] = HEAD) -> str:
    """Return rows as a table in Markdown, its columns aligned."""
    rows = [list(head), *rows]
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    rows.insert(1, ["-" * width for width in wide])
    return "".join(
        f"| {' | '.join(word.ljust(width) for word, width in zip(line, wide, strict=True))} |\n"
        for line in rows
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("only", nargs="*", help="cells whose names begin so: 4.2, 5.0-1.26 ...")
    only = tuple(parser.parse_args().only)
    if unknown := [o for o in only if not any(cell.name.startswith(o) for cell in CELLS)]:
        parser.error(f"no cell is named {unknown[0]}; there are {', '.join(c.name for c in CELLS)}")
    OUT.mkdir(parents=True, exist_ok=True)
    rows, well = [], True
    for cell in CELLS:
        if not only or cell.name.startswith(only):
            line, passed = row(cell)
            rows.append(line)
            well &= passed
            (OUT / "table.md").write_text(table(rows), "utf-8")
    print("\n" + table(rows), end="")
    return not well


if __name__ == "__main__":
    sys.exit(main())
