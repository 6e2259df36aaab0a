"""The documents are what `make docs` makes of them, as far as that is the same on every machine."""

from __future__ import annotations

import ast
import re
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from reference_tracer_grading.student_error import KINDS

pytestmark = pytest.mark.slow

PROJECT = Path(__file__).parent.parent
DOCS = PROJECT / "docs"
TOOLS = str(PROJECT / "tools")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)")


@pytest.fixture(scope="module", autouse=True)
def unregistered():
    """A command registers the add-on by itself: tests with Blender may have done so before."""
    import bpy
    from reference_tracer.blender import registration

    before = hasattr(bpy.types.Scene, "reference_tracer")
    if before:
        registration.unregister()
    yield
    if before:
        registration.register()


@pytest.fixture(scope="module")
def tools():
    """The modules that make the documents, which are a script's own."""
    sys.path.insert(0, TOOLS)
    try:
        import make_docs
        from documents import (
            derivations,
            figures,
            markers,
            pictures,
            python,
            records,
            subjects,
        )

        yield {
            "make": make_docs,
            "figures": figures,
            "markers": markers,
            "pictures": pictures,
            "derivations": derivations,
            "python": python,
            "records": records,
            "subjects": subjects,
        }
    finally:
        sys.path.remove(TOOLS)


@pytest.fixture(scope="module")
def values(tools):
    """Every figure, computed once for all documents."""
    out = {"python_api": tools["python"].page()}
    for name in ("figures", "derivations", "records", "subjects"):
        out |= tools[name].values()
    return out


def texts():
    return sorted(p for p in DOCS.rglob("*.md"))


def originals():
    """Not translations, whose commands and figures test_lesson_languages.py holds to these."""
    return [p for p in texts() if not re.match(r"lessons/[a-z]{2}/", str(p.relative_to(DOCS)))]


@pytest.mark.blender
@pytest.mark.parametrize("path", originals(), ids=lambda p: p.stem)
def test_commands_and_figures(path, tools, values):
    """Run again, every command prints what the text says, and every figure is that."""
    for folder in tools["make"].MADE:
        shutil.rmtree(PROJECT / "out" / folder, ignore_errors=True)
    text = path.read_text(encoding="utf-8")
    again = tools["markers"].refreshed(text, tools["make"].run, values)
    assert again.splitlines() == text.splitlines()


@pytest.mark.parametrize("path", texts(), ids=lambda p: p.stem)
def test_links_lead_somewhere(path):
    for link in LINK.findall(path.read_text(encoding="utf-8")):
        assert (path.parent / link).exists(), link


@pytest.mark.parametrize("path", texts(), ids=lambda p: p.stem)
def test_every_row_of_a_table_has_its_columns(path):
    """A row with more is cut off by who shows it, without a word."""
    columns = 0
    for line in path.read_text(encoding="utf-8").splitlines():
        found = len(re.findall(r"(?<!\\)\|", line)) if line.startswith("|") else 0
        assert not (columns and found) or found == columns, line
        columns = found


def test_commands_are_run_ones(tools):
    """No block with a command stands outside the markers."""
    for path in texts():
        rest = tools["markers"].unmarked(path.read_text(encoding="utf-8"))
        assert "```" not in rest and "\n    reftrace" not in rest, path.name


def test_pictures(tools):
    """The lessons' pictures are what is traced today."""
    folder = DOCS / "images" / "lessons"
    pictures = tools["pictures"].PICTURES
    assert {p.stem for p in folder.glob("*.png")} == set(pictures)
    for name, make in pictures.items():
        stored = np.asarray(Image.open(folder / f"{name}.png").convert("RGBA"))[::-1]
        fresh = make()
        assert stored.shape == fresh.shape, name
        assert (stored != fresh).any(axis=2).mean() < 0.001, name


def test_the_tutorials_pictures_are_there():
    shown = re.findall(r"images/tutorial/(\w+)\.png", (DOCS / "tutorial.md").read_text("utf-8"))
    assert sorted(shown) == sorted(p.stem for p in DOCS.glob("images/tutorial/*.png"))
    for name in shown:
        picture = Image.open(DOCS / "images" / "tutorial" / f"{name}.png").convert("L")
        assert np.asarray(picture).std() > 5, name


def test_every_fault_is_described():
    grading = (DOCS / "grading.md").read_text(encoding="utf-8")
    folder = PROJECT / "packages" / "grading"
    names = set()
    for file in ("subjects/triangle.py", "subjects/triangle_faults.py", "faults.py"):
        for node in ast.walk(ast.parse((folder / file).read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                if re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)+|parallel|float32", node.value):
                    names.add(node.value)
    assert len(names) >= 20
    assert not [name for name in names if f"`{name}`" not in grading]


def test_every_failure_is_described():
    grading = (DOCS / "grading.md").read_text(encoding="utf-8")
    assert not [kind for kind in KINDS if not re.search(rf"^\|.*`{kind}`", grading, re.MULTILINE)]


def test_markers(tools):
    markers = tools["markers"]
    silent = "```console\n$ reftrace y\n```\n"
    text = f"a <!--one-->0<!--/--> b\n```console\n$ reftrace x\nold\n```\n{silent}"
    assert [(c.text, c.printed) for c in markers.commands(text)] == [
        ("reftrace x", "old"),
        ("reftrace y", ""),
    ]
    assert markers.figures(text) == ["one"]

    def run(command):
        return f"{command.text} in 0.25 s\n00:01.234  blend | Read\nend\n"

    once = markers.refreshed(text, run, {"one": "1"})
    assert "a <!--one-->1<!--/--> b" in once and silent in once
    assert "```console\n$ reftrace x\nreftrace x in … s\nend\n```" in once
    assert markers.refreshed(once, run, {"one": "1"}) == once
    with pytest.raises(KeyError):
        markers.refreshed(text, run, {})
    left = "<!--not run: it takes long-->\n```\nreftrace z\n```\n"
    assert markers.refreshed(left, run, {}) == left
    rest = markers.unmarked(f"before\n{left}after\n{once}").split()
    assert rest == ["before", "after", "a", "<!--one-->1<!--/-->", "b"]


def test_only_reftrace_is_run(tools):
    command = tools["markers"].Command("rm -r /", "")
    with pytest.raises(SystemExit, match="run reftrace"):
        tools["make"].run(command)
    broken = tools["markers"].Command("reftrace trace not_there.ply --out out/a.png", "")
    with pytest.raises(SystemExit, match=r"no file 'not_there\.ply'"):
        tools["make"].run(broken)
