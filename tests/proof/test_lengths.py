"""Nothing that is recorded sums in numpy's order, or goes another way for more numbers at once.

What Coq reads is recorded in one column. In 3 and in 70 it is the same, column by column; and as
other lengths may be asked for, questions of them are looked for in the text of each function that
runs while all is recorded.
"""

from __future__ import annotations

import ast

import pytest
from recorder.nodes import RefusedError
from recorder.records import RECORDS, recorded
from reference_tracer.certified import bounds

from .constants import FOLDER
from .test_whole import functions_that_run

ADDON = FOLDER.parent
SUMS = frozenset(
    "vdot einsum sum inner tensordot matmul prod mean cumsum nansum norm det trace".split()
)
LENGTHS = frozenset({"shape", "size", "count", "ndim"})
SHARED = "what all rays share is one column: other inputs, and each way is recorded"
BATCH = "what all rays of a batch share, in integers: the numbers are the same"
EMPTY = "of none there is nothing to do, or to return"
KIND = "a plane or a triangle: each is recorded"
FEW = "how the same numbers are fetched"
# By function: what is found there, and why it may be.
LISTED = {
    "certified/exact.py IntegerBatch._triangle": {"len(self.origins) == 1": BATCH},
    "certified/exact.py IntegerBatch.hit": {
        "len(self.origins) > 1": BATCH,
        "len(self.directions) > 1": BATCH,
        "surface < len(self.planes)": KIND,
        "sum(edges)": "of three integers: any order is right",
    },
    "certified/exact.py IntegerBatch.of_first_ray": {"surface < len(self.planes)": KIND},
    "certified/measures.py Prepared.meet": {"len(self._edges.T)": EMPTY},
    "certified/sweep/depth_buffer.py DepthBuffer.enter": {"len(pixel) or not fragments": EMPTY},
    "certified/sweep/edge_functions.py set_up": {"len(unsure)": EMPTY},
    "certified/ties.py seen_and_ties": dict.fromkeys(
        ("not front or (len(front) == 1 and (not front[0][1].on_edge))", "len(front) == 1"),
        "the rule itself: recorded with one hit, and with two",
    ),
    "tracer/camera.py Rays.__post_init__": dict.fromkeys(
        ("self.origins.shape[1] == 1", "self.directions.shape[1] == 1"), SHARED
    ),
    "tracer/camera.py corner_rays": {
        "np.abs((camera.right, camera.up, camera.forward)).sum(axis=0)": "how far beyond the "
        "picture's corners: any number of pixels that is not less than one encloses all rays",
    },
    "tracer/vector.py gather": dict.fromkeys(("values.ndim == 1", "not out.size"), FEW),
}


ALL = "it is of all columns together: of several of the same, their maximum, or whether all are so"
ONE = "its record makes the arrays that it works on, of one column"
# By record: which are recorded in one column only, and why.
ONE_COLUMN = {
    **dict.fromkeys(("unit_from_point", "around_directions", "around_origins", "pair"), ALL),
    **dict.fromkeys(("enter", "box"), ONE),
    **dict.fromkeys(("plane_pixel_perspective", "plane_pixel_parallel", "square"), ONE),
}


@pytest.mark.parametrize(
    "record",
    [r for r in RECORDS if r.name not in ONE_COLUMN],
    ids=lambda r: f"{r.name} {r.function}",
)
def test_each_column_is_the_one_that_coq_reads(record):
    """A path may differ: whether all are so is asked of more."""
    one = {output.name: output.node for output, _ in recorded(record, record.values)}
    for columns in (3, 70):
        for output, _ in recorded(record, record.values, columns):
            assert output.node is one[output.name] or output.name.endswith("_path"), output.name


def test_nearly_all_results_of_a_ray_and_a_surface_are_as_many_as_the_columns():
    wide = sum(
        value.size == 3
        for record in RECORDS
        if record.name not in ONE_COLUMN
        for _, value in recorded(record, record.values, 3)
    )
    assert wide > 200


def test_another_expression_in_some_column_is_refused(monkeypatch):
    """As a sum is in which numpy adds in pairs, from eight numbers on."""
    edges = bounds.FromPoint.edges

    def other(prepared, rows, rays):
        found, error = edges(prepared, rows, rays)
        if len(rows) > 8:
            error[8:] = error[8:] + error[8:]
        return found, error

    monkeypatch.setattr(bounds.FromPoint, "edges", other)
    record = next(r for r in RECORDS if r.function == "bounds.FromPoint.edges")
    recorded(record, record.values, 3)
    with pytest.raises(RefusedError, match="the columns of a result are different"):
        recorded(record, record.values, 70)


def found_in(source: str) -> dict[str, set[str]]:
    """Return by function what sums in an order of numpy's, and what is asked of lengths."""
    found: dict[str, set[str]] = {}

    def look(node: ast.AST, name: str) -> None:
        for child in ast.iter_child_nodes(node):
            inner = name
            if isinstance(child, ast.FunctionDef | ast.ClassDef):
                inner = f"{name}.{child.name}".lstrip(".")
            elif is_sum(child):
                found.setdefault(name, set()).add(ast.unparse(child))
            elif isinstance(child, ast.Compare) and asks(child):
                found.setdefault(name, set()).add(ast.unparse(child))
            elif isinstance(child, ast.If | ast.IfExp | ast.While) and asks(child.test):
                found.setdefault(name, set()).add(ast.unparse(child.test))
            look(child, inner)

    look(ast.parse(source), "")
    return found


def is_sum(node: ast.AST) -> bool:
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.MatMult)
    if not isinstance(node, ast.Call):
        return False
    name = getattr(node.func, "attr", getattr(node.func, "id", ""))
    return name in SUMS or (name in ("dot", "reduce") and isinstance(node.func, ast.Attribute))


def asks(test: ast.AST) -> bool:
    """Return whether a condition depends on how many numbers there are."""
    return any(
        getattr(getattr(node, "func", None), "id", "") == "len"
        or getattr(node, "attr", "") in LENGTHS
        for node in ast.walk(test)
    )


def test_only_what_is_listed():
    found = {}
    ran = functions_that_run(ADDON)
    for file in {file for file, _ in ran}:
        for name, texts in found_in((ADDON / file).read_text(encoding="utf-8")).items():
            if (file, name) in ran:
                found[f"{file} {name}"] = texts
    assert found == {name: set(texts) for name, texts in LISTED.items()}
