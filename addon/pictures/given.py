"""A picture of unknown make, from a file or an array, as the other side of a comparison."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..files.images import PictureFile
from ..scene import Camera, Scene
from ..tracer.memory import COMPARED, check_memory
from .picture import Picture
from .renderers import RENDERERS, Renderer, renderer_of
from .sampling import Sampling
from .source import Source, check_size
from .storage import Storage


@dataclass(frozen=True)
class Making:
    """How a picture was made, as far as it is known.

    Raises
    ------
    ValueError
        If there is no such renderer, naming those that there are, or a number is negative.
    """

    renderer: str = ""  # a name in RENDERERS, whose rounding excuses a pixel; '': what a file says
    filter_radius: float = 0.0  # pixels: how far its filter reaches; 0 for one sample a pixel
    dither: float | None = None  # noise, in levels of 8 bits; None: what Blender added by default
    default_dither: float = 0.0
    engine: str = ""  # Blender's name of the engine that made it, where that is known
    asked: str = "as was asked for"  # who chose the renderer

    def __post_init__(self) -> None:
        if self.renderer and self.renderer not in RENDERERS:
            names = ", ".join(RENDERERS)
            raise ValueError(f"renderer is {self.renderer!r}; it must be one of {names}")
        for name, number in (("filter_radius", self.filter_radius), ("dither", self.dither)):
            if number is not None and not 0 <= number < np.inf:
                raise ValueError(f"{name} is {number}; it must be 0 or more")

    def renderer_of(self, header: str) -> tuple[Renderer, str]:
        """Return the renderer of a picture with a file's header, and how that is known."""
        if self.renderer:
            return RENDERERS[self.renderer], self.asked
        return renderer_of(header, self.engine)


class GivenPicture(Protocol):
    """A file, or an array, that is the other side: read once the scene is known."""

    def picture(self, scene: Scene, making: Making) -> Picture:
        """Read it, as it was made; of a whole view, the camera's region.

        Raises
        ------
        SizeError, SceneError, PictureTooLargeError, MissingLibraryError, OSError
            If it shows neither the view nor the region, or cannot be read.
        """
        ...


@dataclass(frozen=True)
class GivenFile:
    """A picture file and its header."""

    file: PictureFile

    def picture(self, scene: Scene, making: Making) -> Picture:
        """Read it."""
        return picture_of_file(self.file, scene.camera, making)


def picture_of_file(file: PictureFile, camera: Camera, making: Making) -> Picture:
    """Read a picture file as the other side; of a whole view, the camera's region.

    Raises
    ------
    SizeError, PictureTooLargeError
        If it shows neither the view nor the region, or there is not enough memory; its pixels are
        not read then.
    OSError
        If they are damaged.
    """
    at = traced(camera, (file.height, file.width))
    check_memory(camera.region.width, camera.region.height, COMPARED)
    stored = file.read()
    color = np.ascontiguousarray(stored.color[at])
    dither = 0.0 if stored.levels > 255 else making.default_dither  # of what has 8 bits alone
    if making.dither is not None:
        dither = making.dither * stored.levels / 255
    renderer, known = making.renderer_of(stored.engine)
    remarks = tuple(f"of the picture: {remark}" for remark in stored.remarks)
    return Picture(
        color,
        Source(file=file.path.name, known=known, remarks=remarks),
        sampling=Sampling(filter_radius=making.filter_radius, renderer=renderer),
        storage=Storage(stored.levels, dither, opaque=stored.opaque),
    )


def traced(camera: Camera, size: tuple[int, int]) -> tuple[slice, slice]:
    """Return the rows and columns of a picture (h, w) that are traced.

    They are the camera's region of its whole view, or the whole of that region.
    """
    r = camera.region
    if size == (camera.height, camera.width):
        return slice(r.y0, r.y1), slice(r.x0, r.x1)
    check_size(size, (r.height, r.width))
    return slice(None), slice(None)


def picture_of_array(color: ArrayLike, camera: Camera, making: Making) -> Picture:
    """Take an array (h, w, 3 or 4), linear, row 0 at the bottom, as the other side.

    RGBA has its alpha multiplied in. RGB says nothing of alpha, which is not compared then. If it
    shows the whole view, that is the camera's region.

    Raises
    ------
    SizeError
        If it shows neither the view nor the region.
    ValueError
        If it has another shape, or holds whole numbers.
    """
    given = np.asarray(color)
    if given.ndim != 3 or given.shape[2] not in (3, 4):
        raise ValueError(f"a picture has the shape (h, w, 3) or (h, w, 4), not {given.shape}")
    if given.dtype.kind != "f":
        say = "a picture holds linear colours, floats from 0 to 1"
        raise ValueError(f"{say}, not {given.dtype}: for what is encoded, name its file")
    opaque = given.shape[2] == 3
    at = traced(camera, given.shape[:2])
    given = np.ascontiguousarray(given[at], np.float32)
    if opaque:
        given = np.concatenate((given, np.ones_like(given[..., :1])), axis=2)
    renderer, known = making.renderer_of("")
    return Picture(
        given,
        Source(file="array", known=known),
        sampling=Sampling(filter_radius=making.filter_radius, renderer=renderer),
        storage=Storage(dither=making.dither or 0.0, opaque=opaque),
    )
