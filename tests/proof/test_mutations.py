"""The bridge is watched itself: where the code of a copy is changed, it no longer holds."""

from __future__ import annotations

import pytest

from ..copied import copied
from ..sampled import daily
from .mutants import Mutant, checked

pytestmark = pytest.mark.slow  # a Python of its own for each

BOUNDS = "certified/bounds.py"
EDGES = "certified/sweep/edge_functions.py"
# What is changed, in which file, and what the failure says of it.
CHANGES = {
    "6 roundings instead of 12": (
        BOUNDS,
        ("BOUND = 12 * U", "BOUND = 6 * U"),
        ("from_point_error, bounds.FromPoint.edges", "theorem concerned", "Num 3 (-52)"),
    ),
    "the other form of an edge function": (
        BOUNDS,
        ("sides = (b - a, c - b, a - c)", "sides = (b - origins, c - origins, a - origins)"),
        ("from_point_ab, bounds.FromPoint.edges", 'Sub (Var "bz") (Var "oz")'),
    ),
    "nothing for gradual underflow": (
        BOUNDS,
        (" + SLACK * (1 + w[0] + w[1] + w[2])", ""),
        ("plane_T_error, bounds.plane_fractions",),
    ),
    "the interval is not rounded outwards": (
        BOUNDS,
        ("np.nextafter(t + error, np.inf)", "t + error"),
        ("interval_high, bounds.Fractions.interval",),
    ),
    "one rounding more in the sweep": (
        EDGES,
        (
            "np.subtract(q[a] * w[b], w[a] * q[b]",
            "np.subtract(q[a] * w[b] * 1.5 / 1.5, w[a] * q[b]",
        ),
        ("set_up_perspective_bc_x, edge_functions.set_up", "Num 3 (-1)"),
    ),
    "a nearness without slack": (
        EDGES,
        ("error / least + (2 * film.ray_error + 16 * U)", "error / least"),
        ("set_up_perspective_nearness_error, edge_functions.set_up",),
    ),
    "a plane's nearness without slack": (
        "certified/sweep/depth_buffer.py",
        ("(1 - room) / high, (1 + room)", "1 / high, 1"),
        ("plane_pixel_perspective_least, sweep.Sweep.enter_planes",),
    ),
    "sure at the error itself": (
        "certified/sweep/rasterise.py",
        ("> gather(own.edge_error, row)", ">= gather(own.edge_error, row)"),
        ("block_sure, rasterise._block",),
    ),
    "an order that two floats may not have": (
        "certified/order.py",
        ("np.abs(value) > error", "np.abs(value) > 0"),
        ("order_from_point_known, order.order_of",),
    ),
    "half as much for the rays and the dual axes": (
        "tracer/candidates.py",
        ("SAFETY = 64", "SAFETY = 32"),
        ("film_place_perspective_slope, film.Film.place",),
    ),
    "a digit less in the highest": (
        "certified/quotient.py",
        ("-1 << 27", "-1 << 28"),
        ("highest, quotient.highest", "Keep 25"),
    ),
    "a sum whose order numpy chooses": (
        "tracer/vector.py",
        ("a[0] * b[0] + a[1] * b[1] + a[2] * b[2]", "np.stack(list(a * b)).sum(axis=0)"),
        ("RefusedError", "numpy chooses the order of a sum", "bounds.FromPoint"),
    ),
    "a matrix product": (
        "tracer/vector.py",
        ("a[0] * b[0] + a[1] * b[1] + a[2] * b[2]", "a.T @ b"),
        ("RefusedError", "numpy chooses the order of its sums", "bounds.FromPoint"),
    ),
}


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied(tmp_path_factory.mktemp("copy"))


def changed(copy, path, old, new):
    """Record a copy with one text in one file changed, which then is as it was."""
    return checked(copy, Mutant("", path, old, new, "expressions"))


@pytest.mark.parametrize("what", daily(CHANGES))
def test_a_change_breaks_the_bridge(copy, what):
    path, change, said = CHANGES[what]
    result = changed(copy, path, *change)
    assert result.returncode
    told = " ".join(result.stderr.split())
    for words in said:
        assert words in told


def test_what_changes_no_operation_does_not(copy):
    result = changed(copy, BOUNDS, "U = 2.0**-53", "U = 2.0**-52 / 2  # the same")
    assert not result.returncode, result.stderr
