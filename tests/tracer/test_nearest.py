"""The nearest hit: as brute force has it, however the work is divided."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.tracer import candidates, plane, world
from reference_tracer.tracer import render as loop
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.triangle import TESTS
from reference_tracer.tracer.vector import transform_points

from . import pictures

PLAIN = [Settings(m, p) for m in Method if not m.is_proven for p in ("float64", "float32")]


def for_all(some):
    return pytest.mark.parametrize(
        "settings", some, ids=lambda s: f"{s.method.value} {s.precision.value}"
    )


@pytest.fixture
def mess(make, rng):
    return pictures.mess(make, rng, False, False)


def brute_force(scene, settings):
    """Return t, instance, triangle of every pixel, (h w,) each: every ray with every triangle."""
    region, dtype = scene.camera.region, settings.precision.dtype
    rays = camera_rays(scene.camera, *film_positions(region, 0.0, 0.0), dtype)
    count = region.width * region.height
    best = [(np.inf, NOTHING, NOTHING)] * count

    def enter(hit, t, name):
        for pixel in np.flatnonzero(
            hit & (t >= scene.camera.clip_start) & (t <= scene.camera.clip_end)
        ):
            found = (float(t[pixel]), *name)
            if best[pixel][1] == NOTHING or found < best[pixel]:
                best[pixel] = found

    for i, instance in enumerate(scene.instances):
        mesh = scene.meshes[instance.mesh]
        world = transform_points(instance.world_from_object, mesh.vertices.T).astype(dtype)
        for k, triangle in enumerate(mesh.triangles):
            hit, t, _ = TESTS[settings.method](rays, *(world[:, [corner]] for corner in triangle))
            enter(hit, t, (i, k))
    for i, infinite in enumerate(scene.planes):
        t = plane.intersect(
            rays, infinite.point[:, None].astype(dtype), infinite.normal[:, None].astype(dtype)
        )
        enter(np.isfinite(t), t, (len(scene.instances) + i, NOTHING))
    return tuple(np.array(column) for column in zip(*best, strict=True))


def traced(scene, settings=None):
    return render(scene, settings)


@pytest.mark.slow
@for_all(PLAIN)
@pytest.mark.parametrize(
    "division",
    [
        (50, 7, 3),
        (1 << 20, 1 << 20, 1000),
        *(
            pytest.param(division, marks=pytest.mark.torture)
            for division in ((1, 1 << 14, 32), (1 << 15, 1, 32), (1 << 15, 17, 1))
        ),
    ],
)
def test_the_division_of_the_work_does_not_matter(mess, settings, division, monkeypatch):
    whole = traced(mess, settings)
    for module, name, value in zip(
        (candidates, world, loop), ("PAIRS", "BATCH", "ROWS"), division, strict=True
    ):
        monkeypatch.setattr(module, name, value)
    divided = traced(mess, settings)
    for name, values in divided.passes().items():
        assert values.tobytes() == whole.passes()[name].tobytes(), name
    assert divided.statistics.pairs_tested == whole.statistics.pairs_tested


SEEING = pytest.mark.parametrize("method", [m for m in Method if m != Method.TEXTBOOK_LITERAL])


@SEEING
def test_equal_t_goes_to_the_lower_instance_and_triangle(make, method):
    quad = make.quad(-9, 9, -9, 9, -2)
    double = replace(quad, triangles=quad.triangles[[1, 0, 1, 0]], slots=None)
    scene = make.scene(make.camera(), double, quad)
    instances = [replace(scene.instances[k], mesh=m) for k, m in ((0, 1), (1, 0), (0, 0), (1, 1))]
    for some in (instances, instances[1:], instances[::-1]):
        frame = traced(replace(scene, instances=some), Settings(method))
        assert (frame.instance_index == 0).all()
        lower_right = (
            0 if some[0].mesh == 1 else 1
        )  # of the double mesh, the first of its two copies
        assert frame.triangle_index[0, -1] == lower_right
        assert frame.triangle_index[-1, 0] == 1 - lower_right
        assert set(np.unique(frame.triangle_index)) == {0, 1}


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("kind", ["triangle", "plane"])
@pytest.mark.parametrize("method", ["moller_trumbore", "certified"])
def test_the_clip_range_is_inclusive(make, orthographic, kind, method):
    camera = make.camera(orthographic=orthographic, clip_start=2, clip_end=3)
    for z, seen in ((2, True), (3, True), (2 - 1e-12, False), (3 + 1e-12, False), (-2.5, False)):
        things = {"planes": [((0, 0, -z), (0, 0, 1))]} if kind == "plane" else {}
        meshes = () if kind == "plane" else (make.quad(-9, 9, -9, 9, -z),)
        frame = traced(make.scene(camera, *meshes, **things), Settings(method))
        assert (frame.instance_index == (0 if seen else NOTHING)).all()
        assert np.allclose(frame.t, z if seen else np.inf, rtol=0, atol=1e-15)
