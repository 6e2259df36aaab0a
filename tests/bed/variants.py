"""The scene as another reader may have it: what only the file knows, whichever fault is looked for.

Cameras and objects are changed in the description, and exported as the right ones are. A variant is
given for every camera, frame, level, shape, hidden object and matrix that the scene has, most of
them wrong for any one picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from reference_tracer.causes.case import Case, Variant
from reference_tracer.scene import Scene, ViewWindow

from .bridge import camera_of, scene_of
from .description import Description, Item, Lens, Shape

FRAMES = (-3, -2, -1, -0.5, 0.5, 1, 2, 3)
Found = tuple[str, str, str, Scene]  # the fault's key, the object, in words, the scene


def variants_of(scene: Description) -> tuple[Found, ...]:
    """Return all variants of a scene."""
    return (*_cameras(scene), *_frames(scene), *_objects(scene), *_together(scene))


def with_variants(case: Case, scene: Description) -> Case:
    """Return the case with all variants of its scene, made once they are asked for."""

    def made() -> tuple[Variant, ...]:
        return tuple(
            Variant(key, other, text, name) for key, name, text, other in variants_of(scene)
        )

    return replace(case, variants=made)


def _cameras(scene: Description) -> Iterator[Found]:
    right = scene_of(scene)
    pose, lens, film = scene.eye, scene.lens, scene.film
    own = pose.world(scene.frame)
    for name, other, where in scene.others:
        camera = camera_of(other, film, where.world(scene.frame), name)
        yield "other_camera", name, f"through camera '{name}'", right.seen_by(camera)
    if pose.parent is not None:
        camera = camera_of(lens, film, pose.basis(scene.frame))
        yield "parent_left_out", "Camera", "without its parent", right.seen_by(camera)
    camera = right.camera
    x, y, z = np.linalg.norm(own[:3, :3], axis=0)
    if not np.allclose((x, y, z), 1):
        # Rays that are x and y times as far aside, z times as deep: a window of another shape.
        w = camera.window
        window = ViewWindow(w.left * x / z, w.right * x / z, w.bottom * y / z, w.top * y / z)
        ends = {"clip_start": z * camera.clip_start, "clip_end": z * camera.clip_end}
        scaled = replace(camera, window=window, **ends)
        yield "camera_scale", "Camera", "with its object's scale", right.seen_by(scaled)
    for key, text, changed in _lenses(lens):
        through = camera_of(changed, film, own)
        yield key, "Camera", text, right.seen_by(through)


def _lenses(lens: Lens) -> Iterator[tuple[str, str, Lens]]:
    """Yield other readings of a lens."""
    if lens.parallel:
        yield "camera_type", "in perspective", replace(lens, parallel=False)
    if lens.fit == "VERTICAL":
        wide = replace(lens, sensor_height=lens.sensor_width)
        yield "sensor_width_for_height", "with the sensor's width for its height", wide
        yield "sensor_fit_setting", "fitted to the width", replace(lens, fit="HORIZONTAL")


def _frames(scene: Description) -> Iterator[Found]:
    if any(item.pose.moves for item in scene.items) or scene.eye.moves:
        for by in FRAMES:
            then = scene_of(scene, scene.frame + by)
            yield "other_frame", "what is animated", f"frame {scene.frame + by:g}", then


def _objects(scene: Description) -> Iterator[Found]:
    for item in scene.items:
        for key, text, other in _readings(item):
            yield key, item.name, text, scene_of(_with(scene, other))


def _readings(item: Item) -> Iterator[tuple[str, str, Item]]:
    """Yield an item as another reader may have it."""
    if item.hidden:
        yield "hidden_shown", "hidden in renders", replace(item, hidden=False)
    if item.other_layer:
        yield "other_layer", "of another view layer", replace(item, other_layer=False)
    shapes: tuple[tuple[str, str, Shape | None], ...] = (
        ("rest_pose", "at its rest pose", item.rest),
        ("viewport_modifiers", "with the viewport's modifiers", item.viewport),
        ("no_modifiers", "without its modifiers", item.plain),
        *(
            ("subdivision", f"at level {n}, not {item.level}", other)
            for n, other in enumerate(item.levels)
            if n != item.level
        ),
    )
    for key, text, other in shapes:
        if other is not None:
            yield key, text, replace(item, shape=other)
    if item.pose.parent_inverse is not None:
        pose = replace(item.pose, parent_inverse=None)
        yield "parent_inverse", "without its parent's inverse", replace(item, pose=pose)


def _together(scene: Description) -> Iterator[Found]:
    """Yield what changes several objects."""
    inside = [i for i in scene.items if i.pose.instancer is not None]
    if inside:
        free = [replace(i, pose=replace(i.pose, instancer=None)) for i in inside]
        names = ", ".join(i.name for i in inside)
        text = "without the instance's transform"
        yield "instance_transform", names, text, scene_of(_with(scene, *free))


def _with(scene: Description, *items: Item) -> Description:
    """Return the scene with items in place of those of their names."""
    others = {item.name: item for item in items}
    return replace(scene, items=tuple(others.get(i.name, i) for i in scene.items))
