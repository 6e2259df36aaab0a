"""What the README says: links, code, the table of causes; and all commands, the documents' too."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
import trimesh
from reference_tracer.cli.main import parser
from reference_tracer.compare.causes import CAUSES
from reference_tracer.report.page.content import _hex

PROJECT = Path(__file__).parent.parent
TEXT = (PROJECT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^ *```(\w*)\n(.*?)^ *```$", TEXT, re.M | re.S)
SHELL = [line.strip() for kind, block in BLOCKS if not kind for line in block.splitlines()]


def anchor(heading: str) -> str:
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def test_links_lead_somewhere():
    anchors = {anchor(h) for h in re.findall(r"^#+ (.+)$", TEXT, re.M)}
    links = re.findall(r"\]\((?!https?:)([^)\s]+)\)", TEXT)
    assert len(links) > 10
    for link in links:
        path, _, part = link.partition("#")
        assert (PROJECT / path).exists(), link
        if not path:
            assert part in anchors, link


def shown(text: str) -> list[str]:
    """Every `reftrace` line of a text, in a block or in a sentence."""
    blocks = re.findall(r"^ *(?:\$ |\.venv/bin/)?(reftrace .+)$", text, re.M)
    return [c for c in (*blocks, *re.findall(r"`(reftrace [^`]+)`", text)) if "COMMAND" not in c]


def commands() -> list[str]:
    documents = (p.read_text(encoding="utf-8") for p in sorted((PROJECT / "docs").rglob("*.md")))
    return sorted({c for text in (TEXT, *documents) for c in shown(text)})


@pytest.mark.parametrize("command", commands())
def test_every_command_line_is_understood(command):
    words = shlex.split(command, comments=True)[1:]
    if len(words) > 1:  # otherwise it only names one
        parser(words).parse_args(words)
    else:
        with pytest.raises(SystemExit) as end:
            parser(words).parse_args([*words, "--help"])
        assert end.value.code == 0


def test_there_are_commands_of_every_kind():
    commands = next(a.choices for a in parser([])._actions if a.choices)
    assert {c.split()[1] for c in shown(TEXT)} == set(commands)
    targets = re.findall(r"^([a-z-]+):.*##", (PROJECT / "Makefile").read_text("utf-8"), re.M)
    for target in re.findall(r"(?:`|^)make ([a-z-]+)", "\n".join((TEXT, *SHELL)), re.M):
        assert target in targets, target


def test_its_code_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    trimesh.creation.icosphere(2).export("mesh.ply")
    [code] = [block for kind, block in BLOCKS if kind == "python"]
    exec(compile(code, "README.md", "exec"), {})
    assert "decided by the error bound" in capsys.readouterr().out


def test_the_table_of_causes_is_that_of_the_code():
    rows = re.findall(r"^\| [^|]*`(#[0-9a-f]{6})` \| \**(\d+) ([^|*]+)\** \|", TEXT, re.M)
    assert {(int(n), label.strip(), color) for color, n, label in rows} == {
        (int(cause), cause.label, _hex(cause.color)) for cause in CAUSES if cause.color is not None
    }
