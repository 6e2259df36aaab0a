"""Faults made on purpose: what a mistaken exporter, camera or reader would have made.

A fault takes a right comparison and returns the same with one thing wrong, or None where there is
nothing to get wrong. A mistake in the scene is also made in the alternatives, as all are exported
alike.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import Array, Bools
from ..scene import Camera, Instance, Mesh, Scene, ViewWindow
from ..tracer.camera import pixel_size
from ..tracer.frame import Frame
from .case import Case

Change = Callable[[Array], Array]

_BGRA = [2, 1, 0, 3]


@dataclass(frozen=True)
class Fault:
    """A fault of the self-check."""

    name: str  # in JSON
    text: str  # what is wrong, in words
    make: Callable[[Case, Frame], Case | None]  # takes the case and what was traced of its scene


def _with_camera(case: Case, camera: Camera) -> Case:
    return case.with_scenes(lambda scene: replace(scene, camera=camera))


def _window(case: Case, scale: float, x: float = 0.0, y: float = 0.0) -> Case:
    """Scale the view window, and move it by (x, y) of its own units."""
    camera = case.scene.camera
    w = camera.window
    window = ViewWindow(
        scale * w.left + x, scale * w.right + x, scale * w.bottom + y, scale * w.top + y
    )
    return _with_camera(case, replace(camera, window=window))


def _off(x: float, y: float, case: Case, _: Frame) -> Case:
    """Move the view window by pixels."""
    width, height = pixel_size(case.scene.camera)
    return _window(case, 1.0, x * width, y * height)


def _sensor_fit(case: Case, _: Frame) -> Case | None:
    if not case.scene.camera.projection.is_linear:  # a panorama has no sensor to fit
        return None
    w = case.scene.camera.window
    return _window(case, (w.right - w.left) / (w.top - w.bottom))


def _axes(change: Change, case: Case, _: Frame) -> Case:
    """Change the axes of the camera, the columns of a (3, 3) matrix."""
    camera = case.scene.camera
    matrix = camera.world_from_camera.copy()
    matrix[:3, :3] = change(matrix[:3, :3])
    return _with_camera(case, replace(camera, world_from_camera=matrix))


def _clip_start(case: Case, frame: Frame) -> Case | None:
    """Clip halfway between the nearest and the farthest surface that is seen."""
    t = frame.t[np.isfinite(frame.t)]
    if not len(t) or np.ptp(t) == 0:
        return None
    start = float(np.min(t) + np.max(t)) / 2
    return _with_camera(case, replace(case.scene.camera, clip_start=start))


def _flipped_winding(case: Case, _: Frame) -> Case:
    every, backwards = slice(None), slice(None, None, -1)

    def flipped(scene: Scene) -> Scene:
        meshes = tuple(_with_triangles(m, every, backwards) for m in scene.meshes)
        return replace(scene, meshes=meshes)

    return case.with_scenes(flipped)


def _with_triangles(mesh: Mesh, left: Bools | slice, corners: slice = slice(None)) -> Mesh:
    """Return the mesh of some of the triangles, with their corners in some order."""
    colors = None if mesh.corner_colors is None else mesh.corner_colors[left][:, corners]
    triangles = mesh.triangles[left][:, corners]
    return replace(mesh, triangles=triangles, slots=mesh.slots[left], corner_colors=colors)


def _seen(case: Case, frame: Frame) -> list[int]:
    """Return the instances of meshes that are seen, those of the most pixels first."""
    index = frame.instance_index
    index = index[(index >= 0) & (index < len(case.scene.instances))]
    found, count = np.unique(index, return_counts=True)
    return [int(i) for i in found[np.argsort(-count, kind="stable")]]


def _in(other: Scene, scene: Scene, number: int) -> int | None:
    """Return which instance of another export is the scene's: its object's first, second, ..."""
    *before, name = (scene.objects[i.object] for i in scene.instances[: number + 1])
    there = [n for n, i in enumerate(other.instances) if other.objects[i.object] == name]
    rank = before.count(name)
    return there[rank] if rank < len(there) else None


def _instance(case: Case, number: int, change: Callable[[Instance], Instance | None]) -> Case:
    """Change an instance, or drop it, in every scene that has it."""

    def changed(scene: Scene) -> Scene:
        own = _in(scene, case.scene, number)
        if own is None:
            return scene
        instances = list(scene.instances)
        made = change(instances[own])
        instances[own : own + 1] = [] if made is None else [made]
        return replace(scene, instances=tuple(instances))

    return case.with_scenes(changed)


def _dropped_instance(case: Case, frame: Frame) -> Case | None:
    seen = _seen(case, frame)
    if not seen:
        return None
    wrong = _instance(case, seen[0], lambda _: None)
    owners = case.picture.owners
    if owners is None:
        return wrong
    return replace(wrong, picture=replace(case.picture, owners=np.delete(owners, seen[0])))


def _dropped_triangle(case: Case, frame: Frame) -> Case | None:
    if not _seen(case, frame):
        return None
    names = np.stack((frame.instance_index, frame.triangle_index), axis=-1)
    found, count = np.unique(names[frame.triangle_index >= 0], axis=0, return_counts=True)
    instance, triangle = (int(n) for n in found[np.argmax(count)])

    def less(scene: Scene) -> Scene:
        own = _in(scene, case.scene, instance)
        if own is None:
            return scene
        meshes = list(scene.meshes)
        number = scene.instances[own].mesh
        left = np.arange(len(meshes[number].triangles)) != triangle
        meshes[number] = _with_triangles(meshes[number], left)
        return replace(scene, meshes=tuple(meshes))

    return case.with_scenes(less)


def _moved_object(case: Case, frame: Frame) -> Case | None:
    """Move the instance that is seen in the most pixels by a pixel of them, to the right."""
    seen = _seen(case, frame)
    if not seen:
        return None
    camera = case.scene.camera
    depth = float(np.median(frame.t[frame.instance_index == seen[0]]))
    length = pixel_size(camera)[0] * camera.projection.scale(depth)

    def moved(instance: Instance) -> Instance:
        matrix = instance.world_from_object.copy()
        matrix[:3, 3] += length * camera.right
        return replace(instance, world_from_object=matrix)

    return _instance(case, seen[0], moved)


def _of_one_color(case: Case, frame: Frame) -> list[int]:
    """Return the instances that are seen without colours of their corners."""
    scene = case.scene
    meshes = {n: scene.meshes[scene.instances[n].mesh] for n in _seen(case, frame)}
    return [n for n, mesh in meshes.items() if mesh.corner_colors is None]


def _in_colors(case: Case, number: int, colors: Array) -> Case:
    return _instance(case, number, lambda instance: replace(instance, colors=colors))


def _swapped_colors(case: Case, frame: Frame) -> Case | None:
    """Give the largest object and another one each other's colours."""
    instances = case.scene.instances
    first, *others = _of_one_color(case, frame) or [0]
    for second in others:
        own, other = instances[first].colors, instances[second].colors
        if not np.array_equal(own, other):
            return _in_colors(_in_colors(case, first, other), second, own)
    return None


