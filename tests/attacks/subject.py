"""What is attacked: a right comparison; and what an attack makes of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from reference_tracer.causes.case import Case
from reference_tracer.causes.cause import Cause
from reference_tracer.causes.checks.unmodelled import covered
from reference_tracer.pictures.identity import NOTHING
from reference_tracer.pictures.metrics import boundary
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import difference, differing
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Plane, Scene, ViewWindow
from reference_tracer.tracer.camera import pixel_size
from reference_tracer.tracer.frame import Frame


@dataclass(frozen=True, eq=False)
class Subject:
    """What is attacked: a right comparison, and what was traced of it.

    `decidable` (h, w) are the pixels of which Blender's float32 lets something be said.
    """

    case: Case
    frame: Frame
    decidable: NDArray[np.bool_]

    @property
    def scene(self) -> Scene:
        return self.case.scene

    @property
    def picture(self) -> Picture:
        return self.case.picture

    @property
    def owner(self) -> NDArray | None:
        """Whose surface each pixel of the picture shows, (h, w), if that is known."""
        return owner_of(self.picture)

    @cached_property
    def of_instance(self) -> NDArray[np.intp]:
        """Which object each instance is of, then each plane; NOTHING at the end."""
        surfaces: list[Instance | Plane] = [*self.scene.instances, *self.scene.planes]
        return np.array([*(s.object for s in surfaces), NOTHING])

    @cached_property
    def object(self) -> NDArray[np.intp]:
        """Which object each pixel shows, (h, w)."""
        return self.of_instance[self.frame.instance_index]

    @cached_property
    def seen(self) -> list[int]:
        """The objects that are seen where it can be decided, those of the most pixels first."""
        there = self.object[self.decidable & (self.object >= 0)]
        found, count = np.unique(there, return_counts=True)
        return [int(n) for n in found[np.argsort(-count, kind="stable")]]

    @cached_property
    def inside(self) -> NDArray[np.bool_]:
        """Pixels away from edges, of which something can be said."""
        return self.decidable & ~boundary(self.frame)

    @cached_property
    def reaches(self) -> list[tuple[NDArray, NDArray, NDArray[np.bool_]]]:
        """The least and most of each object's colours, and which pixels its box comes near to."""
        out, scene = [], self.scene
        for number in range(len(scene.objects)):
            points, colors = [], [p.color for p in scene.planes if p.object == number]
            everywhere = bool(colors)
            for own in (i for i in scene.instances if i.object == number):
                mesh = scene.meshes[own.mesh]
                box = np.array(np.meshgrid(*mesh.bounds.T)).reshape(3, 8)
                points.append(own.world_from_object[:3, :3] @ box + own.world_from_object[:3, 3:])
                shown = own.colors if mesh.corner_colors is None else mesh.corner_colors
                colors.extend(shown.reshape(-1, 4))
            if not colors:
                continue
            near = np.ones(self.object.shape, bool)
            if not everywhere:
                ends = [end(np.hstack(points), axis=1) for end in (np.min, np.max)]
                near = np.pad(covered(scene.camera, np.array(ends)), 3)
                near = np.lib.stride_tricks.sliding_window_view(near, (7, 7)).any(axis=(-2, -1))
            out.append((np.min(colors, axis=0), np.max(colors, axis=0), near))
        return out

    def name(self, number: int) -> str:
        return self.scene.objects[number]


def owner_of(picture: Picture) -> NDArray | None:
    """Return whose surface each pixel of a picture shows, (h, w), if that is known."""
    return picture.owners and picture.owners.pixels


def in_place(picture: Picture, color: NDArray, owner: NDArray | None) -> Picture:
    """Return a picture with other colours, and other owners in its pixels."""
    owners = picture.owners and replace(picture.owners, pixels=owner)
    return replace(picture, color=color, owners=owners)


class Attacked(NamedTuple):
    """A wrong case, the frame that was traced of its scene, and which pixels (h, w) are wrong."""

    case: Case
    frame: Frame
    changed: NDArray[np.bool_]
    object: str = ""  # whose colour was changed, if it was one object's


Make = Callable[[Subject], Attacked | None]


class Attack(NamedTuple):
    """An attack, the cause that it imitates, and what it does, for the documents."""

    name: str
    imitates: Cause
    text: str
    make: Make


def near_edges(scene: Scene, frame: Frame, band: float) -> NDArray[np.bool_]:
    """Return where the scene traced a `band` of pixels beside shows another colour or object.

    So says the tracer's own picture, without any check.
    """
    out, w = np.zeros(frame.t.shape, bool), scene.camera.window
    width, height = (band * size for size in pixel_size(scene.camera))
    for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        dx, dy = x * width, y * height
        window = ViewWindow(w.left + dx, w.right + dx, w.bottom + dy, w.top + dy)
        beside = render(replace(scene, camera=replace(scene.camera, window=window)))
        out |= differing(beside.color, frame.color, interpolated=True)
        out |= beside.instance_index != frame.instance_index
    return out


def alone(case: Case) -> Case:
    """Return a case of colours alone, as a foreign picture is compared."""
    picture = replace(case.picture, owners=None)
    return replace(case, picture=picture, curves=())


def changes(right: Picture, wrong: Picture) -> NDArray[np.bool_]:
    """Return which pixels (h, w) differ in colour, clearly, or in whose surface is shown."""
    apart, allowed = difference(right.color, wrong.color, interpolated=True)
    changed = (apart > 2 * allowed).any(axis=-1)
    if right.owners is None or wrong.owners is None:
        return changed
    other = right.owners.pixels != wrong.owners.pixels
    return changed | (other & right.owners.known & wrong.owners.known)


def damaged(subject: Subject, color: NDArray, owner: NDArray | None = None, **known) -> Attacked:
    """Return the attack by a picture: its colours, and whose surfaces it shows if these move."""
    right = subject.picture
    owner = subject.owner if owner is None else owner
    owner = None if subject.owner is None else np.ascontiguousarray(owner, np.int32)
    wrong = in_place(right, np.ascontiguousarray(color, np.float32), owner)
    case = replace(subject.case, picture=wrong, **known)
    return Attacked(case, subject.frame, changes(right, wrong) & subject.decidable)


def owners_of(subject: Subject, frame: Frame, instances: NDArray | None = None) -> NDArray | None:
    """Return whose surfaces a frame of another scene shows; `instances` are its own in the right
    scene."""
    owners, index = subject.picture.owners, frame.instance_index
    if owners is None:
        return None
    return owners.instances[index if instances is None else instances[index]]


def painted(
    subject: Subject, frame: Frame, instances: NDArray | None = None, where: NDArray | bool = True
) -> Attacked:
    """Return the attack by another frame, pasted over Blender's picture where the two differ."""
    right, owner = subject.picture, owners_of(subject, frame, instances)
    other = (frame.color != subject.frame.color).any(axis=-1)
    if owner is not None:
        other |= owner != right.owners.instances[subject.frame.instance_index]
    other = other & where
    color = np.where(other[..., None], frame.color, right.color)
    return damaged(subject, color, None if owner is None else np.where(other, owner, subject.owner))


def neighbours(values: NDArray, step: int, axis: int) -> NDArray:
    """Return what is `step` pixels before along an axis; at the rim, the rim itself."""
    size = values.shape[axis]
    return values.take(np.clip(np.arange(size) - step, 0, size - 1), axis)
