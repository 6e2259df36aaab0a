"""What a benchmark leaves in a folder, also when it is interrupted: JSON, a table, a plot."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR, INTERRUPTED
from reference_tracer.methods import Method
from reference_tracer.scene import SceneError
from reference_tracer_benchmarks import run as bench_run
from reference_tracer_benchmarks.measure import measure
from reference_tracer_benchmarks.plan import COMMANDS, Case, Plan
from reference_tracer_benchmarks.plot import largest, picture
from reference_tracer_benchmarks.report import JSON, PLOT, SCHEMA, TABLE, load, to_dict, write
from reference_tracer_benchmarks.rows import Bench, CommandRow, Row, machine
from reference_tracer_benchmarks.scenes import CAMERAS, SCALED, SUBJECTS
from reference_tracer_benchmarks.tables import ratios, table

from ..drawn import Plot, scale

STAGES = "project", "cull", "decide", "resolve", "shade"


def made_row(name, size, camera, method, rng):
    triangles, pixels = SUBJECTS[name].triangles, size[0] * size[1]
    seconds = 2e-8 * pixels + 6e-8 * triangles
    row = Row(name, triangles, size[0], size[1], camera, method, "float64")
    row.trace_s, row.render_s = seconds * rng.uniform(0.9, 1.2), 1.6 * seconds
    row.embreex_trace_s, row.embreex_build_s = 7e-8 * pixels, 1e-6 * triangles
    row.embreex_rays, row.peak_bytes, row.rounds = pixels, 120 << 20, 5
    row.ratio_to_mt, row.ratio_to_mt_least, row.ratio_to_mt_most = 1.1, 1.02, 1.34
    row.ratio_to_embreex, row.ratio_to_embreex_least, row.ratio_to_embreex_most = 10.6, 9.5, 12.7
    row.picture_s, row.outputs_s, row.embreex_ids_s = 0.5 * seconds, 0.8 * seconds, 6e-8 * pixels
    row.picture_ratio, row.picture_ratio_least, row.picture_ratio_most = 0.71, 0.61, 0.81
    row.outputs_ratio, row.outputs_ratio_least, row.outputs_ratio_most = 1.41, 1.31, 1.51
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


def test_the_json_and_back(bench, tmp_path):
    write(tmp_path, bench)
    text = (tmp_path / JSON).read_text(encoding="utf-8")
    data = json.loads(text, parse_constant=pytest.fail)
    assert data["schema"] == SCHEMA == "reference_tracer.bench/1"
    assert {"python", "numpy", "cpu_count", "machine"} <= data.keys()
    assert load(tmp_path / JSON) == bench
    assert to_dict(load(tmp_path / JSON)) == data
    assert {s["over"] for s in data["scaling"]} == {"triangles", "pixels"}
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"schema": "other/1"}', '{"schema": 1, "rows"'])
def test_another_file_is_refused(text, tmp_path):
    (tmp_path / "other.json").write_text(text)
    with pytest.raises(SceneError, match=r"other\.json"):
        load(tmp_path / "other.json")


def test_the_table(bench):
    text = table(bench)
    lines = text.splitlines()
    assert max(map(len, lines)) <= 100 and all(line == line.rstrip() for line in lines)
    assert all(name in text for name in SUBJECTS) and all(stage in text for stage in STAGES)
    assert "1.10 (1.02 - 1.34)" in text and "10.60 (9.50 - 12.70)" in text
    assert "0.71 (0.61 - 0.81)" in text and "1.41 (1.31 - 1.51)" in text
    assert all(name in text for name in COMMANDS) and "0.40 (0.30 - 9.50)" in text
    assert text.count("0.25 s") == 1
    assert "~30,000" in text and bench.notes[0] in text
    assert "baseline" not in text and "nterrupted" not in text
    assert "Interrupted" in table(replace(bench, interrupted=True))


def test_a_sample_of_rays_is_marked(bench):
    row = next(r for r in bench.rows if r.method == "certified")
    whole, sample = (
        table(Bench({}, rows=[replace(row, embreex_rays=n)])) for n in (row.pixels, row.pixels - 1)
    )
    mark = "10.60 (9.50 - 12.70)~"
    assert mark in sample and mark not in whole


def test_a_table_of_what_little_there_is(bench):
    bare = Row("cube", 12, 8, 8, "perspective", "certified", "float64", 0.5, 0.75)
    assert "cube" in table(Bench({}, rows=[bare]))
    assert "nothing was measured" in table(Bench({}, notes=["why"])) and "why" in table(
        Bench({}, notes=["why"])
    )
    Plot(picture(Bench({}, rows=[bare]))).assert_legible()


def test_against_a_baseline(bench):
    faster = [replace(r, trace_s=r.trace_s / 2) for r in bench.rows if r.scene != "cube"]
    new = Bench(bench.machine | {"numpy": "9.9"}, rows=faster)
    found = ratios(new, bench, "trace_s")
    assert len(found) == len(faster) and set(found.values()) == {0.5}
    text = table(new, bench)
    assert max(map(len, text.splitlines())) <= 100
    last = next(line for line in text.splitlines() if line.startswith("median"))
    assert last.split() == ["median", "0.50", "1.00", "1.00", "1.00"]
    assert f"numpy {bench.machine['numpy']} then, 9.9 now" in text
    slower = [replace(c, ratio=3 * c.ratio) for c in bench.commands[1:]]
    lines = table(Bench({}, commands=slower), bench).splitlines()
    assert sum(line.endswith("3.00") for line in lines) == len(slower)
    other = Bench({}, rows=[replace(bench.rows[0], width=7)])
    assert "none of these rows" in table(other, bench)


def test_the_plot(bench):
    assert {(r.width, r.camera) for r in largest(bench)} == {(1920, "perspective")}
    for rows in (bench.rows, [r for r in bench.rows if r.scene not in SCALED]):
        some = replace(bench, rows=rows)
        plot = Plot(picture(some))
        plot.assert_legible()
        along = [t for t in plot.texts if 880 < t.y < 930]  # the numbers of both axes
        number = {" k": 1e3, " M": 1e6}
        values = [
            (t.x, float(t.words[:-2]) * number[t.words[-2:]])
            for t in along
            if t.words[-2:] in number
        ]
        x = scale(values, log=True)
        marks = [e for e in plot.elements if e.tag == "circle" and e.x > 150 and e.y < 885]
        of_mine = [r for r in largest(some) if len(rows) < len(bench.rows) or r.scene in SCALED]
        found = sorted(
            x(m.x) for m in marks if m.attributes["fill"] == Method.CERTIFIED.record.color
        )
        assert found == pytest.approx(sorted(r.triangles for r in of_mine), rel=0.01)
        bars = plot.titled("rect")
        assert {b.words.split(",")[0] for b in bars} == {r.scene for r in largest(some)}
        for r in largest(some):
            ends = [
                (b.x, float(b.attributes["width"]))
                for b in bars
                if b.words.startswith(f"{r.scene},")
            ]
            assert len(ends) == len(r.stages) + 1
            assert all(x + w == pytest.approx(other) for (x, w), (other, _) in pairwise(ends))
    with pytest.raises(ValueError, match="nothing"):
        picture(Bench({}))


# ---- the command


def tiny_plan(names, quick, repeats):
    cases = tuple(Case(n, 24, 14, c) for n in ("cube", "icosphere_5k") for c in CAMERAS)
    return Plan(cases, quick, repeats or 1, budget=0.2, slow=0.05)


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_run, "plan", tiny_plan)
    assert main(["bench", "--quick", "--out", str(tmp_path / "a")]) == AGREE
    first = load(tmp_path / "a" / JSON)
    assert first.quick and len(first.rows) == 8 and not first.interrupted
    assert "icosphere_5k" in Plot((tmp_path / "a" / PLOT).read_text(encoding="utf-8")).said()
    said = capsys.readouterr().out
    assert "icosphere_5k" in said and "written to" in said
    options = ["--out", str(tmp_path / "b"), "--baseline", str(tmp_path / "a" / JSON)]
    assert main(["bench", *options]) == AGREE
    assert "against the baseline" in (tmp_path / "b" / TABLE).read_text()


def test_interrupted_it_leaves_what_was_measured(tmp_path, monkeypatch, capsys):
    def interrupted(plan, bench, cache):
        work = measure(plan, bench, cache)
        for share in work:
            yield share
            if len(bench.rows) == 4:
                written = load(tmp_path / JSON)  # before the end, too
                assert len(written.rows) >= 2 and not written.interrupted
                raise KeyboardInterrupt

    monkeypatch.setattr(bench_run, "plan", tiny_plan)
    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "--out", str(tmp_path)]) == INTERRUPTED
    found = load(tmp_path / JSON)
    assert found.interrupted and len(found.rows) == 4
    both = capsys.readouterr()
    assert "interrupted: 2 of 4 pictures" in both.err and "Interrupted" in both.out
    assert (tmp_path / PLOT).is_file()


def test_interrupted_at_once(tmp_path, monkeypatch, capsys):
    def interrupted(plan, bench, cache):
        raise KeyboardInterrupt
        yield 0.0

    monkeypatch.setattr(bench_run, "measure", interrupted)
    assert main(["bench", "cube", "--out", str(tmp_path)]) == INTERRUPTED
    assert load(tmp_path / JSON).rows == [] and not (tmp_path / PLOT).exists()
    assert "nothing was measured" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "what"),
    [
        (["sphere"], "no benchmark scene 'sphere'"),
        (["--repeats", "0"], "--repeats is 0"),
        (["--baseline", "nowhere.json"], "nowhere.json"),
    ],
)
def test_what_is_wrong_is_said_before_the_work(options, what, tmp_path, capsys):
    assert main(["bench", "--out", str(tmp_path / "new"), *options]) == INPUT_ERROR
    assert what in capsys.readouterr().err and not (tmp_path / "new").exists()
