"""The buttons of the two studies in the real window. Screenshots are left in out/gui."""

import pytest
from reference_tracer.tracer.settings import UNPROVEN_SETTINGS

pytestmark = pytest.mark.gui


def assert_ran(noted, name):
    """It ran while the interface was alive, alone, and changed nothing."""
    assert noted["pressed"] == ["RUNNING_MODAL"]
    assert noted["running"] == [f"REFERENCE_TRACER_OT_{name}"]
    assert noted["others"] == [False, False]
    assert noted["changed"] == {}
    assert noted["new"] == {}
    assert noted["render_result_kept"]
    assert not noted["in_add_on"]
    assert f"reference_tracer.{name}(" in noted["button"]


@pytest.mark.story("trade")
def test_trade_shows_its_table_and_has_its_plot(noted):
    assert_ran(noted, "trade")
    assert noted["rows"] == len(UNPROVEN_SETTINGS) + 1 and noted["plots"] == 1
    assert noted["lines"] == [noted["advice"]] and "float32" in noted["advice"]


@pytest.mark.story("extremes")
def test_extremes_shows_its_table_and_has_its_plot(noted):
    assert_ran(noted, "extremes")
    assert noted["plots"] == 1
    assert "Certified gets no ray wrong" in noted["lines"][0]
    certified = [never for _, method, _, never in noted["points"] if method == "certified"]
    assert len(certified) > 3 and all(certified)
    assert not all(never for _, _, _, never in noted["points"])


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.story(f"{name}_escape"))
        for name in ("trade", "extremes")
    ],
)
def test_escape_leaves_nothing(name, noted):
    assert noted["running"] == [f"REFERENCE_TRACER_OT_{name}"]
    assert noted["changed"] == noted["new"] == {}
    assert noted["render_result_kept"]
    assert not noted["found"]
    assert noted["can_begin"]
