"""At the ends of float64 every pixel is right, or the scene is refused in words."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.plain import plain
from reference_tracer.certified.sweep.sweep import sweep
from reference_tracer.projections import EQUIRECTANGULAR, PERSPECTIVE
from reference_tracer.rendering import render
from reference_tracer.scene import (
    Camera,
    Instance,
    Mesh,
    Plane,
    Region,
    Scene,
    SceneError,
    ViewWindow,
)
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.world import world_corners

from ..oracle import barycentrics, rational, scene_sights
from .test_definition import held

pytestmark = pytest.mark.filterwarnings("error")
ENDS = (1020, 1015, 1000, 900, 700, 600, 540, 512, 500)
U = Fraction(1, 2**53)


@np.errstate(all="ignore")
def scene_at(make, rng, lengths: int, window: int, orthographic: bool) -> Scene:
    """Return a camera and some triangles in its view, of lengths about 2^`lengths`.

    `window` is the exponent of a perspective view window.
    """
    width, height = (int(n) for n in rng.integers(3, 8, 2))
    unit = 2.0**lengths
    half = rng.uniform(0.3, 2) * (unit if orthographic else 2.0**window)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0] if rng.integers(2) else np.eye(3)
    eye = unit * rng.normal(size=3) * rng.integers(2)
    camera = make.camera(
        width,
        height,
        half=half,
        eye=eye,
        axes=axes,
        orthographic=orthographic,
        clip_start=max(0.01 * unit, 5e-324),
        clip_end=min(1000 * unit, 1e308),
    )
    depth = rng.uniform(0.5, 8, (3, 4)) * unit
    x, y = 1.5 * half * rng.normal(size=(2, 3, 4)) * (1 if orthographic else depth)
    corners = np.stack((x, y, -depth))
    world = eye[:, None, None] + sum(axes[:, k, None, None] * corners[k] for k in range(3))
    mesh = Mesh(world.transpose(2, 1, 0).reshape(-1, 3), np.arange(12).reshape(4, 3))
    planes = [Plane(0, world[:, 0, 0], rng.normal(size=3))] if rng.integers(2) else []
    return Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), planes, objects=("A",))


def check(scene: Scene) -> int:
    """Hold every pixel against exact arithmetic; returns how many see a triangle."""
    frame = render(scene, Settings("certified"))
    names = list(
        zip(
            frame.instance_index.ravel().tolist(),
            frame.triangle_index.ravel().tolist(),
            strict=True,
        )
    )
    sights = scene_sights(scene)
    assert names == [sight.seen for sight in sights]
    assert np.array_equal(frame.t.ravel(), [sight.rounded_t for sight in sights])
    on_mesh = [k for k, name in enumerate(names) if name[0] == 0]
    if on_mesh:
        rays = camera_rays(scene.camera, *film_positions(scene.camera.region, 0.0, 0.0))
        shape = 3, len(names)
        rays = [np.broadcast_to(v, shape)[:, on_mesh] for v in (rays.origins, rays.directions)]
        corners = world_corners(scene, *np.array([names[k] for k in on_mesh]).T)
        found = frame.barycentrics.reshape(-1, 3)[on_mesh].T
        assert np.isfinite(found).all()
        apart, allowed = error_of(found, *rays, corners=corners)
        assert (apart <= allowed).all(), max(apart.ravel() / allowed.ravel())
    return len(on_mesh)


def error_of(found, origins, directions, corners):
    """Return how far barycentrics (3, n) are off, and how far the edge functions' bounds allow."""
    exact, total = barycentrics(origins, directions, corners)
    apart = np.abs(rational(found) - exact)
    o, d, c = rational(origins), rational(directions), rational(corners)
    sums = []
    for k in range(3):
        (ax, ay, az), (bx, by, bz) = np.abs(c[k] - o), np.abs(c[k - 2] - c[k])
        terms = ay * bz + az * by, az * bx + ax * bz, ax * by + ay * bx
        sums.append(sum(np.abs(d) * np.stack(terms)))
    return apart, 5 * 12 * U * np.max(sums, axis=0) / np.abs(total) + U


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("sign", [-1, 1])
def test_every_pixel_is_right_or_the_scene_is_refused(make, orthographic, sign):
    seen = refused = 0
    for seed, end in enumerate(ENDS * 2):
        rng = np.random.default_rng(seed)
        of_window = seed >= len(ENDS) and not orthographic  # else of the lengths
        lengths, window = (0, sign * end) if of_window else (sign * end, 0)
        try:
            seen += check(scene_at(make, rng, lengths, window, orthographic))
        except SceneError as error:
            assert end >= 1015 and "\n" not in str(error), error
            refused += 1
    assert seen > 150 and refused <= 6


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("half", [5e-324, 2.0**-1060, 2.0**-1022])
def test_a_window_too_small_to_divide_is_refused(make, orthographic, half):
    with pytest.raises(SceneError, match=r"Camera 'Camera' has pixels of .*: enlarge its sensor"):
        make.camera(window=ViewWindow(-half, half, -half, half), orthographic=orthographic)


