"""Long commands say how much is done, and what is being done, also where there is no terminal."""

from __future__ import annotations

import os
import struct
import sys
import time
from threading import Event

import pytest
from reference_tracer.cli import running
from reference_tracer.cli.commands import extremes as command
from reference_tracer.cli.main import main
from reference_tracer.cli.watch import watched
from reference_tracer.files import exr
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.study import extremes
from reference_tracer.study.scenarios.sweeps import BY_NAME
from reference_tracer.tracer.progress import Progress


class Clock:
    """One that is moved on by hand."""

    now = 100.0

    def __call__(self):
        return self.now


def test_an_estimate_never_grows_by_more_than_a_tenth(capsys):
    """Of what slows down, or of what nobody knows, no seconds are said."""
    clock = Clock()
    events = (
        Progress(0.25),
        Progress(0.26, "a"),
        Progress(0.5),
        Progress(None, "3/8: trying the lens"),
    )
    with running.progress_bar(clock) as show:
        for event in events:
            clock.now += 10.0
            show(event)
    assert capsys.readouterr().err.splitlines() == [
        " 25 % (10 s, 30 s left)",
        " 26 %, a (20 s)",
        " 50 % (30 s, 30 s left)",
        " 50 %, 3/8: trying the lens (40 s)",
    ]


def test_what_has_no_steps_is_named_every_ten_seconds(capsys):
    """And nothing is said of what has steps, or takes no time."""
    ended = Event()
    turns = []

    def wait(seconds):
        turns.append(seconds)
        if len(turns) == 3:
            ended.set()
        return len(turns) > 3

    with running.meanwhile("reading"), running.meanwhile("reading scene.obj"), watched(wait):
        assert ended.wait(60)
    with watched():
        pass
    assert capsys.readouterr().err.splitlines()[:2] == [
        "reading scene.obj (10 s)",
        "reading scene.obj (20 s)",
    ]
    assert turns == [running.LINE_EVERY] * 4 and not running.named


def test_tracing_is_said(make, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(running, "LINE_EVERY", 1e-9)
    save_scene(tmp_path / "s.npz", make.scene(make.camera(8, 6), make.quad(-1, 1, -1, 1, -2)))
    assert main(["trace", str(tmp_path / "s.npz"), "--out", str(tmp_path / "s.png")]) == 0
    assert "%, tracing (" in capsys.readouterr().err


def test_the_verdict_is_said_before_what_is_wrong_is_looked_for(
    make, tmp_path, capsys, monkeypatch
):
    """And then what is tried, without seconds."""
    monkeypatch.setattr(running, "LINE_EVERY", 1e-9)
    save_scene(tmp_path / "s.npz", make.room())
    picture = render(make.room()).color.copy()
    picture[20:30, 20:30, :3] = 0.123
    exr.save(tmp_path / "p.exr", {"color": picture})
    arguments = [str(tmp_path / n) for n in ("s.npz", "p.exr", "out")]
    main(["compare", arguments[0], "--against", arguments[1], "--out", arguments[2]])
    said = capsys.readouterr().err.splitlines()
    verdict = next(n for n, line in enumerate(said) if line.startswith("verdict: differences"))
    before = "\n".join(said[:verdict])
    after = [line for line in said[verdict + 1 :] if "trying" in line]
    assert "looking for causes" in before and "trying" not in before
    assert any("3/8: trying one object" in line for line in after)
    assert not [line for line in after if "left" in line]


def test_on_a_terminal_a_bar_says_what_is_done(monkeypatch):
    pty = pytest.importorskip("pty", reason="Windows has no pseudo-terminals")
    fcntl = pytest.importorskip("fcntl")
    termios = pytest.importorskip("termios")
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 100, 0, 0))
    with open(theirs, "w", encoding="utf-8") as terminal:
        monkeypatch.setattr(sys, "stderr", terminal)
        with running.progress_bar() as show:
            for number in range(5):
                show(Progress(number / 10, "tracing"))
                time.sleep(0.1)
        assert b"tracing" in os.read(ours, 1 << 16)


def test_a_command_says_which_scene_it_is_at(tmp_path, capsys, monkeypatch):
    scenarios = [BY_NAME["integer_cube"], BY_NAME["needles"]]
    measure = extremes.measure
    monkeypatch.setattr(
        command.study, "measure", lambda **given: measure(scenarios, judged=1, **given)
    )
    monkeypatch.setattr(running, "LINE_EVERY", 0.05)
    assert main(["extremes", "--rays", "20", "--out", str(tmp_path / "out")]) == 0
    printed = capsys.readouterr()
    assert "%, Integers, perspective, cells per side" in printed.err
    assert "%, Needles, " in printed.err
    assert "certified" in printed.out and "First scale" in printed.out
    written = {p.name for p in (tmp_path / "out").iterdir()}
    assert {"extremes.json", "extremes.txt", "extremes.html"} <= written
