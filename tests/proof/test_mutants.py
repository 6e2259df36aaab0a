"""Each wrong version of the certified code is noticed by the check that is said to notice it."""

from __future__ import annotations

import pytest

from ..copied import copied
from .mutants import CHECKS, MUTANTS, Mutant, checked

# Every day; all of them in `make torture`.
SAMPLE = {
    "an edge is a miss",
    "the highest name is seen",
    "alone at an edge is clear",
    "the farther candidate wins",
}


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied(tmp_path_factory.mktemp("copy"))


def marked(mutant: Mutant):
    """Return a mutant as a test's parameter."""
    marks = pytest.mark.slow if mutant.what in SAMPLE else pytest.mark.torture
    return pytest.param(mutant, id=mutant.what, marks=marks)


@pytest.mark.parametrize("mutant", [marked(mutant) for mutant in MUTANTS])
def test_it_is_noticed(copy, mutant):
    result = checked(copy, mutant)
    assert result.returncode
    said = "wrong: " if mutant.check == "judge" else "than Coq has read"
    assert said in result.stderr, result.stderr


@pytest.mark.torture
@pytest.mark.parametrize("check", CHECKS)
def test_the_code_as_it_is_passes(copy, check):
    result = checked(copy, Mutant("nothing", "certified/exact.py", "", "", check))
    assert not result.returncode, result.stderr


def test_each_is_of_a_text_that_is_there(copy):
    texts = {mutant.file: (copy / mutant.file).read_text("utf-8") for mutant in MUTANTS}
    assert not [m.what for m in MUTANTS if m.old not in texts[m.file] or m.old == m.new]
