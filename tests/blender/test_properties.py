"""What a .blend stores of the settings: by numbers, so these must never change their meaning."""

from __future__ import annotations

import bpy
import pytest
from reference_tracer.blender.live.shows import SHOWS
from reference_tracer.blender.ui import choices
from reference_tracer.methods import Method
from reference_tracer.study import tradeoff
from reference_tracer.study.scenarios import sweeps
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.frame import PASSES
from reference_tracer.tracer.settings import Precision, Settings

# As released. A line may be added, none changed or removed: files are out there.
STORED = {
    "method": {
        "textbook": 0,
        "textbook_literal": 1,
        "moller_trumbore": 2,
        "watertight": 3,
        "certified": 4,
        "auto": 5,
    },
    "precision": {"float64": 0, "float32": 1},
    "judge": {
        "AUTO": 0,
        "WORKBENCH": 1,
        "CYCLES": 2,
        "EEVEE": 3,
        "ENGINE": 10,
        "RENDER_RESULT": 11,
        "IMAGE": 12,
    },
    "renderer": {"AUTO": 0, "RAYS": 1, "RASTER": 2},
    "shading": {"LIKE_FOR_LIKE": 0, "AS_IS": 1},
    "color": {"object": 0, "normal": 1, "facing": 2, "depth": 3},
    "show": {
        "PICTURE": 0,
        "WRONG": 1,
        "DIFFERENCE": 2,
        "CERTAINTY": 3,
        "OBJECT": 4,
        "NORMAL": 5,
        "FACING": 6,
        "DEPTH": 7,
    },
}


def test_numbers_are_those_that_were_released():
    items = {
        "method": choices.METHODS,
        "precision": choices.PRECISIONS,
        "judge": choices.JUDGES,
        "renderer": choices.RENDERERS,
        "shading": choices.SHADINGS,
        "color": choices.COLORS,
        "show": choices.SHOWS,
    }
    assert items.keys() == STORED.keys()
    for name, released in STORED.items():
        assert {i[0]: i[-1] for i in items[name]}.items() >= released.items(), name


def test_what_is_offered_is_what_there_is():
    """The texts stand where reading them needs no numpy; what they are of stands elsewhere."""
    assert {i[0] for i in choices.METHODS} == {m.value for m in Method}
    assert {i[0] for i in choices.PRECISIONS} == {p.value for p in Precision}
    assert [i[0] for i in choices.COLORS] == [c.value for c in Color]
    assert [i[0] for i in choices.SHOWS] == list(SHOWS)
    bits = {p.label: 2**k for k, p in enumerate(PASSES) if p.label and p.label != "Combined"}
    assert {i[0]: i[-1] for i in choices.PASSES} == bits
    names = [s.name for s in sweeps.SCENARIOS]
    assert [i[0] for i in choices.STUDIES] == [choices.EVERY, *names]
    trade = bpy.ops.reference_tracer.trade.get_rna_type().properties
    defaults = trade["width"].default, trade["samples"].default
    assert defaults == (tradeoff.WIDTH, tradeoff.SAMPLES)


def test_a_scene_that_stores_nothing_is_certified_where_that_is_possible():
    assert bpy.context.scene.reference_tracer.settings() == Settings("auto", "float64", 1)


@pytest.mark.parametrize("method", list(Method))
def test_a_precision_that_is_greyed_out_does_not_count(method):
    stored = bpy.context.scene.reference_tracer
    stored.method, stored.precision, stored.samples = method, "float32", 3
    used = "float64" if method.is_proven else "float32"
    assert stored.settings() == Settings(method, used, 3)
    assert stored.has_precision != method.is_proven
    assert stored.precision == "float32"  # for when the method is a plain one again
