"""Menus, presets, another language, twice the size, Material Preview. Screenshots in out/gui."""

import zipfile

import pytest

from .conftest import PROJECT

pytestmark = pytest.mark.gui


@pytest.mark.story("house")
def test_menus_have_our_entries(noted):
    drawn = noted["english"]
    for label in ("Trace and Compare", "Compare All Engines", "Compare Animation"):
        assert label in drawn["TOPBAR_MT_render"]
    assert "Trace and Compare" in drawn["RENDER_PT_reference_tracer"]
    assert "Inspect Pixels" in drawn["IMAGE_MT_image"] and "Save Pixel" in drawn["IMAGE_MT_image"]
    assert "Reference Tracer (.npz)" in drawn["TOPBAR_MT_file_export"]


@pytest.mark.story("house")
def test_a_preset_is_offered_and_chosen(noted):
    for label in ("Lecture", "Exporter test", "Fast look"):
        assert label in noted["english"]["REFERENCE_TRACER_PT_presets"]
    assert noted["preset"]["method"] == "moller_trumbore" and not noted["preset"]["identity"]


@pytest.mark.story("house")
def test_the_panel_can_be_translated(noted):
    drawn = noted["spanish"]["RENDER_PT_reference_tracer"]
    assert "Trazar y comparar" in drawn and "Otras comparaciones" in drawn
    assert "'Trace and Compare'" not in drawn
    assert noted["formatted"] == "{} distintos, {} sin causa"


@pytest.mark.story("house")
def test_material_preview_stays(noted):
    assert noted["shading"] == "MATERIAL"


@pytest.mark.story("house")
def test_nothing_is_written_into_the_add_on(noted, blender):
    """After all stories, its folder is as the zip has it, but for what Python compiles."""
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    own = blender.out / "user" / "extensions" / "user_default" / "reference_tracer"
    files = (p for p in own.rglob("*") if p.is_file() and p.suffix != ".pyc")
    found = {p.relative_to(own).as_posix(): p.read_bytes() for p in files}
    with zipfile.ZipFile(package) as file:
        shipped = {i.filename: file.read(i) for i in file.infolist() if not i.is_dir()}
    assert found == shipped
