"""Each subject beside the triangle: its truth, its faults by name, its marks."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache
from importlib.resources import files

import jsonschema
import numpy as np
import pytest
import reference_tracer_grading
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, DIFFERENCES, INPUT_ERROR
from reference_tracer.methods import Method
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Mesh, ViewWindow
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_grading.cases import TableCases
from reference_tracer_grading.child import checked
from reference_tracer_grading.faults import find_faults
from reference_tracer_grading.judging import judge
from reference_tracer_grading.matching import alike
from reference_tracer_grading.mutations import mutations
from reference_tracer_grading.programs import columns
from reference_tracer_grading.subjects import NAMES, subject
from reference_tracer_grading.subjects.picture import LONGER, OBJECTS, PIXELS
from reference_tracer_grading.subjects.triangle import MOLLER_TRUMBORE
from reference_tracer_grading.tally import COST
from reference_tracer_grading.truth import exact_hit, exactly

from .reordering import rewritten

OTHERS = [name for name in NAMES if name != "triangle"]


@cache
def asked(name):
    return subject(name).cases()


def answered(name, program):
    cases = asked(name)
    return cases.answers(program.answers(cases.letters))


def names_of(answers):
    return [f.name for f in find_faults(answers)[0]]


@pytest.mark.parametrize("name", NAMES)
def test_right_programs_are_right(name):
    for program in subject(name).programs:
        answers = answered(name, program)
        assert find_faults(answers) == ([], None)
        assert answers.tally.score == 100 and answers.tally.total > 150


@pytest.mark.parametrize("name", NAMES)
def test_every_group_is_there(name):
    cases = asked(name)
    assert set(np.unique(cases.group)) == set(range(len(cases.subject.groups)))
    doubtful = {list(cases.subject.groups)[g] for g in np.unique(cases.group[cases.doubt])}
    assert doubtful == {"nearest": {"tied"}, "triangle": {"empty"}}.get(name, set())


@pytest.mark.parametrize(
    ("name", "step"), [("plane", 3), ("camera", 7), ("nearest", 11), ("triangle", 37)]
)
def test_the_truth_is_that_of_fractions(name, step):
    """Which a bound decides; and no right answer in float64 is as far off as is allowed."""
    check_truth(name, step)


@pytest.mark.torture
@pytest.mark.parametrize("name", ["plane", "camera", "nearest", "triangle"])
def test_the_truth_is_that_of_fractions_everywhere(name):
    check_truth(name, 1)


def check_truth(name, step):
    cases = asked(name)
    [program, *_] = cases.subject.programs
    shape = cases.letters.shape
    checked = 0
    for row in range(0, shape[0], step):
        every = [(row, *rest) for rest in np.ndindex(*shape[1:])]
        hit = [place for place in every if exact_hit(program, cases.letters, place)]
        if cases.doubt[row]:
            continue
        checked += 1
        assert bool(hit) == np.isfinite(cases.right[row, 0])
        if not hit:
            continue
        names = min((exactly(program, cases.letters, p) | {"place": p} for p in hit),
                    key=lambda own: own.get("t", 0))  # fmt: skip
        names["owner"] = Fraction(names["place"][-1])
        for part, place in columns(program.parts):
            exact = [v for label in part.labels for v in np.ravel(names[label])]
            if part.unit:
                exact = [float(v) for v in exact]
                exact = [v / np.linalg.norm(exact) for v in exact]
            for value, true, most in zip(
                cases.right[row, place], exact, cases.allowed[row, place], strict=True
            ):
                assert abs(Fraction(float(value)) - Fraction(true)) <= Fraction(float(most))
    assert checked > 10


def test_pictures_are_the_certified_ones(make):
    """The project's own tracer sees the same objects, proven pixel by pixel."""
    cases = asked("picture")
    for k, found in enumerate(cases.right.reshape(-1, PIXELS)):
        (columns_, rows), orthographic, lens, sensor, scale, shifts, matrix, triangles = (
            array[k] for array in cases.given
        )
        width = scale if orthographic else sensor / lens
        half = np.array((columns_, rows)) / LONGER * width / 2
        (left, bottom), (right, top) = (sign * half + shifts * width for sign in (-1, 1))
        camera = Camera(
            np.concatenate((matrix, [[0, 0, 0, 1]])),
            ViewWindow(left, right, bottom, top),
            int(columns_),
            int(rows),
            ORTHOGRAPHIC if orthographic else PERSPECTIVE,
            clip_start=1e-6,
        )
        meshes = [Mesh(triangle, [[0, 1, 2]]) for triangle in triangles]
        frame = render(make.scene(camera, *meshes), Settings(Method.CERTIFIED))
        seen = frame.instance_index.ravel()
        assert (np.where(np.isfinite(found), found, -1) == seen).all()
        assert len(np.unique(seen)) > OBJECTS / 2


