"""`--excuse`: what is known of how a picture was made, which excuses a pixel."""

from __future__ import annotations

from argparse import Namespace, _ActionsContainer
from collections.abc import Sequence

from ..pictures.given import Making
from ..pictures.renderers import RENDERERS
from .named import Setting, add_named, one_of
from .parser import AT_LEAST_0

RENDERER = Setting(
    "renderer",
    "|".join(RENDERERS),
    one_of(*RENDERERS),
    "whose rounding excuses a pixel: float32 rays, or a rasteriser with a depth buffer of 24 "
    "bits (default: as is known of Blender's, else rays)",
)
FILTER = Setting(
    "filter",
    "PIXELS",
    AT_LEAST_0,
    "how far samples lie from pixels' centres (default 0)",
)
_DITHER = Setting(
    "dither",
    "LEVELS",
    AT_LEAST_0,
    "noise of a .png, of 255 levels (default the .blend's, else 0)",
)


def add_excuses(
    group: _ActionsContainer, rows: Sequence[Setting] = (RENDERER, FILTER, _DITHER)
) -> None:
    """Add the option."""
    add_named(group, "--excuse", rows)


def making_from(given: Namespace) -> Making:
    """Return how the picture was made, as far as the options say."""
    dither = getattr(given, "dither", None)
    return Making(given.renderer or "", given.filter or 0.0, dither, asked="as --excuse says")
