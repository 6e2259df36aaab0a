"""Keeps the latest of each kind of result for the panels, and shows it in images and texts.

They belong to the session, as a render does. Blender stores no data-block that is marked as runtime
data. A picture is shown from a file of the session's, so there is nothing in it to be saved. No
undo step need have them: undo takes them away, and they are put back.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
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
MARK = "reference_tracer_result"  # a custom property of our images and texts: their name
_SHOWN_AS = {"IMAGE_EDITOR": "image", "TEXT_EDITOR": "text"}  # by the type of an area


@dataclass(frozen=True, eq=False)
class Result:
    """What a panel shows; computed once, since panels are drawn many times a second."""

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
_pictures: dict[str, tuple[str, str]] = {}  # the files of our images, and their colour spaces
_texts: dict[str, tuple[int, str]] = {}  # the `session_uid` of ours, and what they say
_seen: list[tuple[Any, str]] = []  # the areas that show ours, before those are made again


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
    remove(PUT_RIGHT)
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
    _latest[kind] = Result(content, tuple(lines), scene, page)
    return _latest[kind]


def latest(kind: Kind, scene: Any) -> Result | None:
    """Return the latest result of a kind, if it is of this scene."""
    found = _latest.get(kind)
    return found if found and found.scene in (None, scene.name) else None


def content(kind: Kind, scene: Any) -> Any:
    """Return what :func:`latest` has of a kind; None if there is none."""
    found = latest(kind, scene)
    return found and found.content


def drop(kind: Kind, scene: Any) -> None:
    """Drop a scene's result of a kind, with its pictures."""
    if latest(kind, scene):
        del _latest[kind]
    if kind not in _latest and kind is Kind.COMPARISON:
        for name in (TRACED, BLENDER, DIFFERENCE, CAUSES, PUT_RIGHT):
            remove(name)


def forget() -> None:
    """Drop all results, with what shows them, as when another file is opened."""
    _latest.clear()
    for name in (*_pictures, *_texts):
        remove(name)


def show(name: str, color: Colors) -> Any:
    """Show linear RGBA (h, w, 4) as our image of this name, in place of the one that there is."""
    import numpy as np

    remember_editors()
    height, width = color.shape[:2]
    image: Any = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    linear = image.colorspace_settings.name
    image.colorspace_settings.is_data = True  # it is written as it is
    image.alpha_mode = "CHANNEL_PACKED"
    image.pixels.foreach_set(np.ascontiguousarray(color, dtype=np.float32).ravel())
    image.filepath_raw = str(Path(bpy.app.tempdir, f"{name}.exr"))
    image.file_format = "OPEN_EXR"
    image.save()
    _pictures[name] = image.filepath_raw, linear
    _as_ours(image, name)
    _fill_editors()
    return image


def _as_ours(block: Any, name: str) -> Any:
    """Mark an image, whose file is written, or a text, and have it take the place of ours."""
    if name in _pictures:
        block.colorspace_settings.name = _pictures[name][1]
        block.alpha_mode = "PREMUL"
    _give_up(name, block)
    block.name = name
    block[MARK] = name
    block.is_runtime_data = True
    return block


def remove(name: str) -> None:
    """Remove our image or text of a name, if there is one."""
    _give_up(name)
    _pictures.pop(name, None)
    _texts.pop(name, None)


def _give_up(name: str, successor: Any = None) -> None:
    """Remove ours, whose users take another one; if the user has saved it to a file, it is his."""
    old = ours(name)
    if old and old.filepath != _pictures.get(name, ("",))[0]:
        del old[MARK]
        old.is_runtime_data = False
        old.name = Path(old.filepath).name
    elif old:
        if successor:
            old.user_remap(successor)
        _blocks(name).remove(old)


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
    """Return our image or text of a name, or None."""
    return next((b for b in _blocks(name) if b.get(MARK) == name and b.is_runtime_data), None)


def _blocks(name: str) -> Any:
    return bpy.data.texts if name in _texts else bpy.data.images


def show_text(context: Any, name: str, content: str) -> Any:
    """Put a text into our text of this name, and show it in a text editor."""
    text = _new_text(name, content)
    if area := next(areas(context, "TEXT_EDITOR"), None):
        area.spaces.active.text = text
        area.spaces.active.top = 0
    return text


def _new_text(name: str, content: str) -> Any:
    text = bpy.data.texts.new(name)
    text.from_string(content)
    _texts[name] = text.session_uid, content
    return _as_ours(text, name)


def remember_editors(*_: Any) -> None:
    """Remember which editors show ours, before undo takes it away."""
    _seen.clear()
    manager: Any = bpy.context.window_manager
    for window in manager.windows:
        for area in window.screen.areas:
            shown = getattr(area.spaces.active, _SHOWN_AS.get(area.type, ""), None)
            if shown and MARK in shown:
                _seen.append((area, shown[MARK]))


def put_back(*_: Any) -> None:
    """Make again what undo has taken away, or has put an older one in the place of."""
    for name, (path, _linear) in _pictures.items():
        if ours(name) is None:
            _as_ours(bpy.data.images.load(path), name)
    for name, (made, content) in _texts.items():
        text = ours(name)
        if text is None or text.session_uid != made:
            _new_text(name, content)
    _fill_editors()


def _fill_editors() -> None:
    for area, name in _seen:
        setattr(area.spaces.active, _SHOWN_AS[area.type], ours(name))


def areas(context: Any, kind: str) -> Iterator[Any]:
    """Yield the areas of a type that the context's window shows; without a window, none."""
    for area in context.window.screen.areas if context.window else ():
        if area.type == kind:
            yield area


def redraw(context: Any) -> None:
    """Have the context's window drawn again, where there is one."""
    for area in context.window.screen.areas if context.window else ():
        area.tag_redraw()
