"""No function of what is certified is left out: it is recorded, or said here why it needn't be."""

from __future__ import annotations

import ast
import gc
import sys
from functools import cache
from pathlib import Path

import pytest
from recorder.records import every_output

from ..copied import CHECKER
from .constants import FOLDER

WHICH = "which are meant, and how many: integers"
CALLS = "calls others, with what they return: compares no numbers itself"
EXACT = "Python's integers, which do not round: transcribed by hand, or without a model; tested"
WORDS = "words for the user, of what is decided already"
LEAST = "the least or the largest of numbers, which are not changed"
SORTS = "sorts what is looked at first: any order is right"
FLOAT32 = "float32 and a matrix product: Trees.v has no word for it (test_dropped.py)"
BOXES = "boxes of whole instances, argued by hand: test_ends_of_float64.py, test_dropped.py"
BOXES_BY_HAND = "bounds on what a ray misses, argued at the heads of both trees (test_tree.py)"
WEIGHTS = "barycentrics, whose bound is argued by hand in measures.py (test_barycentrics.py)"
BEFORE = "the roundings before the proof: test_rounding.py holds their bounds against fractions"

# By file, then by reason: functions that the records do not run.
LEFT_OUT = {
    "any_rays.py": {CALLS: "trace_rays nearest_hits hits_through decide"},
    "arithmetic.py": {
        "looks whether floats are IEEE 754's, as the proofs take them": (
            "broken_assumptions check_assumptions has_x87 _at _at.<locals>.largest _runs "
            "_one_by_one _refuse _check_modes sound sound.<locals>.checked sound_steps "
            "sound_steps.<locals>.checked"
        ),
    },
    "known_results.py": {"numbers by their bits": "floats"},
    "definition.py": {CALLS: "definition seen_by"},
    "exact.py": {EXACT: "Hit.weights turning"},
    "order.py": {WHICH: "applies"},
    "ladder.py": {
        CALLS: "Ladder.__init__ Ladder.of Ladder.test Ladder._test_plane",
        "as Ladder._candidates, with what is the farthest at the end": "Ladder.hits",
    },
    "decisions.py": {
        CALLS: "Decisions.by_bound Decisions.by_order Decisions._compare "
        "Decisions._compare.<locals>.compare Decisions.by_integers Decisions._enter_ties",
        WORDS: "Decisions._count_reasons",
        "by whatever order.py says: Tournament.v has a model of it": "tournament",
    },
    "measures.py": {
        WHICH: "Known.none",
        CALLS: "Prepared.__init__ Prepared.enter Measured.__call__ "
        "Measured.__call__.<locals>.rays_at",
        WEIGHTS: "Prepared._weights _edges _least",
    },
    "plain.py": {CALLS: "plain _tile"},
    "reasons.py": {WORDS: "of_doubts reasons _length"},
    "rounding.py": {BEFORE: "rounding", WORDS: "Rounding.__str__"},
    "samples.py": {
        "which pixel of a larger picture a sample is: test_samples.py holds it to the bit": (
            "traced_together traced_together.<locals>.trace"
        ),
    },
    "surfaces.py": {
        WHICH: "Candidates.none Candidates.by_ray Surfaces.planes_of Surfaces.only Surfaces.names "
        "Surfaces.integers surfaces_of _different",
    },
    "ties.py": {EXACT: "_ways _lines _reduced _by_angle"},
    "tree.py": {
        BOXES_BY_HAND: "BoxRays.of Tree.crossed Tree._entered",
        WHICH: "Tree.of Tree.joined",
        LEAST: "around",
        SORTS: "neighbours _cuts",
    },
    "triangle_tree.py": {
        BOXES_BY_HAND: "TriangleTree.pairs",
        WHICH: "TriangleTree.of",
        LEAST: "TriangleTree.made_of",
    },
    "sweep/boxes.py": {
        BOXES: "_corners_with_room",
        WHICH: "InstanceBoxes.in_region Boxed.of Boxed.seen Boxed.in_region",
        LEAST: "boxes_of",
        CALLS: "_mend",
        SORTS: "InstanceBoxes.area",
    },
    "sweep/depth_bins.py": {SORTS: "by_depth by_depth.<locals>.depth"},
    "sweep/chunks.py": {
        WHICH: "Names.of Numbering.__init__ Numbering.enter Numbering.names_of _parts",
        SORTS: "chunks",
        CALLS: "_world expand",
    },
    "sweep/depth_buffer.py": {
        WHICH: "DepthBuffer.__init__ DepthBuffer.winners DepthBuffer.pixels DepthBuffer.places _at",
        LEAST: "DepthBuffer.refresh DepthBuffer.farthest DepthBuffer.farthest_in "
        "DepthBuffer.farthest_around",
    },
    "sweep/film.py": {CALLS: "Film.dual Film.is_sound", FLOAT32: "Film.rows with_room"},
    "sweep/rasterise.py": {WHICH: "Boxes.size rasterised split cells"},
    "sweep/small_triangles.py": {
        FLOAT32: "SmallTriangles.__init__ SmallTriangles.within SmallTriangles._ends"
    },
    "sweep/sweep.py": {
        CALLS: "sweep Sweep.__init__ Sweep.steps Sweep._instances Sweep._keep "
        "Sweep._make_room Sweep.enter Sweep._enter_triangles "
        "_FullError.__init__",
    },
    "sweep/resolve.py": {CALLS: "Resolver.steps Resolver._enter_open Resolver._decide"},
}
LEFT_OUT_OF_THE_CHECKER = {
    "command.py": {CALLS: "add verify _is_one"},
    "verify.py": {
        "reads and writes, and says so in words: test_verify.py": (
            "only film shown Certificate.__init__ Certificate.set_surfaces verified main"
        ),
        "the stored rays' roundings: test_verify.py": "Certificate.rays sine",
        "which pixels come into which square: test_forms.py": "left",
        "moves integers, transcribed by hand in Leaf.v: test_mutations.py": "check",
        "which other surfaces are ties: without a model, test_verify.py": "ways",
        "looks whether floats are IEEE 754's": "check_arithmetic",
    },
}
TABLES = {FOLDER: LEFT_OUT, CHECKER: LEFT_OUT_OF_THE_CHECKER}


