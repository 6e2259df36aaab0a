"""Each language has all the words that Blender's interface shows, and no others."""

from __future__ import annotations

import ast
from pathlib import Path
from string import Formatter

import bpy
import pytest
from reference_tracer.blender.ui import language
from reference_tracer.causes.explain import CAUSES
from reference_tracer.comparison.extras import MEANWHILE
from reference_tracer.comparison.verdict import BUT, Verdict
from reference_tracer.derivation.document import CERTAINTY_SENTENCES
from reference_tracer.diagnosis.faults.fault import TRIED
from reference_tracer.diagnosis.variants import ASKING
from reference_tracer.translations import tables

BLENDER = Path(language.__file__).parents[1]
TRANSLATED = {"rpt_", "iface_", "tip_", "wrapped", "poll_message_set"}  # functions given texts
WORDS = {"scaled": 3, "Progress": 1}  # which argument says what is being done
KINDS = "Operator", "Panel", "Menu", "PropertyGroup", "AddonPreferences", "GizmoGroup"


def declared():
    """Yield what registered classes say of themselves, of their properties and of the choices."""
    for kind in KINDS:
        base = getattr(bpy.types, kind)
        for cls in base.__subclasses__():
            if not cls.__module__.startswith("reference_tracer."):
                continue
            rna = cls.bl_rna
            if kind == "Operator":
                rna = getattr(bpy.ops.reference_tracer, cls.bl_idname.split(".")[1]).get_rna_type()
            yield getattr(cls, "bl_label", "")
            yield rna.description
            for p in rna.properties:
                if p.identifier in base.bl_rna.properties or p.identifier == "rna_type":
                    continue
                if not p.is_hidden:
                    yield from (p.name, p.description)
                    for item in getattr(p, "enum_items_static", ()):
                        yield from (item.name, item.description)


def sources():
    """Return the texts that the code has translated when it draws, and all that it holds."""
    drawn, held = set(), set()
    for file in BLENDER.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            given = []
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                held.add(node.value)
            elif isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                given = node.args if name in TRANSLATED else []
                given = [*given, *(k.value for k in node.keywords if k.arg == "text")]
            texts = (a.value for a in given if isinstance(a, ast.Constant) and a.value)
            drawn |= {text for text in texts if not text.isupper()}  # an icon's name
    return drawn, held


def stages():
    """Yield the words for what long work does at a time."""
    for file in BLENDER.parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                words = node.args[WORDS.get(getattr(node.func, "id", ""), len(node.args)) :][:1]
                yield from (word.value for word in words if isinstance(word, ast.Constant))


def fields(text):
    return sorted((name, form) for _, name, form, _ in Formatter().parse(text) if name is not None)


@pytest.mark.parametrize("table", tables("blender").values(), ids=tables("blender"))
def test_a_language_has_each_text_and_no_other(table):
    drawn, held = sources()
    computed = {*CERTAINTY_SENTENCES.values(), *(v.capitalize() for v in Verdict)}
    computed |= {cause.place or cause.label for cause in CAUSES[1:]} | {BUT, ASKING, *stages()}
    computed |= {f"trying {what}" for what in TRIED.values()} | {*MEANWHILE.values()}
    shown = {*declared(), *drawn, *computed} - {""}
    shown -= {"Presets"}  # Blender's own name for a menu of presets of which one was removed
    assert {"Trace and Compare", "Watertight", "Needles", "{} differ, {} open"} < shown
    assert sorted(shown - table.keys()) == []
    assert sorted(table.keys() - shown - held) == []
    assert [text for text, said in table.items() if fields(text) != fields(said) or not said] == []


def test_blender_forgets_the_words(addon):
    """A second registration is refused where the first one was not undone."""
    language.unregister()
    language.register()
