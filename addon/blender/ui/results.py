"""Keeps the latest of each kind of result for the panels, and shows it in images and texts.

What the panels show is not stored in the .blend: it is about one moment.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...methods import Method
from ...tracer.progress import Work, by_rows, scaled

if TYPE_CHECKING:
    from ...arrays import Colors
    from ...comparison.comparison import Comparison
    from ...diagnosis.diagnosis import Told
    from ...diagnosis.regions import Region
    from ...study.extremes import ExtremesRow
    from ...study.trade import Trade

# A name: so the class of a result need not be imported.
Kind = Enum("Kind", "COMPARISON ENGINES FRAMES PIXEL TRADE EXTREMES")
TRACED = "Reference Tracer Traced"
BLENDER = "Reference Tracer Blender"
DIFFERENCE = "Reference Tracer Difference"
CAUSES = "Reference Tracer Causes"
PUT_RIGHT = "Reference Tracer Put Right"
MARK = "reference_tracer"  # a custom property of the images that the add-on may write into


@dataclass(frozen=True, eq=False)
class Result:
    """What a panel shows; computed once, since panels are drawn many times a second."""

    file: str
    content: Any  # what the kind says
    lines: tuple[str, ...]  # sentences; a panel shows the first
    scene: str | None = None  # None: of no scene
    page: str = ""  # the address of its plots
    regions: tuple[Region, ...] = ()  # where it differs, the largest first
    # By the number of a fault that is told: the picture that it changes, put right.
    put_right: Mapping[int, Colors] = field(default_factory=dict)
    # The numbers of the faults that a copy of the camera was added for, by its `session_uid`.
    copies: dict[int, int] = field(default_factory=dict)


_latest: dict[Kind, Result] = {}


def keep_comparison(comparison: Comparison) -> Work[Result]:
    """Remember a comparison, and put its pictures into images of Blender's, in small steps."""
    from ...causes.cause import AGREE
    from ...causes.maps import cause_map, difference_map, ringed
    from ...comparison.put_right import pictures_put_right
    from ...report.comparison import differing_regions

    traced = comparison.frame.color
    cause = comparison.causes.cause
    show(TRACED, traced)
    yield 0.1
    show(BLENDER, comparison.picture)
    yield 0.2
    pair = traced, comparison.picture
    apart = yield from scaled(by_rows(difference_map, *pair), 0.2, 0.3)
    apart = ringed(apart, cause != AGREE)
    yield 0.5
    show(DIFFERENCE, apart)
    yield 0.6
    causes = yield from scaled(by_rows(cause_map, traced, cause), 0.6, 0.2)
    show(CAUSES, causes)
    yield 0.9
    regions = tuple(differing_regions(comparison))
    yield 0.95
    right = {}
    for number, _, color in pictures_put_right(comparison):
        right[number] = color
        yield 1.0
    if stale := ours(PUT_RIGHT):
        bpy.data.images.remove(stale)
    found = keep(Kind.COMPARISON, comparison, comparison.lines(), comparison.manifest.scene)
    _latest[Kind.COMPARISON] = replace(found, regions=regions, put_right=right)
    return _latest[Kind.COMPARISON]


def keep_trade(trade: Trade) -> Result:
    """Remember a trade, and write its plot for the browser."""
    from ...report import trade as trade_report

    page = _page("trade", trade_report.picture(trade))
    return keep(Kind.TRADE, trade, [trade.advice], trade.scene, page)


def keep_extremes(rows: Sequence[ExtremesRow]) -> Result:
    """Remember where each method breaks, and write the plot of it for the browser."""
    from ...report import extremes as extremes_report

    page = _page("extremes", extremes_report.picture(rows))
    wrong = sum(r.lost + r.doubled for r in rows if Method(r.method).is_proven)
    lines = [f"Certified gets {f'{wrong:,} rays' if wrong else 'no ray'} wrong."]
    return keep(Kind.EXTREMES, tuple(rows), lines, page=page)


