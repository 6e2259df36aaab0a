"""Attacks on the verdict: pictures damaged so that the damage looks like something excusable.

Each attack takes what a comparison has of a scene and returns the case to be explained with the
pixels that were changed. What is changed must come out unexplained, but for the few pixels where
Blender's own rounding decides. `ATTACKS` says which cause each imitates.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from reference_tracer.causes.case import Alternative, Case
from reference_tracer.causes.cause import Cause
from reference_tracer.causes.checks.unmodelled import covered
from reference_tracer.causes.explain import (
    ANTI_ALIASING,
    CAUSES,
    CLIP_PLANE,
    COLOR,
    DEPTH_TIE,
    EDGE,
    HIDDEN,
    NOT_DECIDABLE,
    NOT_MODELLED,
)
from reference_tracer.images import curve
from reference_tracer.manifest import Unmodelled
from reference_tracer.pictures.bounds import difference, differing
from reference_tracer.pictures.identity import NOTHING, UNKNOWN
from reference_tracer.pictures.metrics import boundary
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Plane, Scene, ViewWindow
from reference_tracer.tracer.camera import pixel_size
from reference_tracer.tracer.frame import Frame

BLOCK, BLOCKS = 5, 4  # pixels a side, how many
ROWS = 8  # in which mixes are attacked: a check of one asks for hundreds of samples
FILTER = 1.5  # pixels: the anti-aliasing that an attack claims to have
SEED = 12


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


# The whole picture


def _moved(pixels: int) -> Make:
    def make(subject: Subject) -> Attacked:
        def shift(values: NDArray) -> NDArray:
            pad = [(0, 0), (pixels, 0)] + [(0, 0)] * (values.ndim - 2)
            return np.pad(values, pad, mode="edge")[:, :-pixels]

        return _rearranged(shift)(subject)

    return make


def _rearranged(change: Callable[[NDArray], NDArray]) -> Make:
    def make(subject: Subject) -> Attacked:
        owner = subject.owner
        return damaged(
            subject, change(subject.picture.color), None if owner is None else change(owner)
        )

    return make


def half_pixel(subject: Subject) -> Attacked:
    """Resample the picture half a pixel to the right, bilinearly."""
    color, owner = subject.picture.color, subject.owner
    color = (color + neighbours(color, 1, 1)) / 2
    if owner is not None:
        owner = np.where(owner == neighbours(owner, 1, 1), owner, UNKNOWN)
    return damaged(subject, color, owner)


def noise(subject: Subject) -> Attacked:
    """Random colours, and random objects."""
    rng, right = np.random.default_rng(SEED), subject.picture
    color = rng.uniform(0.01, 0.99, right.color.shape)
    color[..., 3] = 1
    count = len(right.owners.names) if right.owners else 1
    return damaged(subject, color, rng.integers(-1, max(count, 1), color.shape[:2]))


# Colours


def halved(rgb: NDArray) -> NDArray:
    return 0.5 * rgb


def exposed(rgb: NDArray) -> NDArray:
    return 2.0**0.75 * rgb


def gamma(rgb: NDArray) -> NDArray:
    return np.maximum(rgb, 0) ** 1.8


def swapped(rgb: NDArray) -> NDArray:
    return rgb[..., ::-1]


def encoded_twice(rgb: NDArray) -> NDArray:
    return curve(np.clip(rgb, 0, 1))


SHADES = {
    "halved": halved,
    "exposed": exposed,
    "gamma": gamma,
    "swapped": swapped,
    "encoded_twice": encoded_twice,
}


def shaded(color: NDArray, change: Callable[[NDArray], NDArray]) -> NDArray:
    """Return premultiplied colours (..., 4) with their straight RGB changed."""
    alpha = color[..., 3:].astype(np.float64)
    rgb = color[..., :3] / np.where(alpha > 0, alpha, 1)
    return np.concatenate((change(rgb) * alpha, alpha), axis=-1).astype(np.float32)


def target(subject: Subject) -> int | None:
    """Return the object to be recoloured: one of many, and not the largest."""
    return subject.seen[1] if len(subject.seen) > 2 else None


def one_recoloured(change: Callable[[NDArray], NDArray]) -> Make:
    """Show one object of many in another shade; whose surfaces are shown stays."""
    return _recoloured(change, True)


def all_but_one(change: Callable[[NDArray], NDArray]) -> Make:
    """Transform the whole picture, but leave one object out."""
    return _recoloured(change, False)


def _recoloured(change: Callable[[NDArray], NDArray], alone: bool) -> Make:
    """Change the shade of one object of many alone, or of all that it is not."""

    def make(subject: Subject) -> Attacked | None:
        number = target(subject)
        if number is None:
            return None
        right = subject.picture.color
        own = (subject.object == number)[..., None]
        made = damaged(subject, np.where(own == alone, shaded(right, change), right))
        return made._replace(object=subject.name(number))

    return make


def all_recoloured(change: Callable[[NDArray], NDArray]) -> Make:
    """Transform the whole picture: that is a transform, and no attack."""
    return lambda subject: damaged(subject, shaded(subject.picture.color, change))


# Surfaces in wrong places


def _without(subject: Subject, gone: NDArray[np.bool_]) -> tuple[Frame, NDArray]:
    """Trace the scene without some instances; return the frame, and its instances' right numbers.

    `gone` is of instances, then planes.
    """
    scene, count = subject.scene, len(subject.scene.instances)
    instances = tuple(i for i, out in zip(scene.instances, gone, strict=False) if not out)
    planes = tuple(p for p, out in zip(scene.planes, gone[count:], strict=True) if not out)
    frame = render(replace(scene, instances=instances, planes=planes), subject.case.settings)
    return frame, np.append(np.flatnonzero(~gone), NOTHING)


def _without_object(subject: Subject, number: int) -> tuple[Frame, NDArray]:
    return _without(subject, subject.of_instance[:-1] == number)


def _object_moved(pixels: int) -> Make:
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
    return painted(subject, *_without(subject, gone))


def swapped_depth(subject: Subject) -> Attacked | None:
    """Show the farther of two objects wherever one hides the other."""
    best, most = None, 0
    for number in subject.seen[:6]:
        frame, instances = _without_object(subject, number)
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


# Lines and blocks


def grown(subject: Subject) -> Attacked | None:
    """Draw an object one pixel wider all around: a line along its edge in its own colour."""
    if not subject.seen:
        return None
    own = subject.object == subject.seen[0]
    color, owner = subject.picture.color.copy(), subject.owner
    owner = None if owner is None else owner.copy()
    left = ~own
    for axis, step in ((1, 1), (1, -1), (0, 1), (0, -1)):
        take = left & neighbours(own, step, axis)
        color[take] = neighbours(subject.picture.color, step, axis)[take]
        if owner is not None:
            owner[take] = neighbours(subject.owner, step, axis)[take]
        left &= ~take
    return damaged(subject, color, owner)


def shrunk(subject: Subject) -> Attacked | None:
    """Draw an object one pixel narrower: its outermost pixels show what is beside it."""
    if not subject.seen:
        return None
    own = subject.object == subject.seen[0]
    color, owner = subject.picture.color.copy(), subject.owner
    owner = None if owner is None else owner.copy()
    left = own.copy()
    for axis, step in ((1, 1), (1, -1), (0, 1), (0, -1)):
        take = left & neighbours(~own, step, axis)
        color[take] = neighbours(subject.picture.color, step, axis)[take]
        if owner is not None:
            owner[take] = neighbours(subject.owner, step, axis)[take]
        left &= ~take
    return damaged(subject, color, owner)


def _blocks(allowed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return some blocks within a mask (h, w): wholly, as far as there is room."""
    rng, out = np.random.default_rng(SEED), np.zeros(allowed.shape, bool)
    windows = np.lib.stride_tricks.sliding_window_view(allowed, (BLOCK, BLOCK))
    places = np.argwhere(windows.all(axis=(-2, -1)))
    if len(places):
        for y, x in rng.choice(places, BLOCKS):
            out[y : y + BLOCK, x : x + BLOCK] = True
    return out


