"""Pictures and rows from workers are one process's to the bit, whatever becomes of the workers."""

from __future__ import annotations

import json
import signal
import time
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Scene
from reference_tracer.study import extremes, tradeoff
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import Meter, result_of
from reference_tracer.tracer.settings import UNPROVEN_SETTINGS, Settings
from reference_tracer_cluster import pictures, studies
from reference_tracer_cluster.cluster import ClusterError
from reference_tracer_cluster.connection import connected

from ..scenarios import quick
from .conftest import dask

pytestmark = pytest.mark.slow

CASES = [
    Settings("certified"),
    Settings("certified", samples=3),
    Settings("certified", samples=2, color="depth"),
    Settings("watertight", samples=2),
    Settings("textbook", "float32", color="facing"),
]


def bits(frame: Frame) -> dict:
    out = {name: (v.dtype, v.shape, v.tobytes()) for name, v in frame.passes().items()}
    return out | {"ties": dict(frame.ties), "refused": frame.statistics.refused}


@pytest.mark.parametrize("settings", CASES)
def test_all_arrays_are_those_of_one_process(cluster, scene, settings):
    found = render(scene, settings, tracer=pictures.tracer(cluster))
    assert bits(found) == bits(render(scene, settings))
    if settings.method == "certified":
        assert len(found.ties) > 10 and (found.certainty == Certainty.EXACT).any()


@pytest.fixture
def larger(scene):
    """Of enough rows for every worker to have some when something happens to one."""
    return scene.seen_by(replace(scene.camera, width=240, height=180, region=None))


def happens(cluster, scene, do) -> Frame:
    """Trace, and do something once a part is there."""
    frame = Frame.empty(scene)
    work, meter = steps(scene, Settings("certified"), frame, pictures.tracer(cluster)), Meter()
    for event in work:
        meter.read(event)
        if meter.share > 0.1 and do:
            do()
            do = None
    assert not do
    return frame


@pytest.fixture
def victim(shared, monkeypatch):
    """One more worker, that is ended; pictures are of many small parts."""
    monkeypatch.setattr(pictures, "EACH", 20)
    yield shared.work("victim")
    shared.end("victim")


def test_a_worker_is_killed(victim, shared, cluster, larger):
    kill = shared.processes["victim"].kill
    assert bits(happens(cluster, larger, kill)) == bits(render(larger))


def test_a_worker_is_silent(tmp_path, larger, monkeypatch):
    """Neither dead nor alive, it is not waited for: Dask gives up on it."""
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL", "2s")
    monkeypatch.setattr(pictures, "EACH", 20)
    with dask(tmp_path) as own:
        own.work("first"), own.work("second")
        with connected(own.address) as found:

            def pause():
                own.processes["second"].send_signal(signal.SIGSTOP)

            assert bits(happens(found, larger, pause)) == bits(render(larger))


def test_no_worker_is_left(tmp_path, larger, monkeypatch):
    monkeypatch.setattr(pictures, "EACH", 100)
    with dask(tmp_path) as own, pytest.raises(ClusterError, match=r"no worker of .* is left"):
        own.work("only")
        with connected(own.address) as found:
            happens(found, larger, lambda: own.end("only"))


def test_the_scheduler_ends(tmp_path, larger, monkeypatch):
    monkeypatch.setattr(pictures, "EACH", 100)
    with dask(tmp_path) as own, pytest.raises(ClusterError, match=r"127\.0\.0\.1:\d+ has ended"):
        own.work("only")
        with connected(own.address) as found:
            happens(found, larger, lambda: own.end("scheduler"))


def test_what_is_not_wanted_any_more_is_not_done(shared, larger):
    with connected(shared.address) as found:
        work = steps(
            larger.seen_by(replace(larger.camera, width=960, height=720, region=None)),
            Settings("textbook", samples=8),
            Frame.empty(larger),
            pictures.tracer(found),
        )
        while not any(found.client.processing().values()):
            next(work)
    with connected(shared.address) as again:
        for _ in range(100):
            if not any(again.client.processing().values()):
                break
            time.sleep(0.1)
        assert not any(again.client.processing().values())
        assert bits(render(larger, tracer=pictures.tracer(again)))


def test_a_trade_sends_a_scene_once_for_each_width(cluster, scene, monkeypatch):
    sent, keep = [], cluster.keep
    monkeypatch.setattr(cluster, "keep", lambda data: sent.append(data) or keep(data))
    every = partial(studies.trade, cluster)
    result_of(tradeoff.measure(scene, width=8, samples=2, every=every))
    assert sorted(s.camera.width for s in sent if isinstance(s, Scene)) == [2, 4, 8]


def test_commands(shared, scene, tmp_path, capsys, monkeypatch):
    """Each writes what it writes without workers."""
    save_scene(tmp_path / "scene.npz", scene)
    elsewhere = ["--scheduler", shared.address]

    def both(command, out, *options):
        for where, more in (("here", []), ("there", elsewhere)):
            argv = [command, *options, "--out", str(tmp_path / where / out), *more]
            assert main(argv) < INPUT_ERROR, capsys.readouterr().err
        return [tmp_path / where / out for where in ("here", "there")]

    path = str(tmp_path / "scene.npz")
    here, there = both("trace", "picture.exr", path)
    assert here.read_bytes() == there.read_bytes()
    main(["trace", path, "--out", str(tmp_path / "other.png")])
    other = str(tmp_path / "other.png")
    here, there = (p / "frame.npz" for p in both("compare", "c", path, "--against", other))
    with np.load(here) as one, np.load(there) as two:
        assert one.files == two.files
        assert all(one[name].tobytes() == two[name].tobytes() for name in one.files)
    small = ["--set", "width=6", "--samples", "1"]
    found = [
        json.loads((p / "tradeoff.json").read_text()) for p in both("trade", "t", path, *small)
    ]
    facts = "method", "precision", "width", "wrong_pixels", "largest_t_error", "coverage_error"
    here, there = ([{k: row[k] for k in facts} for row in f["rows"]] for f in found)
    assert here == there and len(here) == 3 * (len(UNPROVEN_SETTINGS) + 1)
    monkeypatch.setattr(
        extremes.measure, "__defaults__", (tuple(quick()[:2]), *extremes.measure.__defaults__[1:])
    )
    here, there = both("extremes", "e", "--rays", "30")
    assert (here / "extremes.json").read_bytes() == (there / "extremes.json").read_bytes()
