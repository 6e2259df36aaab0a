"""The lessons' notebooks run from top to bottom, as programs; what they claim, they assert."""

import runpy
from pathlib import Path

import pytest

NOTEBOOKS = Path(__file__).parent.parent / "docs" / "lessons" / "notebooks"
NAMES = "camera", "floating_point", "plane", "triangle"


def test_all_are_tried():
    assert {path.stem for path in NOTEBOOKS.glob("*.py")} == {*NAMES, "picture"}


@pytest.mark.parametrize("name", NAMES)
def test_it_runs(name, monkeypatch, tmp_path, capsys):
    monkeypatch.syspath_prepend(NOTEBOOKS)
    monkeypatch.chdir(tmp_path)
    names = runpy.run_path(str(NOTEBOOKS / f"{name}.py"))
    assert capsys.readouterr().out.count("\n") >= 5
    if "frame" in names:
        shown = names["Picture"](names["frame"].color)._repr_png_()
        assert shown.startswith(b"\x89PNG") and len(shown) > 1000
