"""The lessons' notebooks run from top to bottom, as programs; what they claim, they assert."""

from __future__ import annotations

import ast
import runpy
from pathlib import Path

import pytest

LESSONS = Path(__file__).parent.parent / "docs" / "lessons"
NOTEBOOKS = LESSONS / "notebooks"
NAMES = "camera", "floating_point", "plane", "triangle"
LANGUAGES = ("", *(path.parent.name for path in LESSONS.glob("*/notebooks")))


def notebook(language: str, name: str) -> Path:
    return LESSONS / language / "notebooks" / f"{name}.py"


def code(text: str) -> str:
    """A program without its words: comments, docstrings, and what it prints but for the values."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):  # what it shows may stand in another order
            shown = [part for part in node.values if isinstance(part, ast.FormattedValue)]
            node.values = sorted(shown, key=ast.dump)
        elif isinstance(node, ast.Call) and ast.unparse(node.func) == "print":
            node.args = [value for value in node.args if not isinstance(value, ast.Constant)]
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            node.value.value = None
    return ast.dump(tree)


def test_all_are_tried():
    assert {path.stem for path in NOTEBOOKS.glob("*.py")} == {*NAMES, "picture"}
    for language in LANGUAGES[1:]:
        assert {path.stem for path in (LESSONS / language / "notebooks").iterdir()} == {*NAMES}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_a_translation_is_the_same_program_in_other_words(language, name):
    english, ours = (notebook(of, name).read_text("utf-8") for of in ("", language))
    assert code(ours) == code(english)
    cells, said = (
        [cell for cell in text.split("# %%") if cell.startswith(" [markdown]")]
        for text in (english, ours)
    )
    assert len(said) == len(cells) and not set(said) & set(cells)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_it_runs(language, name, monkeypatch, tmp_path, capsys):
    monkeypatch.syspath_prepend(NOTEBOOKS)
    monkeypatch.chdir(tmp_path)
    names = runpy.run_path(str(notebook(language, name)))
    assert capsys.readouterr().out.count("\n") >= 5
    if "frame" in names:
        shown = names["Picture"](names["frame"].color)._repr_png_()
        assert shown.startswith(b"\x89PNG") and len(shown) > 1000
