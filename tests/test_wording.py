"""Counts in messages: one of a thing has no s."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from reference_tracer.certainty import sentences
from reference_tracer.wording import count_of

ADDON = Path(__file__).parent.parent / "addon"


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


def test_no_message_makes_its_own_plural():
    """An s that is multiplied by a comparison, or chosen by one."""
    own = [
        f"{path.name}:{node.lineno}"
        for path in ADDON.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.BinOp)
        and isinstance(node.left, ast.Constant)
        and node.left.value in ("s", "es")
    ]
    assert not own


def test_where_nothing_or_one_thing_was_decided():
    assert sentences(0, {}) == ["no ray comes near a surface: there was nothing to decide"]
    assert re.match("the one pair of a ray and a surface was decided", sentences(1, {})[0])
    assert re.match("all of 2 pairs of a ray and a surface were decided", sentences(2, {})[0])
