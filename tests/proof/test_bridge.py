"""What `proofs/` is about is what the tracer computes: every operation, in its order."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import prove
import pytest
import record_trees
from record_trees import proven
from recorder import coq
from recorder.arrays import Recorded, variable
from recorder.evaluate import evaluate
from recorder.functions import Numpy, recording
from recorder.nodes import RefusedError
from recorder.records import (
    BY_HAND,
    NAMES,
    RECORDS,
    computed,
    every_output,
    outputs,
    recorded,
)

ORDINARY, HOSTILE = 24, 24  # values of the variables that each function is called with


@pytest.fixture(scope="module")
def found():
    return {record: outputs(record) for record in RECORDS}


@pytest.fixture(scope="module")
def of_file():
    return dict(every_output())


def test_each_result_has_a_name_of_its_own(of_file):
    every = [output.name for some in of_file.values() for output in some]
    assert len(set(every)) == len(every)
    assert {name.split(".")[0] for name in proven()} == set(of_file) == set(NAMES)


@pytest.mark.parametrize("file", NAMES)
def test_the_proofs_are_about_what_is_computed(file, of_file):
    """If not: `make prove`, which stops at the theorems that no longer hold."""
    changed = coq.differences(file, proven(), of_file[file])
    assert not changed, "\n\n".join([f"{file}.v is not what Coq has read", *changed])


def test_a_difference_is_told_in_words(of_file):
    """Which function, which result, what it is now, and the theorem."""
    file = "RecordedBounds"
    every = of_file[file]
    digests = coq.digests(file, every)
    one = f"{file}.from_point_error"
    [said] = coq.differences(file, digests | {one: "another"}, every)
    assert said.startswith(f"{one}, bounds.FromPoint.edges: error")
    assert "theorem concerned: Forms.from_point_e" in said and "(Num 3 (-51))" in said
    [said] = coq.differences(file, digests | {"RecordedFilm.other": "of another file"}, every[1:])
    assert every[0].name in said and "nothing records it" in said
    del digests[one]
    [said] = coq.differences(file, digests, every)
    assert said.startswith(one) and "is new" in said


def test_a_digest_is_of_each_operation_and_constant(found):
    every = [output for some in found.values() for output in some]
    digests = [coq.digest(replace(output, words="renamed", name="one")) for output in every]
    texts = {coq.definition(replace(output, words="renamed", name="one")) for output in every}
    assert len(set(digests)) == len(texts) > 200


def test_what_coq_reads_is_written_as_it_is_recorded(of_file, tmp_path, monkeypatch):
    monkeypatch.setattr(record_trees, "RECORDED", tmp_path)
    assert dict(line.split() for line in record_trees.write().splitlines()) == proven()
    for file, outputs_of in of_file.items():
        text = (tmp_path / f"{file}.v").read_text(encoding="utf-8")
        assert text == coq.text(file, outputs_of)


@pytest.mark.parametrize("record", RECORDS, ids=lambda r: f"{r.function} {r.note}")
def test_an_expression_is_worth_what_the_function_returns(record, found, rng):
    """To the bit, also for numbers that a function was not recorded with: then it is the same."""
    some = samples(record, rng)
    values = {name: np.array([sample[name] for sample in some]) for name in record.values}
    results = evaluate([output.node for output in found[record]], values)
    worth = {output.name: result for output, result in zip(found[record], results, strict=True)}
    on_path = worth.pop(f"{record.name}_path", np.ones(len(some), bool))
    assert on_path[0]
    seen, whole = {output.name for output in found[record]}, []
    for k in np.flatnonzero(on_path):
        results = {n: v for n, v in computed(record, some[k]).items() if v is not None}
        whole += [k] if all(map(np.size, results.values())) else []
        seen -= set(results)
        for name, value in results.items():
            assert not np.size(value) or same(value, worth[name][k]), (name, some[k])
    assert whole[0] == 0
    for k in whole[:3]:
        again = recorded(record, some[k])
        seen -= {output.name for output, _ in again}
        assert [output for output, _ in again] == found[record]
        for output, value in again:
            assert output.name not in worth or same(value, worth[output.name][k])
    assert not seen


def test_a_theorem_that_is_said_to_be_proven_is_there(of_file):
    paths = {path.stem: path for path in prove.files()}
    named = {output.theorem for some in of_file.values() for output in some}
    for theorem in sorted(named - {"", BY_HAND}):
        file, name = theorem.split(".")
        text = paths[file].read_text(encoding="utf-8")
        proven = re.findall(r"^ *(?:Theorem|Corollary|Lemma) ([\w']+)", text, re.M)
        assert name in proven, f"{file}.v has no theorem {name}"


# The theorem that is named beside these is about the same formula as people have read it.
TRANSCRIBED = {
    *(f"around_{name}_{k}" for name in ("reach", "low", "high") for k in "xyz"),
    *("pair_enters", "pair_open_stays", "hidden_instance", "not_hidden_box", "not_hidden_fragment"),
    *("film_perspective_finite", "film_parallel_finite"),
}


def test_a_proof_imports_what_is_recorded(of_file):
    texts = (prove.without_comments(path.read_text(encoding="utf-8")) for path in prove.files())
    words = {word for text in texts for word in re.findall(r"[\w']+", text)}
    of_theorems = {
        output.name
        for some in of_file.values()
        for output in some
        if output.theorem not in ("", BY_HAND)
    }
    assert of_theorems - words == TRANSCRIBED


def samples(record, rng):
    """The values of a record; some near them; and some of any size, and small integers."""
    values = record.values
    names = [name for name in values if not isinstance(values[name], bool)]
    given = {name: value for name, value in values.items() if isinstance(value, bool)}
    out = [dict(values)]
    for k in range(ORDINARY):
        size = 10.0 ** -rng.integers(1, 16)
        near = {name: values[name] * (1 + size * rng.normal()) for name in names}
        out.append(near | {name: bool(k % 2) for name in given})
    for k in range(HOSTILE):
        exponents = rng.integers(-300, 300, len(names)) if k % 3 else np.zeros(len(names))
        numbers = rng.normal(size=len(names)) if k % 2 else rng.integers(-2, 3, len(names))
        some = dict(zip(names, (numbers * 2.0**exponents).tolist(), strict=True))
        out.append(some | {name: bool(k % 2) for name in given})
    for name, domain in record.domain.items():
        for sample in out[1:] if name in values else ():
            sample[name] = float(rng.choice(domain))
    return out


def same(value, worth):
    """Open is the sign of zero, as of a maximum of two zeros, and NaN made an integer."""
    value = np.asarray(value).reshape(-1)[0]
    is_open = np.isnan(worth) and (np.isnan(value) or np.issubdtype(value.dtype, np.integer))
    return bool(value == worth or is_open)


@pytest.fixture
def x():
    with recording():
        yield Recorded(*(np.concatenate([k] * 3) for k in vars(variable("x", 2.0)).values()))


REFUSED = {
    "@": lambda x, np: x @ x,
    "plain @": lambda x, _: np.ones((2, 3)) @ x,
    "einsum": lambda x, np: np.einsum("i,i", x, x),
    "dot": lambda x, np: np.dot(x, x),
    ".dot": lambda x, np: x.dot(x),
    "inner": lambda x, np: np.inner(x, x),
    "matmul": lambda x, np: np.matmul(x, x),
    "tensordot": lambda x, np: np.tensordot(x, x, 1),
    "sum": lambda x, np: np.sum(x),
    ".sum": lambda x, np: x.sum(),
    "prod": lambda x, np: np.prod(x),
    ".mean": lambda x, np: x.mean(),
    "cumsum": lambda x, np: np.cumsum(x),
    "add.reduce": lambda x, np: np.add.reduce(x),
    "linalg": lambda x, np: np.linalg.norm(x),
    "sqrt": lambda x, np: np.sqrt(x),
    "power": lambda x, np: x**2,
    "float32": lambda x, np: x.astype(np.float32),
    "a float32 number": lambda x, _: x * np.float32(2),
    "a plain array for the result": lambda x, _: np.add(x, x, out=np.ones(3)),
    "a plain array += it": lambda x, _: np.ones(3).__iadd__(x),
    "a plain array of it": lambda x, _: np.asarray(x),
    "numpy's own, which would lose it": lambda x, _: np.abs([x, x]),
    "what was not written": lambda x, np: np.empty(3) + x,
    "a mask that keeps no high digits": lambda x, _: x.view(np.int64) & np.int64(0xFF),
    "rint": lambda x, np: np.rint(x),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_has_no_word_is_refused(what, x):
    with pytest.raises(RefusedError):
        REFUSED[what](x, Numpy())