@pytest.mark.parametrize("folder", TABLES, ids=lambda folder: folder.name)
def test_every_function_is_recorded_or_said_not_to_be(folder):
    ran = functions_that_run(folder)
    left = {
        (file, name)
        for file, reasons in TABLES[folder].items()
        for names in reasons.values()
        for name in names.split()
    }
    there = set(functions(folder))
    new = sorted(there - ran - left)
    assert not new, f"neither recorded (tools/recorder/records) nor named here: {new}"
    assert not sorted(left - there), "named here, but there is no such function"
    assert not sorted(left & ran), "named here, but recorded"


def functions_that_run(folder):
    """Return file and name of each function of a folder that runs while all is recorded."""
    return {
        (path.relative_to(folder.resolve()).as_posix(), name)
        for path, name in what_runs()
        if path.is_relative_to(folder.resolve())
    }


@cache
def what_runs():
    """Return path and name of each function that runs while all is recorded."""
    codes = set()

    def look(frame, *_):
        codes.add(frame.f_code)

    gc.collect()  # else work that another test left unfinished may end meanwhile
    before = sys.gettrace()
    sys.settrace(look)  # called once for each call, as it returns nothing; records use a profiler
    try:
        for _ in every_output():
            pass
    finally:
        sys.settrace(before)
    return {(Path(code.co_filename).resolve(), code.co_qualname) for code in codes}


def functions(folder):
    """Yield file and name of each function that is defined in the folder."""
    for path in sorted(folder.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for found in _functions(tree, ""):
            yield path.relative_to(folder).as_posix(), found


def _functions(node, prefix):
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef):
            yield prefix + child.name
            yield from _functions(child, f"{prefix}{child.name}.<locals>.")
        else:
            inner = f"{child.name}." if isinstance(child, ast.ClassDef) else ""
            yield from _functions(child, prefix + inner)
