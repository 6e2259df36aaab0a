"""What the reader of a mesh file gives: placed meshes, and what it has to say of the file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..arrays import Floats
from ..scene import Mesh


class Placed(NamedTuple):
    """A mesh at a place; several may share one mesh."""

    mesh: Mesh
    world_from_object: Floats  # (4, 4) float64
    object: str  # the name of the object whose mesh it is


@dataclass(frozen=True, eq=False)
class Contents:
    """The meshes of a file, in the file's own axes until they are turned to have Z up."""

    placed: tuple[Placed, ...]
    # What the file holds and the meshes do not show, or show in one of several ways: a sentence
    # each, with what it changes.
    notes: tuple[str, ...] = ()
    # What of the file's surfaces is not traced, in the same words: it may change the picture, and
    # nobody knows where, so a comparison cannot agree.
    missing: tuple[str, ...] = ()
    up: str = ""  # which axis is up, "y" or "z", if the file itself says so
