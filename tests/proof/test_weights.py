"""The barycentrics are quotients of the edge functions whose bounds are proven: measures.py."""

from __future__ import annotations

import pytest
from recorder.nodes import node
from recorder.records import RECORDS, bounds, recorded
from recorder.records.record import Inputs, Kept, Record
from reference_tracer.certified.measures import Prepared, _edges

NAMES = ("bc", "ca", "ab")


@pytest.mark.parametrize("prefix, shared", [("from_point", "o"), ("parallel", "d")])
def test_each_is_an_edge_function_divided_by_the_sum(prefix, shared):
    [edges] = [r for r in RECORDS if r.function.endswith(".edges") and r.name == prefix]

    def call(v: Inputs) -> Kept:
        rays = bounds.rays(v, shared)
        own = Prepared.__new__(Prepared)
        own._one_direction = rays.one_direction
        own._edges = _edges(rays, v.matrix(*bounds.CORNERS))
        return dict(zip(NAMES, own._weights(rays, v.rows), strict=True))

    record = Record("weights", "measures.Prepared._weights", edges.values, call)
    found = {output.name: output.node for output, _ in recorded(record, record.values, 3)}
    proven = {output.name: output.node for output, _ in recorded(edges, edges.values)}
    bc, ca, ab = (proven[f"{prefix}_{name}"] for name in NAMES)
    total = node("Add", node("Add", bc, ca), ab)
    assert [found[name] for name in NAMES] == [node("Div", e, total) for e in (bc, ca, ab)]
