"""The benchmark's scenes: what they say they are, the same every time, and all of them seen."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.rendering import render
from reference_tracer.tracer.camera import camera_rays as our_rays
from reference_tracer.tracer.settings import Settings
from reference_tracer_benchmarks import meshes, scenes
from reference_tracer_benchmarks.plan import BLENDER, LARGE, plan
from reference_tracer_benchmarks.rays import rays_of
from reference_tracer_benchmarks.scenes import CAMERAS, SUBJECTS

SMALL = {
    "icosphere_1m": partial(meshes.icosphere, 3),
    "icosphere_5m": partial(meshes.icosphere, 3),
    "heightfield": partial(meshes.heightfield, 20),
    "large_100k": partial(meshes.large_triangles, 300),
    "small_1m": partial(meshes.soup, 2000, 0.1),
    "nested_spheres": partial(meshes.nested_spheres, 4, 2),
    "slivers_100k": partial(meshes.slivers, 3000),
    "inside_sphere": partial(meshes.icosphere, 3),
    "foliage": partial(meshes.foliage, 300, 0.3),
    "subpixel_1m": partial(meshes.soup, 10_000, 0.02),
    "instances_10k": partial(meshes.icosphere, 0),
}


def small(name: str):
    """A scene's mesh, or one of its kind with fewer triangles."""
    make = SMALL.get(name) or SUBJECTS[name].mesh
    return scenes.Mesh(*make(), name=name)


SPHERES = {"icosphere_5m", "icosphere_1m", "inside_sphere"}  # large, and counted below
MADE_HERE = [name for name, s in SUBJECTS.items() if s.mesh]


@pytest.mark.parametrize("name", sorted(set(MADE_HERE) - SPHERES))
def test_the_triangles_are_as_many_as_stated(name):
    vertices, triangles = SUBJECTS[name].mesh()
    assert triangles.shape == (SUBJECTS[name].triangles, 3) and triangles.dtype == np.int32
    assert vertices.dtype == np.float32 and np.isfinite(vertices).all()
    assert triangles.min() == 0 and triangles.max() == len(vertices) - 1


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("name", MADE_HERE)
def test_all_scenes_trace(name, camera):
    scene = scenes.build(small(name), 32, 18, camera)
    seen = render(scene, Settings("certified")).instance_index >= 0
    assert scene.camera.projection.shares_direction == (camera == "orthographic")
    assert 0.02 < seen.mean() <= 1
    inside = {"inside_soup", "inside_sphere"} if camera == "perspective" else {"inside_soup"}
    assert seen.all() == (name in inside)


@pytest.mark.parametrize("camera", CAMERAS)
def test_peers_get_the_rays_that_are_traced(camera):
    """From the clip start on, in float32; of a sample those of some rows, in the middle of each."""
    view = scenes.build(small("cube"), 32, 18, camera).camera
    whole, some = rays_of(view), rays_of(view, 4)
    ours = our_rays(view, np.tile(np.arange(32) + 0.5, 18), np.repeat(np.arange(18) + 0.5, 32))
    ends = (ours.origins + view.clip_start * ours.directions).T
    assert np.allclose(whole.origins, ends, rtol=0, atol=1e-6)
    assert whole.length == view.clip_end - view.clip_start
    assert whole.origins.flags.c_contiguous and whole.directions.dtype == np.float32
    rows = whole.directions.reshape(18, 32, 3)[2::4]
    assert (some.directions.reshape(-1, 32, 3) == rows).all() and some.count == 32 * 4
    assert some.of == whole.of == whole.count == 32 * 18


def test_what_blender_makes_is_asked_for_by_name(tmp_path: Path):
    with pytest.raises(meshes.MissingMeshError, match=r'pip install "reference_tracer\[blender\]"'):
        scenes.mesh_of("suzanne", tmp_path)
    vertices, triangles = meshes.cube()
    np.savez(tmp_path / scenes.SUZANNE_FILE, vertices=vertices, triangles=triangles)
    assert len(scenes.mesh_of("suzanne", tmp_path).triangles) == 12


def test_the_plan():
    whole, quick = plan(), plan(quick=True)
    everyday = [n for n, s in SUBJECTS.items() if s.group == scenes.EVERYDAY]
    assert len(everyday) == 7 and {c.scene for c in whole.cases} == set(SUBJECTS)
    assert set(everyday) < {c.scene for c in quick.cases} < set(SUBJECTS)
    assert len(whole.cases) == 4 * 17 + 1
    for c in whole.cases:
        at_peers = (c.width, c.height) == LARGE and c.camera == "perspective"
        assert (c.peers >= BLENDER) == (at_peers and c.scene in everyday)
    assert all(c.title and c.cost > 0 for c in whole.cases)
    assert {c.scene for c in plan(["cube", "soup_10k", "cube"]).cases} == {"cube", "soup_10k"}
    assert plan(["cube"], repeats=9).repeats == 9
