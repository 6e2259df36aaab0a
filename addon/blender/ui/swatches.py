"""Has an icon of each cause's colour, for the legend."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...causes.cause import Cause

_SIDE = 16  # pixels of an icon
_made: list[Any] = []  # the collection of the icons, once one is drawn


def swatch(cause: Cause) -> int:
    """Return the number of the icon of a cause's colour; 0 if it has none."""
    import bpy.utils.previews
    import numpy as np

    from ...images import curve

    if cause.color is None:
        return 0
    if not _made:
        _made.append(bpy.utils.previews.new())
    [icons] = _made
    if cause.key not in icons:
        icon = icons.new(cause.key)
        icon.icon_size = _SIDE, _SIDE
        icon.icon_pixels_float = [*curve(np.array(cause.color)), 1.0] * _SIDE**2
    found: int = icons[cause.key].icon_id
    return found


def register() -> None:
    """Make nothing: a server draws no icon."""


def unregister() -> None:
    """Free the icons."""
    import bpy.utils.previews

    while _made:
        bpy.utils.previews.remove(_made.pop())
