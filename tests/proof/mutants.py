"""Wrong versions of the certified code, and the check that notices each.

    .venv/bin/python -m tests.proof.mutants    # makes each, runs its check: one table

- *expressions*: `tools/record_trees.py --check`, of the expressions of floats;
- *integers*: the same, of whole functions of integers;
- *checker*: the same, of the checker of certificates;
- *judge*: small scenes, whose rays meet edges, corners and several surfaces at once, by the sweep
  and by `plain`; owner, certainty, t and ties against `tests/oracle.py` and `tests/moved.py`, which
  share nothing with the tracer's own exact path.
"""

from __future__ import annotations

import itertools
import os
import sys
import tempfile
from pathlib import Path
from subprocess import CompletedProcess
from typing import NamedTuple

from ..copied import TOOLS, copied, run

ROOT = str(Path(__file__).resolve().parents[2])
WHOLE = """
import sys
sys.path.append({tools!r})
import record_trees
from recorder import coq
from recorder.records import WHOLE
proven, changed = record_trees.proven(), []
for file in {files!r}:
    found = [record.output() for record in WHOLE[file][0]]
    changed += coq.differences(file, proven, found)
sys.exit("\\n\\n".join(changed) or 0)
"""
CHECKS = {
    "expressions": f"""
import sys
sys.path.append({TOOLS!r})
sys.argv = ["record_trees.py", "--check"]
import record_trees
record_trees.main()
""",
    "integers": WHOLE.format(tools=TOOLS, files=("RecordedIntegers", "RecordedConversions")),
    "checker": WHOLE.format(tools=TOOLS, files=("RecordedChecker", "RecordedConversions")),
    "judge": f"""
import sys
sys.path.append({ROOT!r})
from tests.proof.judged import wrong_answers
if wrong := wrong_answers():
    sys.exit(f"wrong: {{', '.join(sorted(wrong))}}")
""",
}
_TIMES = itertools.count(1_000_000_000, 10)


class Mutant(NamedTuple):
    """What is changed, in which file, from which text to which, and which check notices it."""

    what: str
    file: str
    old: str
    new: str
    check: str


