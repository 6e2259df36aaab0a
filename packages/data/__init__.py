"""Data in place of colours: depths, normals, positions, ids; a kind a file.

The add-on finds this package by its entry points, since Blender's window needs none of it.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reference_tracer.arrays import Array
    from reference_tracer.cli.parser import Parser
    from reference_tracer.pictures.given import GivenPicture


def add_options(parser: Parser, name: str) -> None:
    """Add what a comparison's file of data takes to the parser of that command."""
    if name == "compare":
        from . import options

        options.add(parser)


def given_data(kind: str, source: Path | Array, scale: float | None) -> GivenPicture:
    """Return a file or an array of a kind of data; raises ValueError for no such kind, or scale."""
    from .given import GivenData

    return GivenData(kind, source, scale=scale)
