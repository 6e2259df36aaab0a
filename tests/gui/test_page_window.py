"""The page from the real window: the button writes it, and the browser is told to open it."""

import json
import re

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("page")
def test_the_button_writes_the_page_and_opens_it(noted, blender):
    assert not noted["before"] and noted["pressed"] == ["RUNNING_MODAL"]
    assert noted["address"].startswith("file:///") and noted["address"].endswith("/page.html")
    assert noted["unchanged"]
    text = (blender.out / "page.html").read_text(encoding="utf-8")
    [data] = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)
    held = json.loads(data)
    assert held["comparison"]["blender"]["source"] == "viewport"
    assert held["comparison"]["verdict"] == "agree"
    assert [p["id"] for p in held["pictures"]] == ["traced", "blender", "literal"]
