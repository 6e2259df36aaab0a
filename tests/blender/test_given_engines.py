"""Engines that are registered in this Blender are judged as the built-in ones are."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.engines import others
from reference_tracer.blender.drawing.judges import judge_named
from reference_tracer.blender.jobs import engines
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.cli import in_blender
from reference_tracer.comparison.engines import EngineRow
from reference_tracer.scene import SceneError

from .given import rendered_png, solids, told, toy
from .scenes import save

__all__ = ["rendered_png", "solids", "toy"]  # fixtures
OPS = bpy.ops.reference_tracer


def test_a_half_pixel_fault_of_an_engine_is_named(toy, solids):
    toy.offset = (0.5, 0.0)
    solids.reference_tracer.judge = "ENGINE"
    solids.reference_tracer.engine = "toy_tracer"
    OPS.compare()
    found = results.content(Kind.COMPARISON, solids)
    assert found.verdict == "differences" and found.counts.unexplained > 20
    assert told() == ["pixel_offset"]
    assert found.diagnosis.told[0].guess.values == pytest.approx((0.5, 0), abs=0.02)


def test_only_what_is_registered_is_a_judge(toy, solids, compare):
    assert others()["toy_tracer"].label == "Toy Tracer" and "cycles" not in others()
    assert judge_named("Toy_Tracer", background=True).engine == "TOY_TRACER"
    with pytest.raises(SceneError, match=r"no judge 'TOY'.*workbench, cycles, eevee, toy_tracer"):
        compare(judge="TOY")
    bpy.utils.unregister_class(toy)
    try:
        assert others() == {}
        with pytest.raises(SceneError, match="no judge 'TOY_TRACER'"):
            compare(judge="TOY_TRACER")
    finally:
        bpy.utils.register_class(toy)


def test_all_engines_are_those_of_add_ons_too(toy, solids, monkeypatch):
    monkeypatch.setattr(engines, "JUDGES", {"workbench": engines.JUDGES["workbench"]})
    for render, said in (
        (toy.render, ""),
        (begins, "Toy Tracer made no picture: see the console."),
    ):
        monkeypatch.setattr(toy, "render", render)
        OPS.compare_all()
        found = results.content(Kind.ENGINES, solids)
        assert [row.engine for row in found] == ["workbench", "toy_tracer"]
        assert [row.error for row in found] == ["", said]
        assert [row.verdict for row in found] == ["agree", "failed" if said else "agree"]


@pytest.mark.parametrize("own", [False, True])
def test_an_engine_that_does_not_show_the_colors_is_told(own, toy, solids, monkeypatch, compare):
    """It has a light of its own, or only one wrong colour: that is a fault, not another palette."""
    real = toy.triangles

    def lit(self, depsgraph):
        for number, (corners, rgb) in enumerate(real(self, depsgraph)):
            wrong = own or number == 0
            yield corners, 0.5 * np.array(rgb) + 0.01 * (number % 7) if wrong else rgb

    monkeypatch.setattr(toy, "triangles", lit)
    found = compare(judge="TOY_TRACER", diagnose=False)
    assert found.verdict == "differences"
    told = [note for note in found.manifest.notes if "none of the colours" in note]
    assert len(told) == own
    assert [line for line in EngineRow.of(found).not_judged if "none of" in line] == told


def raises(self, depsgraph):
    raise ValueError("a fault of the engine")


def begins(self, depsgraph):
    self.begin_result(0, 0, 96, 54)


def begins_and_raises(self, depsgraph):
    begins(self, depsgraph)
    raises(self, depsgraph)


@pytest.mark.parametrize(
    "render", [raises, begins, begins_and_raises, lambda self, depsgraph: None]
)
def test_an_engine_that_fails_is_told(render, toy, solids, monkeypatch, compare):
    """Blender itself would crash if it were to write such a render to a file."""
    assert compare(judge="TOY_TRACER", diagnose=False).verdict == "agree"
    monkeypatch.setattr(toy, "render", render)
    for as_is in (False, True):
        with pytest.raises(SceneError, match="Toy Tracer made no picture: see the console"):
            compare(judge="TOY_TRACER", as_is=as_is)
    monkeypatch.undo()
    assert compare(judge="TOY_TRACER", diagnose=False).verdict == "agree"


def test_the_command_takes_an_engine_by_its_name(toy, solids, tmp_path, capsys):
    toy.is_opaque = True
    save(tmp_path / "scene.blend")
    compare = "compare", "--out", str(tmp_path / "out"), "--judge"
    code = in_blender.run([*compare, "Toy_Tracer", "--excuse", "renderer=raster"])
    said = capsys.readouterr().out
    assert code == 1 and "Toy Tracer's render" in said
    assert "the picture's background is" in said and "as was asked for" in said
    assert in_blender.run([*compare, "cycles", "--excuse", "filter=1"]) == 4
    assert in_blender.run([*compare, "storm"]) == 4


@pytest.mark.parametrize(
    ("stored", "options", "said"),
    [
        ("ENGINE", [], ""),
        ("AUTO", ["--judge", "Toy_tracer", "--excuse", "filter=1.5"], ""),
        (
            "ENGINE",
            ["--judge", "Cycles", "--excuse", "renderer=raster"],
            "--excuse renderer is for a picture of",
        ),
        ("AUTO", ["--judge", "image"], "--judge image names no engine"),
        ("AUTO", ["--judge", "Render_Result"], "--judge Render_Result names no engine"),
        ("AUTO", ["--judge", "engine"], "--judge engine names no engine"),
    ],
)
def test_options_for_an_engine_that_the_file_stores(
    stored, options, said, toy, solids, tmp_path, capsys
):
    solids.reference_tracer.judge, solids.reference_tracer.engine = stored, "TOY_TRACER"
    save(tmp_path / "scene.blend")
    code = in_blender.run(["compare", "--out", str(tmp_path / "out"), *options])
    assert code == (4 if said else 0)
    assert said in capsys.readouterr().err


def test_an_engine_without_a_name_is_asked_for(solids):
    solids.reference_tracer.judge = "ENGINE"
    with pytest.raises(RuntimeError, match="No engine is named: type its name below Compare With"):
        OPS.compare()
