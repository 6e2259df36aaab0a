"""The self-test finds what breaks the proof, and what is asked for then happens.

Rounding and subnormals are switched for a whole thread: each case is a process of its own.
"""

from __future__ import annotations

import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import arithmetic
from reference_tracer.certified.arithmetic import (
    AssumptionError,
    broken_assumptions,
    check_assumptions,
)
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings

from .modes import ON_X86

UP, DOWN, TO_ZERO = 0x800, 0x400, 0xC00  # of fesetround, on x86

SWITCH = """
import ctypes
import numpy as np
from reference_tracer.scene import Camera, Instance, Mesh, Scene, ViewWindow
from reference_tracer.certified.arithmetic import AssumptionError, broken_assumptions
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings

libm = ctypes.CDLL("libm.so.6")
triangle = Mesh([(-9.0, -9, -2), (9, -9, -2), (0, 9, -2)], [[0, 1, 2]])
camera = Camera(np.eye(4), ViewWindow(-0.5, 0.5, -0.5, 0.5), 3, 2)
scene = Scene(camera, (triangle,), (Instance(0, 0, np.eye(4)),), objects=("A",))
assert broken_assumptions() == []

def set_rounding(mode):
    assert libm.fesetround(mode) == 0

def set_mxcsr(bits):  # 0x8000 flushes results to zero, 0x40 takes subnormal operands for zero
    environment = (ctypes.c_uint32 * 8)()
    libm.fegetenv(environment)
    environment[7] |= bits
    libm.fesetenv(environment)

SWITCH
print("|".join(broken_assumptions()))
try:
    render(scene, Settings("certified"))
except AssumptionError as error:
    print(error)
frame = render(scene, Settings("auto"))
print(frame.statistics.method, int(frame.certainty.max()), (frame.instance_index == 0).all())
print(" ".join(frame.statistics.required()))
"""


def switched(how: str) -> list[str]:
    """Return what a process says that switches its arithmetic so: four lines."""
    result = subprocess.run(
        [sys.executable, "-c", SWITCH.replace("SWITCH\n", how + "\n")],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert result.returncode == 0, result.stderr
    return result.stdout.splitlines()


@ON_X86
@pytest.mark.parametrize(
    "how, lacks",
    [
        (f"set_rounding({UP})", {"rounding to nearest"}),
        (f"set_rounding({DOWN})", {"rounding to nearest"}),
        (f"set_rounding({TO_ZERO})", {"rounding to nearest"}),
        ("set_mxcsr(0x8000)", {"subnormal results"}),
        ("set_mxcsr(0x40)", {"subnormal operands"}),
        ("set_mxcsr(0x8040)", {"subnormal results", "subnormal operands"}),
    ],
)
def test_a_changed_arithmetic_is_found(how, lacks):
    found, refusal, auto, said = switched(how)
    assert lacks <= set(found.split("|"))
    assert ("rounding" in found) == ("rounding" in how)
    assert "nothing can be certified" in refusal and all(words in refusal for words in lacks)
    assert auto == f"watertight {int(Certainty.NOT_CERTIFIED)} True"
    assert "traced by watertight in float64" in said and refusal in said


@ON_X86
def test_an_arithmetic_that_is_as_it_should_be():
    found, auto, said = switched("set_rounding(0)")
    assert found == "" and auto.startswith("certified") and "error bound" in said


def test_here_it_is_as_it_should_be():
    assert broken_assumptions() == []
    check_assumptions()


@pytest.mark.parametrize("number", range(len(arithmetic._RUNS)))
def test_each_function_is_asked(monkeypatch, number):
    """In its last element, a scalar's where the others were a register's, one bit is another."""
    run = arithmetic._RUNS[number]

    def other(*inputs):
        out = np.array(run.function(*inputs))
        out.view(np.int64)[-1] ^= 1
        return out

    runs = [*arithmetic._RUNS]
    runs[number] = run._replace(function=other)
    monkeypatch.setattr(arithmetic, "_RUNS", runs)
    assert broken_assumptions() == [run.checked[-1]]


def test_what_is_asked_of_numpy_are_the_functions_that_decide():
    asked = {run.function for run in arithmetic._RUNS}
    assert {np.add, np.subtract, np.multiply, np.divide, np.maximum, np.nextafter} < asked
    strides = {run.inputs[0].strides[0] for run in arithmetic._RUNS if run.function is np.add}
    assert strides == {8, 16}


def test_numbers_that_x87_rounds_twice_are_among_them():
    """To 64 digits, and again to 53, or to a subnormal: another result each time."""
    tie = Fraction(1) + Fraction(1, 2**53)
    exact = tie + Fraction(1, 2**78)
    assert float(exact) == 1 + 2.0**-52 and float(tie) == 1
    assert 1 + float(exact - 1) == 1 + 2.0**-52
    product = Fraction(1 + 2.0**-30) ** 2 / 2**1046
    first = Fraction(float(product * 2**99)) / 2**99
    assert float(product) == (2**28 + 1) * 2.0**-1074 != float(first)


@pytest.mark.parametrize(
    "machine, bits, refused",
    [
        ("i686", 32, True),
        ("x86_64", 32, True),  # a 32-bit program on a 64-bit system
        ("AMD64", 32, True),
        ("x86_64", 64, False),
        ("AMD64", 64, False),
        ("armv7l", 32, False),
        ("wasm32", 32, False),
        ("arm64", 64, False),
    ],
)
def test_where_x87_may_compute_nothing_is_certified(monkeypatch, machine, bits, refused):
    assert arithmetic.has_x87(machine, bits) == refused
    monkeypatch.setattr(arithmetic, "_X87", arithmetic.has_x87(machine, bits))
    assert [("x87" in lack) for lack in broken_assumptions()] == [True] * refused


def test_certified_refuses_and_auto_falls_back(make, broken_arithmetic):
    scene = make.scene(make.camera(5, 4), make.quad(-9, 9, -9, 9.3, -2))
    with pytest.raises(AssumptionError, match=r"rounding to nearest.*choose another method"):
        render(scene, Settings("certified"))
    frame = render(scene, Settings("auto"))
    plain = render(scene, Settings("watertight"))
    assert frame.statistics.method == plain.statistics.method == "watertight"
    assert (frame.certainty == Certainty.NOT_CERTIFIED).all() and not frame.ties
    assert np.array_equal(frame.t, plain.t) and frame.color.tobytes() == plain.color.tobytes()
    assert len(frame.statistics.notes) == 1 and "watertight" in frame.statistics.notes[0]
    assert frame.statistics.required() == frame.statistics.notes
    assert not plain.statistics.notes


def test_plain_methods_do_not_ask(make, broken_arithmetic):
    scene = make.scene(make.camera(5, 4), make.quad(-9, 9, -9, 9.3, -2))
    for method in ("textbook_literal", "textbook", "moller_trumbore", "watertight"):
        assert not render(scene, Settings(method)).statistics.notes


def test_auto_is_certified_here(make):
    scene = make.scene(make.camera(5, 4), make.quad(-9, 9, -9, 9.3, -2))
    frame, certified = (render(scene, Settings(m)) for m in ("auto", "certified"))
    assert frame.statistics.method == "certified" and not frame.statistics.notes
    for name, values in frame.passes().items():
        assert values.tobytes() == certified.passes()[name].tobytes(), name
