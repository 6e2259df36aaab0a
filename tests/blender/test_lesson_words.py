"""What the lessons say to click is in Blender's window under that name, in each language."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
import pytest
from reference_tracer.translations import tables

PROJECT = Path(__file__).parents[2]
LESSONS = PROJECT / "docs" / "lessons"
NAMES = "constant_shading", "perspective_camera", "plane", "triangle"
NAMED = re.compile(r"(?<!\*)\*([^*\n]+)\*(?!\*)")
TRANSLATED = re.compile(r"\*([^*\n]+)\* \(\*([^*\n]+)\*\)")


def steps(folder, name):
    """The steps of a plan: what to click, and what one sees."""
    text = (folder / "plans" / f"{name}.md").read_text("utf-8")
    return "\n".join(re.findall(r"^\d+\. .*", text, re.M))


@pytest.fixture(scope="module")
def shown():
    """All names that Blender and the extension show, and those in the lessons' scenes."""
    names = {"Reference Tracer Pixel", *tables("blender")["de"]}
    kinds = [getattr(getattr(bpy.types, name), "bl_rna", None) for name in dir(bpy.types)]
    for kind in filter(None, kinds):
        for p in kind.properties:
            names |= {p.name, *(item.name for item in getattr(p, "enum_items_static", ()))}
    presets = PROJECT / "addon" / "blender" / "ui" / "presets"
    names |= {path.stem.title() for path in presets.rglob("*.xml")}
    for path in (PROJECT / "sample_scenes").glob("exercise_*.blend"):
        with bpy.data.libraries.load(str(path)) as (inside, _):
            names |= {path.stem.replace("_", " ").title(), *inside.objects}
    return names


@pytest.mark.parametrize("name", NAMES)
def test_each_name_is_there(name, shown):
    named = {part for found in NAMED.findall(steps(LESSONS, name)) for part in found.split(" › ")}
    assert len(named) >= 4
    assert sorted(named - shown) == []


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", tables("blender"))
def test_a_translation_names_them_in_its_language_and_the_english_name_beside(
    language, name, shown
):
    table, text = tables("blender")[language], steps(LESSONS / language, name)
    pairs = TRANSLATED.findall(text)
    assert len(pairs) >= 3
    assert [(own, english) for own, english in pairs if table.get(english) != own] == []
    assert sorted(set(NAMED.findall(text)) - shown - set(table.values())) == []
