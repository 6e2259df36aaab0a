"""A judge is one record: what is added there is seen everywhere, and nothing else is drawn."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import nullcontext

import bpy
import pytest
from reference_tracer.blender.drawing import rasteriser
from reference_tracer.blender.drawing.judge import Judge
from reference_tracer.blender.drawing.judges import JUDGES, judge_named
from reference_tracer.pictures.bounds import SNAPPING
from reference_tracer.scene import SceneError

# A Blender of its own, in which the records have one more before anything else reads them.
ADDED = """
import sys
from contextlib import contextmanager
from pathlib import Path
from reference_tracer.blender.drawing import judges

drawn = []

@contextmanager
def set_up(scene, depsgraph):
    drawn.append(scene)
    yield

del judges.JUDGES["eevee"]  # its shaders take seconds to compile
judges.JUDGES["draft"] = judges.Judge(
    name="draft", label="Draft", description="A quick picture", number=7,
    engine="BLENDER_WORKBENCH", set_up=set_up, sample_radius=0.25,
)

import bpy
import reference_tracer
from reference_tracer.cli import main as cli
from reference_tracer.cli import in_blender

reference_tracer.register()
out = Path(sys.argv[1])
bpy.ops.wm.open_mainfile(filepath=sys.argv[2], load_ui=False)
stored = bpy.context.scene.reference_tracer
stored.judge = "DRAFT"
item = stored.bl_rna.properties["judge"].enum_items["DRAFT"]
assert (item.name, item.description, item.value) == ("Draft", "A quick picture", 7)
bpy.context.scene.render.resolution_percentage = 10
assert bpy.ops.reference_tracer.compare(directory=str(out / "stored")) == {"FINISHED"}
stored.judge = "AUTO"
in_blender.run(["compare", "--judge", "draft", "--out", str(out / "named")])
assert len(drawn) == 5, drawn  # what it rounds to, then its pictures, and whose they show
in_blender.run(["compare", "--judge", "all", "--out", str(out / "all")])
cli.main(["compare", "--help"])
"""


def test_what_is_added_is_seen_everywhere(tmp_path, opened):
    opened("suzanne", 96)
    path = str(tmp_path / "small.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    done = subprocess.run(
        [sys.executable, "-c", ADDED, tmp_path, path], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "auto,workbench,cycles,draft;" in "".join(done.stdout.split())
    for folder in ("stored", "named", "all/draft"):
        found = json.loads((tmp_path / folder / "comparison.json").read_text(encoding="utf-8"))
        assert found["blender"]["source"] == "draft"
        assert found["blender"]["sample_radius"] == 0.25
        assert found["pixels"]["unexplained"] == 0 < found["pixels"]["agree"]
    table = json.loads((tmp_path / "all" / "engines.json").read_text(encoding="utf-8"))
    assert [row["engine"] for row in table["engines"]] == ["workbench", "cycles", "draft"]


@pytest.mark.parametrize("name", ["STORM", "viewport "])
def test_one_that_is_unknown_is_refused(name, opened, compare):
    """In place of a picture by another."""
    opened("suzanne", 32)
    with pytest.raises(SceneError, match=rf"no judge '{name}'.*workbench, cycles"):
        compare(judge=name)


def test_a_record_is_found_by_its_name():
    for name, judge in JUDGES.items():
        assert judge.name == name
        assert judge_named(name.upper(), background=True) is judge
    assert judge_named("AUTO", background=True) is JUDGES["workbench"]
    assert judge_named("AUTO", background=False).needs_window


@pytest.mark.parametrize(
    ("own", "problem"),
    [
        ({"sample_radius": 0.5}, "within their pixel"),
        ({"number": 9, "engine": "X"}, "needs a description"),
        ({"traces_rays": True}, "traces no rays"),
    ],
    ids=["samples beside the pixel", "nothing to choose it by", "rays in a viewport"],
)
def test_a_record_that_contradicts_itself_is_refused(own, problem):
    with pytest.raises(ValueError, match=rf"'draft'.*{problem}"):
        Judge("draft", "Draft", **own)


def test_one_that_takes_no_other_materials_is_refused():
    """As EEVEE in 4.3: Cycles with no light and the materials that there are."""
    own = {"solid": False, "set_up": lambda *_: nullcontext()}
    with_its_own = Judge("draft", "Draft", engine="CYCLES", **own)
    with pytest.raises(SceneError, match=r"Draft of Blender .* materials of its own"):
        rasteriser.snapping_of(with_its_own)


def test_only_a_ray_tracer_is_taken_to_leave_corners_where_they_are(monkeypatch):
    """A rasteriser with materials rounds them too: here to a sixteenth of a pixel."""

    def coarse(judge, moved):
        return moved > 1 / 32

    monkeypatch.setattr(rasteriser, "covered", coarse)
    with_materials = Judge("draft", "Draft", engine="EEVEE", solid=False)
    assert rasteriser.snapping_of(with_materials) >= 1 / 16 > SNAPPING
    assert rasteriser.snapping_of(JUDGES["cycles"]) == SNAPPING
