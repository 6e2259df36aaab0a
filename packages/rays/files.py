"""Reads rays from an .npz, and writes what they meet: arrays that numpy alone reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.files import npz
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.vector import spread

from .every import Crossings
from .inside import ALONG, Inside


def load_rays(path: Path) -> Rays:
    """Read n rays: `origins` and `directions`, (n, 3) each or (3,) where all share it.

    Raises
    ------
    SceneError
        If there is no such file, an array is missing or has another shape or type, a number is not
        finite, or a direction is zero; the message names the array and the row.
    """
    with npz.opened(path) as held:
        origins = _vectors(held, "origins")
        directions = _vectors(held, "directions")
        counts = origins.shape[1], directions.shape[1]
        if len({*counts, 1}) > 2:
            said = "it has {:,} origins and {:,} directions: there must be as many, or one for all"
            raise SceneError(said.format(*counts))
        for row in np.flatnonzero(~directions.any(axis=0)):
            raise SceneError(f"row {row} of directions is zero, and leads nowhere")
    return Rays(origins, directions)


def load_points(path: Path) -> Rays:
    """Read n points, `points`, (n, 3), as the origins of rays; it raises what `load_rays` does."""
    with npz.opened(path) as held:
        return Rays(_vectors(held, "points"), ALONG)


@np.errstate(all="ignore")  # what a number becomes is compared
def _vectors(held: npz.Arrays, name: str) -> Floats:
    """Return an array's rows as (3, n) float64."""
    if name not in held:
        raise SceneError(f"it has no array '{name}': (n, 3) numbers, a row each")
    given = np.atleast_2d(held[name])
    if given.shape[1:] != (3,) or given.dtype.kind not in "fiu":
        raise SceneError(f"{name} holds {given.shape} of {given.dtype}, not (n, 3) numbers")
    vectors = given.T.astype(np.float64)
    for row in np.flatnonzero(~np.isfinite(vectors).all(axis=0)):
        raise SceneError(f"row {row} of {name} is not finite")
    if (vectors.astype(given.dtype) != given.T).any():
        raise SceneError(f"{name} holds numbers that float64 does not: round them")
    return vectors


def save(path: Path, scene: Scene, count: int, found: Hits | Crossings | Inside) -> None:
    """Write what n rays meet, or where n points are, as `docs/rays.md` and `docs/every.md` say."""
    if isinstance(found, Inside):
        there = {name: array for name, array in vars(found).items() if array is not None}
        return npz.save(path, there)
    arrays = {
        "t": found.t,
        "object": scene.instance_objects[found.instance],
        "instance": found.instance,
        "triangle": found.triangle,
        "barycentrics": np.where(found.triangle != NOTHING, found.s, np.nan).T,
        "certainty": found.certainty,
        "objects": np.array(scene.objects, dtype=str),
    }
    if isinstance(found, Crossings):
        arrays |= {"start": found.start(count), "enters": found.enters, "same_t": found.same_t}
    else:
        ties = found.ties
        rows = sum(spread(ties.start, ties.count))
        arrays["tie_ray"] = np.repeat(ties.ray, ties.count)
        arrays["tie_instance"] = ties.instance[rows]
        arrays["tie_triangle"] = ties.triangle[rows]
    return npz.save(path, arrays)
