"""The tracer's result: one array for each output, row 0 at the bottom.

Stored is what tracing finds. What follows from it is computed when it is asked for; of a certified
picture, t and the barycentrics are, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Bools, Bytes, Colors, Floats, Index, Integers, parts
from ..certainty import Certainty
from ..scene import Region, Scene
from . import shading
from .camera import camera_rays, film_positions
from .frame_measures import FrameMeasures
from .hits import NOTHING, Hits, Measures, Names, Statistics
from .memory import TRACED, check_memory
from .ties import Ties

_PIXELS = 1 << 15  # of which something is computed together
FEW = 8  # fewer than one in 8 pixels are few: their measures are found by themselves
NO_HIT_DEPTH = 1e10  # what Blender's own depth pass has where nothing is hit


class Pass(NamedTuple):
    """One output: what EXR files and arrays call it, and how Blender shows it.

    `name` is the attribute of `Frame` that has it, `label` Blender's name (none: not in Blender),
    `letters` those of its channels there, `shown` what Blender is given of its values.
    """

    name: str
    label: str = ""
    letters: str = "X"
    kind: str = "VALUE"
    shown: Callable[[Array], Array] = np.asarray


def _finite(t: Array) -> Array:
    return np.minimum(t, NO_HIT_DEPTH)


def _from_1(index: Array) -> Array:
    return index + 1  # 0 is none


PASSES = (
    Pass("color", "Combined", "RGBA", "COLOR"),
    Pass("depth", "Depth", "Z", shown=_finite),
    Pass("t", "T", shown=_finite),
    Pass("position", "Position", "XYZ", "VECTOR"),
    Pass("normal", "Normal", "XYZ", "VECTOR"),
    Pass("barycentrics", "Barycentrics", "XYZ", "VECTOR"),
    Pass("object_index", "Object Index", shown=_from_1),
    Pass("instance_index"),
    Pass("triangle_index", "Triangle Index", shown=_from_1),
    Pass("certainty", "Certainty"),  # see `certainty.Certainty`
    Pass("rows_done"),
)


@dataclass(eq=False)
class Frame:
    """A traced picture of h x w pixels: the camera's region.

    `color` is the mean over the samples of a pixel; everything else is that of the ray through
    the pixel's centre.
    """

    scene: Scene  # that is traced
    color: Colors  # (h, w, 4) linear RGBA, alpha premultiplied
    instance_index: Integers  # (h, w) instances, then planes; NOTHING: no hit
    triangle_index: Integers  # (h, w) index into Mesh.triangles; NOTHING: none
    certainty: Bytes  # (h, w) Certainty of the surface that is seen
    rows_done: Bools  # (h,) False for rows that were not traced
    measures: FrameMeasures  # t and the barycentrics
    ties: Ties = field(default_factory=Ties.none)  # by the pixel's index, row by row
    cancelled: bool = False
    statistics: Statistics = field(default_factory=Statistics)

    @classmethod
    def empty(cls, scene: Scene) -> Frame:
        """Return a frame of the camera's region with no row done, its colour transparent.

        Raises
        ------
        PictureTooLargeError
            If there is not enough memory for it.
        """
        h, w = scene.camera.region.height, scene.camera.region.width
        check_memory(w, h, TRACED)
        instance = np.full((h, w), NOTHING, np.int32)
        triangle = np.full((h, w), NOTHING, np.int32)
        return cls(
            scene,
            color=np.zeros((h, w, 4), np.float32),
            instance_index=instance,
            triangle_index=triangle,
            certainty=np.full((h, w), Certainty.NOT_CERTIFIED, np.uint8),
            rows_done=np.zeros(h, bool),
            measures=FrameMeasures(instance, triangle),
        )

    def cancel(self) -> None:
        """End here: empty the rows that are not done, whatever was found of them."""
        self.cancelled = True
        self._empty(int(self.rows_done.sum()))  # the lowest are done first

    def withdraw(self) -> None:
        """Empty all rows, as if nothing had been traced."""
        self.rows_done[:] = False
        self.statistics = Statistics()
        self._empty(0)

    def _empty(self, first: int) -> None:
        height, width = self.shape
        rows = slice(first, height)
        self.color[rows] = 0
        self.ties = self.ties.below(rows.start * width)
        self.enter(rows, Hits.none((height - rows.start) * width))

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width in pixels."""
        return self.certainty.shape

    @property
    def t(self) -> Floats:
        """Ray parameter, (h, w): the depth in metres (a panorama's distance); inf: no hit."""
        return self.measures.of(slice(None))[0]

    depth = t  # as Blender's Z pass has it

    @property
    def barycentrics(self) -> Floats:
        """Weights of the triangle's corners, (h, w, 3)."""
        return np.moveaxis(self.measures.of(slice(None))[1:], 0, -1)

    @property
    def position(self) -> Floats:
        """Each ray's hit in world space, (h, w, 3) metres; zero where nothing is hit."""
        return self._by_rows(self.positions)

    @property
    def normal(self) -> Floats:
        """Geometric unit normals in world space, (h, w, 3), as `shading.normals` has them."""
        return self._by_rows(self._normals)

    @property
    def object_index(self) -> Integers:
        """Index into `Scene.objects`, (h, w); NOTHING: no hit."""
        return self.scene.instance_objects[self.instance_index]

    def hits(self, rows: slice = slice(None)) -> Hits:
        """Return what the centre rays of some rows met, row by row: views of the frame's arrays."""
        first, last, _ = rows.indices(self.shape[0])
        width = self.shape[1]

        def find(ray: Index, _instance: Names, _triangle: Names) -> Measures:
            if FEW * len(ray) < (last - first) * width:  # the others may never be needed
                return self.measures.some(ray + first * width)
            return self.measures.of(rows).reshape(4, -1)[:, ray]

        return Hits(
            self.instance_index[rows].reshape(-1),
            self.triangle_index[rows].reshape(-1),
            self.certainty[rows].reshape(-1),
            find,
        )

    def enter(self, rows: slice, hits: Hits) -> None:
        """Enter what the centre rays of some rows met, row by row."""
        own = self.hits(rows)
        own.instance[:] = hits.instance
        own.triangle[:] = hits.triangle
        own.certainty[:] = hits.certainty
        self.measures.enter(rows, hits)
        self.ties = Ties.joined((self.ties, hits.ties.numbered(rows.start * self.shape[1])))

    def positions(self, rows: slice) -> Floats:
        """Return where the rays of some rows end, (n, 3), as `position` has it."""
        r = self.scene.camera.region
        y0, y1, _ = rows.indices(self.shape[0])
        film = film_positions(Region(r.x0, r.y0 + y0, r.x1, r.y0 + y1))
        return shading.positions(camera_rays(self.scene.camera, *film), self.hits(rows))

    def _normals(self, rows: slice) -> Floats:
        return shading.normals(self.scene, self.hits(rows))

    def blocks(self, name: str) -> Iterator[Array]:
        """Yield an output, from its lowest rows upwards: those that are large, some at a time."""
        of = {"position": self.positions, "normal": self._normals}.get(name)
        if of is None:
            yield getattr(self, name)
            return
        for rows in self._rows():
            yield of(rows).reshape(-1, self.shape[1], 3)

    def _by_rows(self, of: Callable[[slice], Floats]) -> Floats:
        """Return what a function makes of rows, (n, 3), as one array (h, w, 3)."""
        height, width = self.shape
        out = np.moveaxis(np.zeros((3, height, width)), 0, -1)  # as the tracer has vectors
        for rows in self._rows():
            out[rows] = of(rows).reshape(-1, width, 3)
        return out

    def _rows(self) -> list[slice]:
        height, width = self.shape
        return parts(height, max(1, _PIXELS // width))

    def depths(self) -> tuple[float, float]:
        """Return the depths of the nearest and the farthest hit, metres; 0 where there is none."""
        t = self.t[np.isfinite(self.t)]
        return (float(np.min(t)), float(np.max(t))) if t.size else (0.0, 0.0)

    def wrong_against(self, certified: Frame) -> Bools:
        """Return which pixels, (h, w), see another surface than a certified frame of the scene.

        Where that is ambiguous, all that a ray moved infinitesimally may see is right.
        """
        wrong = (self.instance_index != certified.instance_index) | (
            self.triangle_index != certified.triangle_index
        )
        pixel = np.flatnonzero(wrong)
        name = self.instance_index.ravel()[pixel], self.triangle_index.ravel()[pixel]
        wrong.flat[pixel[certified.ties.may_see(pixel, *name)]] = False
        return wrong

    def passes(self) -> dict[str, Array]:
        """Return every output by name, also those that are computed."""
        return {p.name: getattr(self, p.name) for p in PASSES}
