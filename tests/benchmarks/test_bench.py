"""The benchmark's loop and its peers, on pictures of a few pixels."""

from __future__ import annotations

import importlib.util
import os
import sys
from multiprocessing import active_children
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.tracer.progress import result_of
from reference_tracer_benchmarks import children, commands, field, measure, peers, scenes
from reference_tracer_benchmarks.blender_peer import BlenderPeer
from reference_tracer_benchmarks.peers import Embreex, MissingPeerError, Rtree, Timed
from reference_tracer_benchmarks.plan import Case, Plan
from reference_tracer_benchmarks.rays import rays_of
from reference_tracer_benchmarks.results import Bench
from reference_tracer_benchmarks.rounds import Runner, in_rounds

from ..cases import rising

WIDTH, HEIGHT = 48, 27
OURS = [f"{m}, {w}" for m in ("certified", "moller_trumbore") for w in ("trace", "render")]
FILES = "suzanne", "out", "cube.blend", "xray.blend", "mesh.ply"


def tiny(*names: str, cameras=("perspective",), peers=frozenset(), sizes=((WIDTH, HEIGHT),)):
    cases = [Case(n, w, h, c, frozenset(peers)) for n in names for w, h in sizes for c in cameras]
    return Plan(tuple(cases), True, repeats=2, budget=0.5, slow=0.05)


# ---- peers


def test_rtree_traces_a_sample(tmp_path):
    tracer, rays = (
        Rtree(scenes.mesh_of("cube", tmp_path)),
        rays_of(
            scenes.build(scenes.mesh_of("cube", tmp_path), WIDTH, HEIGHT, "perspective").camera
        ),
    )
    timed = tracer.trace(rays, 1e-9)
    assert timed.rays == peers.BATCH and timed.seconds > 0
    assert tracer.trace(rays, 1e9).rays == WIDTH * HEIGHT


def test_as_many_rows_as_fit():
    camera = scenes.build(scenes.mesh_of("cube", None), 400, 300, "perspective").camera

    def taking(each):
        return lambda rays: each * rays.count

    assert peers.fitting(taking(1e-6), camera, 1.0).count == 400 * 300
    some = peers.fitting(taking(1e-3), camera, 12.0)  # a tenth of its 120 s
    assert some.count == 400 * 30 and some.of == 400 * 300
    assert peers.fitting(taking(1.0), camera, 1e-3).count == 400


@pytest.mark.parametrize("library", ["embreex", "rtree"])
def test_a_missing_library_is_named(library, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, library, None)
    if library == "rtree":
        monkeypatch.setattr("trimesh.Trimesh.triangles_tree", property(_no_rtree))
    make = {"embreex": Embreex, "rtree": Rtree}[library]
    with pytest.raises(MissingPeerError, match=rf'{library}.*"reference_tracer\[bench\]"'):
        make(scenes.mesh_of("cube", tmp_path))


def _no_rtree(self):
    raise ImportError("no rtree")


def test_without_peers_ours_is_measured(monkeypatch, tmp_path):
    for name in ("embreex", "rtree"):
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setattr("trimesh.Trimesh.triangles_tree", property(_no_rtree))
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    bench = Bench()
    wanted = tiny("cube", "suzanne", peers={"rtree", "bvhtree", "cycles", "workbench"})
    result_of(measure.measure(wanted, bench, tmp_path))
    assert {what for what, _ in bench.found} == {"cube, 48 x 27, perspective"}
    assert {who for _, who in bench.found} >= set(OURS) and "embreex_trace" not in str(bench.found)
    said = "\n".join(bench.notes)
    for word in ("embreex", "rtree", "bvhtree, cycles, workbench", "suzanne is left out"):
        assert word in said
    assert len(bench.notes) == 4


class NoWorkbench:
    """A Blender that can do all but draw."""

    def __init__(self):
        NoWorkbench.asked = self.asked = []

    def open(self, scene):
        self.asked.append("open")

    def bvhtree(self, budget):
        return Timed(2.0, 100)

    def render(self, engine):
        self.asked.append(engine)
        if engine == "workbench":
            raise MissingPeerError("Blender ended without an answer to 'workbench'")
        return 3.0

    def close(self):
        self.asked.append("closed")