@pytest.mark.parametrize("size, wrong", [(1e200, "are too long"), (1e-200, "lie in a plane")])
def test_axes_that_have_no_inverse_are_refused(make, size, wrong):
    with pytest.raises(SceneError, match=f"The axes of camera 'Camera' {wrong}: clear its scale"):
        make.camera(axes=np.eye(3) * size)


@pytest.mark.parametrize("ends", [(511, 511), (-537, -537), (-700, -700), (400, 700)])
def test_a_panorama_of_what_is_so_far_away(ends):
    """Where the squares of lengths leave float64, cones round triangles are as wide."""
    seen = 0
    for seed in range(4):
        rng = np.random.default_rng(seed)
        corners = rng.normal(size=(24, 3)) * 2.0 ** rng.uniform(*ends, (24, 1))
        mesh = Mesh(corners, np.arange(24).reshape(8, 3))
        window = ViewWindow(-3, 3, -1.5, 1.5)
        camera = Camera(np.eye(4), window, 8, 4, EQUIRECTANGULAR, 2.0 ** (ends[0] - 20), 1e308)
        scene = Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), objects=("A",))
        seen += held(scene, plain)[1]
    assert seen > 60


def test_a_panorama_from_next_to_a_triangle_around_the_eye():
    """The corners' directions cancel, but for 2^-537: the square of that has no digit left."""
    y = 0.714 * 2.0**-536 / 3
    corners = [(2, y, 0), (-1, y, np.sqrt(3)), (-1, y, -np.sqrt(3))]
    camera = Camera(np.eye(4), ViewWindow(-3, 3, -1.5, 1.5), 8, 8, EQUIRECTANGULAR, 1e-200, 1e300)
    scene = Scene(
        camera, (Mesh(corners, [[0, 1, 2]]),), (Instance(0, 0, np.eye(4)),), objects=("A",)
    )
    assert held(scene, plain)[1] == 32  # all that is above


def test_instances_of_a_few_units_of_the_least_float():
    """Corners of their boxes are projected with errors as large as they are."""
    seen = 0
    for seed in range(60, 70):
        rng = np.random.default_rng(seed)
        matrix = np.eye(4)
        matrix[:3, :3] = axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        x, y = (int(v) for v in rng.integers(0, 14, 2))
        meshes = []
        for _ in range(12):
            depth = rng.uniform(1, 6, 3)
            along = rng.uniform(-0.7, 0.7, (2, 1)) * depth + 0.7 * rng.normal(size=(2, 3))
            corners = np.round(axes @ (*along, -depth)).T * 5e-324
            meshes.append(Mesh(corners, [[0, 1, 2]]))
        region = Region(x, y, x + 2, y + 2)
        window = ViewWindow(-0.6, 0.6, -0.6, 0.6)
        camera = Camera(matrix, window, 16, 16, PERSPECTIVE, 5e-324, 1e300, region)
        instances = [Instance(k, 0, np.eye(4)) for k in range(12)]
        seen += held(Scene(camera, meshes, instances, objects=("A",)), sweep)[1]
    assert seen > 5


# Sheared axes whose inverse has elements of 8: sums of products overflow where the sums do not.
SHEARED = (
    np.array([[1, -1, 0], [1, 1, 2], [1, 1, -1]]).T
    / np.sqrt([2, 6, 3])
    @ (
        (1.9, 0, 0.5),
        (0, 1.9, 0),
        (0, 0, 0.07),
    )
)


@pytest.mark.parametrize("orthographic, half, seed", [(False, 0.5, 4), (True, 5e307, 6)])
@pytest.mark.parametrize("plane", [False, True])
def test_a_depth_that_overflows_in_its_first_terms(make, orthographic, half, seed, plane):
    """Of a triangle before the clip end, or before a plane."""
    rng = np.random.default_rng(seed)
    camera = make.camera(
        12,
        12,
        window=ViewWindow(-half, half, -half, half),
        axes=SHEARED * (1, 1, -1),
        orthographic=orthographic,
        clip_start=1.0,
        clip_end=np.inf if plane else 1.79e308,
    )
    spread = 0.5 * rng.normal(size=(3, 1)) * (1, -1, 0) + 0.2 * rng.normal(size=(3, 3))
    scene = make.scene(camera, Mesh(1.3e307 * (1 + spread), [[0, 1, 2]]))
    behind = np.array((1, 1, -1)) / np.sqrt(3)
    if plane:
        scene = replace(scene, planes=(Plane(0, 1.1e307 * behind, behind * 2.0**-300),))
    assert held(scene, sweep)[1] == (144 if plane else 1)
