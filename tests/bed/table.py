"""The test bed's table: fault x scene, named rightly or not, settled share, seconds.

    python -m tests.bed.table [--fault KEY] [--scene N] [--damage N] [--compare]

By default all faults of all scenes, then the 200 damaged pictures. `--fault` and `--scene` choose
some of the cells; `--damage N` diagnoses the first N damaged pictures alone, with 0 none of them;
`--compare` stops after the comparison, and prints what it leaves unexplained.

A line of a fault ends in the names that were told. `named`: its own name, or one that is right for
this very picture (`names.py` says why); `+wrong`: a wrong one stands beside it; `wrong`; `nothing`.
The last lines are the shares that the issue asks for; the exit code is 1 if they are not reached.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.comparison.comparison import Comparison
from reference_tracer.tracer.progress import result_of

from .bridge import case_of
from .damage import COUNT, damaged
from .description import Description
from .faults import cells
from .making import Made, right
from .names import right_names, same, says_nothing
from .variants import with_variants

# What the diagnosis calls what the bed has other names for.
NAMES = {
    "pixel_offset": "principal_point",
    "srgb_twice": "srgb_for_linear",
    "srgb_left_out": "srgb_for_linear",
    "straight_alpha": "premultiplied",
    "scene_scaled": "object_scaled",
    "cut_off": "rounding_level",
}
NAMED = 0.95  # of the cells, as the issue asks for
TRANSFORMS = {  # words in a transform's name
    "an exposure of": "exposure",
    "a gamma of": "gamma",
    "a power of": "gamma",
    "swapped": "channels",
    "sRGB's curve applied once more": "srgb_twice",
    "sRGB's curve left out": "srgb_left_out",
    "cut off": "cut_off",
}


class Row(NamedTuple):
    """What became of one picture."""

    what: str
    scene: int
    result: str  # 'named', 'named, +wrong', 'wrong', 'nothing'
    unexplained: int
    settled: float  # the largest share of these that what was told settles
    seconds: float  # of the diagnosis alone
    told: tuple[str, ...]
    reason: str = ""  # why another name than its own is right

    def line(self) -> str:
        """Return the row as a line of the table."""
        told = "; ".join(self.told) + (f" [{self.reason}]" if self.reason else "")
        return (
            f"{self.what:56} {self.scene}  {self.result:14} {self.unexplained:7,} "
            f"{100 * self.settled:6.1f} % {self.seconds:6.2f} s  {told}"
        )


def compared(scene: Description, picture: np.ndarray, made: Made | None = None) -> Comparison:
    """Return the comparison with a picture (h, w, 4), row 0 at the top, and what it was made by."""
    known = (made.levels, made.filter_radius) if made else ()
    return result_of(trace_and_compare(with_variants(case_of(scene, picture, *known), scene)))


def looked_at(
    what: str,
    scene: Description,
    picture: np.ndarray,
    made: Made | None,
    names: dict[str, str],
    only_compare: bool,
) -> Row:
    """Compare a picture, diagnose it, and judge what is told by the right names and reasons."""
    found = compared(scene, picture, made)
    unexplained = found.counts.unexplained
    if only_compare:
        transform = found.causes.transform or ""
        return Row(what, scene.number, "compared", unexplained, 0.0, 0.0, (transform,))
    began = time.perf_counter()
    diagnosis = result_of(diagnosed(found)).diagnosis
    seconds = time.perf_counter() - began
    told = diagnosis.told if diagnosis else ()
    every = {t.fault.name for t in told} | named_transform(found.causes.transform or "")
    hit, wrong = sorted(every & names.keys()), every - names.keys()
    result = "named" if hit else "wrong" if wrong else "nothing"
    result += ", +wrong" if hit and wrong else ""
    settled = max((t.settled / max(t.unexplained, 1) for t in told), default=0.0)
    if not unexplained:
        settled = 1.0  # the comparison has a cause for all of them
    said = tuple(f"{t.fault.name} ({t.sentence})" for t in told)
    said += (found.causes.transform,) if found.causes.transform else ()
    own = next(iter(names), "")
    reason = names[hit[0]] if hit and own not in hit else ""
    return Row(what, scene.number, result, unexplained, settled, seconds, said, reason)


def named_transform(transform: str) -> set[str]:
    """Return the fault that a transform is, which the comparison itself names."""
    return {key for words, key in TRANSFORMS.items() if words in transform}


def fault_rows(key: str | None, number: int | None, only_compare: bool) -> Iterator[Row]:
    """Yield a row for each fault and scene in which it can be seen; say which are left out."""
    for fault, scene in cells(key, number):
        wrong = fault.make(scene, right(scene))
        picture = None if wrong is None else wrong.stored()
        if picture is None or same(picture, right(scene).picture()):
            print(f"{fault.name:56} {scene.number}  changes nothing here: left out")
        elif says_nothing(picture):
            print(f"{fault.name:56} {scene.number}  the picture has one colour: left out")
        else:
            names = right_names(fault, scene)
            yield looked_at(fault.name, scene, picture, wrong, names, only_compare)


def damage_rows(count: int, only_compare: bool) -> Iterator[Row]:
    """Yield a row for each damaged picture."""
    for number in range(count):
        kind, scene, picture = damaged(number)
        yield looked_at(f"damage {number}: {kind}", scene, picture, None, {}, only_compare)


def _printed(rows: Iterator[Row]) -> list[Row]:
    out = []
    for row in rows:
        print(row.line(), flush=True)
        out.append(row)
    return out


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table; returns 1 if fewer faults are named than asked for, or damage is."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--fault", metavar="KEY", help="only faults of this name")
    parser.add_argument("--scene", type=int, metavar="N", help="only this scene, 1 to 6")
    parser.add_argument("--damage", type=int, metavar="N", help="how many damaged pictures")
    parser.add_argument("--compare", action="store_true", help="compare, do not diagnose")
    options = parser.parse_args(argv)
    some = options.fault is not None or options.scene is not None
    count = (0 if some else COUNT) if options.damage is None else options.damage
    faults: list[Row] = []
    if some or options.damage in (None, 0):
        faults = _printed(fault_rows(options.fault, options.scene, options.compare))
    damage = _printed(damage_rows(count, options.compare))
    if options.compare:
        return 0
    named = sum(row.result.startswith("named") for row in faults)
    wrong = sum("wrong" in row.result for row in faults)
    false = sum("wrong" in row.result for row in damage)
    print(f"faults: {named} of {len(faults)} named, a wrong name at {wrong}")
    print(f"damage: a wrong name at {false} of {len(damage)}")
    missed = Counter(row.what for row in faults if not row.result.startswith("named"))
    for what, times in missed.most_common():
        print(f"  not named: {what} ({times} scenes)")
    return int(named < NAMED * len(faults) or false > 0)


if __name__ == "__main__":
    raise SystemExit(main())
