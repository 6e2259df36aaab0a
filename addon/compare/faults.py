"""Faults on purpose, one function each: what a mistaken exporter, camera or reader would have made.

In comes a right comparison; out goes the same with one thing wrong, or None where there is nothing
to get wrong. A mistake in the scene is one in all that is exported: the alternatives have it, too.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Instance, Mesh, Scene, ViewWindow
from ..tracer.camera import pixel_size
from ..tracer.frame import Frame
from .case import Case

Change = Callable[[NDArray], NDArray]
Make = Callable[[Case, Frame], Case | None]  # of a comparison's case, and what was traced of it

_BGRA = [2, 1, 0, 3]


def _camera(case: Case, **changes: object) -> Case:
    camera = replace(case.scene.camera, **changes)
    return case.with_scenes(lambda scene: replace(scene, camera=camera))


def _window(case: Case, scale: float = 1.0, dx: float = 0.0, dy: float = 0.0) -> Case:
    """Scale the view window, and move it by some pixels."""
    w, (width, height) = case.scene.camera.window, pixel_size(case.scene.camera)
    x, y = dx * width, dy * height
    left, right, bottom, top = (scale * side for side in (w.left, w.right, w.bottom, w.top))
    return _camera(case, window=ViewWindow(left + x, right + x, bottom + y, top + y))


def _axes(change: Change, case: Case, _: Frame) -> Case:
    """Change the axes of the camera."""
    matrix = case.scene.camera.world_from_camera.copy()
    matrix[:3, :3] = change(matrix[:3, :3])
    return _camera(case, world_from_camera=matrix)


def _picture(change: Change, case: Case, _: Frame, moves: bool = False) -> Case:
    """Change the picture, and whose surfaces it shows where its pixels move."""
    names = ("color", "beneath", "owner", "drawn") if moves else ("color", "beneath")
    held = {name: getattr(case.picture, name) for name in names}
    changed = {n: np.ascontiguousarray(change(v.copy())) for n, v in held.items() if v is not None}
    return replace(case, picture=replace(case.picture, **changed))


def _seen(case: Case, frame: Frame) -> list[int]:
    """Return the instances of meshes that are seen, those of the most pixels first."""
    index = frame.instance_index
    index = index[(index >= 0) & (index < len(case.scene.instances))]
    found, count = np.unique(index, return_counts=True)
    return [int(i) for i in found[np.argsort(-count, kind="stable")]]


def _in(other: Scene, scene: Scene, number: int) -> int | None:
    """Return which instance of another export is a scene's: the same one of its object's."""
    *before, name = (scene.objects[i.object] for i in scene.instances[: number + 1])
    there = [n for n, i in enumerate(other.instances) if other.objects[i.object] == name]
    rank = before.count(name)
    return there[rank] if rank < len(there) else None


def _instance(case: Case, number: int, change: Callable[[Instance], Instance | None]) -> Case:
    """Change an instance, or drop it, wherever it is exported."""

    def changed(scene: Scene) -> Scene:
        own, instances = _in(scene, case.scene, number), list(scene.instances)
        if own is not None:
            instances[own : own + 1] = [i for i in [change(instances[own])] if i is not None]
        return replace(scene, instances=tuple(instances))

    return case.with_scenes(changed)


def sensor_fit(case: Case, _: Frame) -> Case:
    """Fit the lens to the picture's other side."""
    w = case.scene.camera.window
    return _window(case, (w.right - w.left) / (w.top - w.bottom))


def clip_start(case: Case, frame: Frame) -> Case | None:
    """Clip halfway between the nearest and the farthest that is seen."""
    t = frame.t[np.isfinite(frame.t)]
    if not len(t) or t.min() == t.max():
        return None
    return _camera(case, clip_start=float(t.min() + t.max()) / 2)


def flipped_winding(case: Case, _: Frame) -> Case:
    """Turn the normals of all triangles over."""
    every = slice(None), slice(None, None, -1)
    return case.with_scenes(lambda s: replace(s, meshes=tuple(_of(m, *every) for m in s.meshes)))


def _of(mesh: Mesh, kept: NDArray[np.bool_] | slice, corners: slice = slice(None)) -> Mesh:
    """Return a mesh of some of the triangles, their corners in some order."""
    colors = None if mesh.corner_colors is None else mesh.corner_colors[kept][:, corners]
    triangles, slots = mesh.triangles[kept][:, corners], mesh.slots[kept]
    return replace(mesh, triangles=triangles, slots=slots, corner_colors=colors)


