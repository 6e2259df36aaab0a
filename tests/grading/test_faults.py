"""Every known fault is recognised by its name, alone and among others; right files have none."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer_grading.faults import dependence, find_faults


def function(text):
    space = {}
    exec(text, space)

    def quiet(*rays):
        with np.errstate(all="ignore"):
            t, s = space["intersect"](*rays)
        return np.asarray(t, np.float64), np.asarray(s, np.float64)

    return quiet


def faults(text, checks):
    ask = function(text)
    answers = checks.answers(checks.subject.rows(*ask(*checks.given)))
    return find_faults(answers)[0] + dependence(answers, ask)


@pytest.mark.parametrize("name", ["textbook", "moller_trumbore", "loop", "signed_volumes"])
def test_right_files_have_no_fault(name, right, checks):
    assert faults(right[name], checks) == []


def test_a_fault_is_recognised(fault, checks):
    name, text = fault
    found = faults(text, checks)
    assert [f.name for f in found] == [name]
    assert found[0].pairs > 0 and len(found[0].sentence) > 15


def test_several_at_once(right, checks):
    text = right["textbook"]
    for old, new in (
        ("(t > 0)", "(t > 0) & (slope > 0) & (s1 + s2 + s3 == 1)"),
        ("np.where(hit, t, ", "np.where(hit, t * np.linalg.norm(d, axis=1), "),
        ("stack((s1, s2, s3)", "stack((s1, s3, s2)"),
    ):
        assert old in text
        text = text.replace(old, new)
    found = [f.name for f in faults(text, checks)]
    assert found == ["back_faces_culled", "sum_equals_one", "t_is_distance", "s2_s3_swapped"]


def test_batch_mixed_up_with_components(right, checks):
    """A call of three rays, in which (3,) fits (3, 3) the wrong way round."""
    text = right["textbook"].replace(
        "t[:, None] * d", "(t * d if t.shape == d.shape[1:] else t[:, None] * d)"
    )
    assert [f.name for f in faults(text, checks)] == ["depends_on_the_call"]


def test_another_order_of_summation_is_no_dependence(right, checks):
    """Libraries sum a single row otherwise than many; float32 makes more of it."""
    for dtype in ("float64", "float32"):
        text = right["textbook"].replace(
            "(a * b).sum(axis=1)", "((a * b)[:, ::1 if len(a) > 3 else -1]).sum(axis=1)"
        )
        text = text.replace("o, d = ", f"triangles = triangles.astype('{dtype}')\n    o, d = ")
        text = text.replace("= origins, directions", f"= origins.astype('{dtype}'), directions")
        assert "depends_on_the_call" not in [f.name for f in faults(text, checks)]


@pytest.mark.parametrize("s", ["np.full((len(t), 3), 1 / 3)", "np.stack((s1, s2, 0 * s3), axis=1)"])
def test_other_barycentrics_are_not_all_zero(right, checks, s):
    text = right["textbook"].replace("np.stack((s1, s2, s3), axis=1)", s)
    assert [f.name for f in faults(text, checks)] == ["unrecognised_barycentrics"]


def test_nothing_is_said_twice(checks, right):
    """Of programs that no ray tells apart each has its own sentence, and one other has its name."""
    [found] = faults(right["textbook"].replace(" & (t > 0)", ""), checks)
    assert found.sentence == "t > 0 is not tested"
    [found] = faults(right["textbook"].replace("t = -dot", "t = dot"), checks)
    ways = found.sentence.split("; or ")
    assert len(ways) == len(set(ways)) > 2 and "1 others" not in found.sentence
