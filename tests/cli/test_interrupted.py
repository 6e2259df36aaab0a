"""Commands that are interrupted, or run out of memory, leave nothing half done."""

from __future__ import annotations

import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import pytest
from reference_tracer.cli.commands import trace as trace_command
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE, INPUT_ERROR
from reference_tracer.files import images
from reference_tracer.study import extremes, tradeoff
from reference_tracer.tracer import signals
from reference_tracer.tracer.progress import result_of

from .parts import trace


def refuse_memory(*args, **options):
    raise MemoryError("Unable to allocate 1 TiB")


def test_too_little_memory_is_one_line(ball, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(trace_command, "render", refuse_memory)
    assert trace(ball, tmp_path / "new" / "b.png") == INPUT_ERROR
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "choose a smaller size" in said and "1 TiB" in said
    assert not (tmp_path / "new").exists()


@pytest.fixture(params=list(signals.SIGNALS), ids=lambda number: number.name)
def number(request):
    """Return each of the signals that end the work."""
    return request.param


@pytest.fixture
def interrupted_work(monkeypatch, number):
    def swallow(*args, **options):
        """Be interrupted where nobody hears it, as in a callback of Blender's."""
        with suppress(KeyboardInterrupt):
            signal.raise_signal(number)
        yield 0.5
        pytest.fail("the work went on")

    monkeypatch.setattr(extremes, "measure", swallow)
    monkeypatch.setattr(tradeoff, "measure", swallow)
    monkeypatch.setattr(trace_command, "render", lambda *given: result_of(swallow(), given[-1]))


@pytest.mark.usefixtures("interrupted_work")
@pytest.mark.parametrize("command", ["trace", "trade", "extremes"])
def test_interrupted(command, number, ball, tmp_path, capsys):
    handlers = [signal.getsignal(n) for n in signals.SIGNALS]
    before = sorted(tmp_path.rglob("*"))
    out = tmp_path / "new" / ("x.png" if command == "trace" else "out")
    scene = [] if command == "extremes" else [str(ball)]
    assert main([command, *scene, "--out", str(out)]) == 128 + number
    said = capsys.readouterr().err.strip().splitlines()[-1]
    assert said == f"reftrace: {signals.SIGNALS[number]}"
    assert sorted(tmp_path.rglob("*")) == before
    assert [signal.getsignal(n) for n in signals.SIGNALS] == handlers


def test_interrupted_while_writing(number, ball, tmp_path, monkeypatch):
    """The older picture is whole, and no temporary folder is left."""
    assert trace(ball, tmp_path / "b.png") == AGREE
    before = {p: p.read_bytes() for p in tmp_path.iterdir()}

    def half(path, picture):
        path.write_bytes(b"half")
        signal.raise_signal(number)

    monkeypatch.setattr(images, "save_png", half)
    assert trace(ball, tmp_path / "b.png", "--method", "textbook_literal") == 128 + number
    assert {p: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_what_is_held_within_what_is_held_comes_at_the_outer_end():
    steps = []
    with pytest.raises(KeyboardInterrupt), signals.heard():
        with signals.held():
            with signals.held():
                signal.raise_signal(signal.SIGINT)
                steps.append("inner")
            steps.append("between")
            signal.raise_signal(signal.SIGINT)
            steps.append("outer")
        steps.append("after")
    assert steps == ["inner", "between", "outer"]


def test_outside_the_main_thread_nothing_is_taken_over():
    def work():
        with signals.heard():
            return signal.getsignal(signal.SIGINT)

    with ThreadPoolExecutor() as pool:
        assert pool.submit(work).result() is signal.default_int_handler


def test_a_signal_in_a_destructor_is_answered_and_nothing_is_printed(monkeypatch):
    class Last:
        def __del__(self):
            signal.raise_signal(signal.SIGINT)

    class Broken:
        def __del__(self):
            raise ValueError

    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda swallowed: told.append(swallowed.exc_type))
    with pytest.raises(KeyboardInterrupt), signals.heard():
        Last()
        assert told == []
        Broken()
        assert told == [ValueError]
        signals.check()
    Broken()
    assert told == [ValueError, ValueError]  # as before
