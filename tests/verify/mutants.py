"""Wrong versions of the checker, and whether the tests of this folder notice each.

.venv/bin/python -m tests.verify.mutants    # one table, in some ten minutes
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
CHECKER = ROOT / "packages" / "verify" / "verify.py"
# Runs the tests with another text for the checker.
TESTED = """
import sys, types
import pytest
import reference_tracer_verify
name = "reference_tracer_verify.verify"
checker = types.ModuleType(name)
checker.__file__ = sys.argv[1]
sys.modules[name] = reference_tracer_verify.verify = checker
exec(compile(sys.stdin.read(), sys.argv[1], "exec"), vars(checker))
files = (f"tests/verify/test_{name}.py" for name in ("verify", "mutations", "forms"))
sys.exit(pytest.main([*files, "-x", "-q", "-p", "no:cacheprovider"]))
"""


class Mutant(NamedTuple):
    """What is changed, from which text to which; and whether it is more than the bound's room."""

    what: str
    old: str
    new: str
    is_wrong: bool = True


MUTANTS = (
    # Reading.
    Mutant("what is not known passes", "if each not in known]:", "if False]:"),
    Mutant("an array may come twice", "len(file.files) == len(set(file.files))", "True"),
    Mutant("a shape is read up to its end", "re.fullmatch(known", "re.match(known"),
    Mutant("an empty clip range", "< self.clip[1] <", "< np.inf or self.clip[1] <"),
    Mutant("an instance may end first", "(instances[:, 0] <= instances[:, 1]).all()", "True"),
    Mutant("pixels beside the picture", "0 <= begin < end <= count", "begin < end"),
    Mutant("angles that have no sine", "not is_far", "True"),
    Mutant("rays that are not finite", "np.isfinite(values).all(), ", "True, "),
    Mutant("another order of sums", "+ m[k, 1] * y + m[k, 2] * z", "+ (m[k, 1] * y + m[k, 2] * z)"),
    Mutant("triangles are counted anew", "for k in finite.tolist()", "for k in range(len(finite))"),
    Mutant("a film by a millionth", "+ 0.5)", "+ 0.500001)"),
    Mutant("a panorama with another z", "level * sine(x, 1)", "sine(x, 1)"),
    Mutant("a shorter series", "range(18, 0, -2)", "range(14, 0, -2)"),
    # What floats drop.
    Mutant("a sixty-fourth of the bound", "2.0**-44 *", "2.0**-50 *"),
    Mutant("no room for underflow", " + 2.0**-1040 * (1 + reach)", ""),
    Mutant("what overflows has a sign", "np.isfinite(value - reach)", "True"),
    Mutant("a plane has edges", "found[4, 2:, plane] = np.inf", "pass"),
    Mutant("D's error is forgotten", "np.abs(far) * reach[1] + reach[0]", "reach[0]"),
    Mutant("boxes that are too small", "(1 + 2.0**-50)", "0.9"),
    Mutant("boxes without their rounding", " * (1 + 2.0**-50)", "", False),
    Mutant("t as the file rounds it", "np.nextafter(np.minimum(of.t, of.clip[1]), np.inf)",
           "np.minimum(of.t, of.clip[1])", False),
    Mutant("t is too near", "half, far[None]", "half, 0.9 * far[None]"),
    Mutant("ties up to t alone", "np.put(far, list(of.ties), of.clip[1])", "pass"),
    Mutant("ties up to t of a file by columns", "np.put(far, list(of.ties), of.clip[1])",
           "far.ravel()[list(of.ties)] = of.clip[1]"),
    Mutant("one corner beside is enough", "above[5:].all(axis=0)", "above[5:].any(axis=0)"),
    Mutant("one sign is enough", ".any(axis=0) & below[:5]", ".any(axis=0) | below[:5]"),
    Mutant("a quarter is left out", "for x in (0, 1)]", "for x in (0,)]"),
    Mutant("the least component", "np.abs(v).max(axis=0)", "np.abs(v).min(axis=0)"),
    # What integers decide.
    Mutant("a float's last digit is lost", "(mantissa * 2.0**53).astype(np.int64)",
           "((mantissa * 2.0**53).astype(np.int64) & ~1)"),
    Mutant("an edge is a miss", "min(signs) < 0 <", "min(signs) <= 0 <"),
    Mutant("the clip range is open", "signs += [top", "signs += [-1 + top"),
    Mutant("a hit at t = 0", " or top == start == 0", ""),
    Mutant("D = 0 is a hit", "if not bottom or ", "if "),
    Mutant("crossed from one side alone", "self.bottom * moved", "moved"),
    Mutant("the sign of D1 D2 is forgotten", " * self.bottom * other.bottom", ""),
    Mutant("the highest name is seen", "self.name < other.name", "self.name > other.name"),
    Mutant("no line where rays begin", "(0, 0, 0) if a else", "(0, 0, 0) if True else"),
    Mutant("the origin does not move", "if not any(m):", "if False:"),
    Mutant("the origin moves along d alone", "in (d, *moves)]", "in (d,)]"),
    Mutant("another move", "((1, 0, 0), (0, 1, 0)", "((0, 1, 0), (1, 0, 0)"),
    Mutant("what is as near is not in front", "h.at <= other.at", "h is other or h.at < other.at"),
    Mutant("an edge is clear", "<= min(1, len(inside))", "<= 1"),
    Mutant("what is met first is no tie", "if hit.at == least)", "if False)"),
    Mutant("one side of each line", "(far, 1), (far, -1), (-far, 1), (-far, -1)", "(far, 1),"),
    Mutant("too far beside a line", "default=0) ** 2", "default=0) ** 0"),
    Mutant("no line of two surfaces", "if h.at == g.at]", "if False]"),
    # The answer.
    Mutant("ties are not compared", "found != said", "found[:2] != said[:2]"),
    Mutant("t is not compared", "found != said", "found[::2] != said[::2]"),
    Mutant("the owner is not compared", "found != said", "found[1:] != said[1:]"),
)  # fmt: skip


def is_noticed(mutant: Mutant) -> bool:
    """Return whether a test fails."""
    text = CHECKER.read_text("utf-8")
    assert mutant.old in text, f"the checker has no {mutant.old!r}"
    run = [sys.executable, "-c", TESTED, str(CHECKER)]
    changed = text.replace(mutant.old, mutant.new, 1)
    return (
        subprocess.run(run, cwd=ROOT, input=changed, text=True, capture_output=True).returncode == 1
    )


def main() -> None:
    """Print whether each is noticed; the program fails if a wrong one is not."""
    passed = 0
    for mutant in MUTANTS:
        noticed = is_noticed(mutant)
        passed += mutant.is_wrong and not noticed
        print(f"{mutant.what:36}{'noticed' if noticed else 'not noticed'}", flush=True)
    sys.exit(f"{passed} pass" if passed else 0)


if __name__ == "__main__":
    main()
