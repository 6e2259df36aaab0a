"""`reftrace trace`: how far rounding goes before the proof, and what it changes."""

from __future__ import annotations

from reference_tracer.cli.parser import AGREE, INPUT_ERROR

from .parts import trace

BOUNDS = "before any test, rounding moves rays by at most"


def test_bounds_are_said_on_request_alone(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png") == AGREE
    assert BOUNDS not in capsys.readouterr().out
    assert trace(ball, tmp_path / "b.png", "--check-rounding") == AGREE
    assert BOUNDS in capsys.readouterr().out


def test_the_check(ball, tmp_path, capsys):
    assert trace(ball, tmp_path / "b.png", "--check-rounding") == AGREE
    assert "0 of 384 pixels would show another surface unrounded" in capsys.readouterr().out


def test_the_check_is_about_proven_pixels(ball, tmp_path, capsys):
    plain = "--check-rounding", "--method", "textbook"
    assert trace(ball, tmp_path / "b.png", *plain) == INPUT_ERROR
    assert "--method certified" in capsys.readouterr().err
    assert not (tmp_path / "b.png").exists()
