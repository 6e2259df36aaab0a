"""A file of data as the other side of a comparison: which convention it follows, and what it says.

What is not chosen is told from the data: the convention in which the most pixels are right.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product, starmap
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array, Bools
from reference_tracer.pictures.given import Making, traced
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import trace
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import film_positions
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.settings import Settings

from . import ids, vectors
from .depth import DEPTH, DISTANCE
from .files import StoredData, read
from .kind import Data, Kind
from .picture import DataPicture
from .step import Step

NO_HIT = 1e10  # Blender's own depth where nothing is hit; as much is no distance
KINDS: dict[str, tuple[Kind, ...]] = {  # each in all its conventions
    "depth": (DEPTH,),
    "distance": (DISTANCE,),
    "normals": tuple(starmap(vectors.normals, product(vectors.SPACES, vectors.RANGES))),
    "positions": tuple(map(vectors.positions, vectors.SPACES)),
    "ids": (ids.kind_of({}),),
}


@dataclass(frozen=True)
class GivenData:
    """A file of data, and what is known of it.

    Raises
    ------
    ValueError
        If there is no such kind, the scale is no length, or the kind has none.
    """

    kind: str  # of KINDS
    path: Path | Array  # or an array, (h, w) or (h, w, c), row 0 at the bottom
    layer: str = ""  # of several arrays in the file; '': as they are named
    scale: float | None = None  # metres that 1 is; None: 1, but required of integers
    space: str = ""  # of vectors.SPACES; '': found from the data
    range: str = ""  # of vectors.RANGES; '': found from the data
    top_down: bool = False  # an array's first row is the topmost
    names: Path | None = None  # a table of ids, which says whose is whose

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind is {self.kind!r}; it must be one of {', '.join(KINDS)}")
        if self.scale is not None:
            if not KINDS[self.kind][0].unit:
                raise ValueError(f"scale is {self.scale!r}; {self.kind} are no lengths")
            if not 0 < self.scale < np.inf:
                raise ValueError(f"scale is {self.scale!r}; it must be above 0, in metres")

    @property
    def name(self) -> str:
        """The file's name, or "array"."""
        return self.path.name if isinstance(self.path, Path) else "array"

    def conventions(self, stored: StoredData) -> Iterator[Kind]:
        """Yield the kind in each convention that may be the file's."""
        range_ = self.range or ("" if stored.step.type else "unit")  # integers hold 0 to 1
        for kind in KINDS[self.kind]:
            if self.space in ("", kind.space) and {range_, kind.range} != {*vectors.RANGES}:
                yield kind

    def picture(self, scene: Scene, making: Making) -> DataPicture:
        """Read it as the other side; of a whole view, the camera's region.

        Raises
        ------
        SizeError
            If it shows neither the view nor the region.
        SceneError
            If integers have no scale, or the camera knows no such depth.
        MissingLibraryError, OSError
            If the file cannot be read.
        """
        if self.kind == "depth" and not scene.camera.projection.is_linear:
            raise SceneError(
                "a panorama has no view axis: its depths are distances: --holds distance"
            )
        stored = read(self.path, KINDS[self.kind][0], self.layer, self.top_down)
        at = traced(scene.camera, stored.values.shape[:2])
        stored = replace(stored, values=stored.values[at])
        renderer, known = making.renderer_of("")
        sampling = Sampling(sample_radius=making.filter_radius, renderer=renderer)
        remarks = []
        if self.kind == "ids":
            data = _ids(stored, scene, trace(scene, Settings()), self.names)
        else:
            found = [_data(self, stored, scene, kind) for kind in self.conventions(stored)]
            data = found[0]
            remarks.append(f"it holds {data.step.words}")
            if len(found) > 1:
                hits = trace(scene, Settings())
                right = [int(one.flat.same(scene, hits, sampling, hits.t).sum()) for one in found]
                data = found[int(np.argmax(right))]
                remarks.append(
                    f"its {data.kind.words} are taken to be {data.kind.variant}, as most agree"
                )
        said = tuple(f"of '{self.name}': {remark}" for remark in remarks)
        source = Source(file=self.name, known=known, remarks=said, what=data.kind.words)
        return DataPicture(data.color, source, sampling=sampling, data=data)


def _film(scene: Scene) -> Array:
    region = scene.camera.region
    return np.stack(film_positions(region), axis=-1).reshape(region.height, region.width, 2)


def _ids(stored: StoredData, scene: Scene, hits: Hits, names: Path | None) -> Data:
    numbers = ids.numbers_of(stored.values)
    known = ids.named(names, stored.values, numbers, scene) if names else None
    ways = (1, -1)  # the rows as they are, and turned over, which is a fault of its own
    found = [ids.owners_of(scene, hits, numbers[::way].reshape(-1), known) for way in ways]
    way, (own, blank, _) = max(zip(ways, found, strict=True), key=lambda one: one[1][2])
    return Data(
        ids.kind_of(own, "" if names else ids.PRESUMED),
        numbers[..., None],
        blank.reshape(numbers.shape)[::way],
        _film(scene),
        scene.camera,
        Step("float64"),
        raw=stored.values,
    )


def _data(given: GivenData, stored: StoredData, scene: Scene, kind: Kind) -> Data:
    """Return what a file holds as data of a kind."""
    raw = stored.values.astype(np.float64)
    unit = 1.0
    if kind.unit:
        if not stored.step.type and given.scale is None:
            raise SceneError(
                f"'{given.name}' holds integers: say how many metres 1 is, as scale=0.001"
            )
        unit = 1.0 if given.scale is None else given.scale
    elif not stored.step.type:
        unit = 1 / stored.top
    values = raw * unit
    step = replace(stored.step, unit=unit)
    full = 1.0 if step.type else stored.top * unit
    blank = _blank(raw if kind.unit else values, stored, kind, step)
    return Data(kind, values, blank, _film(scene), scene.camera, step, full)


def _blank(values: Array, stored: StoredData, kind: Kind, step: Step) -> Bools:
    """Return which pixels (h, w) say that nothing is there."""
    with np.errstate(invalid="ignore"):
        out = ~np.isfinite(values).all(axis=-1) | (np.abs(values) >= NO_HIT).all(axis=-1)
    near = 0.0 if step.type or kind.unit else step.unit
    for empty in kind.empty:
        out |= (np.abs(values - empty) <= near).all(axis=-1)
    if kind.unit and not step.type:
        out |= (values == stored.top).all(axis=-1)
    return np.asarray(out, np.bool_)