def _recolored(change: Change, case: Case, frame: Frame) -> Case | None:
    """Change the colours of the largest object whose colours that changes."""
    for number in _of_one_color(case, frame):
        colors = case.scene.instances[number].colors
        if not np.allclose(change(colors), colors):
            return _in_colors(case, number, change(colors))
    return None


def _wrong_frame(case: Case, _: Frame) -> Case | None:
    if case.next_frame is None:
        return None
    wrong = replace(case, scene=case.next_frame)
    if len(wrong.scene.instances) == len(case.scene.instances):
        return wrong
    # Which of the objects is which instance is not known.
    return replace(wrong, picture=replace(case.picture, owner=None, owners=None))


def _moved_rows(change: Change, case: Case, _: Frame) -> Case:
    """Change the order of the picture's rows."""
    rows = change(np.arange(len(case.picture.color)))
    return replace(case, picture=case.picture.at(rows))


def _recolored_picture(change: Change, case: Case, _: Frame) -> Case:
    """Change the picture's colours, and those beneath what draws itself."""
    picture = case.picture
    beneath = None if picture.beneath is None else change(picture.beneath)
    return replace(case, picture=replace(picture, color=change(picture.color), beneath=beneath))


def _gamma(color: Array) -> Array:
    color = color.copy()
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


# In the order in which a self-check makes them.
FAULTS = (
    Fault("half_pixel", "rays through the pixels' corners", partial(_off, 0.5, 0.5)),
    Fault("one_pixel", "the camera off by a pixel to the right", partial(_off, 1.0, 0.0)),
    Fault(
        "mirrored_x",
        "the camera mirrored left to right",
        partial(_axes, lambda axes: axes * (-1, 1, 1)),
    ),
    Fault(
        "mirrored_y",
        "the camera mirrored upside down",
        partial(_axes, lambda axes: axes * (1, -1, 1)),
    ),
    Fault("sensor_fit", "the lens fitted to the picture's other side", _sensor_fit),
    Fault("camera_transposed", "the camera's rotation inverted", partial(_axes, np.transpose)),
    Fault("clip_start", "the clip start halfway into the scene", _clip_start),
    Fault("flipped_winding", "all normals turned over", _flipped_winding),
    Fault("dropped_instance", "the largest object left out", _dropped_instance),
    Fault("dropped_triangle", "the largest triangle left out", _dropped_triangle),
    Fault("moved_object", "the largest object moved by a pixel", _moved_object),
    Fault("swapped_colors", "two objects with one another's colours", _swapped_colors),
    Fault(
        "one_shade",
        "one object half as bright",
        partial(_recolored, lambda colors: colors * (0.5, 0.5, 0.5, 1)),
    ),
    Fault(
        "one_channels",
        "one object's red and blue swapped",
        partial(_recolored, lambda colors: colors[:, _BGRA]),
    ),
    Fault("wrong_frame", "the scene a frame later", _wrong_frame),
    Fault(
        "border",
        "the border off by one row",
        partial(_moved_rows, lambda rows: np.roll(rows, 1)),
    ),
    Fault("rows", "the picture's rows from top to bottom", partial(_moved_rows, np.flip)),
    Fault(
        "channels",
        "red and blue swapped",
        partial(_recolored_picture, lambda color: color[..., _BGRA]),
    ),
    Fault("gamma", "a gamma of 2.2 applied to the picture", partial(_recolored_picture, _gamma)),
)
