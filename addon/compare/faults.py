"""Faults on purpose, one function each: what a mistaken exporter, camera or reader would have made.

In comes a right comparison; out goes the scene or the picture with one thing wrong, or None where
there is nothing to get wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..manifest import Unmodelled
from ..scene import Mesh, Scene, ViewWindow
from ..tracer.camera import pixel_size
from ..tracer.frame import Frame
from .shown import Shown


@dataclass(frozen=True, eq=False)
class Case:
    """A comparison as it was: what was traced and shown, and what is known of it."""

    scene: Scene
    frame: Frame
    shown: Shown
    unmodelled: tuple[Unmodelled, ...] = ()
    sample_radius: float = 0.0
    filter_radius: float = 0.0
    next_frame: Scene | None = None

    def seen(self) -> list[int]:
        """Return the instances of meshes that are seen, those of the most pixels first."""
        index = self.frame.instance_index
        index = index[(index >= 0) & (index < len(self.scene.instances))]
        found, count = np.unique(index, return_counts=True)
        return [int(i) for i in found[np.argsort(-count, kind="stable")]]


class Wrong(NamedTuple):
    """What is wrong: the scene, or the picture."""

    scene: Scene
    shown: Shown


Make = Callable[[Case], Wrong | None]


def _camera(case: Case, **changes: object) -> Wrong:
    camera = replace(case.scene.camera, **changes)
    return Wrong(replace(case.scene, camera=camera), case.shown)


def _window(case: Case, scale: float = 1.0, dx: float = 0.0, dy: float = 0.0) -> Wrong:
    """Scale the view window, and move it by some pixels."""
    w, (width, height) = case.scene.camera.window, pixel_size(case.scene.camera)
    x, y = dx * width, dy * height
    left, right, bottom, top = (scale * side for side in (w.left, w.right, w.bottom, w.top))
    return _camera(case, window=ViewWindow(left + x, right + x, bottom + y, top + y))


def _axes(case: Case, change: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Wrong:
    matrix = case.scene.camera.world_from_camera.copy()
    matrix[:3, :3] = change(matrix[:3, :3])
    return _camera(case, world_from_camera=matrix)


def sensor_fit(case: Case) -> Wrong:
    """Fit the lens to the picture's other side."""
    w = case.scene.camera.window
    return _window(case, (w.right - w.left) / (w.top - w.bottom))


def clip_start(case: Case) -> Wrong | None:
    """Clip halfway between the nearest and the farthest that is seen."""
    t = case.frame.t[np.isfinite(case.frame.t)]
    if not len(t) or t.min() == t.max():
        return None
    return _camera(case, clip_start=float(t.min() + t.max()) / 2)


def flipped_winding(case: Case) -> Wrong:
    """Turn the normals of all triangles over."""
    meshes = tuple(
        replace(
            m,
            triangles=m.triangles[:, ::-1],
            corner_colors=None if m.corner_colors is None else m.corner_colors[:, ::-1],
        )
        for m in case.scene.meshes
    )
    return Wrong(replace(case.scene, meshes=meshes), case.shown)


def dropped_instance(case: Case) -> Wrong | None:
    """Leave out the instance that is seen in the most pixels."""
    if not (seen := case.seen()):
        return None
    kept = [i for n, i in enumerate(case.scene.instances) if n != seen[0]]
    owners = case.shown.owners
    owners = None if owners is None else np.delete(owners, seen[0])
    return Wrong(replace(case.scene, instances=tuple(kept)), replace(case.shown, owners=owners))


def dropped_triangle(case: Case) -> Wrong | None:
    """Leave out the triangle that is seen in the most pixels."""
    if not case.seen():
        return None
    frame = case.frame
    names = np.stack((frame.instance_index, frame.triangle_index), axis=-1)[
        frame.triangle_index >= 0
    ]
    found, count = np.unique(names, axis=0, return_counts=True)
    instance, triangle = found[count.argmax()]
    number = case.scene.instances[instance].mesh
    meshes = list(case.scene.meshes)
    meshes[number] = _less(meshes[number], int(triangle))
    return Wrong(replace(case.scene, meshes=tuple(meshes)), case.shown)


