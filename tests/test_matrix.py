"""What the matrix of Blenders leaves out is there, and what the workflow asks it for."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

from reference_tracer.cli.opening import PYTHONS

PROJECT = Path(__file__).parent.parent
CELLS = runpy.run_path(str(PROJECT / "tools/matrix.py"))["CELLS"]


def test_what_is_left_out_is_there():
    for name in {name for cell in CELLS for name in cell.left_out}:
        file, _, test = name.partition("::")
        source = (PROJECT / "tests" / file).read_text(encoding="utf-8")
        assert f"def {test.partition('[')[0]}(" in source if test else source, name


def test_the_workflow_asks_for_cells_that_there_are():
    workflow = (PROJECT / ".github/workflows/release.yml").read_text(encoding="utf-8")
    asked = {cell for only in re.findall(r'ONLY="(.+)"', workflow) for cell in only.split()}
    assert asked == {cell.blender for cell in CELLS if cell.bpy}


def test_messages_name_the_pythons_that_a_bpy_is_made_for():
    assert set(PYTHONS) == {cell.python for cell in CELLS if cell.bpy}
