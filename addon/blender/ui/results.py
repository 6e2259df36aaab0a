"""Keeps the latest of each kind of result for the panels; they belong to the session."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.types import Context, Scene

from ...tracer.progress import Work, by_rows
from . import blocks

if TYPE_CHECKING:
    from ...arrays import Colors
    from ...comparison.comparison import Comparison
    from ...diagnosis.diagnosis import Told
    from ...diagnosis.regions import Region

# A name: so the class of a result need not be imported.
Kind = Enum("Kind", "COMPARISON ENGINES FRAMES PIXEL TRADE EXTREMES")


@dataclass(frozen=True, eq=False)
class Result:
    """A result as a panel shows it; computed once, since panels are drawn many times a second."""

    content: Any  # what the kind says
    lines: tuple[str, ...]  # sentences; a panel shows the first
    scene: int | None = None  # its `session_uid`, as its name may change; None: of no scene
    page: str = ""  # the address of its plots
    regions: tuple[Region, ...] = ()  # where it differs, the largest first
    # By the number of a fault of the diagnosis: the picture that it changes, put right.
    put_right: Mapping[int, Colors] = field(default_factory=dict)
    shown: list[int] = field(default_factory=list)  # of the fault that is shown put right
    # The numbers of the faults that a copy of the camera was added for, by its `session_uid`.
    copies: dict[int, int] = field(default_factory=dict)


_NOTHING = Result(None, ())
_latest: dict[Kind, Result] = {}


def keep_comparison(comparison: Comparison, scene: int) -> Work[Result]:
    """Remember a comparison of the scene of a `session_uid`, and show its pictures.

    Ended in between, there is none.
    """
    from ...causes.maps import cause_map, difference_map
    from ...comparison.put_right import pictures_put_right
    from ...report.comparison import differing_regions
    from ...report.lines import describe

    traced, picture = comparison.frame.color, comparison.picture
    try:
        blocks.show(blocks.TRACED, traced)
        yield None
        blocks.show(blocks.BLENDER, picture)
        yield None
        blocks.show(blocks.DIFFERENCE, (yield from by_rows(difference_map, traced, picture)))
        yield None
        blocks.show(blocks.CAUSES, (yield from by_rows(cause_map, traced, comparison.causes.cause)))
        yield None
        regions = tuple(differing_regions(comparison))
        yield None
        right = {}
        for number, _, color in pictures_put_right(comparison):
            right[number] = color
            yield None
        blocks.remove(blocks.PUT_RIGHT)
        lines = describe(comparison)
        kind = Kind.COMPARISON
        return keep(kind, comparison, lines, scene, regions=regions, put_right=right)
    finally:
        found = _latest.get(Kind.COMPARISON)
        if found is None or found.content.causes is not comparison.causes:
            drop(Kind.COMPARISON)  # some pictures are of another one


@cache
def session_folder() -> Path:
    """Return a folder that outlives this Blender, so that the browser can load a page again."""
    return Path(tempfile.mkdtemp(prefix="reference-tracer-"))


def keep(
    kind: Kind, content: Any, lines: Iterable[str], scene: int | None = None, **more: Any
) -> Result:
    """Remember a result of a kind, of the scene of a `session_uid`, for :func:`latest`."""
    _latest[kind] = Result(content, tuple(lines), scene, **more)
    return _latest[kind]


def latest(kind: Kind, scene: Scene) -> Result:
    """Return the latest result of a kind, if it is of this scene; else one without content."""
    found = _latest.get(kind, _NOTHING)
    return found if found.scene in (None, scene.session_uid) else _NOTHING


def content(kind: Kind, scene: Scene) -> Any:
    """Return what :func:`latest` has of a kind; None if there is none."""
    return latest(kind, scene).content


def of_comparison(context: Context) -> Result:
    """Return the latest result of a comparison of the context's scene."""
    return latest(Kind.COMPARISON, context.scene)


def comparison(context: Context) -> Any:
    """Return the latest comparison of the context's scene; None if there is none."""
    return content(Kind.COMPARISON, context.scene)


def drop(kind: Kind) -> None:
    """Drop the latest result of a kind, of whichever scene, with its pictures."""
    _latest.pop(kind, None)
    for name in blocks.PICTURES if kind is Kind.COMPARISON else ():
        blocks.remove(name)


@bpy.app.handlers.persistent
def forget(*_: Any) -> None:
    """Drop all results, with what shows them, as when another file is opened."""
    _latest.clear()
    blocks.remove_all()


def shown_put_right(scene: Scene) -> Told:
    """Return the fault of a scene's latest comparison that our picture shows put right.

    Raises
    ------
    SceneError
        If it shows none of them.
    """
    from ...scene import SceneError

    found = latest(Kind.COMPARISON, scene)
    if found.shown:
        return found.content.diagnosis.told[found.shown[0]]
    raise SceneError("No picture of this scene's latest comparison is shown put right: press Show.")
