"""What may be chosen; and what may not says what may."""

from __future__ import annotations

import pytest
from reference_tracer.methods import Method
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.settings import Precision, Settings
from reference_tracer.tracer.triangle import TESTS

PLAIN = {m for m in Method if not m.is_proven}


def test_the_default_is_the_best_there_is():
    assert Settings() == Settings("auto", "float64", 1)
    assert isinstance(Settings().method, Method) and isinstance(Settings().precision, Precision)


def test_plain_methods_have_both_precisions_and_a_function():
    assert TESTS.keys() == PLAIN
    assert PLAIN == set(Method) - {Method.CERTIFIED, Method.AUTO}
    assert {Settings(m, p).precision for m in PLAIN for p in Precision} == set(Precision)


@pytest.mark.parametrize("method", ["certified", "auto"])
def test_a_proof_is_for_float64(method):
    assert Settings(method, "float64").method == method
    with pytest.raises(ValueError, match="float32") as caught:
        Settings(method, "float32")
    message = str(caught.value)
    assert method in message and "float64" in message
    assert all(m.value in message for m in PLAIN)


@pytest.mark.parametrize(
    "name, choices", [("method", Method), ("precision", Precision), ("color", Color)]
)
def test_what_is_not_a_choice_names_them_all(name, choices):
    for value in ("magic", "", None, 3):
        with pytest.raises(ValueError, match=name) as caught:
            Settings(**{name: value})
        assert all(c.value in str(caught.value) for c in choices)


@pytest.mark.parametrize("wrong", [{"samples": 0}, {"samples": 65}, {"memory": 1000}])
def test_numbers_out_of_range(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Settings(**wrong)
