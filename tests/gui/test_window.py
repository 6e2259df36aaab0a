"""The real window of a whole Blender: F12, the button, Esc. Screenshots are left in out/gui."""

import zipfile

import pytest

from .conftest import PROJECT

pytestmark = pytest.mark.gui


@pytest.mark.story("compare")
def test_button_leaves_four_images_and_nothing_else(noted):
    comparison = noted["comparison"]
    assert comparison["blender"]["source"] == "viewport"
    assert comparison["pixels"]["unexplained"] == 0
    assert comparison["verdict"] == "agree"
    assert set(noted["images"]) == {
        "Reference Tracer Traced",
        "Reference Tracer Blender",
        "Reference Tracer Difference",
        "Reference Tracer Causes",
    }
    assert all(size == [960, 540] and spread > 0 for size, spread in noted["images"].values())
    assert noted["changed"] == {}
    assert noted["new"] == {"images": sorted(noted["images"])}
    assert noted["render_result_kept"]


@pytest.mark.story("engines")
def test_every_engine_in_one_table(noted):
    rows = noted["rows"]
    assert [row["engine"] for row in rows] == ["viewport", "workbench", "cycles", "eevee"]
    if noted["version"] < [5]:  # the only one that cannot be asked
        assert "no other is put over them all. Compare with Workbench or" in rows.pop()["error"]
    for row in rows:
        assert row["verdict"] == "agree" and row["pixels"]["unexplained"] == 0
        assert row["wrong_objects"] <= row["pixels"]["differ"] < 25
    assert noted["changed"] == noted["new"] == {}


@pytest.mark.story("animation")
def test_escape_keeps_the_frames_of_an_animation_that_are_done(noted):
    assert noted["pressed"] == noted["pressed_again"] == ["RUNNING_MODAL"]
    frames = noted["frames"]
    assert 2 < len(frames) < 60 and sorted(frames) == list(range(1, len(frames) + 1))
    assert noted["on_disk"] == [f"frame_{frame:04d}" for frame in sorted(frames)]
    assert f"{len(frames)} of 60 frames are done" in noted["page"]
    assert noted["frame"] == 7
    assert noted["changed"] == noted["new"] == {}
    assert not noted["left"]


@pytest.mark.story("compare_as_is")
def test_as_it_is_names_what_the_window_adds(noted):
    comparison = noted["comparison"]
    assert comparison["blender"]["settings"]["anti_aliasing"] == noted["preference"] != "OFF"
    assert "anti-aliasing" in {u["feature"] for u in comparison["scene"]["unmodelled"]}
    assert comparison["pixels"]["unexplained"] == 0
    assert comparison["verdict"] == "warnings"


@pytest.mark.story("no_camera")
def test_a_camera_is_added_by_a_button_and_taken_away_by_undo(noted):
    assert noted["pressed"] == ["FINISHED"] and noted["added"] == "Camera"
    assert noted["undo"] == ["FINISHED"] and noted["cameras"] == []


@pytest.mark.story("f12")
def test_f12_shows_the_traced_picture(noted):
    assert noted["result"]
    assert "IMAGE_EDITOR" in noted["areas"]


@pytest.mark.story("f12_escape")
def test_escape_stops_f12(noted):
    assert noted["cancelled"] and noted["result"]


@pytest.mark.story("scenes")
def test_every_sample_scene_agrees_with_the_viewport(noted):
    assert len(noted) == 12 and noted["default_cube"]["verdict"] == "agree"
    assert {name: c["pixels"]["unexplained"] for name, c in noted.items()} == dict.fromkeys(
        noted, 0
    )
    assert {c["blender"]["source"] for c in noted.values()} == {"viewport"}
    assert all(c["certificate"]["passed"] for c in noted.values())
    for name, comparison in noted.items():  # whose surface is shown, object by object
        shown = comparison["identity"]["pixels"]
        assert shown["not_known"] == 0, name
        assert shown["other_object"] < 0.01 * comparison["pixels"]["total"], name
    assert noted["far_away"]["pixels"]["not_decidable"] > 0


@pytest.mark.story("f12_error")
def test_f12_says_why_it_cannot(noted):
    assert "Reference Tracer models perspective" in noted["reports"]


@pytest.mark.story("material_preview")
def test_material_preview_stays(noted):
    assert noted["shading"] == "MATERIAL"


@pytest.mark.story("material_preview")
def test_nothing_is_written_into_the_add_on(noted, blender):
    """After all stories, its folder is as the zip has it, but for what Python compiles."""
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    own = blender.out / "user" / "extensions" / "user_default" / "reference_tracer"
    files = (p for p in own.rglob("*") if p.is_file() and p.suffix != ".pyc")
    found = {p.relative_to(own).as_posix(): p.read_bytes() for p in files}
    with zipfile.ZipFile(package) as file:
        shipped = {i.filename: file.read(i) for i in file.infolist() if not i.is_dir()}
    assert found == shipped


@pytest.mark.story("trade")
def test_a_study_changes_nothing_and_has_its_plot(noted):
    assert noted["pressed"] == ["RUNNING_MODAL"]
    assert noted["running"] == ["REFERENCE_TRACER_OT_trade"] and noted["others"] == [False, False]
    assert noted["same"] and noted["plots"]
    line, advice = noted["said"]
    assert line == advice and "float32" in line