def test_a_peer_that_fails_is_left_out_from_then_on(monkeypatch, tmp_path):
    monkeypatch.setattr(field, "BlenderPeer", NoWorkbench)
    bench = Bench()
    wanted = tiny("cube", cameras=scenes.CAMERAS, peers={"bvhtree", "cycles", "workbench"})
    result_of(measure.measure(wanted, bench, tmp_path))
    for camera in scenes.CAMERAS:
        case = f"cube, {WIDTH} x {HEIGHT}, {camera}"
        tree = bench.found[case, "bvhtree"]
        assert set(tree.get_values()) == {2.0} and tree.get_metadata()["rays"] == 100
        assert set(bench.found[case, "cycles"].get_values()) == {3.0}
        assert (case, "workbench") not in bench.found
    assert NoWorkbench.asked.count("workbench") == 1 and NoWorkbench.asked[-1] == "closed"
    [note] = bench.notes
    assert note.endswith("workbench: Blender ended without an answer to 'workbench'")


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="there is no bpy")
def test_blender_answers(tmp_path, monkeypatch):
    # A process is given our path, to which bpy, imported by another test, adds its own folders.
    monkeypatch.setattr(sys, "path", [p for p in sys.path if "scripts" not in Path(p).parts])
    blender = BlenderPeer()
    try:
        blender.open(scenes.build(scenes.mesh_of("cube", tmp_path), WIDTH, HEIGHT, "orthographic"))
        timed = blender.bvhtree(1.0)
        assert timed.rays == WIDTH * HEIGHT and timed.seconds > 0
        assert blender.render("cycles") > 0
        blender.make_suzanne(tmp_path / scenes.SUZANNE_FILE)
        mesh = scenes.mesh_of("suzanne", tmp_path)
        assert len(mesh.triangles) == scenes.SUBJECTS["suzanne"].triangles
        assert np.abs(mesh.vertices).max() < 1.5
        with pytest.raises(MissingPeerError, match="KeyError: 'none'"):
            blender.render("none")
        [process] = active_children()
        process.kill()
        with pytest.raises(MissingPeerError, match="ended without an answer to 'cycles'"):
            blender.render("cycles")
        assert blender.render("cycles") > 0  # a new one opens the scene again
    finally:
        blender.close()


# ---- rounds


def test_rounds_take_turns_and_the_first_is_forgotten():
    order = []

    def run(name, seconds):
        def once():
            order.append(name)
            return seconds.pop(0)

        return once

    a, b = Runner(run("a", [9.0, 1.0, 3.0])), Runner(run("b", [9.0, 2.0, 2.0]))
    once = Runner(run("c", [5.0]), allowed=0.0)
    result_of(in_rounds([a, b, once], 2, 100.0))
    assert "".join(order) == "abc" + "ab" + "ba"
    assert (a.seconds, b.seconds, once.seconds) == ([1.0, 3.0], [2.0, 2.0], [5.0])


def test_where_there_is_no_time_the_first_round_counts():
    slow = Runner(lambda: 7.0)
    slow.spent.append(99.0)  # seconds that it has taken already
    result_of(in_rounds([slow], 5, 10.0))
    assert slow.seconds == [7.0]


def test_who_fails_has_no_time():
    def fail():
        raise MissingPeerError("gone")

    broken, other = Runner(fail), Runner(lambda: 1.0)
    shares, _ = rising(in_rounds([broken, other], 2, 10.0))
    assert (broken.seconds, broken.failed, set(other.seconds)) == ([], "gone", {1.0})
    assert shares[-1] == 1


# ---- commands


def test_commands_are_beside_the_ruler_and_what_fails_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(commands, "RULER", "sum(range(3_000_000))")
    monkeypatch.setattr(commands, "_files", lambda folder: dict.fromkeys(FILES, tmp_path / "none"))
    names = "reftrace --help", "compare suzanne, 960 x 540"
    bench, wanted = Bench(), Plan((), True, 1, 9.0, 1.0, commands=names)
    result_of(commands.measure_commands(wanted, bench, tmp_path))
    ruled = {(name, commands.RULER) for name in names}
    assert set(bench.found) == {*ruled, (names[0], "command")}
    [seconds] = bench.found[names[0], "command"].get_values()
    assert 0.01 < seconds < 5
    [note] = bench.notes
    assert note.startswith(f"{names[1]}: command: it failed (") and "none" in note


# ---- the whole


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    found = Bench()
    wanted = tiny(
        "cube",
        "icosphere_5k",
        cameras=scenes.CAMERAS,
        sizes=((WIDTH, HEIGHT), (24, 13)),
        peers={"rtree"},
    )
    before = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else None
    shares, _ = rising(measure.measure(wanted, found, tmp_path_factory.mktemp("bench")))
    assert shares[-1] == 1
    assert before is None or os.sched_getaffinity(0) == before
    return found


def test_each_picture_is_timed_beside_its_peers(bench):
    pictures = {what for what, _ in bench.found}
    assert len(pictures) == 2 * 2 * 2 and not bench.notes
    for what in pictures:
        own = {who: found for (other, who), found in bench.found.items() if other == what}
        assert own.keys() >= {*OURS, "certified, picture", "certified, outputs", "rtree"}
        width, height = map(int, what.split(", ")[1].split(" x "))
        embreex, rtree = own["embreex_trace"].get_metadata(), own["rtree"].get_metadata()
        assert embreex["rays"] == width * height >= rtree["rays"] and embreex["differs"] < 0.01
        assert own["rtree"].mean() > own["embreex_trace"].mean() and "cycles" not in own
    assert sum(who == "embreex_build" for _, who in bench.found) == 2  # once a scene


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork")
def test_a_plain_method_that_takes_too_long_is_not_timed(tmp_path, monkeypatch):
    monkeypatch.setattr(children, "LONGEST", 1e-6)
    case = Case("cube", 64, 36, "perspective")
    found = Bench()
    result_of(measure.measure(Plan((case,), False, 1, 1.0, 0.1), found, tmp_path))
    who = {who for _, who in found.found}
    assert not any(name.startswith("moller_trumbore") for name in who)
    assert {"certified, trace", "certified, render"} <= who
    assert sum("takes more than" in note for note in found.notes) == 2
