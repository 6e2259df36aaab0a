"""Makes an icon of each cause's colour, for the legend."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...causes.cause import Cause

_SIDE = 16  # pixels of an icon


@cache
def _icons() -> Any:
    import bpy.utils.previews

    return bpy.utils.previews.new()


@cache
def swatch(cause: Cause) -> int:
    """Return the number of the icon of a cause's colour; 0 if it has none."""
    import numpy as np

    from ...files.images import curve

    if cause.color is None:
        return 0
    icon = _icons().new(cause.key)
    icon.icon_size = _SIDE, _SIDE
    icon.icon_pixels_float = [*curve(np.array(cause.color)), 1.0] * _SIDE**2
    found: int = icon.icon_id
    return found


def register() -> None:
    """Make nothing: a server draws no icon."""


def unregister() -> None:
    """Free the icons."""
    import bpy.utils.previews

    bpy.utils.previews.remove(_icons())
    _icons.cache_clear()
    swatch.cache_clear()
