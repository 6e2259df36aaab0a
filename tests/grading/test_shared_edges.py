"""Edges that leak are named and do not count; edges that are hit twice, or once, are not named."""

from __future__ import annotations

import pytest
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.judging import judge
from reference_tracer_grading.page import page
from reference_tracer_grading.report import student
from reference_tracer_grading.shared_edges import EDGES, SharedEdges
from reference_tracer_grading.tables import lines

CLOSED = "hit = (s1 >= 0) & (s2 >= 0) & (s3 >= 0) & (t > 0)"
STRICT = CLOSED.replace(">= 0", "> 0")
# One of two triangles that are wound alike has a shared edge upwards, the other one downwards: that
# which has it upwards has the points on it.
OWNED = """
    def up(a, b):
        e = b - a
        return (e[:, 0] > 0) | (e[:, 0] == 0) & ((e[:, 1] > 0) | (e[:, 1] == 0) & (e[:, 2] > 0))

    hit = t > 0
    for s, a, b in ((s1, p2, p3), (s2, p3, p1), (s3, p1, p2)):
        hit &= (s > 0) | (s == 0) & up(a, b)
"""
CULLED = CLOSED + " & (slope > 0)"


@pytest.fixture
def judged(right, checks, written):
    def run(hit: str):
        text = right["textbook"]
        assert text.count(CLOSED) == 1
        return result_of(judge(written(text.replace(CLOSED, hit)), checks, []))

    return run


def said(found) -> bool:
    return any("edges leak" in line for line in lines(found))


def test_strict_inequalities_leak_and_do_not_count(judged):
    found = judged(STRICT)
    assert (found.edges.edges, found.edges.leaking) == (EDGES, EDGES)
    assert found.verdict == "right" and found.score == 100
    assert said(found) and f"{EDGES} of {EDGES} edges leak" in "\n".join(lines(found))
    assert student(found)["shared_edges"]["leaking"] == EDGES
    assert "edges leak" in page(found)


def test_edges_that_are_hit_twice_do_not_leak(judged):
    found = judged(CLOSED)
    assert found.edges.hit_twice == EDGES and found.edges.leaking == 0 and not said(found)


def test_edges_that_one_triangle_has_do_not_leak(judged):
    found = judged(OWNED.strip())
    assert found.edges == SharedEdges(EDGES, leaking=0, hit_twice=0)
    assert not said(found) and found.score == 100


def test_one_strict_inequality_leaks_where_both_triangles_have_it(judged):
    found = judged(CLOSED.replace("s2 >= 0", "s2 > 0"))
    assert 0 < found.edges.leaking < EDGES / 4 and said(found)


def test_what_is_not_seen_at_all_is_no_edge(judged):
    """A triangle that faces away is missed for another reason."""
    found = judged(CULLED)
    assert 0 < found.edges.edges < EDGES and found.edges.leaking == 0 and not said(found)
    nothing = judged(CLOSED + " & False")
    assert nothing.edges.edges == 0 and not said(nothing)


def test_a_file_that_fails_has_no_edges(checks, written):
    found = result_of(judge(written("import nothing_of_this_name"), checks, []))
    assert found.edges is None and student(found)["shared_edges"] is None
