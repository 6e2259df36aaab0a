"""The lessons are whole: each has a plan of 45 minutes, slides, and an answer to each question."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

LESSONS = Path(__file__).parent.parent / "docs" / "lessons"
NAMES = "constant_shading", "perspective_camera", "plane", "triangle"
KINDS = "plans", "slides", "solutions", "worksheets"


def text(kind: str, name: str) -> str:
    return (LESSONS / kind / f"{name}.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("kind", KINDS)
def test_each_lesson_has_it_and_the_index_links_to_it(kind):
    assert {path.stem for path in (LESSONS / kind).iterdir()} == set(NAMES)
    index = (LESSONS / "README.md").read_text(encoding="utf-8")
    assert all(f"({kind}/{name}.md)" in index for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_is_of_45_minutes(name):
    plan = text("plans", name)
    assert sum(map(int, re.findall(r"^\| (\d+) \|", plan, re.M))) == 45
    for part in ("## Goals", "## What to click, and what one sees", "## Before and after"):
        assert part in plan
    shown = {int(n) for a, b in re.findall(r"\.md\) (\d)(?:–(\d))?", plan) for n in (a, b) if n}
    assert max(shown) == text("slides", name).count("\n---\n")  # the first of them ends the head


@pytest.mark.parametrize("name", NAMES)
def test_each_question_has_an_answer_and_is_asked_in_class_or_at_home(name):
    questions, answers = (
        [int(n) for n in re.findall(r"^(\d+)\. ", text(kind, name), re.M)]
        for kind in ("worksheets", "solutions")
    )
    assert questions == answers == list(range(1, len(questions) + 1))
    [(first, last)] = re.findall(
        r"[Hh]omework:\*{0,2} questions (\d) (?:to|and) (\d)", text("plans", name)
    )
    assert "In class 1 to 4" in text("worksheets", name)
    assert (int(first), int(last)) == (5, len(questions))
