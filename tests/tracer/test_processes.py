"""Several processes make the picture that one makes, and leave nothing behind however they end."""

from __future__ import annotations

import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
from collections import namedtuple
from dataclasses import replace
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path

import numpy as np
import pytest
import reference_tracer
import trimesh
from reference_tracer.scene import Instance, Mesh, Region, Scene
from reference_tracer.tracer import processes, shared
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.processes import WorkerError, Workers, render_with, tracing
from reference_tracer.tracer.render import render, steps
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.worker import _sendable

from .pictures import mess


@pytest.fixture(scope="module")
def workers():
    """Three processes, which all tests share that do not end them."""
    with Workers(3) as crew:
        yield crew


@pytest.fixture
def blocks(monkeypatch):
    """Return the names of the blocks of shared memory that this process makes."""
    names = []

    class Noted(SharedMemory):
        def __init__(self, *args, **options):
            super().__init__(*args, **options)
            names.append(self.name)

    monkeypatch.setattr(shared, "SharedMemory", Noted)
    return names


def check_nothing_left(blocks: list[str], before: list) -> None:
    assert len(blocks) == 2  # one for the scene, one for the frame
    for name in blocks:
        with pytest.raises(FileNotFoundError):
            SharedMemory(name)
    assert set(multiprocessing.active_children()) <= set(before)


def traced(workers: Workers, scene: Scene, settings: Settings) -> Frame:
    frame = Frame.empty(scene)
    assert list(workers.steps(scene, settings, frame))[-1] == 1
    return frame


def same(frame: Frame, other: Frame) -> None:
    for name, values in frame.passes().items():
        found = other.passes()[name]
        assert values.shape == found.shape and values.dtype == found.dtype, name
        assert values.tobytes() == found.tobytes(), name
    assert frame.ties == other.ties and not other.cancelled
    took, found = frame.statistics, other.statistics
    for name in ("method", "triangles", "refused", "reasons", "notes"):
        assert getattr(took, name) == getattr(found, name), name
    assert required(frame) == required(other)


def required(frame: Frame) -> list[str]:
    """What the scene required, but for how many pairs were tested: that is how it was done."""
    text = "\n".join(frame.statistics.required())
    return re.sub(r"of [\d,]+ pairs", "of pairs", re.sub(r"\(one in [\d,]+\) ", "", text)).split(
        "\n"
    )


@pytest.mark.parametrize("orthographic", [False, True], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("whole", [True, False], ids=["grid", "any"])
@pytest.mark.parametrize("seed", range(3))
def test_a_messy_picture_is_the_same(workers, make, seed, whole, orthographic):
    """Ties, planes, duplicates, clip planes, a border, several samples."""
    scene = mess(make, np.random.default_rng(seed), orthographic, whole)
    larger = replace(scene.camera, width=60, height=45, region=Region(7, 4, 55, 40))
    scene = replace(scene, camera=larger)
    frame = render(scene, Settings("certified"))
    same(frame, traced(workers, scene, Settings("certified")))
    assert frame.ties and frame.statistics.reasons
    sampled = Settings("certified", samples=2)
    same(render(scene, sampled), traced(workers, scene, sampled))


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize(
    "method", ["textbook_literal", "textbook", "moller_trumbore", "watertight"]
)
def test_plain_methods_are_the_same(workers, make, method, precision):
    scene = mess(make, np.random.default_rng(5), False, False)
    scene = replace(scene, camera=replace(scene.camera, width=60, height=45, region=None))
    settings = Settings(method, precision)
    frame, found = render(scene, settings), traced(workers, scene, settings)
    same(frame, found)
    assert frame.statistics.pairs_tested == found.statistics.pairs_tested > 0


def test_colours_come_with_the_scene(workers, make):
    """Slots, corner colours, arrays that are not contiguous or empty, triangles left out."""
    ball = trimesh.creation.icosphere(3)
    faces = np.array(ball.faces, np.int32)
    rng = np.random.default_rng(1)
    wide = np.zeros((len(ball.vertices), 6))
    wide[:, ::2] = ball.vertices
    meshes = (
        Mesh(wide[:, ::2], faces, slots=rng.integers(0, 3, 2 * len(faces))[::2]),
        Mesh(np.asfortranarray(ball.vertices), faces, corner_colors=rng.random((len(faces), 3, 4))),
        Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32)),
        Mesh([(0, 0, 0), (1e300, 0, 0), (0, 1, 0)], [(0, 1, 2)]),
    )
    instances = []
    for k, scale in enumerate((1, 1, 1, 1e200)):
        matrix = np.diag([scale] * 3 + [1.0])
        matrix[:3, 3] = (k - 1.0, 0, -5)
        instances.append(Instance(k, 0, matrix, rng.random((3, 4))))
    scene = Scene(
        make.camera(64, 48), meshes, instances, background=(0.1, 0.2, 0.3, 1), objects="A"
    )
    frame = render(scene)
    same(frame, traced(workers, scene, Settings()))
    assert frame.statistics.refused == 1
    assert len(np.unique(frame.color.reshape(-1, 4), axis=0)) > 5


