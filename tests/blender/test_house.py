"""What Blender's own systems show of the add-on: tooltips, menus, presets, preferences, export."""

from __future__ import annotations

import re
import xml.dom.minidom
from pathlib import Path
from unittest.mock import MagicMock

import bpy
import pytest
from reference_tracer.blender import registration
from reference_tracer.blender.ui import long_work, menus, preferences, samples
from reference_tracer.blender.ui.properties import GROUPS as OWNED

from .scenes import save

PRESETS = Path(menus.__file__).parent / "presets" / "reference_tracer"
GROUPS = [group for _, group in OWNED]
UNITS = r"[Pp]ixel|rays|metre|triangles|faults|regions|share"


def operators():
    for name in (o.bl_idname.split(".")[1] for o in long_work.OPERATORS):
        yield name, getattr(bpy.ops.reference_tracer, name).get_rna_type()


def properties():
    """Every property of ours, by the name of what has it."""
    owners = {g.__name__: g.bl_rna for g in (*GROUPS, preferences.ReferenceTracerPreferences)}
    for owner, rna in (owners | dict(operators())).items():
        for name, prop in rna.properties.items():
            if name not in ("rna_type", "name", "bl_idname") and not prop.is_hidden:
                yield f"{owner}.{name}", prop


def test_every_control_has_a_tooltip():
    found = dict(properties())
    assert len(found) > 30 and len(long_work.OPERATORS) > 12
    said = {name: prop.description for name, prop in found.items()}
    said |= {name: rna.description for name, rna in operators()}
    for name, prop in found.items():
        if prop.type == "ENUM":
            said |= {f"{name}: {i.identifier}": i.description for i in prop.enum_items}
    assert not {name: text for name, text in said.items() if not text or text.endswith(".")}


def test_every_number_names_its_unit():
    numbers = {n: p for n, p in properties() if p.type in ("INT", "FLOAT")}
    assert len(numbers) > 5
    assert not {n for n, p in numbers.items() if not re.search(UNITS, p.description)}


def drawing(menu):
    return getattr(getattr(bpy.types, menu).draw, "_draw_funcs", [])


def entries_of(draw):
    """The operators that a function draws in a menu."""
    menu = MagicMock()
    draw(menu, None)
    for call in menu.layout.menu.call_args_list:
        getattr(bpy.types, call.args[0]).draw(menu, None)
    return {call.args[0].split(".")[1] for call in menu.layout.operator.call_args_list}


def test_menus_have_entries_for_operators_that_there_are():
    known = dict(operators())
    for menu, draw in menus.MENUS.items():
        entries = entries_of(draw)
        assert entries and entries <= {*known, "read_homefile"}  # for the sample scenes
        assert draw in drawing(menu)


def test_sample_scenes_are_opened_as_new_files_and_stay_as_they_are():
    menu = MagicMock()
    samples.draw_scenes(menu)
    names = [call.kwargs["text"] for call in menu.operator.call_args_list]
    assert len(names) == len(samples.scenes()) > 9 and "Exercise Triangle" in names
    path = samples.FOLDER / "exercise_triangle.blend"
    before = path.read_bytes()
    assert bpy.ops.wm.read_homefile(filepath=str(path)) == {"FINISHED"}
    assert bpy.context.scene.name == "Exercise: Triangle"
    assert bpy.data.filepath == "" and not bpy.data.is_saved
    with pytest.raises(RuntimeError, match=r"file"):
        bpy.ops.wm.save_mainfile()
    assert path.read_bytes() == before


def test_all_is_gone_when_the_add_on_is():
    registration.unregister()
    try:
        assert not any(draw in drawing(menu) for menu, draw in menus.MENUS.items())
        assert not [d for d in drawing("IMAGE_HT_header") if d.__module__ == menus.__name__]
        assert not bpy.utils.preset_paths("reference_tracer")
        assert not hasattr(bpy.types, "REFERENCE_TRACER_OT_export")
    finally:
        registration.register()


