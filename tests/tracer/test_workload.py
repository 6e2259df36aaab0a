"""Bands of even work: they cover the picture once, and are as few as large meshes want."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Instance, Region, Scene
from reference_tracer.tracer.workload import Workload, even_bands, workload

REGION = Region(3, 5, 43, 105)


def check_cover(region: Region, parts: list[Region]) -> None:
    assert [p.y0 for p in parts] == [region.y0, *(p.y1 for p in parts[:-1])]
    assert parts[-1].y1 == region.y1 and all(p.y0 < p.y1 for p in parts)
    assert {(p.x0, p.x1) for p in parts} == {(region.x0, region.x1)}


@pytest.mark.parametrize("processes", [1, 2, 3, 7, 100, 1000])
@pytest.mark.parametrize("most", [1, 7, 1000])
def test_bands_cover_the_region_once(processes, most, rng):
    rows = rng.random(100) ** 8
    parts = even_bands(REGION, Workload(rows, 0.0), processes, most)
    check_cover(REGION, parts)
    assert max(p.height for p in parts) <= most
    assert len(parts) >= min(processes, 20)


@pytest.mark.parametrize("processes", [2, 3, 8])
def test_their_work_is_even(processes, rng):
    rows = 1 + np.sin(np.arange(100) / 9) + rng.random(100)
    parts = even_bands(REGION, Workload(rows, 1e9), processes, 1000)
    assert len(parts) == processes
    took = [rows[p.y0 - REGION.y0 : p.y1 - REGION.y0].sum() for p in parts]
    assert max(took) - min(took) <= 2 * rows.max()


def test_the_more_a_band_takes_the_fewer_there_are():
    rows = np.ones(100)
    counts = [len(even_bands(REGION, Workload(rows, b), 2, 1000)) for b in (0, 1, 2, 10)]
    assert counts == sorted(counts, reverse=True) and counts[0] > counts[-1] == 2


def test_one_row_is_one_band():
    region = Region(0, 4, 9, 5)
    assert even_bands(region, Workload(np.ones(1), 0.0), 3, 10) == [region]


def test_rows_that_see_more_take_more(make):
    """A ball in the lower half: of as many triangles, the larger it appears the more it takes."""
    ball = make.mesh(trimesh.creation.icosphere(5))
    camera = make.camera(96, 72, eye=(0, -6, 1.2), target=(0, 0, 1.2))
    scene = make.scene(camera, ball)
    load = workload(scene)
    assert load.rows.shape == (72,) and load.rows[:36].sum() > 3 * load.rows[36:].sum()
    assert load.rows.min() > 0 and load.band > 0
    border = workload(replace(scene, camera=replace(camera, region=Region(8, 10, 80, 60))))
    assert np.argmax(border.rows) == pytest.approx(np.argmax(load.rows) - 10, abs=2)


def test_a_few_large_triangles_among_many_small_ones_count(make):
    """A ground below a million triangles of one ball: it is not lost in the sample."""
    camera = make.camera(64, 48, eye=(0, 0, 0), half=1.0)
    scene = make.scene(
        camera, make.mesh(trimesh.creation.icosphere(6)), make.quad(-9, 9, -9, 0, -2)
    )
    far = np.eye(4)
    far[:3, 3] = (0, 20, -40)
    ball, ground = scene.instances
    scene = replace(scene, instances=(replace(ball, world_from_object=far), ground))
    rows = workload(scene).rows
    assert rows[:23].min() > 10 * rows[26:30].min()


def test_what_is_not_there_takes_nothing_but_its_pixels(make):
    camera = make.camera()
    nothing = workload(make.scene(camera))
    assert np.ptp(nothing.rows) == 0 and nothing.band == 0
    behind = make.scene(camera, make.quad(-1, 1, -1, 1, 5))
    assert np.array_equal(workload(behind).rows, nothing.rows)
    plane = workload(make.scene(camera, planes=[((0, 0, -3), (0, 0, 1))]))
    assert (plane.rows > 2 * nothing.rows).all()


@pytest.mark.filterwarnings("error")
def test_no_scene_is_too_strange(make):
    """Empty meshes, corners that are not finite in world space or behind the eye, thousands."""
    mesh = make.quad(-1, 1, -1, 1, -2)
    empty = replace(mesh, triangles=np.zeros((0, 3), np.int32), slots=None)
    matrices = [np.diag([s, s, s, 1.0]) for s in (1.0, 0.0, -1.0, 1e200, 1e308)]
    instances = [Instance(k % 2, 0, m) for m in matrices for k in range(2)] * 600
    scene = Scene(make.camera(), (mesh, empty), instances, objects=("All",))
    load = workload(scene)
    assert np.isfinite(load.rows).all() and np.isfinite(load.band)
