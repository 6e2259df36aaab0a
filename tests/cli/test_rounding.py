"""`reftrace trace`: how far rounding goes before the proof, and what it changes."""

from __future__ import annotations

from reference_tracer.cli.parser import AGREE, INPUT_ERROR

from .parts import trace


def test_bounds_are_said_of_what_is_certified(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png") == AGREE
    said = capsys.readouterr().out.splitlines()
    assert any(line.startswith("before any test, rounding moves rays by at most") for line in said)
    assert not any("unrounded" in line for line in said)


def test_the_check(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png", "--check-rounding") == AGREE
    assert "0 of 384 pixels would show another surface unrounded" in capsys.readouterr().out


def test_the_check_is_about_proven_pixels(ball, tmp_path, capsys):
    plain = "--check-rounding", "--method", "textbook"
    assert trace(ball, tmp_path / "b.png", *plain) == INPUT_ERROR
    assert "--method certified" in capsys.readouterr().err
    assert not (tmp_path / "b.png").exists()
