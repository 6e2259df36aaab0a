"""Collects what a file holds and the meshes do not show: one sentence a kind, with the names."""

from __future__ import annotations

_NAMED = 3  # of what a note is about; the rest are counted


class Notes:
    """Sentences, each said once, of all things that it is true of."""

    def __init__(self) -> None:
        self._names: dict[str, dict[str, None]] = {}  # by the sentence; in order, each once

    def add(self, sentence: str, *names: str) -> None:
        """Say a sentence of further things; each is named once."""
        self._names.setdefault(sentence, {}).update(dict.fromkeys(names))

    def sentences(self) -> tuple[str, ...]:
        """Return the sentences, in the order in which they were first said."""
        return tuple(
            f"{sentence}: {listed([*names])}." if names else f"{sentence}."
            for sentence, names in self._names.items()
        )


def listed(names: list[str]) -> str:
    """Return the first names of a list, and how many more there are."""
    more = len(names) - _NAMED
    return ", ".join(names[:_NAMED]) + (f" and {more} more" if more > 0 else "")
