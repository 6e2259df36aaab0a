"""ARCHITECTURE.md is what the code is: its floors, and the walks through it."""

from pathlib import Path

import pytest
from documents import architecture

PROJECT = Path(__file__).parent.parent
PAGE = (PROJECT / "ARCHITECTURE.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", architecture.WALKS)
def test_a_walk_leads_from_function_to_function(name):
    assert architecture.faults(architecture.WALKS[name]) == []


def test_a_walk_that_leads_nowhere_is_found():
    wrong = "cli/main.py main\n  cli/main.py parser\ncli/main.py walk\nnone.py main\n"
    wrong += "rendering.py TRACERS\n  certified/sweep/sweep.py sweep\ncli/main.py __name__\n"
    found = architecture.faults(wrong)
    assert found == [
        "main does not name parser",
        "cli/main.py has no walk",
        "none.py has no main",
        "TRACERS does not name sweep",
        "cli/main.py has no __name__",
    ]


def test_the_page_has_them():
    assert architecture.refreshed(PAGE) == PAGE
