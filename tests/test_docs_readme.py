"""What the README and the documents say: links, commands, code."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.cli.main import parser
from reference_tracer.files.scenes import load_scene
from reference_tracer.rendering import render

PROJECT = Path(__file__).parent.parent
TEXT = (PROJECT / "README.md").read_text(encoding="utf-8")
WORDS = 500  # of the README: one screen
DOCUMENTS = {
    path: path.read_text(encoding="utf-8")
    for path in (PROJECT / "README.md", *sorted((PROJECT / "docs").rglob("*.md")))
}


def anchor(heading: str) -> str:
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def anchors(path: Path) -> set[str]:
    text = path.read_text(encoding="utf-8")
    return {anchor(h) for h in re.findall(r"^#+ (.+)$", text, re.M)}


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_links_lead_somewhere(path):
    for link in re.findall(r"\]\((?!https?:)([^)\s]+)\)", DOCUMENTS[path]):
        name, _, part = link.partition("#")
        there = path.parent / name if name else path
        assert there.exists(), link
        assert not part or there.suffix != ".md" or part in anchors(there), link


def test_the_readme_is_one_screen_and_begins_with_a_picture():
    assert len(re.findall(r"\w+", re.sub(r"\]\([^)]+\)", "]", TEXT))) <= WORDS
    assert re.match(r"# .+\n\n!\[", TEXT)


def test_the_index_names_every_document():
    index = DOCUMENTS[PROJECT / "docs" / "README.md"]
    for path in (PROJECT / "docs").glob("*.md"):
        assert path.name == "README.md" or f"({path.name})" in index, path.name


def shown(text: str) -> list[str]:
    """Every `reftrace` line of a text, in a block or in a sentence."""
    blocks = re.findall(r"^ *(?:\$ |\.venv/bin/)?(reftrace .+)$", text, re.M)
    return [c for c in (*blocks, *re.findall(r"`(reftrace [^`]+)`", text)) if "COMMAND" not in c]


def commands() -> list[str]:
    return sorted({c for text in DOCUMENTS.values() for c in shown(text)})


@pytest.mark.parametrize("command", commands())
def test_every_command_line_is_understood(command):
    words = shlex.split(re.sub(r"\s#.*", "", command))[1:]
    if len(words) > 1:  # otherwise it only names one
        parser(words).parse_args(words)
    else:
        with pytest.raises(SystemExit) as end:
            parser(words).parse_args([*words, "--help"])
        assert end.value.code == 0


def test_there_are_commands_of_every_kind():
    commands = next(a.choices for a in parser([])._actions if a.choices)
    assert {c.split()[1] for text in DOCUMENTS.values() for c in shown(text)} == set(commands)
    targets = re.findall(r"^([a-z-]+):.*##", (PROJECT / "Makefile").read_text("utf-8"), re.M)
    for target in re.findall(r"(?:`|^)make ([a-z-]+)", TEXT, re.M):
        assert target in targets, target


def test_the_scene_of_its_own_making_is_read(tmp_path, monkeypatch):
    """That of the page on files, which is written with numpy alone."""
    monkeypatch.chdir(tmp_path)
    text = DOCUMENTS[PROJECT / "docs" / "files.md"]
    [code] = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
    exec(compile(code, "files.md", "exec"), {})
    frame = render(load_scene("scene.npz"))
    height, width = frame.shape
    # By hand: 2 x 2 / 2 square metres, at a depth of 3, of a film of 1.6 x 0.9.
    assert (frame.instance_index == 0).mean() == pytest.approx(2 / 9 / (1.6 * 0.9), abs=0.01)
    assert frame.t[height // 2, width // 2] == 3
    for key in json.loads(str(np.load("scene.npz")["scene"]))["camera"]:
        assert f"`camera.{key}`" in text
