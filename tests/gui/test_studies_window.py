"""The buttons of the two studies in the real window. Screenshots are left in out/gui."""

import pytest

pytestmark = pytest.mark.gui

PICTURES = {
    "Reference Tracer Breaking Points",
    "Reference Tracer Sweeps 1",
    "Reference Tracer Sweeps 2",
    "Reference Tracer Map Angle And Aspect",
    "Reference Tracer Map Size And Distance",
}


def assert_ran(noted, name):
    """It ran while the interface was alive, alone, and changed nothing but our own images."""
    assert noted["pressed"] == ["RUNNING_MODAL"]
    assert noted["running"] == [f"REFERENCE_TRACER_OT_{name}"]
    assert noted["others"] == [False, False]
    assert noted["changed"] == {}
    assert noted["new"] == ({"images": sorted(noted["images"])} if noted["images"] else {})
    assert noted["render_result_kept"]
    assert all(spread > 0 for _, spread in noted["images"].values())


@pytest.mark.story("trade")
def test_trade_without_matplotlib_shows_its_table(noted):
    assert_ran(noted, "trade")
    assert noted["rows"] == 9
    assert noted["images"] == {}
    advice, why = noted["lines"]
    assert advice == noted["advice"] and "float32" in advice
    assert "-m pip install matplotlib" in why and "reftrace trade" in why


@pytest.mark.story("trade_with_plot")
def test_trade_shows_its_plot(noted):
    """With the Matplotlib of the project's environment, where it fits Blender's Python."""
    assert_ran(noted, "trade")
    if noted["matplotlib"]:
        assert noted["images"].keys() == {"Reference Tracer Trade"} == set(noted["shown"])
        assert len(noted["lines"]) == 1
    else:
        assert "-m pip install matplotlib" in noted["lines"][1]


@pytest.mark.story("extremes")
def test_extremes_shows_its_table_and_maps(noted):
    assert_ran(noted, "extremes")
    assert noted["images"].keys() == (PICTURES if noted["matplotlib"] else set())
    assert "Certified gets no ray wrong" in noted["lines"][0]
    certified = [never for _, method, _, never in noted["points"] if method == "certified"]
    assert len(certified) > 15 and all(certified)
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
    assert noted["seconds_to_stop"] < 5  # not a measurement: it stopped long before the end
    assert noted["changed"] == noted["new"] == {}
    assert noted["render_result_kept"]
    assert not noted["found"]
    assert noted["can_begin"]


@pytest.mark.story("extreme_scene")
def test_a_scenario_is_opened_compared_and_undone(noted):
    assert noted["pressed"] == ["FINISHED"]
    assert noted["scene"] == noted["comparison"]["scene"]["scene"] != noted["user"]
    assert set(noted["view"]) == {"CAMERA"}
    wrong = {m["method"]: m["wrong_pixels"] for m in noted["comparison"]["methods"]}
    assert wrong["certified"] == 0
    assert noted["undone"] == [[sorted([noted["user"], noted["scene"]]), []], [[noted["user"]], []]]
