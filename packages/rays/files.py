"""Reads rays from an .npz, and writes what they meet: arrays that numpy alone reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array, Floats
from reference_tracer.files import npz
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import NOTHING, Hits

ORIGINS, DIRECTIONS = "origins", "directions"


def load_rays(path: Path) -> Rays:
    """Read n rays: `origins` and `directions`, (n, 3) each or (3,) where all share it.

    Raises
    ------
    SceneError
        If there is no such file, an array is missing or has another shape or type, a number is not
        finite, or a direction is zero; the message names the array and the row.
    """
    with npz.opened(path) as held:
        found = {name: held[name] for name in (ORIGINS, DIRECTIONS) if name in held}
    origins, directions = (_vectors(path, found, name) for name in (ORIGINS, DIRECTIONS))
    counts = {v.shape[1] for v in (origins, directions)} - {1}
    if len(counts) > 1:
        raise SceneError(
            f"'{path}' has {origins.shape[1]:,} origins and {directions.shape[1]:,} directions: "
            "there must be as many, or one for all"
        )
    if (still := np.flatnonzero(~directions.any(axis=0))).size:
        raise SceneError(f"'{path}': row {still[0]} of {DIRECTIONS} is zero, and leads nowhere")
    return Rays(origins, directions)


@np.errstate(all="ignore")  # what a number becomes is compared
def _vectors(path: Path, found: dict[str, Array], name: str) -> Floats:
    """Return an array's rows as (3, n) float64."""
    if name not in found:
        raise SceneError(f"'{path}' has no array '{name}': (n, 3) numbers, a row for each ray")
    given = np.atleast_2d(found[name])
    if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "fiu":
        say = f"holds {found[name].shape} of {found[name].dtype}, not (n, 3) numbers"
        raise SceneError(f"'{path}': {name} {say}")
    vectors = given.T.astype(np.float64)
    rounded = given.dtype.kind in "iu" and (vectors.astype(given.dtype) != given.T).any()
    if rounded or given.dtype.itemsize > 8:
        raise SceneError(f"'{path}': {name} holds numbers that float64 does not: round them")
    if (bad := np.flatnonzero(~np.isfinite(vectors).all(axis=0))).size:
        raise SceneError(f"'{path}': row {bad[0]} of {name} is not finite")
    return vectors


def save_hits(path: Path, scene: Scene, hits: Hits) -> None:
    """Write what n rays meet, as `docs/rays.md` says."""
    on_mesh = hits.triangle != NOTHING
    ties = hits.ties
    rows = np.repeat(ties.start, ties.count) + _counted(ties.count)
    npz.save(
        path,
        {
            "t": hits.t,
            "object": scene.instance_objects[hits.instance],
            "instance": hits.instance,
            "triangle": hits.triangle,
            "barycentrics": np.where(on_mesh, hits.s, np.nan).T,
            "certainty": hits.certainty,
            "objects": np.array(scene.objects, dtype=str),
            "tie_ray": np.repeat(ties.ray, ties.count),
            "tie_instance": ties.instance[rows],
            "tie_triangle": ties.triangle[rows],
        },
    )


def _counted(counts: Array) -> Array:
    """Return 0, 1, ... below each count, one after the other."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
