"""ARCHITECTURE.md is what the code is: its floors, and the walks through it."""

from pathlib import Path

import pytest
from documents import architecture

PROJECT = Path(__file__).parent.parent
PAGE = (PROJECT / "ARCHITECTURE.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", architecture.WALKS)
def test_a_walk_leads_from_function_to_function(name):
    assert architecture.faults(architecture.WALKS[name]) == []


def test_the_page_has_them():
    assert architecture.refreshed(PAGE) == PAGE
