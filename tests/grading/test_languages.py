"""The examples in other languages are compiled, run, and right; the page shows how."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.external import Run
from reference_tracer_grading.judging import judge
from reference_tracer_grading.subjects import subject

EXAMPLES = Path(__file__).parents[2] / "docs" / "students" / "languages"
C = "cc -O2 -o {out}/c {file} -lm", "{out}/c {rays} {answers}", "csv"
PYTHON = "{python} -m py_compile {file}", "{python} {file}", "csv"
# The file -> its subject, what compiles it, how it is run, how it exchanges numbers.
LANGUAGES = {
    "textbook.c": ("triangle", *C),
    "textbook.cpp": (
        "triangle",
        "c++ -O1 -o {out}/cpp {file}",
        "{out}/cpp {rays} {answers}",
        "raw",
    ),
    "Textbook.java": ("triangle", "javac -d {out} {file}", "java -cp {out} Textbook", "csv"),
    "textbook.js": ("triangle", "node --check {file}", "node {file} {rays} {answers}", "csv"),
    "textbook.rs": ("triangle", "rustc -o {out}/rs {file}", "{out}/rs {rays} {answers}", "csv"),
    "textbook.py": ("triangle", *PYTHON),
    "camera.c": ("camera", *C),
    "camera.py": ("camera", *PYTHON),
    "nearest.c": ("nearest", *C),
    "nearest.py": ("nearest", *PYTHON),
}


def test_every_example_is_tried():
    assert {p.name for p in EXAMPLES.iterdir() if p.is_file()} == LANGUAGES.keys()


@pytest.mark.slow
@pytest.mark.parametrize("name", LANGUAGES)
def test_an_example_is_right(name, tmp_path):
    asked, compile_, run, exchange = LANGUAGES[name]
    own = {"out": tmp_path, "file": EXAMPLES / name, "python": sys.executable}
    words = compile_.format(**own).split()
    if not shutil.which(words[0]):
        pytest.skip(f"no {words[0]} here")
    subprocess.run(words, check=True)
    command = run.format(**own, rays="{rays}", answers="{answers}")
    found = result_of(judge(Run(command, exchange), subject(asked).cases()))
    assert found.errors == [] and found.faults == []
    assert found.verdict == "right" and found.score == 100
