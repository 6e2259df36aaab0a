"""Of what `frexp` returns, only what the record of a conversion has a word for is recorded."""

from __future__ import annotations

import numpy as np
import pytest
from recorder.nodes import RefusedError
from recorder.records.conversions import _floats
from recorder.whole import term, tree
from reference_tracer.certified import integers


def of_one_float(convert):
    """Return what is recorded of a conversion, given numpy as the module has it and a float."""

    def call():
        with _floats(integers, "x") as given:
            return convert(vars(integers)["np"], np.array(given))

    return tree(call)


def test_a_mantissa_is_multiplied_and_then_rounded_and_cut_off():
    def digits(numpy, values):
        return term((numpy.frexp(values)[0] * 3.0).astype(np.int64)[0])

    product = "(Ztrunc (rnd ((mantissa x) * (IZR 3 * bpow radix2 0))%R))"
    assert of_one_float(digits) == f"(if (Req_bool x 0) then 0 else {product})"


@pytest.mark.parametrize(
    "convert",
    [
        lambda numpy, values: (numpy.frexp(values)[0] * 2.0).astype(np.int32),
        lambda numpy, values: numpy.frexp(values)[0] == 0.5,
        lambda numpy, values: numpy.frexp(values)[0] + 1.0,
        lambda numpy, values: np.rint(numpy.frexp(values)[0]),
        lambda numpy, values: numpy.frexp(2 * values),
    ],
)
def test_anything_else_is_refused(convert):
    with pytest.raises((RefusedError, TypeError, KeyError)):
        of_one_float(convert)
