"""What a mesh file holds and is not drawn, or drawn in one of several ways, is said everywhere."""

from __future__ import annotations

import json

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE

from .parts import SMALL, trace

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
# Of each, what is added to the square, what is said of it, and whether there may be no "agree".
SAID = {
    "bent": ("v 5 5 0.5\nf 1 2 5 4\n", "1 face of more than three corners is not flat", False),
    "lines": ("l 1 2\n", "1 line 'l' (lines) is not drawn", False),
    "curves": ("cstype bezier\n", "curves and surfaces are not drawn", True),
}


@pytest.fixture(params=SAID)
def said(request, tmp_path):
    """Return a file, what is to be said of it, and whether that is a warning."""
    text, words, warns = SAID[request.param]
    (tmp_path / "a.obj").write_text(SQUARE + text)
    return tmp_path / "a.obj", words, warns


def test_a_comparison_says_it_and_agrees_only_if_nothing_is_left_out(said, tmp_path, capsys):
    path, words, warns = said
    assert trace(path, tmp_path / "a.png") == AGREE
    assert words in capsys.readouterr().out
    out = tmp_path / "out"
    against = ["--against", str(tmp_path / "a.png"), "--out", str(out), *SMALL]
    assert main(["compare", str(path), *against]) == (1 if warns else 0)
    printed = capsys.readouterr().out
    assert words in printed and ("verdict: warnings" in printed) == warns
    found = json.loads((out / "comparison.json").read_text())
    told = [*found["scene"]["notes"], *(u["feature"] for u in found["scene"]["unmodelled"])]
    assert any(words in text for text in told)
    assert (
        words.replace("'", "&#x27;") in (out / "page.html").read_text()
        or words in (out / "page.html").read_text()
    )
