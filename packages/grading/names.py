"""Files of one name in several folders, told apart for a reader."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from reference_tracer.wording import printable


def distinct(paths: Sequence[Path]) -> list[str]:
    """Return each file's name, with as many of its folders as tell it from the others.

    What steers a terminal is spelt out: the names are not ours.
    """
    parts = [Path(p).resolve().parts for p in paths]
    return [printable("/".join(_least(own, parts))) for own in parts]


def stems(paths: Sequence[Path]) -> list[str]:
    """Return each file's name without its ending, where that tells it from the others."""
    short, whole = [printable(Path(p).stem) for p in paths], distinct(paths)
    return [a if short.count(a) == 1 else b for a, b in zip(short, whole, strict=True)]


def _least(own: tuple[str, ...], every: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    others = [p for p in every if p != own]
    for count in range(1, len(own)):
        if all(p[-count:] != own[-count:] for p in others):
            return own[-count:]
    return own
