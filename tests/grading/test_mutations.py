"""A wrong program is named by what is wrong with it, and no other gets its name."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.faults import find_faults
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.judging import judge
from reference_tracer_grading.matching import LEAST, Match, alike
from reference_tracer_grading.mutations import mutations
from reference_tracer_grading.subjects.triangle import MOLLER_TRUMBORE, TRIANGLE, letters
from reference_tracer_grading.tally import COST

from .reordering import rewritten

PROGRAMS, PARTS = TRIANGLE.programs, TRIANGLE.parts
ALL = [(p, m) for p in PROGRAMS for m in mutations(p)]


def answered(program, checks, silent):
    """Return what a program makes of the checks; `silent`: where it misses, it gives zeros."""
    table = program.answers(checks.letters)
    if silent:
        table[~np.isfinite(table[:, 0]), 1:] = 0
    return checks.answers(table)


def test_a_mistake_of_which_nothing_is_seen_gets_no_name(checks):
    """It never hits, and gives zeros for all that it misses: what is wrong may be anything."""
    program, mutation = next((p, m) for p, m in ALL if m.name == "n_order")
    [fault], found = find_faults(answered(mutation.of(program), checks, silent=True))
    assert fault.name == "no_hits" and found is None


def test_two_at_once(checks):
    rng = np.random.default_rng(7)
    named = 0
    for program in PROGRAMS:
        own = list(mutations(program))
        for one, two in rng.choice(len(own), (20, 2)):
            one, two = own[one], own[two]
            if not one.apart_from(two):
                continue
            answers = answered(two.of(one.of(program)), checks, silent=False)
            faults, found = find_faults(answers)
            if found is None:
                continue
            named += 1
            assert len(faults) <= 2
            again = answered(found.program, checks, silent=False)
            assert alike(answers.table, again.table, PARTS)
    assert named > 20


def test_right_programs_in_another_order_have_no_fault(checks):
    check_orders(checks, 60)


@pytest.mark.torture
def test_a_thousand_right_programs_in_another_order_have_no_fault(checks):
    check_orders(checks, 1000)


def check_orders(checks, count):
    """The formulas' operands and the corners' order are chosen at random."""
    rng = np.random.default_rng(11)
    some = rng.permutation(len(checks.group))[:300]
    turns = list(permutations(range(3)))
    for k in range(count):
        other = rewritten(PROGRAMS[k % 2], rng)
        turn = list(turns[rng.integers(6)])
        origins, directions, triangles = (array[some] for array in checks.given)
        table = other.answers(letters(origins, directions, triangles[:, turn]))
        full = np.zeros_like(checks.right)
        full[some] = table[:, [0, *(1 + np.argsort(turn))]]
        assert not checks.answers(full).wrong[some].any()


def test_other_faults_do_not_get_a_mutations_name(right, checks):
    """What no single formula explains keeps the name of its own test, or none."""
    for old, new in (
        ("(t > 0)", "(t > 1e-3)"),
        ("np.where(hit, t, ", "np.where(hit, np.float32(t), "),
        ("np.where(hit, t, ", "np.where(hit, t + 0.01, "),
        ("(s1 >= 0)", "(s1 >= 1e-6)"),
    ):
        text = right["textbook"]
        assert old in text
        space = {}
        exec(text.replace(old, new), space)
        with np.errstate(all="ignore"):
            rows = TRIANGLE.rows(*space["intersect"](*checks.given))
        assert find_faults(checks.answers(rows))[1] is None


@pytest.fixture(scope="module")
def subject(make):
    front, back = make.quad(-3.1, 3.3, -2.7, 2.9, -5.25), make.quad(-9, 9, -8, 8.3, -9)
    scene = make.scene(make.camera(24, 18, half=1), front, back)
    return result_of(prepare("two", scene, pixels=None))


@pytest.fixture
def judged(checks, written, subject):
    return lambda text: result_of(judge(written(text), checks, [subject]))


@pytest.mark.parametrize("of_a_miss", ["{}", "np.where(hit[:, None], {}, 0)"])
def test_a_forgotten_minus_costs_its_share(of_a_miss, right, judged):
    """Every hit is lost with it: the file would have 0, also if a miss has no barycentrics."""
    text = right["textbook"].replace("t = -dot", "t = dot")
    s = "np.stack((s1, s2, s3), axis=1)"
    text = text.replace(s, of_a_miss.format(s))
    found = judged(text)
    assert [f.name for f in found.faults] == ["t_sign"] and "minus is missing" in (
        found.faults[0].sentence
    )
    assert found.as_is < 20 and found.score == 100 - COST and found.verdict == "wrong"


def test_an_exchanged_cross_product(right, judged):
    text = right["textbook"].replace("cross(p2 - p3, x - p3)", "cross(x - p3, p2 - p3)")
    found = judged(text)
    assert [f.name for f in found.faults] == ["ns1_order"]
    assert found.score == 100 - COST
    both = judged(text.replace("t = -dot", "t = dot"))
    assert len(both.faults) == 2 and both.score == 100 - 2 * COST


def test_every_mistake_that_hits_anything_is_put_right(checks):
    """Whatever a program gives beside a miss; signs and orders hit something somewhere."""
    named = set()
    for mutation in mutations(MOLLER_TRUMBORE):
        table = Match(MOLLER_TRUMBORE, (mutation,)).program.answers(checks.letters)
        table[~np.isfinite(table[:, 0]), 1:] = 0
        if (
            np.isfinite(table[checks.tells, 0]).sum() < LEAST
            or not checks.answers(table).wrong.any()
        ):
            continue
        _, found = find_faults(checks.answers(table))
        assert found, mutation
        assert checks.answers(found.put_right(checks.letters, table)).tally.score == 100, mutation
        named.add(mutation.name)
    assert {"a_sign", "h_order", "q_order", "r_order"} < named and len(named) > 30


def test_what_a_scene_shows_beside_it_is_not_forgiven(right, judged):
    """The mistake explains the checks; in the scene something else is wrong, too."""
    text = right["textbook"].replace("t = -dot", "t = dot")
    more = text.replace(
        "    return np.where", "    hit = hit | (p1[:, 2] == -5.25)\n    return np.where"
    )
    assert more != text
    found = judged(more)
    assert [f.name for f in found.faults] == ["t_sign"]
    assert [tally.score == 100 for tally in found.mended] == [True, False]
    assert found.score == max(found.as_is, found.put_right - COST) < 100 - COST


@pytest.mark.parametrize(
    ("old", "new", "more"),
    [
        ("np.where(hit, t, np.inf)", "np.where(hit, np.float32(t), np.inf)", "float32"),
        ("    return np.where", "    hit |= slope == 0\n    t = np.where(slope == 0, 1.0, t)\n"
         "    return np.where", "parallel"),
    ],
)  # fmt: skip
def test_who_has_more_wrong_has_no_more_points(old, new, more, right, judged):
    """What a mutation does not explain is named, too, and is not forgiven."""
    swapped = right["textbook"].replace("stack((s1, s2, s3)", "stack((s1, s3, s2)")
    both = judged(swapped.replace(old, new))
    assert both.score < 100 - COST
    assert more in [f.name for f in both.faults]
