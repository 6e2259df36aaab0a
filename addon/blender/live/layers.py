"""Draws pictures in a 3D view, pixel on pixel, as textures of the graphics card; and words.

Colours are scene linear: Blender brings them to the screen by the scene's view transform, as it
does with its own. `gpu` is imported only where something is drawn: a server has no display.
"""

from __future__ import annotations

import textwrap
import time
from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np
from bpy.types import Region
from gpu.types import GPUShader

from ...arrays import parts
from .shows import Picture

Place = tuple[float, float, float, float]  # left, bottom, a pixel's width and height, of the region
BAND = 1 << 17  # pixels of a texture: it is made in some 2 ms
_LETTER = 0.55  # mean width of Blender's font, in its size
_SIZE = 14  # of words, points

# A texture's own pixels, never a mean of two, as Blender's image shader would draw.
_PLACED = """
void main() { place = at; gl_Position = ModelViewProjectionMatrix * vec4(pos, 0.0, 1.0); }
"""
_FETCHED = "void main() { color = texelFetch(image, ivec2(floor(place)), 0); }"


@cache
def pixel_shader(fragment: str = _FETCHED) -> GPUShader:
    """Return a shader that shows a texture, each of its pixels as it is, or as a source says.

    Its vertices have `pos`, in pixels of the region, and `at`, in pixels of the texture.
    """
    import gpu

    place = gpu.types.GPUStageInterfaceInfo("reference_tracer_place")
    place.smooth("VEC2", "place")
    info = gpu.types.GPUShaderCreateInfo()
    info.push_constant("MAT4", "ModelViewProjectionMatrix")
    info.sampler(0, "FLOAT_2D", "image")
    info.vertex_in(0, "VEC2", "pos")
    info.vertex_in(1, "VEC2", "at")
    info.vertex_out(place)
    info.fragment_out(0, "VEC4", "color")
    info.vertex_source(_PLACED)
    info.fragment_source(fragment)
    return gpu.shader.create_from_info(info)


class Layers:
    """Pictures on the graphics card, one over the other; a whole one replaces those below it."""

    def __init__(self) -> None:
        self._textures: list[Textures] = []

    def add(self, picture: Picture, place: Place) -> None:
        """Have a picture drawn over the others, unless it is one of them."""
        if not any(t.color is picture.color for t in self._textures):
            self._textures.append(Textures(picture, place))

    def draw(self, width: int, height: int, until: float) -> bool:
        """Draw what is done over a region, in pixels; return whether the time was too short."""
        left = [textures.upload(until) for textures in self._textures]
        whole = [n for n, textures in enumerate(self._textures) if not textures.missing]
        del self._textures[: max(whole, default=0)]
        for textures in self._textures:
            textures.draw(width, height)
        return any(left)


class Textures:
    """The rows of a picture that are on the graphics card, in bands from the lowest up."""

    def __init__(self, picture: Picture, place: Place) -> None:
        height, width = picture.color.shape[:2]
        self.color = picture.color
        self._rows_done = picture.rows_done
        self._place = place
        self.missing = parts(height, max(1, BAND // width))
        self._bands: list[tuple[int, Any]] = []  # the first row of each

    def upload(self, until: float) -> bool:
        """Make textures of rows that are done, one at least; return whether some are left.

        `until` is when to stop, as `time.perf_counter()` has it.
        """
        import gpu

        done = [rows for rows in self.missing if self._rows_done[rows].all()]
        for number, rows in enumerate(done, start=1):
            data = self.color[rows]
            buffer = gpu.types.Buffer("FLOAT", (data.size,), data.reshape(-1))
            texture = gpu.types.GPUTexture(data.shape[1::-1], format="RGBA32F", data=buffer)
            self._bands.append((rows.start, texture))
            self.missing.remove(rows)
            if time.perf_counter() > until:
                return number < len(done)
        return False

    def draw(self, width: int, height: int) -> None:
        """Draw the layers over a region of this size."""
        from gpu_extras.batch import batch_for_shader

        shader = pixel_shader()
        left, bottom, across, up = np.multiply(self._place, (width, height) * 2)
        for row, texture in self._bands:
            w = texture.width
            h = texture.height
            corners = [(0, 0), (w, 0), (0, h), (w, h)]
            pos = [(left + i * across, bottom + (row + j) * up) for i, j in corners]
            batch = batch_for_shader(shader, "TRI_STRIP", {"pos": pos, "at": corners})
            shader.uniform_sampler("image", texture)
            batch.draw(shader)


def draw_words(text: str, region: Region, scale: float) -> None:
    """Draw a sentence in the middle of a region, in as many lines as its width needs."""
    import blf

    size = _SIZE * scale
    lines = textwrap.wrap(text, max(16, int(0.7 * region.width / (size * _LETTER))))
    blf.size(0, size)
    placed = []
    for number, line in enumerate(lines):
        width, _ = blf.dimensions(0, line)
        y = region.height / 2 + (len(lines) / 2 - number) * 1.5 * size
        placed.append((line, (region.width - width) / 2, y))
    draw_outlined(placed)


def draw_outlined(texts: Iterable[tuple[str, float, float]]) -> None:
    """Draw texts at places, in the font's size, white with an outline: on any background."""
    import blf

    blf.color(0, 1, 1, 1, 1)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 6, 0, 0, 0, 1)
    for text, x, y in texts:
        blf.position(0, x, y, 0)
        blf.draw(0, text)
    blf.disable(0, blf.SHADOW)