def _page(name: str, drawn: str) -> str:
    from ...report import folders, plots

    path = session_folder() / f"{name}.html"
    folders.write_text(path, plots.page(f"Reference Tracer {name}", drawn))
    return path.as_uri()


@cache
def session_folder() -> Path:
    """Return a folder that outlives this Blender, so that the browser can load a page again."""
    return Path(tempfile.mkdtemp(prefix="reference-tracer-"))


def keep(
    kind: Kind, content: Any, lines: Iterable[str], scene: str | None = None, page: str = ""
) -> Result:
    """Remember a result of a kind, for :func:`latest`."""
    _latest[kind] = Result(bpy.data.filepath, content, tuple(lines), scene, page)
    return _latest[kind]


def latest(kind: Kind, scene: Any) -> Result | None:
    """Return the latest result of a kind, if it is of this scene in the file that is open."""
    found = _latest.get(kind)
    if found and found.file == bpy.data.filepath and found.scene in (None, scene.name):
        return found
    return None


def content(kind: Kind, scene: Any) -> Any:
    """Return what :func:`latest` has of a kind; None if there is none."""
    found = latest(kind, scene)
    return found and found.content


def forget() -> None:
    """Drop all results, as when another file is opened."""
    _latest.clear()


def remove_stale_images() -> None:
    """Remove our images from a file that was just opened: what was shown of them was not stored."""
    for image in bpy.data.images[:]:
        if image.get(MARK) and image.source == "GENERATED":
            bpy.data.images.remove(image)


def show(name: str, color: Colors) -> Any:
    """Put linear RGBA (h, w, 4) into our image of this name; make it if there is none."""
    import numpy as np

    height, width = color.shape[:2]
    image = _ours(bpy.data.images, name, lambda i: i.source != "GENERATED")
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
        image[MARK] = name
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    image.pixels.foreach_set(np.ascontiguousarray(color, dtype=np.float32).ravel())
    image.update()
    return image


def shown_put_right(scene: Any) -> Told:
    """Return the fault of a scene's latest comparison that our picture shows put right.

    Raises
    ------
    SceneError
        If it shows none of them.
    """
    import numpy as np

    from ...scene import SceneError

    image, found = ours(PUT_RIGHT), latest(Kind.COMPARISON, scene)
    if image and found:
        width, height = image.size
        pixels = np.empty((height, width, 4), np.float32)
        image.pixels.foreach_get(pixels.ravel())
        for number, color in found.put_right.items():
            if np.array_equal(np.asarray(color, np.float32), pixels, equal_nan=True):
                return found.content.diagnosis.told[number]
    raise SceneError("No picture of this scene's latest comparison is shown put right: press Show.")


def ours(name: str) -> Any:
    """Return our image of a name, or None."""
    return next((i for i in bpy.data.images if i.get(MARK) == name), None)


def _ours(blocks: Any, name: str, is_saved: Callable[[Any], object]) -> Any:
    """Return our image or text of a name, or None. One that the user has saved is theirs now."""
    found = next((b for b in blocks if b.get(MARK) == name), None)
    if found and is_saved(found):
        del found[MARK]
        return None
    return found


def show_text(context: Any, name: str, content: str) -> Any:
    """Put a text into our text of this name, or a new one, and show it in a text editor.

    A text that the user has saved to a file is theirs, and is left as it is.
    """
    text = _ours(bpy.data.texts, name, lambda t: t.filepath)
    if text is None:
        text = bpy.data.texts.new(name)
        text[MARK] = name
    text.from_string(content)
    if area := next(areas(context, "TEXT_EDITOR"), None):
        area.spaces.active.text = text
        area.spaces.active.top = 0
    return text


def areas(context: Any, kind: str) -> Iterator[Any]:
    """Yield the areas of a type that the context's window shows; without a window, none."""
    for area in context.window.screen.areas if context.window else ():
        if area.type == kind:
            yield area


def redraw(context: Any) -> None:
    """Have the context's window drawn again, where there is one."""
    for area in context.window.screen.areas if context.window else ():
        area.tag_redraw()
