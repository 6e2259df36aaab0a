"""Rows of a picture -> textures of the graphics card, drawn pixel on pixel; and words.

`gpu` is asked for only where something is drawn: a server has no display.
"""

from __future__ import annotations

import textwrap
import time
from typing import Any

from .shows import Picture

BAND = 1 << 17  # pixels of a texture: it is made in some 2 ms
_LETTER = 0.55  # mean width of Blender's font, in its size
_TEXT = 14  # points


class Textures:
    """What of a picture is on the graphics card: bands of rows, from the lowest."""

    def __init__(self, picture: Picture) -> None:
        height, width = picture.color.shape[:2]
        step = max(1, BAND // width)
        self._picture: Picture | None = picture
        self._width = width
        self._missing = [slice(y, min(y + step, height)) for y in range(0, height, step)]
        self._bands: list[tuple[slice, Any]] = []

    @property
    def is_whole(self) -> bool:
        """Whether nothing is missing."""
        return not self._missing

    def upload(self, until: float) -> bool:
        """Make textures of rows that are done until a time of the clock; True if some are left.

        `until` is one of `time.perf_counter()`; one band is made in any case.
        """
        import gpu

        for rows in [r for r in self._missing if self._picture.rows_done[r].all()]:
            data = self._picture.color[rows].reshape(-1)
            buffer = gpu.types.Buffer("FLOAT", data.shape, data)
            size = self._width, rows.stop - rows.start
            self._bands.append((rows, gpu.types.GPUTexture(size, format="RGBA32F", data=buffer)))
            self._missing.remove(rows)
            if time.perf_counter() > until:
                break
        if self.is_whole:
            self._picture = None  # its memory is free
            return False
        return any(self._picture.rows_done[r].all() for r in self._missing)

    def draw(self, x: float, y: float, pixel_width: float, pixel_height: float) -> None:
        """Draw what is there, the lower left corner at (x, y); all in pixels of the region."""
        from gpu_extras.presets import draw_texture_2d

        for rows, texture in self._bands:
            at = x, y + rows.start * pixel_height
            height = (rows.stop - rows.start) * pixel_height
            draw_texture_2d(texture, at, self._width * pixel_width, height)


def draw_words(text: str, region: Any, scale: float) -> None:
    """Draw a sentence in the middle of a region, in as many lines as its width needs."""
    import blf

    size = _TEXT * scale
    lines = textwrap.wrap(text, max(16, int(0.7 * region.width / (size * _LETTER))))
    blf.size(0, size)
    blf.color(0, 1, 1, 1, 1)
    for number, line in enumerate(lines):
        width, _ = blf.dimensions(0, line)
        y = region.height / 2 + (len(lines) / 2 - number) * 1.5 * size
        blf.position(0, (region.width - width) / 2, y, 0)
        blf.draw(0, line)
