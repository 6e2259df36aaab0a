"""The test bed's table: what is said of each fault in each scene, and in how many CPU seconds.

    python -m tests.bed.table [--sample N] [--part K/N] [--beside REVISION] [--out FILE]
                              [--fault KEY] [--scene N] [--damage N]

Cells are in a random order that is always the same, so that the first N are a sample. Each is
appended to FILE as it is done, and is not done again: runs go on where one ended, and parts may
share a file. The table is of all that stands in it.

`named`: the fault's own name is told, or one that is right for this very picture (`names.py` says
why). `useful`: no name, but the largest region that is left shows the object that has the fault.
`silent`: neither. `wrong`: a wrong name is told, alone or beside a right one. Seconds are those of
the processor: of the comparison alone, and with the diagnosis. A revision before is checked out
into a folder of its own, with this test bed, and does each cell in the same minute.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.comparison.comparison import Comparison
from reference_tracer.tracer.progress import result_of

from . import bridge
from .damage import COUNT, damaged
from .description import Description
from .faults import cells
from .making import Fault, Made, right
from .names import right_names, same, says_nothing, spoken
from .variants import with_variants

Row: TypeAlias = dict[str, Any]

PROJECT = Path(__file__).resolve().parents[2]
SEED = 5
ANSWERS = "named", "useful", "silent", "wrong"
NAMED = 0.95  # of the cells, as asked for
TRANSFORMS = {  # words in a transform's name
    "an exposure of": "exposure",
    "a gamma of": "gamma",
    "a power of": "gamma",
    "swapped": "channels",
    "sRGB's curve applied once more": "srgb_twice",
    "sRGB's curve left out": "srgb_left_out",
    "cut off": "cut_off",
}


def listed(fault: str | None = None, scene: int | None = None, damage: int = 0) -> list[str]:
    """Return the cells' names, in random order; then those of damaged pictures."""
    names = [f"{f.name} | {s.number}" for f, s in cells(fault, scene)]
    order = np.random.default_rng(SEED).permutation(len(names))
    return [*(names[n] for n in order), *(f"damage | {n}" for n in range(damage))]


def made_of(cell: str) -> tuple[Description, np.ndarray, Made | None, Fault | None] | None:
    """Return a cell's scene, picture, what made it, and its fault; None if nothing shows it."""
    name, number = cell.split(" | ")
    if name == "damage":
        _, scene, picture = damaged(int(number))
        return scene, picture, None, None
    found = [pair for pair in cells(None, int(number)) if pair[0].name == name]
    [(fault, scene)] = found
    wrong = fault.make(scene, right(scene))
    if wrong and wrong.holds and not hasattr(bridge, "case_of_data"):
        return None  # a version before knows no data
    shown = None if wrong is None else wrong.stored()
    if shown is None or says_nothing(shown):
        return None
    if same(shown, replace(right(scene), holds=wrong.holds).picture()):
        return None
    return scene, shown, wrong, fault


def compared(scene: Description, picture: np.ndarray, made: Made | None = None) -> Comparison:
    """Return the comparison with a picture (h, w, 4), row 0 at the top, and what it was made by."""
    if made and made.holds:
        case = bridge.case_of_data(scene, picture[..., 0], made.holds)
    else:
        known = (made.levels, made.filter_radius) if made else ()
        case = with_variants(bridge.case_of(scene, picture, *known), scene)
    return result_of(trace_and_compare(case))


def measured(cell: str) -> Row:
    """Compare a cell's picture, diagnose it, and judge what is told."""
    made = made_of(cell)
    if made is None:
        return {"answer": "not seen"}
    scene, picture, wrong, fault = made
    began = time.process_time()
    found = compared(scene, picture, wrong)
    between = time.process_time()
    diagnosis = result_of(diagnosed(found)).diagnosis
    ended = time.process_time()
    told = diagnosis.told if diagnosis else ()
    transform = found.causes.transform or ""
    every = {t.fault.name for t in told}
    every |= {key for words, key in TRANSFORMS.items() if words in transform}
    shown = diagnosis.regions[0].objects[:1] if diagnosis and diagnosis.regions else ()
    useful = wrong is not None and set(shown) & changed(scene, wrong)
    silent = "useful" if useful else "silent"
    return {
        "answer": _judged(every, fault, scene) if every else silent,
        "compare": between - began,
        "both": ended - began,
        "told": [transform] * bool(transform) + [t.sentence for t in told],
        "names": sorted(every),
        "ended": bool(diagnosis and diagnosis.untried),
    }


