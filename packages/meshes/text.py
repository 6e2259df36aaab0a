"""Numbers in text, as files have them: Python itself would also read 1_0."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import numpy as np
from reference_tracer.arrays import Array, Floats, Index
from reference_tracer.scene import SceneError

Number = TypeVar("Number", int, float)
Read = Callable[[Sequence[bytes]], Array]

AGAIN = "copy it again, or export it again"


def floats(words: Sequence[bytes]) -> Floats:
    """Return numbers (n,) float64, each the nearest to its decimal number; a ValueError if not."""
    return np.array(_read(float, words), np.float64)


def integers(words: Sequence[bytes]) -> Index:
    """Return integers (n,) int64; a ValueError if one is none, or too large for any file."""
    found = _read(int, words)
    if found and max(max(found), -min(found)) >= 2**62:
        raise ValueError("an integer has too many digits")
    return np.array(found, np.int64)


def _read(kind: type[Number], words: Sequence[bytes]) -> list[Number]:
    try:
        if b"_" not in b" ".join(words):
            return list(map(kind, words))
    except ValueError:
        pass
    wrong = next(word for word in words if not _is(kind, word))
    point = ": the decimal sign is a point" if b"," in wrong else ""
    raise ValueError(f"'{shown(wrong)}' is no {'integer' if kind is int else 'number'}{point}")


def _is(kind: type[Number], word: bytes) -> bool:
    try:
        kind(word)
    except ValueError:
        return False
    return b"_" not in word


def in_lines(
    read: Read, words: Sequence[bytes], each: Sequence[int], lines: Sequence[int]
) -> Array:
    """Return the numbers of words, of which `each` of the `lines` has so many.

    Raises
    ------
    SceneError
        If one is none; it says in which line.
    """
    try:
        return read(words)
    except ValueError:
        ends = np.cumsum(each).tolist()
        for first, end, line in zip([0, *ends], ends, lines, strict=False):
            try:
                read(words[first:end])
            except ValueError as error:
                raise SceneError(f"line {line}: {error}") from None
        raise


def statements(content: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Yield the number and the words of each line that has some, without comments."""
    for number, line in enumerate(content.splitlines(), 1):
        if words := line.partition(b"#")[0].split():
            yield number, words


def shown(word: bytes) -> str:
    """Return the beginning of a word of a file, for a message."""
    return word.decode("utf-8", "backslashreplace")[:40]