# By check: what is changed, in which file, from which text to which.
_TABLE = {
    # Floats.
    "expressions": (
        ("t's error is half of it", "certified/quotient.py", "_DOT = 2.0**-72", "_DOT = 2.0**-73"),
        (
            "no room for the bounds' roundings",
            "certified/quotient.py",
            "_LOOSE = 1.01",
            "_LOOSE = 1.0",
        ),
        (
            "likewise of t's interval",
            "certified/bounds.py",
            "_LOOSE = 1 + 2.0**-48",
            "_LOOSE = 1.0",
        ),
        ("no error of t's own rounding", "certified/bounds.py", "(error + U * np.abs(t))", "error"),
        (
            "the sign of D1 D2 is forgotten",
            "certified/order.py",
            "* columns[4]",
            "* np.abs(columns[4])",
        ),
        (
            "sure at the clip start",
            "certified/ladder.py",
            "(low > start) & (",
            "(low >= start) & (",
        ),
        (
            "a miss at the error itself",
            "certified/ladder.py",
            "(low < -error) & (high > error)",
            "(low <= -error) & (high >= error)",
        ),
        (
            "what may be as near is dropped",
            "certified/ladder.py",
            "& (low <= self._farthest[ray])",
            "& (low < self._farthest[ray])",
        ),
        ("half of the rays' error", "certified/sweep/film.py", "24 * _EPS", "12 * _EPS"),
        ("a t that is not finite is taken", "certified/measures.py", "& np.isfinite(t) ", ""),
        (
            "a fragment as near is dropped",
            "certified/sweep/depth_buffer.py",
            "some.nearest < gather(self.nearness",
            "some.nearest <= gather(self.nearness",
        ),
        *(
            (what, "../reference_tracer_verify/verify.py", old, new)
            for what, old, new in (
                ("a sixty-fourth of the checker's bound", "2.0**-44 *", "2.0**-50 *"),
                ("no room for its underflow", " + 2.0**-1040 * (1 + reach)", ""),
                ("its D has no error", "np.abs(far) * reach[1] + reach[0]", "reach[0]"),
                ("what overflows has a sign", "np.isfinite(value - reach)", "True"),
                ("boxes without their rounding", " * (1 + 2.0**-50)", ""),
                ("one corner beside is enough", "above[5:].all(", "above[5:].any("),
            )
        ),
    ),
    # Integers, and who is seen.
    "integers": (
        (
            "a component of n has another sign",
            "certified/exact.py",
            "ab[1] + bc[1] + ca[1]",
            "ab[1] + bc[1] - ca[1]",
        ),
        ("an edge is a miss", "certified/exact.py", "min(edges) < 0 <", "min(edges) <= 0 <"),
        (
            "the clip range is open",
            "certified/exact.py",
            "abs(denominator)) < 0",
            "abs(denominator)) <= 0",
        ),
        (
            "no hit at t = 0",
            "certified/exact.py",
            "if not numerator and self._open",
            "if not numerator",
        ),
        (
            "the sign of D1 D2 is forgotten in `gap`",
            "certified/exact.py",
            "return apart if (first.denominator > 0) == (second.denominator > 0) else -apart",
            "return apart",
        ),
        (
            "likewise for the moved ray",
            "certified/exact.py",
            "return sign if (first.denominator > 0) == (second.denominator > 0) else -sign",
            "return sign",
        ),
        (
            "the origin moves always",
            "certified/exact.py",
            "if not value and m == ZERO",
            "if not value",
        ),
        (
            "crossed from one side alone",
            "certified/exact.py",
            "signs in ({1}, {-1})",
            "signs == {1}",
        ),
        ("t by another power of two", "certified/exact.py", "denominator <<= -self._shift", "pass"),
        (
            "w has another sign",
            "certified/order.py",
            "by1 * b - by2 * a",
            "by2 * a - by1 * b",
        ),
        (
            "the highest name is seen",
            "certified/ties.py",
            "name < hits[best][0]",
            "name > hits[best][0]",
        ),
        (
            "what is as near is not in front",
            "certified/ties.py",
            "gap(m, least) <= 0",
            "gap(m, least) < 0",
        ),
        (
            "a clip limit is another power of two",
            "certified/exact.py",
            "self._shift + power.bit_length() - 1",
            "self._shift + power.bit_length()",
        ),
        ("the range is open at 1", "certified/exact.py", "start == 0", "start == 1"),
        (
            "t's power of two is a sum",
            "certified/exact.py",
            "= exponent - direction_exponent",
            "= exponent + direction_exponent",
        ),
        (
            "the last ray is taken as the first",
            "certified/exact.py",
            "dot(self.directions[0], n), n",
            "dot(self.directions[-1], n), n",
        ),
        ("an integer is halved as a float", "certified/order.py", "/ (1 <<", "/ (2 <<"),
        *(
            (what, "certified/integers.py", old, new)
            for what, old, new in (
                ("a mantissa loses a digit", "mantissa * 2.0**53", "mantissa * 2.0**52"),
                ("the power of two is doubled", "least - 53", "least - 52"),
                ("the power of two is the first", "[~zero].min()", "[~zero][0]"),
                ("zeros are shifted otherwise", "exponent[zero] = least", "exponent[zero] = 0"),
            )
        ),
    ),
    # The checker of certificates.
    "checker": tuple(
        (what, "../reference_tracer_verify/verify.py", old, new)
        for what, old, new in (
            ("an edge is no hit", "min(signs) < 0 <", "min(signs) <= 0 <"),
            ("where the ray begins is a hit", " or top == start == 0", ""),
            ("before the clip start is a hit", "below - start", "below + start"),
            ("after the clip end is a hit", "bottom - top * above", "bottom + top * above"),
            ("n has the other sign", "edges[0][1], edges[1][1]", "edges[1][1], edges[0][1]"),
            ("crossed from before alone", "self.bottom * moved(*", "moved(*"),
            ("the sign of D1 D2 is no matter", " * self.bottom * other.bottom", ""),
            ("the higher name is before", "self.name < other", "self.name > other"),
            ("the origin moves, too", "if not any(m)", "if m"),
            ("the origin moves one way", "for along in (d, *moves)", "for along in (d,)"),
            ("as near is not in front of the inside", "h.at <= other.at", "h.at < other.at"),
            ("alone at an edge is clear", "min(1, len(inside))", "1"),
            ("the ray moves along y first", "((1, 0, 0), (0, 1, 0),", "((0, 1, 0), (1, 0, 0),"),
            ("the last that is crossed is first", "b if b.is_before(a, moves) else a", "b"),
            ("a float's last digit is cut off", "mantissa * 2.0**53", "mantissa * 2.0**52"),
            ("a float is doubled in its integer", "power - 53 - exponent", "power - 52 - exponent"),
            (
                "the common power of two is doubled",
                ".min(initial=0)) - 53",
                ".min(initial=0)) - 52",
            ),
            (
                "the common power of two is the first",
                "[1].min(initial=0)",
                "[1][:1].min(initial=0)",
            ),
        )
    ),
    # What no theorem notices: settling, ties, candidates.
    "judge": (
        (
            "ties are called exact",
            "certified/decisions.py",
            "Certainty.AMBIGUOUS if ties else Certainty.EXACT",
            "Certainty.EXACT",
        ),
        (
            "who is alone is taken as sure",
            "certified/ladder.py",
            "clear = alone & (found.doubt == SURE)",
            "clear = alone",
        ),
        (
            "the farther candidate wins",
            "certified/decisions.py",
            "beaten = result == order.FARTHER",
            "beaten = result == order.NEARER",
        ),
        (
            "candidates are not sorted by their names",
            "certified/decisions.py",
            "found = found.take(np.lexsort((*self.surfaces.names(found.surface)[::-1], "
            "found.ray)))",
            "found = found.take(np.lexsort((-found.surface, found.ray)))",
        ),
        (
            "intersections of planes are no lines of change",
            "certified/ties.py",
            "for other in planes[:k] if gap(hit, other) == 0]",
            "for other in planes[:0]]",
        ),
        (
            "only one side of each line is tried",
            "certified/ties.py",
            "for s in (1, -1)}",
            "for s in (1,)}",
        ),
        (
            "a float's last digit is lost in its integer",
            "certified/integers.py",
            "(mantissa * 2.0**53).astype(np.int64)",
            "((mantissa * 2.0**53).astype(np.int64) & ~1)",
        ),
        (
            "the box begins a pixel later",
            "tracer/candidates.py",
            "bounds[2 * axis] = _pixel(first, low",
            "bounds[2 * axis] = _pixel(first + 1, low",
        ),
        (
            "triangles before the camera are culled",
            "tracer/candidates.py",
            "unseen = (farthest < camera.clip_start)",
            "unseen = (nearest < camera.clip_start)",
        ),
    ),
}
MUTANTS = tuple(
    Mutant(what, file, old, new, check)
    for check, rows in _TABLE.items()
    for what, file, old, new in rows
)


def checked(copy: Path, mutant: Mutant) -> CompletedProcess[str]:
    """Make a mutant of a copy, run its check, and put the text back."""
    file = copy / mutant.file
    source = file.read_text(encoding="utf-8")
    assert mutant.old in source, f"{mutant.file} has no {mutant.old!r}"
    try:
        write(file, source.replace(mutant.old, mutant.new, 1))
        return run(copy.parent, CHECKS[mutant.check])
    finally:
        write(file, source)


def write(file: Path, source: str) -> None:
    """Write a file at a time of its own, so that Python sees that it is another."""
    now = next(_TIMES)
    file.write_text(source, encoding="utf-8")
    os.utime(file, (now, now))


def main() -> None:
    """Print which check notices each mutant; the program fails if one passes."""
    passed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = copied(Path(folder))
        for mutant in MUTANTS:
            noticed = checked(copy, mutant).returncode != 0
            passed += not noticed
            result = mutant.check if noticed else "NOT NOTICED"
            print(f"{mutant.file:32}{mutant.what:50}{result}", flush=True)
    sys.exit(f"{passed} pass" if passed else 0)


if __name__ == "__main__":
    main()
