"""Nothing that a ray meets, in fractions, is left out by any of the boxes that are by hand."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

import numpy as np
import pytest
from reference_tracer.certified.sweep import small_triangles
from reference_tracer.certified.sweep.boxes import InstanceBoxes, boxes_of
from reference_tracer.certified.sweep.chunks import Chunk, expand
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.small_triangles import SmallTriangles
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC, PERSPECTIVE, equirectangular
from reference_tracer.scene import Region
from reference_tracer.tracer import candidates
from reference_tracer.tracer.candidates import pixel_bounds
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.world import world_corners

from .aimed import aimed

SCENES = 30  # in a part
PARTS = [0, *(pytest.param(part, marks=pytest.mark.torture) for part in range(1, 80))]


@lru_cache(maxsize=3)
def scenes(projection, part):
    """Return scenes, after their seeds, with what their rays meet."""
    seeds = range(part * SCENES, (part + 1) * SCENES)
    every = [(seed, aimed(np.random.default_rng(seed), projection)) for seed in seeds]
    out = [(seed, *found) for seed, found in every if found is not None and found.met]
    assert sum(len(met) for _, _, met in out) > SCENES
    return out


def is_nearer(camera, nearest: float, t: Fraction) -> bool:
    """Whether a bound on the nearness holds for a hit at t."""
    if not nearest < np.inf:  # NaN hides nothing, either
        return True
    parallel = camera.projection.shares_direction
    return Fraction(float(nearest)) >= (-t if parallel else 1 / t)


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC, EQUIRECTANGULAR])
def test_boxes_of_triangles(projection, part):
    for seed, scene, met in scenes(projection, part):
        every = np.arange(len(scene.instances))
        x0, x1, y0, y1 = pixel_bounds(scene.camera, world_corners(scene, every, 0 * every))
        for k, x, y, _ in met:
            assert x0[k] <= x < x1[k] and y0[k] <= y < y1[k], (seed, k)


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_boxes_of_instances_and_of_the_sweep(projection, part):
    for seed, scene, met in scenes(projection, part):
        film = Film(scene.camera)
        with np.errstate(all="ignore"):
            found = InstanceBoxes.of(scene, film)
            small = SmallTriangles(scene, film, scene.camera.region, found.area)
            chunk = Chunk(np.arange(len(scene.instances), dtype=np.int32))
            low, high, nearest = boxes_of(scene, film, result_of(expand(scene, film, chunk, small)))
        for k, x, y, t in met:
            assert found.in_region(Region(x, y, x + 1, y + 1))[k], (seed, k)
            assert is_nearer(scene.camera, found.nearest[k], t), (seed, k)
            assert (low[:, k] <= (x, y)).all() and ((x, y) <= high[:, k]).all(), (seed, k)
            assert is_nearer(scene.camera, nearest[k], t), (seed, k)


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_small_triangles(projection, part, monkeypatch):
    monkeypatch.setattr(small_triangles, "_PER_PIXEL", 0.0)
    looked = 0
    for seed, scene, met in scenes(projection, part):
        film = Film(scene.camera)
        with np.errstate(all="ignore"):
            area = InstanceBoxes.of(scene, film).area
            for k, x, y, _ in met:
                small = SmallTriangles(scene, film, Region(x, y, x + 1, y + 1), area)
                if small.is_dense[k]:
                    found = [v for v in small.within(scene.meshes[k], np.array([k])) if v]
                    assert sum(v.counts.sum() for v in found) == 1, (seed, k)
                    looked += 1
    assert looked or part  # in some few parts none is dense


@pytest.mark.parametrize("projection", [PERSPECTIVE, EQUIRECTANGULAR])
def test_boxes_without_room_are_found(projection, monkeypatch):
    """In which scene the rounding of a processor needs the room is looked for."""
    monkeypatch.setattr(candidates, "SAFETY", 0)
    monkeypatch.setattr(equirectangular, "_ANGLE", -1e-3)  # else 1e-9
    with pytest.raises(AssertionError, match=r"\(\d+, \d\)"):
        for part in range(40):
            test_boxes_of_triangles(projection, part)
