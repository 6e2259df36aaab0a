"""docs/explain.md shows what the program makes, and its pixel is the sample scene's."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from reference_tracer.explain import reproducer
from reference_tracer.explain.arithmetic import Arithmetic
from reference_tracer.explain.derivation import derive_pixel

PROJECT = Path(__file__).resolve().parents[2]


def test_the_page_is_up_to_date(tmp_path):
    """Else run `python tools/explain_docs.py`."""
    sys.path.insert(0, str(PROJECT / "tools"))
    try:
        import explain_docs
    finally:
        sys.path.pop(0)
    page = explain_docs.PAGE.read_text(encoding="utf-8")
    assert explain_docs.refreshed(page) == page
    assert set(re.findall(r"<!-- ([a-z-]+) -->", page)) - {"end"} == set(explain_docs.parts())


def test_what_it_says_of_its_pixel():
    found = derive_pixel(reproducer.read(PROJECT / "docs" / "pixel.json"))
    first = found.tests[0]
    assert found.seen is first.candidate
    accepted = [first.judgements[kind].accepted for kind in Arithmetic]
    assert accepted == [False, True, True]  # float32 lets the ray through
    assert first.judgements[Arithmetic.FLOAT64].literal is False  # and the printed test, float64's


def test_its_commands_are_there():
    """Every `reftrace explain` of the page parses."""
    page = (PROJECT / "docs" / "explain.md").read_text(encoding="utf-8")
    [scene, file] = re.findall(r"^    reftrace explain (\S+)", page, re.MULTILINE)
    assert (PROJECT / scene).is_file() and (PROJECT / file).is_file()
    done = subprocess.run(
        [sys.executable, "-m", "reference_tracer.cli", "explain", PROJECT / file],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0 and "Torus, triangle 657" in done.stdout