def _less(mesh: Mesh, triangle: int) -> Mesh:
    colors = mesh.corner_colors
    return replace(
        mesh,
        triangles=np.delete(mesh.triangles, triangle, axis=0),
        slots=np.delete(mesh.slots, triangle),
        corner_colors=None if colors is None else np.delete(colors, triangle, axis=0),
    )


def moved_object(case: Case) -> Wrong | None:
    """Move the instance that is seen in the most pixels by one of them, to the right."""
    if not (seen := case.seen()):
        return None
    camera, t = case.scene.camera, case.frame.t[case.frame.instance_index == seen[0]]
    length = pixel_size(camera)[0] * camera.projection.scale(float(np.median(t)))
    instances = list(case.scene.instances)
    matrix = instances[seen[0]].world_from_object.copy()
    matrix[:3, 3] += length * camera.right
    instances[seen[0]] = replace(instances[seen[0]], world_from_object=matrix)
    return Wrong(replace(case.scene, instances=tuple(instances)), case.shown)


def swapped_colors(case: Case) -> Wrong | None:
    """Give two objects that are seen one another's colours."""
    instances = list(case.scene.instances)
    plain = [n for n in case.seen() if case.scene.meshes[instances[n].mesh].corner_colors is None]
    for first in plain[:1]:
        for second in plain[1:]:
            a, b = instances[first], instances[second]
            if not np.array_equal(a.colors, b.colors):
                instances[first] = replace(a, colors=b.colors)
                instances[second] = replace(b, colors=a.colors)
                return Wrong(replace(case.scene, instances=tuple(instances)), case.shown)
    return None


def wrong_frame(case: Case) -> Wrong | None:
    """Trace the scene a frame later."""
    if case.next_frame is None or len(case.next_frame.instances) != len(case.scene.instances):
        return None
    return Wrong(case.next_frame, case.shown)


def _picture(case: Case, change: Callable[[NDArray], NDArray]) -> Wrong:
    color = change(case.shown.color.copy())
    return Wrong(case.scene, replace(case.shown, color=np.ascontiguousarray(color)))


def _moved_picture(case: Case, change: Callable[[NDArray], NDArray]) -> Wrong:
    owner = case.shown.owner
    owner = None if owner is None else change(owner)
    wrong = _picture(case, change)
    return Wrong(case.scene, replace(wrong.shown, owner=owner))


def _gamma(color: NDArray) -> NDArray:
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


class Fault(NamedTuple):
    """A fault's name, what it stands for, and what makes it."""

    name: str
    text: str
    make: Make


FAULTS = (
    Fault("half_pixel", "rays through the pixels' corners", lambda c: _window(c, 1, 0.5, 0.5)),
    Fault("one_pixel", "the camera off by a pixel to the right", lambda c: _window(c, 1, 1)),
    Fault(
        "mirrored_x",
        "the camera mirrored left to right",
        lambda c: _axes(c, lambda m: m * (-1, 1, 1)),
    ),
    Fault(
        "mirrored_y",
        "the camera mirrored upside down",
        lambda c: _axes(c, lambda m: m * (1, -1, 1)),
    ),
    Fault("sensor_fit", "the lens fitted to the picture's other side", sensor_fit),
    Fault("camera_transposed", "the camera's rotation inverted", lambda c: _axes(c, np.transpose)),
    Fault("clip_start", "the clip start halfway into the scene", clip_start),
    Fault("flipped_winding", "all normals turned over", flipped_winding),
    Fault("dropped_instance", "the largest object left out", dropped_instance),
    Fault("dropped_triangle", "the largest triangle left out", dropped_triangle),
    Fault("moved_object", "the largest object moved by a pixel", moved_object),
    Fault("swapped_colors", "two objects with one another's colours", swapped_colors),
    Fault("wrong_frame", "the scene a frame later", wrong_frame),
    Fault(
        "border",
        "the border off by one row",
        lambda c: _moved_picture(c, lambda v: np.roll(v, 1, axis=0)),
    ),
    Fault("rows", "the picture's rows from top to bottom", lambda c: _moved_picture(c, np.flipud)),
    Fault(
        "channels", "red and blue swapped", lambda c: _picture(c, lambda v: v[..., [2, 1, 0, 3]])
    ),
    Fault("gamma", "a gamma of 2.2 applied to the picture", lambda c: _picture(c, _gamma)),
)
