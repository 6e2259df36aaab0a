"""What the documents say of causes, faults and methods is what their records say."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from reference_tracer.causes.explain import CAUSES
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.methods import Method
from reference_tracer_data.faults import DATA_FAULTS

from .attacks.table import withstood

PROJECT = Path(__file__).parent.parent
sys.path.insert(0, str(PROJECT / "tools"))
from documents import records  # noqa: E402
from documents.causes import EXAMPLES as EXAMPLE_OF  # noqa: E402
from documents.causes import picture  # noqa: E402
from documents.markers import refreshed  # noqa: E402

sys.path.pop(0)
PAGES = {
    "camera_conventions": "cameras.md",
    "causes": "causes.md",
    "faults": "faults.md",
    "methods": "accuracy.md",
}
VALUES = records.values()


@pytest.mark.parametrize("part", PAGES)
def test_a_page_has_what_the_records_say(part):
    text = (PROJECT / "docs" / PAGES[part]).read_text(encoding="utf-8")
    start = text.index(f"<!--{part}-->")
    made = text[start : text.index("<!--/-->", start) + len("<!--/-->")]
    assert refreshed(made, lambda command: "", VALUES) == made


def test_every_record_is_told_once():
    for cause in CAUSES[1:]:
        assert VALUES["causes"].count(f"`{cause.key}`, {cause.number})") == 1
    for fault in (*FAULTS, *DATA_FAULTS):
        assert VALUES["faults"].count(f"\n### `{fault.name}`\n") == 1 and fault.why
    assert all(VALUES["methods"].count(f"\n| `{method}`, ") == 1 for method in Method)


def test_every_fault_has_a_witness():
    """The public report in which somebody made it stands in its record, and in its row."""
    for fault in (*FAULTS, *DATA_FAULTS):
        assert re.fullmatch(r"[\w.-]+/[\w.-]+#\d+", fault.witness), fault.name
        repository, number = fault.witness.split("#")
        assert f"(https://github.com/{repository}/issues/{number})" in VALUES["faults"]


def test_a_cause_that_excuses_says_why_and_what_to_do():
    for cause in CAUSES:
        if cause.explains or cause.warns:
            assert cause.why and cause.check and cause.never and cause.advice, cause.key


def test_every_cause_has_a_small_picture():
    shown = {cause.key for cause in CAUSES if cause.why}
    assert set(EXAMPLE_OF) == shown == {cause.key for cause in CAUSES[1:]}
    for key in shown:
        path = PROJECT / "docs" / "images" / "causes" / f"{key}.png"
        assert f"](images/causes/{key}.png)" in VALUES["causes"]
        assert path.stat().st_size < 10_000, "run `make docs`"


@pytest.mark.slow
@pytest.mark.parametrize("cause", CAUSES[1:], ids=[c.key for c in CAUSES[1:]])
def test_the_picture_of_a_cause_shows_it(cause):
    *_, causes = EXAMPLE_OF[cause.key]().shown()
    assert (causes == cause).sum() >= 10
    path = PROJECT / "docs" / "images" / "causes" / f"{cause.key}.png"
    stored = np.asarray(Image.open(path).convert("RGBA"))[::-1]
    fresh = picture(cause)  # of float32, which may round otherwise elsewhere
    assert stored.shape == fresh.shape
    assert (stored != fresh).any(axis=2).mean() < 0.02, "run `make docs`"


def test_a_cause_that_excuses_withstands_an_attack():
    for cause, attacks in withstood().items():
        assert attacks, f"no attack in tests/attacks/ imitates '{cause.key}'"


def test_no_sentence_is_left_without_words():
    """A fault whose sentence is all words says in its record what they may be."""
    assert "“…”" not in VALUES["faults"] and "{" not in VALUES["faults"]