@pytest.mark.parametrize("name", NAMES)
def test_a_slip_has_its_own_name_and_no_other_gets_it(name):
    for program in subject(name).programs:
        for mutation, slip in zip(mutations(program), program.slips, strict=False):
            faults, found = find_faults(answered(name, mutation.of(program)))
            assert [f.name for f in faults] == [slip.name] and found, slip.name
            assert slip.sentence in faults[0].sentence


def check_mutations(name, step):
    """By its own sentence, or by that of one that no case tells from it."""
    unnamed = 0
    every = [(p, m) for p in subject(name).programs for m in mutations(p)]
    for program, mutation in every[::step]:
        answers = answered(name, mutation.of(program))
        faults, found = find_faults(answers)
        if not answers.wrong.any():
            assert faults == [] and found is None
        elif found is None:
            unnamed += 1  # it never hits: there is nothing to tell by
            assert not answers.hit.any() or answers.hit.mean() < 0.01
        else:
            assert len(found.wrong) == 1
            again = answered(name, found.program)
            assert alike(answers.table, again.table, program.parts)
    assert unnamed < 0.13 * len(every[::step])


@pytest.mark.parametrize(("name", "step"), [*zip(NAMES, (5, 6, 19, 2, 2), strict=True)])
def test_mutations_are_named(name, step):
    check_mutations(name, step)


@pytest.mark.torture
@pytest.mark.parametrize("name", NAMES)
def test_all_mutations_are_named(name):
    check_mutations(name, 1)


def check_orders(name, count):
    rng = np.random.default_rng(23)
    programs = subject(name).programs
    for k in range(count):
        answers = answered(name, rewritten(programs[k % len(programs)], rng))
        assert not answers.wrong.any() and answers.tally.score == 100


@pytest.mark.parametrize(("name", "count"), [*zip(OTHERS, (40, 40, 5, 40), strict=True)])
def test_right_programs_in_another_order(name, count):
    check_orders(name, count)


@pytest.mark.torture
@pytest.mark.parametrize("name", OTHERS)
def test_a_thousand_right_programs_in_another_order(name):
    check_orders(name, 1000)


def test_two_at_once_and_what_is_more_wrong():
    [program] = subject("camera").programs
    own = {m.name: m for m in mutations(program)}
    both = own["rows_from_the_top"].of(own["looks_backward"].of(program))
    assert set(names_of(answered("camera", both))) == {"rows_from_the_top", "looks_backward"}
    cases = asked("camera")
    table = program.answers(cases.letters)
    table[:, 3:] += 0.01
    assert names_of(cases.answers(table)) == ["unrecognised_answers"]


def test_ties_are_fair():
    """The other one of two that are hit at once is as right."""
    cases = asked("nearest")
    table = cases.subject.programs[0].answers(cases.letters)
    table[cases.doubt, 1] = (table[cases.doubt, 1] + 1) % 5
    answers = cases.answers(table)
    assert find_faults(answers) == ([], None) and answers.tally.score == 100
    assert answers.tally.boundary == cases.doubt.sum() > 30


def near_and_far(rng, near, far):
    """Two triangles (n, 2, 3, 3) that rays meet at weights (n, 3), scaled and moved."""
    n = len(near)
    origin, direction = rng.normal(size=(2, n, 3))
    t = np.stack((rng.uniform(2, 3, n), rng.uniform(4, 5, n)), axis=1)
    corners = rng.normal(size=(n, 2, 3, 3))
    point = origin[:, None] + t[..., None] * direction[:, None]
    point -= (np.stack((near, far), axis=1)[..., None] * corners).sum(axis=2)
    scale, position = rng.uniform(0.5, 2, (n, 2)), rng.normal(size=(n, 2, 3))
    own = (corners + (point - position)[:, :, None]) / scale[..., None, None]
    return origin, direction, own, scale, position


