"""Numbers in text, as files have them: Python itself would also read 1_0."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from ..arrays import Floats, Index

Number = TypeVar("Number", int, float)


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


def _read(kind: type[Number], words: Sequence[bytes]) -> list[Number]:
    if b"_" in b" ".join(words):
        raise ValueError("what should be a number has an underscore")
    try:
        return list(map(kind, words))
    except ValueError as error:
        raise ValueError(f"what should be a number is none: {error}") from None


def shown(word: bytes) -> str:
    """Return the beginning of a word of a file, for a message."""
    return word.decode("utf-8", "backslashreplace")[:40]