@pytest.fixture
def resources(tmp_path, monkeypatch):
    """A folder of the user's scripts that the tests may write to."""
    monkeypatch.setenv("BLENDER_USER_SCRIPTS", str(tmp_path))
    return tmp_path


def chosen(path):
    """Choose a preset as the menu does; gives what the scene then stores."""
    menu = menus.REFERENCE_TRACER_PT_presets.__name__
    bpy.ops.script.execute_preset(filepath=str(path), menu_idname=menu)
    stored = bpy.context.scene.reference_tracer
    names = GROUPS[0].__annotations__.keys() - {"image"}  # which is one file's
    return {name: getattr(stored, name) for name in names}


@pytest.mark.parametrize("path", sorted(PRESETS.iterdir()), ids=lambda path: path.stem)
def test_a_preset_sets_every_setting(path):
    [listed] = xml.dom.minidom.parse(str(path)).getElementsByTagName("ReferenceTracerScene")
    typed = {name: value for name, value in listed.attributes.items()}
    assert {k: str(v).upper() for k, v in chosen(path).items()} == {
        k: v.upper() for k, v in typed.items()
    }


def test_a_preset_of_the_user_is_kept_with_his(resources):
    stored = bpy.context.scene.reference_tracer
    stored.method, stored.samples, stored.identity = "watertight", 3, False
    stored.judge, stored.engine = "ENGINE", 'MY "<&> ENGINE'
    before = {path: path.read_bytes() for path in PRESETS.iterdir()}
    assert bpy.ops.reference_tracer.preset_add(name="My own") == {"FINISHED"}
    own = resources / "presets" / "reference_tracer" / "My_own.xml"
    stored.method, stored.samples, stored.identity = "auto", 1, True
    stored.judge, stored.engine = "AUTO", ""
    found = chosen(own)
    assert (found["judge"], found["engine"]) == ("ENGINE", 'MY "<&> ENGINE')
    assert (found["method"], found["samples"], found["identity"]) == ("watertight", 3, False)
    assert bpy.ops.reference_tracer.preset_add(remove_active=True) == {"FINISHED"}
    assert not own.exists()
    assert {path: path.read_bytes() for path in PRESETS.iterdir()} == before


@pytest.fixture
def preferred():
    """The add-on's preferences, as Blender has them of an extension that is switched on."""
    addon = bpy.context.preferences.addons.new()
    addon.module = preferences.ReferenceTracerPreferences.bl_idname
    yield addon.preferences
    bpy.context.preferences.addons.remove(addon)


def test_without_preferences_there_is_no_folder():
    assert preferences.default_folder("compare") == ""


@pytest.fixture
def solids(build):
    scene = build.room(16, 9)
    return scene


def test_results_go_to_the_folder_that_is_preferred(preferred, solids, tmp_path):
    preferred.folder = "//found"
    assert bpy.ops.reference_tracer.compare() == {"FINISHED"}  # of no file: it stays in Blender
    save(tmp_path / "solids.blend")
    assert bpy.ops.reference_tracer.compare() == {"FINISHED"}
    assert bpy.ops.reference_tracer.open_page(open_browser=False) == {"FINISHED"}
    found = tmp_path / "found" / "solids"
    assert (found / "compare" / "comparison.json").exists()
    assert [p.name for p in (found / "open_page").iterdir()] == ["page.html"]
    named = tmp_path / "named"
    assert bpy.ops.reference_tracer.compare(directory=str(named)) == {"FINISHED"}
    assert (named / "comparison.json").exists()


def test_export_writes_what_reftrace_does(solids, tmp_path, reftrace):
    file, ours, theirs = (tmp_path / name for name in ("a.blend", "ours.npz", "theirs.npz"))
    save(file)
    assert bpy.ops.reference_tracer.export(filepath=str(ours)) == {"FINISHED"}
    assert reftrace("export", file, "--out", theirs).returncode == 0
    assert ours.read_bytes() == theirs.read_bytes()
