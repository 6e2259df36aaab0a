"""Keeps the latest of each kind of result for the panels, and shows it in images and texts.

They belong to the session, as a render does. Blender stores no data-block that is marked as runtime
data. A picture is shown from a file of the session's, so there is nothing in it to be saved. No
undo step need have them: undo takes them away, and they are put back.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...tracer.progress import Work, by_rows

if TYPE_CHECKING:
    from ...arrays import Colors
    from ...comparison.comparison import Comparison
    from ...diagnosis.diagnosis import Told
    from ...diagnosis.regions import Region

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


_latest: dict[Kind, Result] = {}
_files: dict[str, tuple[str, str]] = {}  # of our images, with their colour spaces, and texts
_made: dict[str, int] = {}  # from these: the latest one's `session_uid`
_seen: list[tuple[Any, str]] = []  # the areas that show ours, before those are made again


def keep_comparison(comparison: Comparison) -> Work[Result]:
    """Remember a comparison, and show its pictures; ended in between, there is none."""
    from ...causes.maps import cause_map, difference_map
    from ...comparison.put_right import pictures_put_right
    from ...report.comparison import differing_regions
    from ...report.lines import lines

    traced, picture = comparison.frame.color, comparison.picture
    try:
        show(TRACED, traced)
        yield None
        show(BLENDER, picture)
        yield None
        show(DIFFERENCE, (yield from by_rows(difference_map, traced, picture)))
        yield None
        show(CAUSES, (yield from by_rows(cause_map, traced, comparison.causes.cause)))
        yield None
        regions = tuple(differing_regions(comparison))
        yield None
        right = {}
        for number, _, color in pictures_put_right(comparison):
            right[number] = color
            yield None
        remove(PUT_RIGHT)
        kept = keep(Kind.COMPARISON, comparison, lines(comparison), comparison.manifest.scene)
        _latest[Kind.COMPARISON] = replace(kept, regions=regions, put_right=right)
        return _latest[Kind.COMPARISON]
    finally:
        found = _latest.get(Kind.COMPARISON)
        if found is None or found.content.causes is not comparison.causes:
            _forget_comparison()  # the pictures are of two


@cache
def session_folder() -> Path:
    """Return a folder that outlives this Blender, so that the browser can load a page again."""
    return Path(tempfile.mkdtemp(prefix="reference-tracer-"))


def keep(
    kind: Kind, content: Any, lines: Iterable[str], scene: str | None = None, page: str = ""
) -> Result:
    """Remember a result of a kind, of the scene of a name, for :func:`latest`."""
    uids = {s.name: s.session_uid for s in bpy.data.scenes}
    own = None if scene is None else uids.get(scene, 0)
    _latest[kind] = Result(content, tuple(lines), own, page)
    return _latest[kind]


def latest(kind: Kind, scene: Any) -> Result | None:
    """Return the latest result of a kind, if it is of this scene."""
    found = _latest.get(kind)
    return found if found and found.scene in (None, scene.session_uid) else None


def content(kind: Kind, scene: Any) -> Any:
    """Return what :func:`latest` has of a kind; None if there is none."""
    found = latest(kind, scene)
    return found and found.content


def drop(kind: Kind) -> None:
    """Drop the latest result of a kind, of whichever scene, with its pictures."""
    if _latest.pop(kind, None) and kind is Kind.COMPARISON:
        _forget_comparison()


def _forget_comparison() -> None:
    _latest.pop(Kind.COMPARISON, None)
    for name in (TRACED, BLENDER, DIFFERENCE, CAUSES, PUT_RIGHT):
        remove(name)


@bpy.app.handlers.persistent
def forget(*_: Any) -> None:
    """Drop all results, with what shows them, as when another file is opened."""
    _latest.clear()
    for name in tuple(_files):
        remove(name)


def show(name: str, color: Colors) -> Any:
    """Show linear RGBA (h, w, 4) as our image of this name, in place of the one that there is."""
    import numpy as np

    height, width = color.shape[:2]
    image: Any = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    linear = image.colorspace_settings.name
    image.colorspace_settings.is_data = True  # it is written as it is
    image.alpha_mode = "CHANNEL_PACKED"
    image.pixels.foreach_set(np.ascontiguousarray(color, dtype=np.float32).ravel())
    image.filepath_raw = str(Path(bpy.app.tempdir, f"{name}.exr"))
    image.file_format = "OPEN_EXR"
    image.save()
    _files[name] = image.filepath_raw, linear
    bpy.data.images.remove(image)
    remember_editors()
    shown = _loaded(name)
    _fill_editors()
    return shown


def _loaded(name: str) -> Any:
    """Load our image or text from its file, in place of the one that there is."""
    path, linear = _files[name]
    block: Any
    if linear:
        block = bpy.data.images.load(path)
        block.colorspace_settings.name = linear
    else:
        block = bpy.data.texts.load(path, internal=True)
    _give_up(name, block)
    block.name = name
    block[MARK] = name
    block.is_runtime_data = True
    _made[name] = block.session_uid
    return block


def remove(name: str) -> None:
    """Remove our image or text of a name, if there is one."""
    _give_up(name)
    _files.pop(name, None)


def _give_up(name: str, successor: Any = None) -> None:
    """Remove ours, whose users take another one; if the user has saved it to a file, it is his."""
    old = ours(name)
    if old and old.filepath and _file(old.filepath) != _file(_files[name][0]):
        del old[MARK]
        old.is_runtime_data = False
        old.name = Path(old.filepath).name
    elif old:
        if successor:
            old.user_remap(successor)
        _blocks(name).remove(old)


def _file(path: str) -> Path:
    return Path(bpy.path.abspath(path)).resolve()


def shown_put_right(scene: Any) -> Told:
    """Return the fault of a scene's latest comparison that our picture shows put right.

    Raises
    ------
    SceneError
        If it shows none of them.
    """
    from ...scene import SceneError

    found = latest(Kind.COMPARISON, scene)
    if found and found.shown:
        return found.content.diagnosis.told[found.shown[0]]
    raise SceneError("No picture of this scene's latest comparison is shown put right: press Show.")


def ours(name: str) -> Any:
    """Return our image or text of a name, or None."""
    return next((b for b in _blocks(name) if b.get(MARK) == name and b.is_runtime_data), None)


def _blocks(name: str) -> Any:
    _path, linear = _files.get(name, ("", ""))
    return bpy.data.images if linear else bpy.data.texts


def show_text(context: Any, name: str, content: str) -> Any:
    """Put a text into our text of this name, and show it in a text editor."""
    path = Path(bpy.app.tempdir, f"{name}.md")
    path.write_text(content, encoding="utf-8")
    _files[name] = str(path), ""
    text = _loaded(name)
    if area := next(areas(context, "TEXT_EDITOR"), None):
        area.spaces.active.text = text
        area.spaces.active.top = 0
    return text


@bpy.app.handlers.persistent
def remember_editors(*_: Any) -> None:
    """Remember which editors show ours, before undo takes it away."""
    _seen.clear()
    manager: Any = bpy.context.window_manager
    for window in manager.windows:
        for area in window.screen.areas:
            shown = getattr(area.spaces.active, _SHOWN_AS.get(area.type, ""), None)
            if shown and MARK in shown:
                _seen.append((area, shown[MARK]))


@bpy.app.handlers.persistent
def put_back(*_: Any) -> None:
    """Make again what undo has taken away, or has put an older one in the place of."""
    for name in _files:
        block = ours(name)
        if block is None or block.session_uid != _made[name]:
            _loaded(name)
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