def _judged(names: set[str], fault: Fault | None, scene: Description) -> str:
    """Judge names: only others than the fault's own take long. Of a pair, both must be named."""
    parts = () if fault is None else fault.parts or (fault,)
    own = [{part.key, spoken(part)} for part in parts]
    if not names <= set().union(*own):
        own = [set(right_names(part, scene)) for part in parts]
    if not names <= set().union(*own):
        return "wrong"
    return "named" if all(names & some for some in own) else "useful"


def changed(scene: Description, made: Made) -> set[str]:
    """Return the name of the object that was changed, if it is one; empty otherwise."""
    before, after = (
        {(s.name, s.vertices.tobytes(), s.triangles.tobytes()) for s in m.solids}
        for m in (right(scene), made)
    )
    found = {name for name, *_ in before ^ after}
    return found if len(found) == 1 else set()


# ---- processes: of this version, and of one before


def answer() -> None:
    """Measure each cell that is named on standard input, a line of JSON each."""
    for line in sys.stdin:
        print(json.dumps(measured(line.rstrip("\n"))), flush=True)
    own = Path(sys.modules["reference_tracer"].__file__ or "").parent
    parts = [m for n, m in sys.modules.items() if n.startswith("reference_tracer.")]
    if not all(Path(m.__file__ or "").is_relative_to(own) for m in parts):
        raise SystemExit("two versions are mixed: this table needs what that revision has not")


