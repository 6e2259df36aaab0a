"""A class hands in sixty wrong submissions: each fault is named rightly, and has its mark.

The table goes to out/grading/class_of_60.csv.
"""

from __future__ import annotations

import csv
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.external import Run
from reference_tracer_grading.judging import judge
from reference_tracer_grading.subjects import subject
from reference_tracer_grading.tally import COST

from .class_of_60 import SUBMISSIONS
from .test_languages import LANGUAGES

TABLE = Path(__file__).parents[2] / "out" / "grading" / "class_of_60.csv"
NO_FORMULA = {"t_is_distance"}  # of triangles: told by a test of its own, so nothing is forgiven


def judged(wrong, folder):
    """Write, compile and judge a submission."""
    folder.mkdir()
    cases = subject(wrong.subject).cases()
    if wrong.file not in LANGUAGES:
        path = folder / "own.py"
        path.write_text(wrong.text, encoding="utf-8")
        return result_of(judge(path, cases))
    (folder / wrong.file).write_text(wrong.text, encoding="utf-8")
    _, compiled, run, exchange = LANGUAGES[wrong.file]
    own = {"out": folder, "file": folder / wrong.file, "python": sys.executable}
    words = compiled.format(**own).split()
    if not shutil.which(words[0]):
        pytest.skip(f"no {words[0]} here")
    subprocess.run(words, check=True)
    command = run.format(**own, rays="{rays}", answers="{answers}")
    return result_of(judge(Run.parsed(command, exchange), cases))


def check(wrong, found):
    assert found.errors == []
    assert [f.name for f in found.faults] == [wrong.fault], wrong
    forgiven = wrong.subject != "triangle" or wrong.fault not in NO_FORMULA
    assert bool(found.alike) == forgiven, wrong
    assert found.as_is < 100 and (found.score >= 100 - COST or not forgiven), wrong


def test_the_class_is_what_it_is_said_to_be():
    assert len(SUBMISSIONS) == 60
    assert len({w.fault for w in SUBMISSIONS}) >= 40 - 5
    assert len({(w.subject, w.fault) for w in SUBMISSIONS}) >= 40
    kinds = {Path(w.file).suffix or ".py" for w in SUBMISSIONS}
    assert len(kinds) == 6 and all(w.text for w in SUBMISSIONS)


@pytest.mark.parametrize("wrong", SUBMISSIONS[-3::-5][:2], ids=lambda w: f"{w.subject}-{w.fault}")
def test_some_are_named_rightly(wrong, tmp_path):
    check(wrong, judged(wrong, tmp_path / "own"))


@pytest.mark.torture
def test_all_sixty_are_named_rightly(tmp_path):
    rows = []
    for number, wrong in enumerate(SUBMISSIONS):
        found = judged(wrong, tmp_path / str(number))
        named = ", ".join(f.name for f in found.faults)
        language = Path(wrong.file).suffix or ".py"
        rows.append((wrong.subject, language, wrong.fault, named, found.score, found.as_is))
    TABLE.parent.mkdir(parents=True, exist_ok=True)
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(("subject", "language", "fault", "named", "mark", "mark as it is"))
        table.writerows(rows)
    assert [row[3] for row in rows] == [row[2] for row in rows]
    assert all(mark >= 100 - COST for *_, name, mark, _ in rows if name not in NO_FORMULA)
