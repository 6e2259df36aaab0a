"""Attacks that show surfaces in wrong places, or none where one is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from reference_tracer.pictures.identity import NOTHING
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Scene
from reference_tracer.tracer.camera import pixel_size
from reference_tracer.tracer.frame import Frame

from .subject import Attacked, Make, Subject, in_place, owners_of, painted


def without(subject: Subject, gone: NDArray[np.bool_]) -> tuple[Frame, NDArray]:
    """Trace the scene without some instances; return the frame, and its instances' right numbers.

    `gone` is of instances, then planes.
    """
    scene, count = subject.scene, len(subject.scene.instances)
    instances = tuple(i for i, out in zip(scene.instances, gone, strict=False) if not out)
    planes = tuple(p for p, out in zip(scene.planes, gone[count:], strict=True) if not out)
    frame = render(replace(scene, instances=instances, planes=planes), subject.case.settings)
    return frame, np.append(np.flatnonzero(~gone), NOTHING)


def without_object(subject: Subject, number: int) -> tuple[Frame, NDArray]:
    return without(subject, subject.of_instance[:-1] == number)


def object_moved(pixels: int) -> Make:
    """Move the object of the most pixels to the right."""

    def make(subject: Subject) -> Attacked | None:
        scene = subject.scene
        own = [n for n in subject.seen if any(i.object == n for i in scene.instances)]
        if not own:
            return None
        camera, t = scene.camera, subject.frame.t[subject.object == own[0]]
        length = pixels * pixel_size(camera)[0] * camera.projection.scale(float(np.median(t)))

        def moved(instance):
            if instance.object != own[0]:
                return instance
            matrix = instance.world_from_object.copy()
            matrix[:3, 3] += length * camera.right
            return replace(instance, world_from_object=matrix)

        wrong = replace(scene, instances=tuple(moved(i) for i in scene.instances))
        return painted(subject, render(wrong, subject.case.settings))

    return make


def dropped_instance(subject: Subject) -> Attacked | None:
    """Leave out the instance that is seen in the most pixels."""
    index = subject.frame.instance_index[subject.decidable]
    index = index[index >= 0]
    if not len(index):
        return None
    gone = np.arange(len(subject.of_instance) - 1) == np.bincount(index).argmax()
    return painted(subject, *without(subject, gone))


def swapped_depth(subject: Subject) -> Attacked | None:
    """Show the farther of two objects wherever one hides the other."""
    best, most = None, 0
    for number in subject.seen[:6]:
        frame, instances = without_object(subject, number)
        behind = subject.of_instance[instances[frame.instance_index]]
        both = subject.decidable & (subject.object == number) & (behind >= 0)
        found, count = np.unique(behind[both], return_counts=True)
        if len(found) and count.max() > most:
            best, most = (frame, instances, both & (behind == found[count.argmax()])), count.max()
    return best and painted(subject, best[0], best[1], where=best[2])


def a_frame_off(subject: Subject) -> Attacked | None:
    """Show the scene as a frame later, everything moved by some two pixels.

    Nothing is said of a frame that the picture may be of. Where nothing is animated, one object in
    two goes to the right, and the others up.
    """
    later = subject.case.next_frame
    if later is not None and len(later.instances) == len(subject.scene.instances):
        made = painted(subject, render(later, subject.case.settings))
        if made.changed.any():
            return made
    camera, t = subject.scene.camera, subject.frame.t
    if not np.isfinite(t).any():
        return None
    length = 2 * pixel_size(camera)[0] * camera.projection.scale(float(np.median(t[t < np.inf])))

    def moved(instance: Instance) -> Instance:
        matrix = instance.world_from_object.copy()
        matrix[:3, 3] += length * (camera.up if instance.object % 2 else camera.right)
        return replace(instance, world_from_object=matrix)

    instances = tuple(moved(i) for i in subject.scene.instances)
    return painted(subject, render(replace(subject.scene, instances=instances)))


def clipped(end: bool) -> Make:
    """Cut the scene beside a clip plane that goes through it."""

    def make(subject: Subject) -> Attacked | None:
        t = subject.frame.t[np.isfinite(subject.frame.t) & subject.decidable]
        if not len(t):
            return None
        low, high = (float(v) for v in np.quantile(t, (0.4, 0.6)))
        # At the very depth of a face across the view, float32 would decide of all of it.
        depth = low + 0.4567 * (high - low)
        if high - low < 1e-3 * depth:
            return None
        side, beside = ("clip_end", low) if end else ("clip_start", high)

        def cut(at: float) -> tuple[Scene, Frame]:
            scene = replace(subject.scene, camera=replace(subject.scene.camera, **{side: at}))
            return scene, render(scene, subject.case.settings)

        (scene, frame), (_, wrong) = cut(depth), cut(beside)
        right = in_place(subject.picture, frame.color.copy(), owners_of(subject, frame))
        cased = replace(subject.case, scene=scene, picture=right, certificate=None)
        return painted(replace(subject, case=cased, frame=frame), wrong)

    return make