def blocks_of_another(subject: Subject, allowed: NDArray | bool = True) -> Attacked | None:
    """Blocks inside surfaces, in the colour and as the surface of the object that is seen next."""
    color, owner = subject.picture.color.copy(), subject.owner
    owner = None if owner is None else owner.copy()
    where = _blocks(subject.inside & (subject.object >= 0) & allowed)
    if len(subject.seen) < 2 or not where.any():
        return None
    number = np.full(len(subject.scene.objects) + 1, subject.seen[0])
    number[subject.seen] = np.roll(subject.seen, -1)
    of = number[subject.object]
    for other in np.unique(of[where]):
        own = np.argwhere((subject.object == other) & subject.decidable)[0]
        color[where & (of == other)] = subject.picture.color[tuple(own)]
        if owner is not None:
            owner[where & (of == other)] = subject.owner[tuple(own)]
    return damaged(subject, color, owner)


def blocks_of_what_is_behind(subject: Subject) -> Attacked | None:
    """Holes in a surface, through which one sees what lies behind the object."""
    for number in subject.seen[:4]:
        where = _blocks(subject.inside & (subject.object == number))
        frame, instances = _without_object(subject, number)
        behind = instances[frame.instance_index] != NOTHING
        if (where & behind).any():
            return painted(subject, frame, instances, where=where)
    return None


def _clipped(end: bool) -> Make:
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


# Mixes


