"""Of what `frexp` returns, only what the record of a conversion has a word for is recorded."""

from __future__ import annotations

import numpy as np
import pytest
from recorder.nodes import RefusedError
from recorder.records.conversions import _floats, _Limit
from recorder.whole import Asked, term, tree
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
    ("error", "convert"),
    [
        (RefusedError, lambda np_, v: (np_.frexp(v)[0] * 2.0).astype(np.int32)),
        (RefusedError, lambda np_, v: np_.frexp(v)[0] == 0.5),
        (TypeError, lambda np_, v: np_.frexp(v)[0] + 1.0),
        (TypeError, lambda np_, v: np.rint(np_.frexp(v)[0])),
        (KeyError, lambda np_, v: np_.frexp(2 * v)),
    ],
)
def test_anything_else_is_refused(error, convert):
    """By the recorder in words, or because its numbers cannot do it."""
    with pytest.raises(error, match=r"mantissa|_Mantissa|rint|2\.828"):
        of_one_float(convert)


def test_a_clip_limit_is_compared_with_0_alone():
    """Another number is another range, and not recorded as 0."""
    assert isinstance(_Limit("start") == 0, Asked)
    with pytest.raises(RefusedError, match="compared with 1"):
        assert _Limit("start") == 1