@contextmanager
def measuring(house: Path) -> Iterator[subprocess.Popen[str]]:
    """Start a process that measures cells with the version of a folder."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "reference_tracer").symlink_to(house / "addon")
        own = {"PYTHONPATH": folder, "OPENBLAS_NUM_THREADS": "1"}
        command = [sys.executable, "-m", __spec__.name, "--answer"]
        pipe = subprocess.PIPE
        child = subprocess.Popen(
            command, cwd=house, env=os.environ | own, stdin=pipe, stdout=pipe, text=True
        )
        try:
            yield child
        finally:
            child.kill()
            child.wait()


@contextmanager
def checked_out(revision: str) -> Iterator[Path]:
    """Check out a revision into a folder of its own, with this test bed, but for its bridge."""
    with tempfile.TemporaryDirectory() as folder:
        house, git = Path(folder) / "before", ["git", "-C", str(PROJECT), "worktree"]
        subprocess.run([*git, "add", "--quiet", "--detach", house, revision], check=True)
        try:
            bed = house / "tests" / "bed"
            bridge_before = (bed / "bridge.py").read_bytes()
            shutil.copytree(Path(__file__).parent, bed, dirs_exist_ok=True)
            (bed / "bridge.py").write_bytes(bridge_before)
            yield house
        finally:
            subprocess.run([*git, "remove", "--force", house], check=True)


def asked(child: subprocess.Popen[str], cell: str) -> Row:
    """Return what a process measures of a cell."""
    assert child.stdin and child.stdout
    print(cell, file=child.stdin, flush=True)
    line = child.stdout.readline()
    if not line:
        raise SystemExit(f"the process that measures ended at {cell}")
    row: Row = json.loads(line)
    return row


# ---- the table


def kept(path: Path | None) -> dict[str, dict[str, Row]]:
    """Return the rows of a file, by cell: `now`, and `before`."""
    if path is None or not path.exists():
        return {}
    rows = map(json.loads, path.read_text(encoding="utf-8").splitlines())
    return {row["cell"]: row for row in rows}


def line_of(cell: str, row: dict[str, Row]) -> str:
    """Return a cell as a line of the table."""
    seconds = (
        f"{r['answer']:8} {r['compare']:6.2f} {r['both']:7.2f}" if "both" in r else r["answer"]
        for r in (row[side] for side in ("now", "before") if side in row)
    )
    told = "; ".join(row["now"].get("told", ()))
    return f"{cell:60} {' | '.join(f'{s:23}' for s in seconds)}  {told}"


def summary(rows: Sequence[dict[str, Row]], side: str) -> Iterator[str]:
    """Yield how many have which answer, and the CPU seconds of each class."""
    every = [r[side] for r in rows if "both" in r.get(side, {})]
    if not every:
        return
    count = Counter(r["answer"] for r in every)
    yield f"{side}: {len(every)} pictures: " + ", ".join(f"{count[a]} {a}" for a in ANSWERS)
    yield f"  {sum(r['ended'] for r in every)} of them reached the limit of work"
    for what in ("all", *ANSWERS):
        some = [r for r in every if what in ("all", r["answer"])]
        if some:
            columns = (
                ("compare", [r["compare"] for r in some]),
                ("with the diagnosis", [r["both"] for r in some]),
                ("ratio", [r["both"] / r["compare"] for r in some]),
            )
            said = (f"{n} {np.median(v):.2f}, {np.quantile(v, 0.9):.2f}" for n, v in columns)
            yield f"  {what:7} median and nine of ten: {'; '.join(said)}"


def judged(rows: dict[str, dict[str, Row]]) -> int:
    """Print the summary; return 1 if too few faults are named, or anything wrongly."""
    faults = [r for cell, r in rows.items() if not cell.startswith("damage")]
    damage = [r for cell, r in rows.items() if cell.startswith("damage")]
    for some in (faults, damage):
        for side in ("now", "before"):
            print(*summary(some, side), sep="\n")
    missed = Counter(
        cell.split(" | ")[0]
        for cell, row in rows.items()
        if row["now"]["answer"] in ("useful", "silent") and row in faults
    )
    print(*(f"  not named: {what} ({times})" for what, times in missed.most_common()), sep="\n")
    answers = Counter(r["now"]["answer"] for r in faults)
    answers.pop("not seen", None)
    wrong = any(r["now"]["answer"] == "wrong" for r in rows.values())
    return int(wrong or answers["named"] < NAMED * answers.total())


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table; returns 1 if fewer faults are named than asked for, or any wrongly."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--fault", metavar="KEY", help="only faults of this name")
    parser.add_argument("--scene", type=int, metavar="N", help="only this scene, 1 to 6")
    parser.add_argument("--damage", type=int, default=0, help=f"damaged pictures, up to {COUNT}")
    parser.add_argument("--sample", type=int, metavar="N", help="only the first N cells")
    parser.add_argument("--part", default="1/1", metavar="K/N", help="each N-th cell from the K-th")
    parser.add_argument("--beside", metavar="REVISION", help="measure this version, too")
    parser.add_argument("--out", type=Path, metavar="FILE", help="where rows are kept")
    parser.add_argument("--answer", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args(argv)
    if options.answer:
        answer()
        return 0
    first, each = map(int, options.part.split("/"))
    names = listed(options.fault, options.scene, options.damage)
    rows = kept(options.out)
    with ExitStack() as stack:
        children = {"now": stack.enter_context(measuring(PROJECT))}
        if options.beside:
            house = stack.enter_context(checked_out(options.beside))
            children["before"] = stack.enter_context(measuring(house))
        for cell in names[: options.sample][first - 1 :: each]:
            if cell in rows:
                continue
            rows[cell] = {side: asked(child, cell) for side, child in children.items()}
            print(line_of(cell, rows[cell]), flush=True)
            if options.out:
                with options.out.open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"cell": cell} | rows[cell]) + "\n")
    return judged(kept(options.out) or rows)


if __name__ == "__main__":
    raise SystemExit(main())