def _filtered(made: Attacked) -> Attacked:
    """Say of a wrong picture that it was anti-aliased."""
    picture = made.case.picture
    sampling = replace(picture.sampling, filter_radius=FILTER)
    case = replace(made.case, picture=replace(picture, sampling=sampling))
    return made._replace(case=case)


def _outside(subject: Subject, color: NDArray) -> NDArray[np.bool_]:
    """Return which colours (h, w, 4) are surely no mix of what the filter may reach.

    One channel lies beyond all colours that are seen within 3 pixels, or that an object has whose
    box reaches there (it may shine through a crack), by more than a mix is allowed to be off.
    """
    padded = np.pad(subject.frame.color, ((3, 3), (3, 3), (0, 0)), mode="edge")
    around = np.lib.stride_tricks.sliding_window_view(padded, (7, 7), axis=(0, 1))
    low, high = around.min(axis=(-2, -1)), around.max(axis=(-2, -1))
    for least, most, near in subject.reaches:
        low[near], high[near] = np.minimum(low[near], least), np.maximum(high[near], most)
    margin = 2.0**-5 * np.maximum(1, np.abs(color).max(axis=-1, keepdims=True))
    return ((color < low - margin) | (color > high + margin)).any(axis=-1)


def _no_mix(subject: Subject, color: NDArray, where: NDArray[np.bool_]) -> Attacked | None:
    """Show colours where they are no mix; say that the picture was anti-aliased."""
    where = where & _outside(subject, color) & subject.decidable
    inner = np.zeros(where.shape, bool)
    inner[4:-4, 4:-4] = True  # beyond the rim may be objects that no pixel shows
    where &= inner
    rows = np.convolve(where.sum(axis=1), np.ones(ROWS), "same")
    where[np.abs(np.arange(len(where)) - rows.argmax()) > ROWS // 2] = False
    if not where.any():
        return None
    owner = subject.owner
    owner = None if owner is None else np.where(where, UNKNOWN, owner)
    color = np.where(where[..., None], color, subject.picture.color)
    return _filtered(damaged(subject, color, owner))


def overshot(subject: Subject) -> Attacked | None:
    """Sharpen edges: colours beyond both of what is mixed there; whose they are is not known."""
    color = subject.picture.color
    mean = sum(np.roll(color, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)) / 9
    sharp = np.maximum(color + 0.8 * (color - mean), 0)
    sharp[..., 3] = color[..., 3]
    return _no_mix(subject, sharp, boundary(subject.frame))


def beyond_the_filter(subject: Subject) -> Attacked | None:
    """Smear edges by 15 x 15 pixels: as far as no sample of the filter reaches."""
    color = subject.picture.color
    for axis in (0, 1):
        pad = [(7, 7) if axis == n else (0, 0) for n in range(3)]
        wide = np.lib.stride_tricks.sliding_window_view(np.pad(color, pad, "edge"), 15, axis)
        color = wide.mean(axis=-1)
    return _no_mix(subject, color, np.ones(color.shape[:2], bool))


def of_no_one_near(subject: Subject) -> Attacked | None:
    """Edges in the colour of a third object, which no filter reaches from there."""
    rim = boundary(subject.frame)
    for number in subject.seen:
        there = tuple(np.argwhere((subject.object == number) & subject.decidable)[0])
        color = np.broadcast_to(subject.picture.color[there], subject.picture.color.shape)
        if (rim & _outside(subject, color)).sum() > rim.sum() / 4:
            return _no_mix(subject, color, rim)
    return None


# What only one side has


def _alternative(subject: Subject, number: int) -> Alternative:
    scene = subject.scene
    left = tuple(i for i in scene.instances if i.object != number)
    planes = tuple(p for p in scene.planes if p.object != number)
    scene = replace(scene, instances=left, planes=planes)
    return Alternative(subject.name(number), "hidden in the viewport", scene)


def another_is_gone(subject: Subject) -> Attacked | None:
    """Leave out one object, where a flag hides another."""
    if len(subject.seen) < 2:
        return None
    made = painted(subject, *_without_object(subject, subject.seen[0]))
    other = _alternative(subject, subject.seen[1])
    return made._replace(case=replace(made.case, alternatives=(other,)))


def partly_gone(subject: Subject) -> Attacked | None:
    """Punch holes into an object that a flag hides: it is neither there nor gone."""
    if not subject.seen:
        return None
    number = subject.seen[0]
    where = _blocks(subject.inside & (subject.object == number))
    made = painted(subject, *_without_object(subject, number), where=where)
    other = _alternative(subject, number)
    return made._replace(case=replace(made.case, alternatives=(other,)))


def gone_and_moved(subject: Subject) -> Attacked | None:
    """Leave out an object that a flag hides, and damage another one besides: that is counted."""
    made = blocks_of_another(subject)
    if made is None or len(subject.seen) < 2:
        return None
    number = subject.seen[0]
    frame, instances = _without_object(subject, number)
    gone = painted(subject, frame, instances).case.picture
    # What was hidden by the object that is gone may be what a block shows.
    kept = made.changed & (subject.object != number)
    wrong, right = made.case.picture, gone
    color = np.where(kept[..., None], wrong.color, right.color)
    owner = wrong.owners and np.where(kept, wrong.owners.pixels, right.owners.pixels)
    case = replace(
        subject.case,
        picture=in_place(gone, color, owner),
        alternatives=(_alternative(subject, number),),
    )
    return Attacked(case, subject.frame, kept)


def beside_the_box(subject: Subject) -> Attacked | None:
    """Blocks outside the box of something that the tracer does not model."""
    for number in reversed(subject.seen):
        points = subject.frame.positions(slice(None))[(subject.object == number).ravel()]
        box = np.stack((points.min(axis=0), points.max(axis=0)))
        outside = ~covered(subject.scene.camera, box)
        made = blocks_of_another(subject, outside)
        if made is not None:
            feature = Unmodelled(subject.name(number), "hair", "", box)
            manifest = replace(made.case.manifest, unmodelled=(feature,))
            return made._replace(case=replace(made.case, manifest=manifest))
    return None


ATTACKS = (
    *(Attack(f"moved_{n}", EDGE, f"the picture moved by {n} px", _moved(n)) for n in (1, 2, 3)),
    *(
        Attack(f"object_moved_{n}", EDGE, f"one object moved by {n} px", _object_moved(n))
        for n in (1, 2, 3)
    ),
    Attack("grown", EDGE, "a line one pixel wide around an object", grown),
    Attack("shrunk", EDGE, "an object's outermost pixels left out", shrunk),
    Attack("half_pixel", ANTI_ALIASING, "the picture resampled by half a pixel", half_pixel),
    Attack("overshot", ANTI_ALIASING, "sharpened edges in an anti-aliased picture", overshot),
    Attack(
        "beyond_the_filter",
        ANTI_ALIASING,
        "edges smeared farther than the filter reaches",
        beyond_the_filter,
    ),
    Attack(
        "of_no_one_near",
        ANTI_ALIASING,
        "edges in a colour that no filter reaches",
        of_no_one_near,
    ),
    Attack("swapped_depth", DEPTH_TIE, "the farther of two objects shown", swapped_depth),
    Attack(
        "blocks_of_what_is_behind",
        DEPTH_TIE,
        "holes that show what lies behind",
        blocks_of_what_is_behind,
    ),
    Attack("blocks_of_another", EDGE, "blocks in another object's colour", blocks_of_another),
    Attack("clip_start", CLIP_PLANE, "surfaces cut behind the clip start", _clipped(False)),
    Attack("clip_end", CLIP_PLANE, "surfaces cut before the clip end", _clipped(True)),
    *(
        Attack(f"one_{name}", COLOR, f"one object of many {words}", one_recoloured(of))
        for (name, of), words in zip(
            SHADES.items(),
            (
                "half as bright",
                "brighter by 0.75 stops",
                "with a gamma of 1.8",
                "with red and blue swapped",
                "with sRGB's curve twice",
            ),
            strict=True,
        )
    ),
    *(
        Attack(
            f"all_but_one_{name}",
            COLOR,
            "one object left out of a transform",
            all_but_one(of),
        )
        for name, of in SHADES.items()
    ),
    Attack("beside_the_box", NOT_MODELLED, "damage beside a feature's box", beside_the_box),
    Attack("dropped_instance", HIDDEN, "an instance left out", dropped_instance),
    Attack("a_frame_off", HIDDEN, "the frame after this one", a_frame_off),
    Attack("another_is_gone", HIDDEN, "not the object that a flag hides", another_is_gone),
    Attack("partly_gone", HIDDEN, "holes in an object that a flag hides", partly_gone),
    Attack("gone_and_moved", HIDDEN, "damage besides an object that is gone", gone_and_moved),
    Attack(
        "mirrored_x",
        NOT_DECIDABLE,
        "the picture mirrored left to right",
        _rearranged(np.fliplr),
    ),
    Attack(
        "mirrored_y",
        NOT_DECIDABLE,
        "the picture mirrored upside down",
        _rearranged(np.flipud),
    ),
    Attack("noise", NOT_DECIDABLE, "random colours of random objects", noise),
)


def withstood() -> dict[Cause, tuple[str, ...]]:
    """Return which attacks each cause withstands, in words: for the documents."""
    return {
        cause: tuple(dict.fromkeys(a.text for a in ATTACKS if a.imitates is cause))
        for cause in CAUSES
        if cause.explains or cause is NOT_DECIDABLE
    }
