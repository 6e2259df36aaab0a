"""Shows pictures and texts in data-blocks of Blender's: ours, which no file and no undo step has.

Blender stores no data-block that is marked as runtime data. A picture is packed, so nothing in it
has to be saved. Undo takes them away, and they are made again.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.types import Image, Text

from .areas import areas

if TYPE_CHECKING:
    from ...arrays import Colors

TRACED = "Reference Tracer Traced"
BLENDER = "Reference Tracer Blender"
DIFFERENCE = "Reference Tracer Difference"
CAUSES = "Reference Tracer Causes"
PUT_RIGHT = "Reference Tracer Put Right"
PICTURES = TRACED, BLENDER, DIFFERENCE, CAUSES, PUT_RIGHT
MARK = "reference_tracer_result"  # a custom property of our images and texts: their name
_SHOWN_AS = {"IMAGE_EDITOR": "image", "TEXT_EDITOR": "text"}  # by the type of an area

_content: dict[str, Colors | str] = {}  # of our images and texts
_made: dict[str, int] = {}  # of these: the latest one's `session_uid`
_seen: list[tuple[Any, str]] = []  # areas, and the name of ours that each shows


def show(name: str, color: Colors) -> Image:
    """Show linear RGBA (h, w, 4) as our image of this name, in place of the one that there is."""
    remember_editors()
    _content[name] = color
    shown = _make(name)
    _fill_editors()
    return shown


def _make(name: str) -> Any:
    """Make our image or text, in place of the one that there is."""
    import numpy as np

    content = _content[name]
    block: Any
    if isinstance(content, str):
        block = bpy.data.texts.new(name)
        block.from_string(content)
    else:
        height, width = content.shape[:2]
        block = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
        block.alpha_mode = "CHANNEL_PACKED"
        block.pixels.foreach_set(np.ascontiguousarray(content, dtype=np.float32).ravel())
        block.pack()
    _give_up(name, block)
    block.name = name
    block[MARK] = name
    block.is_runtime_data = True
    _made[name] = block.session_uid
    return block


def remove(name: str) -> None:
    """Remove our image or text of a name, if there is one."""
    _give_up(name)
    _content.pop(name, None)


def _give_up(name: str, successor: Any = None) -> None:
    """Remove a block of ours, and give its users another; one that was saved to a file stays."""
    old = ours(name)
    if old and old.filepath:
        del old[MARK]
        old.is_runtime_data = False
        old.name = Path(old.filepath).name
    elif old:
        if successor:
            old.user_remap(successor)
        _blocks(name).remove(old)


def ours(name: str) -> Any:
    """Return our image or text of a name, or None."""
    return next((b for b in _blocks(name) if b.get(MARK) == name and b.is_runtime_data), None)


def _blocks(name: str) -> Any:
    return bpy.data.images if name in PICTURES else bpy.data.texts


def show_text(name: str, content: str) -> Text:
    """Put a text into our text of this name, and show it in a text editor."""
    _content[name] = content
    text: Text = _make(name)
    for _, area in list(areas("TEXT_EDITOR"))[:1]:
        area.spaces.active.text = text
        area.spaces.active.top = 0
    return text


@bpy.app.handlers.persistent
def remember_editors(*_: Any) -> None:
    """Remember which editors show ours, before undo takes it away."""
    _seen.clear()
    for _, area in areas(*_SHOWN_AS):
        shown = getattr(area.spaces.active, _SHOWN_AS[area.type])
        if shown and MARK in shown:
            _seen.append((area, shown[MARK]))


@bpy.app.handlers.persistent
def put_back(*_: Any) -> None:
    """Make again what undo removed, or replaced by an older one."""
    for name in _content:
        block = ours(name)
        if block is None or block.session_uid != _made[name]:
            _make(name)
    _fill_editors()


def _fill_editors() -> None:
    for area, name in _seen:
        setattr(area.spaces.active, _SHOWN_AS[area.type], ours(name))


def remove_all() -> None:
    """Remove all of ours."""
    for name in tuple(_content):
        remove(name)