def dropped_instance(case: Case, frame: Frame) -> Case | None:
    """Leave out the instance that is seen in the most pixels."""
    if not (seen := _seen(case, frame)):
        return None
    owners = case.picture.owners
    owners = None if owners is None else np.delete(owners, seen[0])
    wrong = _instance(case, seen[0], lambda _: None)
    return replace(wrong, picture=replace(case.picture, owners=owners))


def dropped_triangle(case: Case, frame: Frame) -> Case | None:
    """Leave out the triangle that is seen in the most pixels."""
    if not _seen(case, frame):
        return None
    names = np.stack((frame.instance_index, frame.triangle_index), axis=-1)
    found, count = np.unique(names[frame.triangle_index >= 0], axis=0, return_counts=True)
    instance, triangle = (int(n) for n in found[count.argmax()])

    def less(scene: Scene) -> Scene:
        own, meshes = _in(scene, case.scene, instance), list(scene.meshes)
        if own is not None:
            number = scene.instances[own].mesh
            kept = np.arange(len(meshes[number].triangles)) != triangle
            meshes[number] = _of(meshes[number], kept)
        return replace(scene, meshes=tuple(meshes))

    return case.with_scenes(less)


def moved_object(case: Case, frame: Frame) -> Case | None:
    """Move the instance that is seen in the most pixels by one of them, to the right."""
    if not (seen := _seen(case, frame)):
        return None
    camera, t = case.scene.camera, frame.t[frame.instance_index == seen[0]]
    length = pixel_size(camera)[0] * camera.projection.scale(float(np.median(t)))

    def moved(instance: Instance) -> Instance:
        matrix = instance.world_from_object.copy()
        matrix[:3, 3] += length * camera.right
        return replace(instance, world_from_object=matrix)

    return _instance(case, seen[0], moved)


def swapped_colors(case: Case, frame: Frame) -> Case | None:
    """Give two objects that are seen one another's colours."""
    scene = case.scene
    colors = {n: scene.instances[n].colors for n in _seen(case, frame)}
    plain = [n for n in colors if scene.meshes[scene.instances[n].mesh].corner_colors is None]
    for second in plain[1:]:
        first = plain[0]
        if not np.array_equal(colors[first], colors[second]):
            wrong = _instance(case, first, lambda i, c=colors[second]: replace(i, colors=c))
            return _instance(wrong, second, lambda i, c=colors[first]: replace(i, colors=c))
    return None


def _recolored(change: Change, case: Case, frame: Frame) -> Case | None:
    """Change the colours of the largest object that they change."""
    for number in _seen(case, frame):
        of = case.scene.instances[number]
        plain = case.scene.meshes[of.mesh].corner_colors is None
        if plain and not np.allclose(colors := change(of.colors), of.colors):
            return _instance(case, number, lambda i, c=colors: replace(i, colors=c))
    return None


def wrong_frame(case: Case, _: Frame) -> Case | None:
    """Trace the scene a frame later."""
    if case.next_frame is None:
        return None
    wrong = replace(case, scene=case.next_frame)
    if len(wrong.scene.instances) == len(case.scene.instances):
        return wrong
    return replace(wrong, picture=replace(case.picture, owner=None, owners=None))  # not known


def _gamma(color: NDArray) -> NDArray:
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


class Fault(NamedTuple):
    """A fault's name, what it stands for, and what makes it."""

    name: str
    text: str
    make: Make


_MAKES: dict[str, Make] = {
    "half_pixel": lambda c, _: _window(c, 1, 0.5, 0.5),
    "one_pixel": lambda c, _: _window(c, 1, 1),
    "mirrored_x": partial(_axes, lambda m: m * (-1, 1, 1)),
    "mirrored_y": partial(_axes, lambda m: m * (1, -1, 1)),
    "sensor_fit": sensor_fit,
    "camera_transposed": partial(_axes, np.transpose),
    "clip_start": clip_start,
    "flipped_winding": flipped_winding,
    "dropped_instance": dropped_instance,
    "dropped_triangle": dropped_triangle,
    "moved_object": moved_object,
    "swapped_colors": swapped_colors,
    "one_shade": partial(_recolored, lambda c: c * (0.5, 0.5, 0.5, 1)),
    "one_channels": partial(_recolored, lambda c: c[:, _BGRA]),
    "wrong_frame": wrong_frame,
    "border": partial(_picture, lambda v: np.roll(v, 1, axis=0), moves=True),
    "rows": partial(_picture, np.flipud, moves=True),
    "channels": partial(_picture, lambda v: v[..., _BGRA]),
    "gamma": partial(_picture, _gamma),
}
_TEXTS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
FAULTS = tuple(Fault(name, text, _MAKES[name]) for name, text in _TEXTS.items())
