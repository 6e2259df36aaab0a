"""Every number in the code of what is certified is one that a proof is about, or tunes speed."""

from __future__ import annotations

import ast
import importlib
from collections import defaultdict

import pytest
from recorder.nodes import in_order
from recorder.records import BY_HAND, RECORDS, outputs
from reference_tracer.tracer import candidates

from .constants import FOLDER, numbers, of_module

U = 2.0**-53
_STEP = "how much is worked on at a time: each pair is decided as if it were alone"
_ROOM = "how much memory is taken: what does not fit is swept in halves, with the same bounds"
_BINS = "the order in which triangles are swept: the depth buffer holds sure hits in any order"
_SHARE = "the share of the work that is shown to the user"

# What only makes it faster or slower: by module, and the expression. Why it can't be wrong.
TUNING = {
    "sweep.film": {"0.25": "where the bounds hold: the premise `ray_error_small` of Perspective.v"},
    "plain": {"_ROWS": _STEP},
    "any_rays": {"_FEW": "from how many pairs a tree of boxes is worth while"},
    "ladder": {"BY_ORDER": _STEP, "BY_INTEGERS": _STEP},
    "sweep.depth_bins": {
        **dict.fromkeys(("_FIRST", "BINS", "BINS - 1", "_GROWTH", "_GROWTH - 1"), _BINS),
        **dict.fromkeys(("2", "3"), _BINS),
    },
    "sweep.boxes": {"2": "the bytes of a kind of integer"},
    "surfaces": {"40503": "the place of a name in a table: it is found by its name"},
    "sweep.depth_buffer": dict.fromkeys(
        ("FINE", "COARSE", "COARSE // FINE", "2 * FINE"),
        "the size of a cell of pixels: integers; a cell has the least nearness of its pixels",
    ),
    "sweep.rasterise": dict.fromkeys(
        ("FINE", "COARSE"), "the size of a cell of pixels: what no edge rules out is kept"
    ),
    "sweep.sweep": {
        "_PAIRS": _STEP,
        "_FRAGMENTS": _ROOM,
        "0.75": _ROOM,
        "2": _SHARE,
        "0.6": _SHARE,
    },
    "sweep.resolve": {"_FRAGMENTS": _STEP},
}
# What reaches an expression only as a part of another number: these.
FOLDED = {
    ("sweep.depth_buffer", "ROUNDING"): (1 - 4 * U, 1 + 4 * U),
    ("sweep.depth_buffer", "-ROUNDING"): (1 - 4 * U, 1 + 4 * U),
    ("sweep.sweep", "ROUNDING"): (1 - 4 * U, 1 + 4 * U),
    **dict.fromkeys((("quotient", "-1 << 27"), ("quotient", "_TOP")), (("Keep", 26),)),
    **dict.fromkeys((("quotient", "2047 << 52"), ("quotient", "_EXPONENT")), (("Keep", 1),)),
}
# Of what is argued by hand, and not in Coq (docs/proof.md lists it): by module, and the expression.
HAND = {
    "samples": {"0.5": "where in its pixel a sample is: which row and column that makes, exactly"},
    "sweep.boxes": {
        "4": "the boxes of instances: what lies between the corners is rounded like them",
        "0.25 * _MARGIN": "the boxes of instances: a corner is off by less than their margin",
    },
    "sweep.film": {"_HUGE": "with_room: of what may be larger, the size is taken to be infinite"},
}
# Proven otherwise than by an expression of floats.
ELSEWHERE = {
    **dict.fromkeys(
        ("arithmetic", "known_results"),
        "bits that this process's arithmetic is asked for: the proofs take IEEE 754 so",
    ),
    "reasons": "words for the user, of what integers have decided",
    "integers": "frexp's mantissa has 53 digits, so that 2^53 of it are an integer: `digits_is`",
    "rounding": "the roundings before the proof, which is about stored rays and corners: "
    "test_rounding.py holds their bounds against fractions",
    "sweep.small_triangles": "float32 and a matrix product, which Trees.v has no word for; what "
    "is left out is held to be met by no ray, in fractions, by test_dropped.py",
    **dict.fromkeys(
        ("tree", "triangle_tree"),
        "which triangles any rays may meet, argued by hand at its head: what is found is held to "
        "be what every pair has by test_tree.py",
    ),
    "measures": "of barycentrics, whose bound is argued by hand: below it, integers divide",
}


@pytest.fixture(scope="module")
def known():
    """The numbers in the expressions of a module's functions that a theorem is about."""
    out = defaultdict(set)
    for record in RECORDS:
        module = record.function.split(".")[0]
        for output in outputs(record):
            if output.theorem not in ("", BY_HAND) or output.name.endswith("_path"):
                for node in in_order([output.node]):
                    if node.kind == "Num":
                        m, e = node.args
                        out[module] |= {m * 2.0**e, -m * 2.0**e}
                    if node.kind == "Keep":
                        out[module].add(("Keep", node.args[0]))
    return out


def unaccounted(found, known):
    """Return the numbers that are not of a proof, nor of a table here."""
    every = set().union(*known.values())
    for number in found:
        own = known[number.module.split(".")[-1]]
        key = number.module, number.text
        if not (
            number.value in (-1, 0, 1)  # a count, an index, an axis or a sign
            or number.module in ELSEWHERE
            or number.value in own
            or number.text in TUNING.get(number.module, ())
            or number.text in HAND.get(number.module, ())
            or (key in FOLDED and all(value in every for value in FOLDED[key]))
        ):
            yield number


def test_every_number_is_accounted_for(known):
    found = list(unaccounted(numbers(), known))
    assert not found, (
        "no theorem of proofs/ is about these numbers, and tests/proof/test_constants.py doesn't "
        "say why they need none:\n" + "\n".join(map(str, found))
    )


def test_the_tables_name_what_there_is():
    found = {(n.module, n.text) for n in numbers()}
    named = {(module, text) for module, texts in TUNING.items() for text in texts} | set(FOLDED)
    assert sorted(named - found) == []
    assert set(ELSEWHERE) <= {module for module, _ in found}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("BOUND * magnitude", "BOUND * 1.5 * magnitude", "BOUND * 1.5"),
        ("* _LOOSE + SLACK", "* _LOOSE + 3e-300", "3e-300"),
        ("size > own)", "size > 1.25 * own)", "1.25"),
    ],
)
def test_a_new_number_is_found(known, old, new, said):
    source = (FOLDER / "bounds.py").read_text(encoding="utf-8")
    assert old in source
    module = importlib.import_module("reference_tracer.certified.bounds")
    found = list(unaccounted(of_module(module, "bounds", source.replace(old, new)), known))
    assert [number.text for number in found] == [said]
    assert str(found[0]).startswith("bounds.py, line ") and ast.parse(found[0].text)


def test_the_film_has_the_numbers_of_its_premises():
    """`lengths` and `not_flat` of Perspective.v, `well_apart_holds` of FitParallel.v, 64 eps."""
    assert (candidates.MIN_DETERMINANT, candidates.LENGTHS) == (1 / 8, (0.5, 2.0))
    assert candidates.SAFETY == 64
