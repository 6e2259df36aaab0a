"""The bounds of the two roundings before the proof hold."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from reference_tracer.certified.rounding import rounding
from reference_tracer.scene import Camera, Scene
from reference_tracer.tracer.camera import camera_rays, dual_axes, film_positions, pixel_size
from reference_tracer.tracer.ties import Name
from reference_tracer.tracer.world import world_corners

from ..tracer.hostile_scenes import hostile_scene


def camera_ray(camera: Camera, pixel: int) -> tuple[list[Fraction], list[Fraction]]:
    """Return origin and direction of a region's ray, as the camera has it, without rounding."""
    y, x = divmod(pixel, camera.region.width)
    w = {name: Fraction(value) for name, value in vars(camera.window).items()}
    u = (
        w["left"]
        + (w["right"] - w["left"]) * Fraction(2 * (x + camera.region.x0) + 1, 2) / camera.width
    )
    v = (
        w["bottom"]
        + (w["top"] - w["bottom"]) * Fraction(2 * (y + camera.region.y0) + 1, 2) / camera.height
    )
    right, up, back, eye = (
        [Fraction(c) for c in column] for column in camera.world_from_camera.T[:, :3].tolist()
    )
    aside = [u * a + v * b for a, b in zip(right, up, strict=True)]
    if camera.projection.shares_direction:
        return [e + a for e, a in zip(eye, aside, strict=True)], [-b for b in back]
    return eye, [a - b for a, b in zip(aside, back, strict=True)]


def placed(scene: Scene, name: Name) -> list[list[Fraction]]:
    """Return where a triangle's corners are, without rounding."""
    instance = scene.instances[name[0]]
    mesh = scene.meshes[instance.mesh]
    rows = [[Fraction(x) for x in row] for row in instance.world_from_object[:3].tolist()]
    vertices = mesh.vertices[mesh.triangles[name[1]]].astype(np.float64).tolist()
    local = [[Fraction(x) for x in v] + [1] for v in vertices]
    return [[sum(a * b for a, b in zip(row, v, strict=True)) for row in rows] for v in local]


def test_bounds_hold(make, rng):
    """Of rays and of corners, and they are not a hundred times what is needed, at their best."""
    shares = []
    for seed in range(60):
        scene = hostile_scene(make, np.random.default_rng(seed), finite=True)
        off, camera = rounding(scene), scene.camera
        rays = camera_rays(camera, *film_positions(camera.region))
        count = camera.region.width * camera.region.height
        origins, directions = (
            np.broadcast_to(v, (3, count)) for v in (rays.origins, rays.directions)
        )
        worst = [Fraction(0)] * 3
        dual = [[Fraction(x) for x in row] for row in dual_axes(camera)[:2].tolist()]
        for pixel in rng.integers(0, count, 8).tolist():
            own, exact = (origins, directions), camera_ray(camera, pixel)
            apart = [
                [Fraction(float(x)) - y for x, y in zip(v[:, pixel], w, strict=True)]
                for v, w in zip(own, exact, strict=True)
            ]
            apart = apart[0] if camera.projection.shares_direction else apart[1]
            worst[0] = max(worst[0], sum(map(abs, apart)))
            for d, size in zip(dual, pixel_size(camera), strict=True):
                moved = sum(a * b for a, b in zip(d, apart, strict=True)) / Fraction(size)
                worst[2] = max(worst[2], abs(moved))
        for i, instance in enumerate(scene.instances):
            for t in range(min(2, len(scene.meshes[instance.mesh].triangles))):
                stored = world_corners(scene, np.array([i]), np.array([t]))[..., 0].tolist()
                for v, w in zip(stored, placed(scene, (i, t)), strict=True):
                    apart = sum(abs(Fraction(a) - b) for a, b in zip(v, w, strict=True))
                    worst[1] = max(worst[1], apart)
        for found, bound in zip(worst, off, strict=True):
            assert found <= Fraction(bound)
            shares.append(float(found / Fraction(bound)))
    assert np.max(np.reshape(shares, (-1, 3)), axis=0).min() > 0.01