def test_at_an_edge_with_something_behind_it_rounding_decides():
    """Where the near one is missed exactly, too; at an edge behind what is hit, nothing does."""
    rng = np.random.default_rng(7)
    inside = rng.dirichlet((3, 3, 3), 300) * 0.7 + 0.1
    edge = rng.permuted(np.insert(rng.dirichlet((3, 3), 300) * 0.8 + 0.1, 2, 0, axis=1), axis=1)
    groups = {"several": near_and_far(rng, edge, inside), "one": near_and_far(rng, inside, edge)}
    cases = TableCases.of(subject("nearest"), groups)
    at_edge = np.repeat((True, False), 300)
    [textbook] = subject("nearest").programs
    first = {label: textbook.formulas[label] for label in ("o", "d")}
    other = replace(
        textbook,
        formulas=first | MOLLER_TRUMBORE.formulas,
        conditions=MOLLER_TRUMBORE.conditions,
    )
    skipped = cases.letters.values | {"k": cases.letters.values["k"] * (np.nan, 1)}
    for program in (textbook, other):
        table = program.answers(cases.letters)
        assert len(np.unique(table[at_edge, 1])) == 2  # it does decide
        assert not cases.answers(table).wrong.any()
        table = program.answers(replace(cases.letters, values=skipped))
        assert (cases.answers(table).wrong == ~at_edge).all()
    assert (cases.doubt == at_edge).all()


@pytest.mark.parametrize("dtype", ["int64", "uint8", "bool", "float32", "float64"])
def test_masked_answers_are_read_as_arrays(dtype):
    """What is masked is infinite, so it says that nothing is hit, in whole numbers, too."""
    form = json.loads(subject("nearest").form.to_json())
    t, objects = np.array([1.5, 2.5, 3.5]), np.array([0, 1, 0], dtype)
    plain = checked((t, objects), form, 3)
    assert (checked((t, np.ma.array(objects)), form, 3) == plain).all()
    hidden = [np.ma.array(a, mask=[False, False, True]) for a in (t, objects)]
    assert (checked(tuple(hidden), form, 3) == [[1.5, 0], [2.5, 1], [np.inf, np.inf]]).all()


def test_the_length_of_a_direction_does_not_count():
    cases = asked("camera")
    [program] = cases.subject.programs
    table = program.answers(cases.letters)
    longer = cases.subject.rows(table[:, :3] * 7.3, table[:, 3:])
    assert find_faults(cases.answers(longer)) == ([], None)
    assert names_of(cases.answers(cases.subject.rows(-table[:, :3], table[:, 3:]))) != []


PLANE = """
import numpy as np

def intersect_plane(o, d, p, n):
    dot = lambda a, b: (a * b).sum(axis=1)
    t = -dot(o - p, n) / dot(d, n)
    return np.where(t > 0, t, np.inf), o + t[:, None] * d
"""


@pytest.mark.parametrize(
    ("old", "new", "faults", "score"),
    [
        ("", "", [], 100),
        ("t = -dot", "t = dot", ["t_sign"], 100 - COST),
        ("np.where(t > 0, t, np.inf)", "t", ["hits_behind"], 94.2),
        ("(t > 0, t,", "(t > 0, -t,", ["unrecognised_answers"], 70),
    ],
)
def test_marks_of_a_file(old, new, faults, score, written):
    found = result_of(judge(written(PLANE.replace(old, new)), asked("plane")))
    assert [f.name for f in found.faults] == faults and found.errors == []
    assert found.score == score and found.verdict == ("wrong" if faults else "right")
    assert bool(found.wrong) == bool(faults)
    for case in found.wrong:
        assert set(case.given) == {"origins", "directions", "points", "normals"}
        assert case.certified != case.student


@pytest.mark.parametrize("name", OTHERS)
def test_the_command_and_all_that_it_writes(name, tmp_path, capsys):
    """The template runs; the page, the JSON and all formats are those of every subject."""
    path, out = tmp_path / "mine.py", tmp_path / "out"
    assert main(["judge", "--subject", name, "--template", str(path)]) == AGREE
    words = ["judge", "--subject", name, str(path), "--out", str(out), "--format", "csv"]
    words += ["--format", "junit", "--format", "gradescope"]
    assert main(words) == DIFFERENCES
    fault = "not_finite" if name == "camera" else "no_hits"
    assert "score 0.0 of 100" in (said := capsys.readouterr().out) and fault in said
    schema = json.loads(files(reference_tracer_grading).joinpath("judge.schema.json").read_text())
    found = json.loads((out / "judge.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(found)
    assert found["subject"] == name and found["students"][0]["wrong_cases"]
    page = (out / "judge.html").read_text(encoding="utf-8")
    assert "A wrong case" in page and f"print({subject(name).form.signature})" in page
    written = {p.name for p in out.rglob("*") if p.is_file()}
    assert {"judge.csv", "judge.xml", "results.json"} <= written
    assert main(words) == DIFFERENCES and "1 student judged before" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "text"),
    [(["--pixels", "9"], "--pixels is for"), (["scene.npz"], "scenes are for --subject triangle")],
)
def test_what_is_for_triangles_is_refused(words, text, written, capsys):
    assert main(["judge", "--subject", "plane", str(written(PLANE)), *words]) == INPUT_ERROR
    assert text in capsys.readouterr().err
