"""How far a sample may lie from its centre: found for a few pixels as for all."""

from __future__ import annotations

import gc
import weakref

import numpy as np
import pytest
import trimesh
from reference_tracer.pictures.bands import SampleBand, band_of
from reference_tracer.pictures.bounds import SNAPPING
from reference_tracer.pictures.renderers import EMBREE, RASTER, RAYS
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.world import depth_ranges, world_corners


def found(scene, frame, asked, renderer=RASTER):
    """Return a new band of a frame of which some pixels (h, w) were asked for."""
    band = SampleBand(scene, frame, renderer)
    result_of(band.find(asked))
    return band


def hall(make, x=20.0, height=2.0):
    """Balls above a floor that reaches behind the camera, so that its box bounds no depth."""
    camera = make.camera(160, 120, eye=(x, -30, height), target=(x, 0, 1), clip_start=1e-3)
    ball = trimesh.creation.icosphere(3)
    balls = [make.mesh(ball, placed(x + at, size)) for at, size in ((-2, 1), (2, 2))]
    floor = make.mesh(trimesh.creation.box((120, 120, 1)), placed(x, 1))
    return make.scene(camera, *balls, floor)


def placed(x, size):
    matrix = np.diag((size, size, size, 1.0))
    matrix[0, 3] = x
    return matrix


@pytest.mark.parametrize("renderer", [RASTER, EMBREE, RAYS])
@pytest.mark.parametrize("of", [hall, lambda make: make.room(True), lambda make: make.stripes()])
def test_those_of_a_few_pixels_are_those_of_all(make, of, renderer, rng):
    scene = of(make)
    frame = render(scene)
    every = found(scene, frame, np.ones(frame.shape, bool), renderer)
    few = rng.random(frame.shape) < 1 / 40
    few[0, 0] = few[-1, -1] = True
    some = found(scene, frame, few, renderer)
    assert np.array_equal(some.values[few], every.values[few])
    assert np.isnan(some.values).any() == (renderer is not RAYS)
    assert every.values.max() <= every.most
    assert every.most == np.inf or every.most < 0.1
    result_of(some.find(np.ones(frame.shape, bool)))
    assert np.array_equal(some.values, every.values)


@pytest.mark.parametrize(
    ("x", "height", "method"), [(20, 2, "moller_trumbore"), (20, 0.501, "auto"), (1e5, 2, "auto")]
)
def test_all_are_looked_at_where_nothing_bounds_them(make, x, height, method):
    """An unproven t may be any; and errors may reach farther than the next pixel."""
    scene = hall(make, x, height)
    frame = render(scene, Settings(method))
    one = np.zeros(frame.shape, bool)
    one[5, 5] = True
    band = found(scene, frame, one)
    assert not band.most <= 1 and not np.isnan(band.values).any()
    assert (band.values.max() > 1) == (method == "auto")


def test_it_lives_as_long_as_its_frame(make):
    room = make.room()
    frame = render(room)
    band = band_of(room, frame)
    assert band_of(room, frame) is band and band_of(room, frame, RAYS) is not band
    assert band_of(room, render(room)) is not band
    assert band.most >= SNAPPING
    gone = weakref.ref(frame)
    del frame
    gc.collect()
    assert gone() is None


def test_no_vertex_lies_outside_the_depths_of_its_box(make):
    scene = hall(make)
    low, high = depth_ranges(scene)
    for number, instance in enumerate(scene.instances):
        triangle = np.arange(len(scene.meshes[instance.mesh].triangles))
        corners = world_corners(scene, np.full(len(triangle), number), triangle)
        depth = np.einsum("kcn,c->kn", corners - scene.camera.origin[:, None], scene.camera.forward)
        assert low[number] <= depth.min() and depth.max() <= high[number]
        assert high[number] - low[number] < 1.8 * np.ptp(depth)