def test_workers_last(workers, make):
    """One set of processes traces many pictures; frames stay what they are, and can be written."""
    first = make.scene(make.camera(), make.quad(-1, 1, -1, 1, -3))
    second = make.scene(make.camera(31, 1), make.quad(-1, 0, -1, 1, -3))  # one row: one band
    frames = [traced(workers, scene, Settings()) for scene in (first, second, first)]
    for scene, frame in zip((first, second, first), frames, strict=True):
        same(render(scene), frame)
        frame.t[:] = 1.0


def test_progress_rises_to_1_at_the_end(workers, make):
    scene = make.scene(make.camera(200, 150), make.mesh(trimesh.creation.icosphere(4)))
    scene = replace(scene, camera=replace(scene.camera, world_from_camera=_backed(6)))
    frame = Frame.empty(scene)
    began = time.perf_counter()
    shares = list(workers.steps(scene, Settings(samples=6), frame))
    seconds = time.perf_counter() - began
    assert (np.diff(shares) >= 0).all() and shares[0] >= 0
    assert shares[-1] == 1 and max(shares[:-1]) < 1 and len(set(shares)) > 5
    assert 0 < frame.statistics.seconds <= seconds  # the clock's, not the sum of all processes'


def _backed(distance: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[2, 3] = distance
    return matrix


def test_one_process_takes_the_plain_way(make, monkeypatch):
    monkeypatch.setattr(processes, "Workers", None)
    scene = make.scene(make.camera(), make.quad(-1, 1, -1, 1, -3))
    shares = []
    same(render(scene), render_with(scene, Settings(), 1, shares.append))
    assert shares[-1] == 1
    with tracing(1) as trace:
        assert trace is steps


@pytest.mark.parametrize("count", [0, -2])
def test_no_processes_are_refused(count, make):
    scene = make.scene(make.camera(), make.quad(-1, 1, -1, 1, -3))
    with pytest.raises(ValueError, match=f"processes is {count}; it must be at least 1"):
        render_with(scene, Settings(), count)


def test_two_at_once_and_nothing_is_left(make, blocks):
    before = multiprocessing.active_children()
    scene = make.scene(make.camera(), make.quad(-1, 1, -1, 1, -3))
    same(render(scene), render_with(scene, Settings(), 2))
    check_nothing_left(blocks, before)


def test_an_error_in_a_worker_is_raised_here(make, blocks):
    """A mesh that has lost its slots: only who shades it sees that."""
    before = multiprocessing.active_children()
    mesh = make.quad(-1, 1, -1, 1, -3)
    object.__setattr__(mesh, "slots", np.zeros(0, np.int32))
    scene = make.scene(make.camera(), mesh)
    two = replace(scene.instances[0], colors=np.ones((2, 4)))
    with pytest.raises(IndexError) as caught:
        render_with(replace(scene, instances=[two]), Settings(), 2)
    told = str(caught.value.__cause__)
    assert "Traceback" in told and "shading.py" in told and "IndexError" in told
    check_nothing_left(blocks, before)


class UnsendableError(Exception):
    def __init__(self, one, two):
        super().__init__(f"{one} and {two}")


def test_an_error_that_cannot_be_sent_keeps_its_words():
    assert str(_sendable(UnsendableError(1, 2))) == "UnsendableError: 1 and 2"
    error = MemoryError("much")
    assert _sendable(error) is error


@pytest.mark.skipif(os.name != "posix", reason="signals are the system's")
@pytest.mark.parametrize("when", [0.0, 0.02], ids=["at the start", "at work"])
def test_a_killed_worker_is_named(when, make, blocks):
    before = multiprocessing.active_children()
    ball = make.mesh(trimesh.creation.icosphere(4))
    scene = make.scene(make.camera(200, 150, eye=(0, 0, 6)), ball)
    killed = []

    def kill(share):
        if share >= when and not killed:
            crew = set(multiprocessing.active_children()) - set(before)
            killed.append(min(p.pid for p in crew))
            os.kill(killed[0], signal.SIGKILL)

    with pytest.raises(WorkerError) as caught:
        render_with(scene, Settings(samples=12), 2, kill)
    told = str(caught.value)
    assert f"process {killed[0]}" in told and "of 2" in told and "SIGKILL" in told
    if when:
        check_nothing_left(blocks, before)


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_who_cancels_leaves_nothing(error, make, blocks):
    before = multiprocessing.active_children()
    ball = make.mesh(trimesh.creation.icosphere(4))
    scene = make.scene(make.camera(200, 150, eye=(0, 0, 6)), ball)

    def cancel(share):
        if share > 0:
            raise error

    with pytest.raises(error):
        render_with(scene, Settings(samples=12), 2, cancel)
    check_nothing_left(blocks, before)


def test_who_stops_asking_ends_the_workers(make, blocks):
    before = multiprocessing.active_children()
    scene = make.scene(make.camera(200, 150), make.quad(-1, 1, -1, 1, -3))
    with Workers(1) as crew:
        work = crew.steps(scene, Settings(samples=12), Frame.empty(scene))
        while next(work) == 0:
            pass
        work.close()
        check_nothing_left(blocks, before)
        with pytest.raises(WorkerError, match="have ended"):
            next(crew.steps(scene, Settings(), Frame.empty(scene)))


def test_too_little_shared_memory_is_said_before_any_work(make, monkeypatch):
    """Containers often have 64 MiB of it; to write beyond ends a process without a word."""
    before = multiprocessing.active_children()
    Room = namedtuple("Room", "f_bavail f_frsize")
    monkeypatch.setattr(shared, "_SHARED", Path())
    monkeypatch.setattr(os, "statvfs", lambda path: Room(32, 1 << 20), raising=False)
    scene = make.scene(make.camera(1000, 1000), make.quad(-1, 1, -1, 1, -3))
    with pytest.raises(OSError, match=r"need 54 MiB of shared memory, of which 32 MiB are free"):
        render_with(scene, Settings(), 2)
    assert set(multiprocessing.active_children()) <= set(before)


SCRIPT = """
import bpy  # as a script for Blender has it: one beside this script that leaves a line
import numpy as np
from reference_tracer.scene import Camera, Scene, ViewWindow
from reference_tracer.tracer.processes import render_with

print("ran")
scene = Scene(Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 8, 8))
print(render_with(scene, processes=2).rows_done.all())
"""


def test_the_script_runs_once_and_workers_know_no_blender(tmp_path):
    """Also one that starts its work outside of `if __name__ == "__main__"`."""
    (tmp_path / "bpy.py").write_text("print('bpy')", encoding="utf-8")
    (tmp_path / "script.py").write_text(SCRIPT, encoding="utf-8")
    folder = Path(next(iter(reference_tracer.__path__))).parent
    done = subprocess.run(
        [sys.executable, "script.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.stdout.split(), done.stderr) == (["bpy", "ran", "True"], "")
