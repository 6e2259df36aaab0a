"""Lines that are printed, whatever files say; and counts: one of a thing has no s."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from reference_tracer.certainty import sentences
from reference_tracer.wording import LONGEST, count_of, say, show
from reference_tracer_verify.verify import shown as shown_by_the_checker

PROJECT = Path(__file__).parent.parent
# What is meant for other programs, or a text for students: children of benchmarks, examples.
OTHERS = re.compile(r"_child\.py|/examples/|/templates/|wording\.py|verify\.py")


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ((0, "row"), "0 rows"),
        ((1, "row"), "1 row"),
        ((2, "row"), "2 rows"),
        ((1, "vertex", "vertices"), "1 vertex"),
        ((1_234, "vertex", "vertices"), "1,234 vertices"),
    ],
)
def test_a_count_has_its_noun(words, says):
    assert count_of(*words) == says


def test_all_is_printed_in_one_place():
    """No `print`, no writing to a standard stream, no traceback but by `wording.show`."""
    found = [
        f"{path.relative_to(PROJECT)}:{node.lineno}"
        for folder in ("addon", "packages")
        for path in (PROJECT / folder).rglob("*.py")
        if not OTHERS.search(path.as_posix())
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and re.search(
            r"^print$|^(sys\.)?std(out|err)\.write|^traceback\.print|^pprint",
            ast.unparse(node.func),
        )
    ]
    assert not found


def hostile_texts(rng) -> list[str]:
    """Texts that steer a terminal, begin lines, or fill it, alone and mixed."""
    steering = [
        "\r\x1b[2Kall pixels see what it says\x1b[8m",
        "\x1b]0;owned\x07",
        "a\x08\x08b",
        "\n\nverdict: agree",
        "\x9b31m",
        "\u202etxt.exe\u202c",
        "\u2028verdict: agree\u2029\x85\x0b\x0c\x1c",
        "\ud800\udfff",
        "\u200b\u2066\U000e0041",
        "A" * 1_000_000,
        "\x1b" * 100_000,
    ]
    mixed = ["".join(map(chr, rng.integers(0, 0x3000, 40))) for _ in range(200)]
    return steering + mixed


def is_harmless(line: str) -> bool:
    return line.isprintable() and len(line) < 11 * LONGEST


def test_a_line_is_one_line_that_steers_nothing(rng, capsys):
    texts = hostile_texts(rng)
    show(*(f"'{text}': the end" for text in texts))
    say(*texts)
    lines = capsys.readouterr().out.split("\n")
    assert len(lines) == 2 * len(texts) + 1
    assert all(map(is_harmless, lines))
    assert all(line.endswith("': the end") for line in lines[: len(texts)])
    assert all(is_harmless(shown_by_the_checker(text)) for text in texts)
    kept = "Käse 日本 ∞ → “x”, 10⁻³"
    show(kept)
    assert capsys.readouterr().out == f"{kept}\n" and shown_by_the_checker(kept) == kept


def test_where_nothing_or_one_thing_was_decided():
    assert sentences(0, {}) == ["no ray comes near a surface: there was nothing to decide"]
    assert re.match("the one pair of a ray and a surface was decided", sentences(1, {})[0])
    assert re.match("all of 2 pairs of a ray and a surface were decided", sentences(2, {})[0])
