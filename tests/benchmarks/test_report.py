"""The files a benchmark leaves in a folder, also when it is interrupted: pyperf's, and a table."""

from __future__ import annotations

import sys

import pytest
from pyperf import BenchmarkSuite
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR, INTERRUPTED
from reference_tracer_benchmarks import plan as bench_plan
from reference_tracer_benchmarks import run as bench_run
from reference_tracer_benchmarks.measure import measure
from reference_tracer_benchmarks.plan import Case, Plan
from reference_tracer_benchmarks.results import TABLE, TIMES, UNFINISHED, Bench, write
from reference_tracer_benchmarks.scenes import CAMERAS
from reference_tracer_benchmarks.tables import table


def read(folder):
    return BenchmarkSuite.load(str(folder / TIMES))


def test_a_table_of_nothing():
    said = table(Bench(notes=["why"]))
    assert "nothing was measured" in said and "why" in said


def test_pyperf_reads_and_compares_the_times(tmp_path):
    """Those of each round; a tick that no clock saw is left out."""
    bench = Bench()
    bench.keep("cube", "embreex_trace", [2.0, 2.2, 0.0], facts={"rays": 64})
    bench.keep("cube", "certified, trace", [1.0, 1.1])
    bench.keep("cube", "rtree", [0.0])
    write(tmp_path, bench)
    kept = read(tmp_path)
    assert len(kept.get_benchmark_names()) == 2
    peer = kept.get_benchmark("cube: embreex_trace")
    assert peer.get_values() == (2.0, 2.2) and peer.get_metadata()["rays"] == 64
    assert {"python_version", "cpu_count", "version_embreex"} <= peer.get_metadata().keys()
    said = (tmp_path / TABLE).read_text(encoding="utf-8")
    assert "2.00x faster" in said and "embreex_trace" in said and "certified_trace" in said
    assert not list(tmp_path.glob("*.part"))


def test_pyperf_is_named_where_it_is_missing(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "pyperf", None)
    monkeypatch.delitem(sys.modules, "reference_tracer_benchmarks.results")
    assert main(["bench", "cube", "--out", str(tmp_path / "new")]) == INPUT_ERROR
    assert 'pip install "reference_tracer[bench]"' in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


# ---- the command


def tiny_plan(names, quick, repeats):
    cases = tuple(Case(n, 24, 14, c) for n in ("cube", "icosphere_5k") for c in CAMERAS)
    return Plan(cases, quick, repeats or 1, budget=0.2, slow=0.05)


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_plan, "plan", tiny_plan)
    (tmp_path / "a" / UNFINISHED).mkdir(parents=True)  # an earlier run's
    assert main(["bench", "--quick", "--out", str(tmp_path / "a")]) == AGREE
    names = read(tmp_path / "a").get_benchmark_names()
    assert "cube, 24 x 14, perspective: certified, trace" in names
    assert "cube, 24 x 14, perspective: embreex_trace" in names
    said = capsys.readouterr().out
    assert "icosphere_5k" in said and "written to" in said
    assert not (tmp_path / "a" / UNFINISHED).exists()


def test_interrupted_it_leaves_what_was_measured(tmp_path, monkeypatch, capsys):
    def interrupted(plan, bench, cache):
        for share in measure(plan, bench, cache):
            yield share
            done = [what for what, who in bench.found if who == "certified, trace"]
            if len(done) == 2:
                assert len(read(tmp_path / UNFINISHED)) >= 6  # before the end, too
                raise KeyboardInterrupt

    monkeypatch.setattr(bench_plan, "plan", tiny_plan)
    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "--out", str(tmp_path)]) == INTERRUPTED
    names = read(tmp_path / UNFINISHED).get_benchmark_names()
    assert sum(name.endswith("certified, trace") for name in names) == 2
    both = capsys.readouterr()
    assert "interrupted: " in both.err and "Interrupted" in both.out
    assert not (tmp_path / TIMES).exists()


@pytest.mark.parametrize("count", [0, 2])
def test_an_older_result_outlives_a_run_that_is_interrupted(count, tmp_path, monkeypatch):
    def interrupted(plan, measured, cache):
        for k in range(count):
            measured.keep("cube", f"{k}", [1.0])
        yield 0.0
        raise KeyboardInterrupt

    older = Bench()
    older.keep("cube", "certified, trace", [1.0])
    write(tmp_path, older)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "cube", "--out", str(tmp_path)]) == INTERRUPTED
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir() if p.is_file()} == before
    assert (tmp_path / UNFINISHED).exists() == bool(count)


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
