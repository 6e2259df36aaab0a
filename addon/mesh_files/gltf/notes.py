"""Collects what a file holds and the meshes do not show: one sentence a kind, with the names."""

from __future__ import annotations

_Names = dict[str, dict[str, None]]  # by the sentence; in order, each once

_NAMED = 3  # of what a note is about; the rest are counted


class Notes:
    """Sentences, each said once, of all things that it is true of."""

    def __init__(self) -> None:
        self._names: _Names = {}
        self._missing: _Names = {}

    def add(self, sentence: str, *names: str) -> None:
        """Say a sentence of further things; each is named once."""
        self._names.setdefault(sentence, {}).update(dict.fromkeys(names))

    def lack(self, sentence: str, *names: str) -> None:
        """Say so of what may be a surface, and is not traced."""
        self._missing.setdefault(sentence, {}).update(dict.fromkeys(names))

    def sentences(self) -> tuple[str, ...]:
        """Return what was added, in the order in which it was first said."""
        return _said(self._names)

    def missing(self) -> tuple[str, ...]:
        """Return what is lacking, likewise."""
        return _said(self._missing)


def _said(names: _Names) -> tuple[str, ...]:
    return tuple(
        f"{sentence}: {listed([*own])}." if own else f"{sentence}."
        for sentence, own in names.items()
    )


def listed(names: list[str]) -> str:
    """Return the first names of a list, and how many more there are."""
    more = len(names) - _NAMED
    return ", ".join(names[:_NAMED]) + (f" and {more} more" if more > 0 else "")
