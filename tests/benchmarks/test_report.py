"""What a benchmark leaves in a folder, also when it is interrupted: JSON and a table."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest
from pyperf import BenchmarkSuite
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR, INTERRUPTED
from reference_tracer_benchmarks import run as bench_run
from reference_tracer_benchmarks.measure import measure
from reference_tracer_benchmarks.plan import COMMANDS, Case, Plan
from reference_tracer_benchmarks.report import JSON, SCHEMA, TABLE, TIMES, UNFINISHED, write
from reference_tracer_benchmarks.rows import Bench, CommandRow, Row, machine
from reference_tracer_benchmarks.scenes import CAMERAS, SUBJECTS
from reference_tracer_benchmarks.tables import table

STAGES = "project", "cull", "decide", "resolve", "shade"


def made_row(name, size, camera, method, rng):
    triangles, pixels = SUBJECTS[name].triangles, size[0] * size[1]
    seconds = 2e-8 * pixels + 6e-8 * triangles
    row = Row(name, triangles, size[0], size[1], camera, method, "float64")
    row.trace_s, row.render_s = seconds * rng.uniform(0.9, 1.2), 1.6 * seconds
    row.embreex_trace_s, row.embreex_build_s = 7e-8 * pixels, 1e-6 * triangles
    row.embreex_rays, row.peak_bytes, row.rounds = pixels, 120 << 20, 5
    row.picture_s, row.outputs_s, row.embreex_ids_s = 0.5 * seconds, 0.8 * seconds, 6e-8 * pixels
    row.stages = {s: row.render_s * (0.1 + 0.04 * k) for k, s in enumerate(STAGES)}
    if size[0] == 1920 and camera == "perspective":
        row.bvhtree_s, row.bvhtree_rays = 5e-7 * pixels, 300_000
        row.cycles_s, row.workbench_s = 0.4 + 5e-6 * triangles, 0.1 + 3e-7 * triangles
        row.rtree_s, row.rtree_rays = 3e4, 64
    return row


@pytest.fixture(scope="module")
def bench():
    rng = np.random.default_rng(3)
    sizes = (480, 270), (1920, 1080)
    rows = [
        made_row(name, size, camera, method, rng)
        for name in SUBJECTS
        for size in sizes
        for camera in CAMERAS
        for method in ("moller_trumbore", "certified")
    ]
    notes = ["rtree: without rtree, which is not installed: ..."]
    commands = [
        CommandRow(name, 0.5 + k, 0.4 + k, 0.3 + k, 9.5, 3) for k, name in enumerate(COMMANDS)
    ]
    commands[-1].waited_s = 0.25
    return Bench(machine(True), False, rows, notes, commands=commands)


def read(folder):
    return json.loads((folder / JSON).read_text(encoding="utf-8"), parse_constant=pytest.fail)


def test_the_json(bench, tmp_path):
    write(tmp_path, bench)
    data = read(tmp_path)
    assert data["schema"] == SCHEMA == "reference_tracer.bench/1"
    assert {"python", "numpy", "cpu_count", "machine"} <= data.keys()
    assert [Row(**row) for row in data["rows"]] == bench.rows
    assert [CommandRow(**row) for row in data["commands"]] == bench.commands
    assert not list(tmp_path.glob("*.part"))


def test_a_table_of_nothing():
    assert "nothing was measured" in table(Bench({}, notes=["why"])) and "why" in table(
        Bench({}, notes=["why"])
    )


def test_pyperf_reads_the_times(bench, tmp_path):
    """Those of each round, and the peaks of memory; a tick that no clock saw is left out."""
    slower, faster = tmp_path / "slower", tmp_path / "faster"
    for folder, seconds in ((slower, [2.0, 2.2, 0.0]), (faster, [1.0, 1.1])):
        one = Bench(bench.machine, rows=bench.rows[:2])
        one.keep("cube: trace", seconds)
        one.keep("never seen", [0.0])
        write(folder, one)
    kept = BenchmarkSuite.load(str(slower / TIMES))
    names = kept.get_benchmark_names()
    assert names[0] == "cube: trace" and len(names) == 3
    assert kept.get_benchmark("cube: trace").get_values() == (2.0, 2.2)
    assert kept.get_benchmark(names[1]).format_value(bench.rows[0].peak_bytes) == "120.0 MiB"
    files = [str(folder / TIMES) for folder in (slower, faster)]
    argv = [sys.executable, "-m", "pyperf", "compare_to", *files]
    said = subprocess.run(argv, capture_output=True, text=True, check=True).stdout
    assert "cube: trace" in said and "2.00x faster" in said


def test_pyperf_is_named_where_it_is_missing(bench, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyperf", None)
    (tmp_path / TIMES).write_text("of an earlier run")
    some = Bench(bench.machine, rows=bench.rows[:4], times={"cube": [1.0]})
    write(tmp_path, some)
    assert "without pyperf, which" in some.notes[0]
    assert some.notes[0] in (tmp_path / TABLE).read_text(encoding="utf-8")
    assert not (tmp_path / TIMES).exists()


# ---- the command


def tiny_plan(names, quick, repeats):
    cases = tuple(Case(n, 24, 14, c) for n in ("cube", "icosphere_5k") for c in CAMERAS)
    return Plan(cases, quick, repeats or 1, budget=0.2, slow=0.05)


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_run, "plan", tiny_plan)
    assert main(["bench", "--quick", "--out", str(tmp_path / "a")]) == AGREE
    first = read(tmp_path / "a")
    assert first["quick"] and len(first["rows"]) == 8 and not first["interrupted"]
    names = BenchmarkSuite.load(str(tmp_path / "a" / TIMES)).get_benchmark_names()
    assert "cube, 24 x 14, perspective: certified, trace" in names
    assert "cube, 24 x 14, perspective: embreex_trace" in names
    said = capsys.readouterr().out
    assert "icosphere_5k" in said and "written to" in said


def test_interrupted_it_leaves_what_was_measured(tmp_path, monkeypatch, capsys):
    def interrupted(plan, bench, cache):
        work = measure(plan, bench, cache)
        for share in work:
            yield share
            if len(bench.rows) == 4:
                written = read(tmp_path / UNFINISHED)  # before the end, too
                assert len(written["rows"]) >= 2 and not written["interrupted"]
                raise KeyboardInterrupt

    monkeypatch.setattr(bench_run, "plan", tiny_plan)
    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "--out", str(tmp_path)]) == INTERRUPTED
    found = read(tmp_path / UNFINISHED)
    assert found["interrupted"] and len(found["rows"]) == 4
    both = capsys.readouterr()
    assert "interrupted: 2 of 4 pictures" in both.err and "Interrupted" in both.out
    assert (tmp_path / UNFINISHED / TIMES).is_file() and not (tmp_path / JSON).exists()


@pytest.mark.parametrize("rows", [0, 4])
def test_an_older_result_outlives_a_run_that_is_interrupted(rows, bench, tmp_path, monkeypatch):
    def interrupted(plan, measured, cache):
        measured.rows += bench.rows[:rows]
        yield 0.0
        raise KeyboardInterrupt

    write(tmp_path, bench)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "cube", "--out", str(tmp_path)]) == INTERRUPTED
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir() if p.is_file()} == before
    assert (tmp_path / UNFINISHED).exists() == bool(rows)


def test_a_run_that_ends_leaves_nothing_unfinished(tmp_path, monkeypatch):
    monkeypatch.setattr(bench_run, "plan", tiny_plan)
    (tmp_path / UNFINISHED).mkdir()
    assert main(["bench", "--out", str(tmp_path)]) == AGREE
    assert not (tmp_path / UNFINISHED).exists()


@pytest.mark.parametrize(
    ("options", "what"),
    [
        (["sphere"], "no benchmark scene 'sphere'"),
        (["--repeats", "0"], "--repeats is 0"),
    ],
)
def test_what_is_wrong_is_said_before_the_work(options, what, tmp_path, capsys):
    assert main(["bench", "--out", str(tmp_path / "new"), *options]) == INPUT_ERROR
    assert what in capsys.readouterr().err and not (tmp_path / "new").exists()
