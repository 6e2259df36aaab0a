"""Numbers in text, as files have them: Python itself would also read 1_0."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from ..arrays import Array, Floats, Index
from ..scene import SceneError

Number = TypeVar("Number", int, float)

AGAIN = "copy it again, or export it again"
SHORT_VERTEX = f"a vertex has three coordinates; if this is the last line, it is cut off: {AGAIN}"


def floats(words: Sequence[bytes]) -> Floats:
    """Return numbers (n,) float64, each the nearest to its decimal number.

    Raises
    ------
    ValueError
        If a word is no number.
    """
    return np.array(_read(float, words), np.float64)


def integers(words: Sequence[bytes]) -> Index:
    """Return integers (n,) int64.

    Raises
    ------
    ValueError
        If a word is no integer, or too large for any file.
    """
    found = _read(int, words)
    if found and max(max(found), -min(found)) >= 2**62:
        raise ValueError("an integer has too many digits")
    return np.array(found, np.int64)


def numbers(
    read: Callable[[Sequence[bytes]], Array], words: Sequence[bytes], line_of: Callable[[int], int]
) -> Array:
    """Return the numbers of words, by :func:`floats` or :func:`integers`.

    Raises
    ------
    SceneError
        If one is none; it says in which line.
    """
    try:
        return read(words)
    except ValueError:
        for k, word in enumerate(words):
            try:
                read([word])
            except ValueError as error:
                raise SceneError(f"line {line_of(k)}: {error}") from None
        raise


def _read(kind: type[Number], words: Sequence[bytes]) -> list[Number]:
    try:
        if b"_" not in b" ".join(words):
            return list(map(kind, words))
    except ValueError:
        pass
    raise ValueError(next(filter(None, (_why_not(kind, word) for word in words))))


def _why_not(kind: type[Number], word: bytes) -> str:
    """Return why a word is no number of a kind, and what to write; "" if it is one."""
    try:
        if b"_" not in word:
            kind(word)
            return ""
    except ValueError:
        pass
    point = ": the decimal sign is a point" if b"," in word else ""
    return f"'{shown(word)}' is no {'integer' if kind is int else 'number'}{point}"


def cut_off(why: str) -> SceneError:
    """Return the error of a file whose end is missing."""
    return SceneError(f"it is cut off: {why}; {AGAIN}")


def shown(word: bytes) -> str:
    """Return the beginning of a word of a file, for a message."""
    return word.decode("utf-8", "backslashreplace")[:40]
