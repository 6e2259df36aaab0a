"""What the hard scenes have in common: solids in view, and how a simulation is stepped."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

ORANGE, CYAN, PINK = (0.9, 0.45, 0.05), (0.05, 0.75, 0.8), (0.9, 0.3, 0.6)


def stage(build: Any, **scene: Any) -> Any:
    """Give a small picture with solids on a floor, seen from a corner; returns the scene."""
    out = build.scene(**scene)
    out.frame_end = 60  # also where caches end
    build.solids()
    build.corner_camera(lens=32)
    return out


def step_to(frame: int) -> None:
    """Play the scene from its start, so that what is simulated is simulated."""
    for number in range(1, frame + 1):
        bpy.context.scene.frame_set(number)


def grid(build: Any, name: str, n: int = 10, size: float = 2.0, **place: Any) -> Any:
    """A flat mesh of n x n squares."""
    ticks = np.linspace(-size / 2, size / 2, n + 1)
    vertices = [(x, y, 0.0) for y in ticks for x in ticks]
    faces = [
        (k, k + 1, k + n + 2, k + n + 1)
        for k in (row * (n + 1) + column for row in range(n) for column in range(n))
    ]
    return build.place(build.mesh(name, vertices, faces), **place)


def ball(build: Any, name: str, radius: float = 0.6, **place: Any) -> Any:
    """A sphere of 16 x 8 faces."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=radius)
    obj = bpy.context.object
    obj.name = name
    return build.place(obj, **place)


def colored(build: Any, name: str, rgb: tuple[float, ...], alpha: float = 1.0) -> Any:
    return build.material(name, *rgb, alpha)


def emitter(build: Any, obj: Any, source: Any, count: int = 60) -> Any:
    """Have an object throw copies of another, or of a collection's objects, upwards."""
    obj.modifiers.new("Thrower", "PARTICLE_SYSTEM")
    system = obj.particle_systems[-1]
    settings = system.settings
    settings.count, settings.frame_start, settings.frame_end = count, 1, 12
    settings.lifetime, settings.normal_factor, settings.factor_random = 60, 3.0, 1.0
    if isinstance(source, bpy.types.Collection):
        settings.render_type, settings.instance_collection = "COLLECTION", source
    else:
        settings.render_type, settings.instance_object = "OBJECT", source
    settings.particle_size, settings.size_random = 0.12, 0.3
    return system
