"""Files of one name in several folders, told apart for a reader."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from reference_tracer.wording import printable


def distinct(paths: Sequence[Path]) -> list[str]:
    """Return each file's name, with as many of its folders as tell it from the others.

    What steers a terminal is spelt out: the names are not ours.
    """
    parts = [p.resolve().parts for p in paths]
    ends = Counter(own[-k:] for own in set(parts) for k in range(1, len(own)))
    least = (
        next((own[-k:] for k in range(1, len(own)) if ends[own[-k:]] == 1), own) for own in parts
    )
    return [printable("/".join(own)) for own in least]


def stems(paths: Sequence[Path]) -> list[str]:
    """Return each file's name without its ending, where that tells it from the others."""
    short, whole = [printable(p.stem) for p in paths], distinct(paths)
    return [a if short.count(a) == 1 else b for a, b in zip(short, whole, strict=True)]


def numbered(names: Sequence[str], pattern: str, key: Callable[[str], str] = str) -> Iterator[str]:
    """Yield names, those that were there before with a number; `key` says which are the same."""
    taken: set[str] = set()
    last: Counter[str] = Counter()
    for name in names:
        own = name
        while key(own) in taken:
            last[key(name)] += 1
            own = pattern.format(name, last[key(name)] + 1)
        taken.add(key(own))
        yield own
