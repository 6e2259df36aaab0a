"""Excuses the pixels in which a feature that is not modelled is seen, and no others.

- Hair and the like draw themselves: the picture without them says where, and what lies beneath.
- A surface of unknown colours, such as glass, must still be of the right object.
- Objects that are drawn in front of others, or not at all, are traced that way; this must give what
  the picture shows.

Pixels in which a fault would be excused are `blind`. The comparison says how many, and why.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from ...arrays import Bools, Floats, Integers
from ...manifest import Effect
from ...pictures.bounds import largest_within
from ...pictures.picture import Picture
from ...scene import Camera
from ...tracer.candidates import pixel_bounds
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ...tracer.world import box_corners
from ..case import Case
from ..cause import NOT_DECIDABLE, NOT_TRACED, UNEXPLAINED, Cause
from . import edges
from .hidden import traced_instead
from .probe import OpenPixels, other_color

NOT_MODELLED = Cause(
    3,
    "not_modelled",
    "not modelled",
    "{name} changes the pixel",
    "index",
    (0.3, 0.08, 0.9),
    explains=True,
    warns=True,
    why="The scene has something that the tracer does not model, such as hair, glass, a "
    "texture or x-ray.",
    check="First: it is drawn in this very pixel; where only its colours are unknown, the "
    "object must still be right. Then, for objects that are not drawn, cut a hole, or are "
    "drawn in front of others: the scene traced like this gives what the picture shows. "
    "Last, what may change a picture *as it is* in any pixel: light, which excuses the "
    "colour only; x-ray, backface culling, depth of field.",
    never="Damage beside it, or beneath hair; another object where only the colour is unknown.",
    advice="hide it, or compare like for like",
)


T = TypeVar("T")

_FINAL = (UNEXPLAINED, NOT_TRACED, NOT_DECIDABLE)  # they stay, whatever is drawn over the pixel


def as_known(case: Case) -> Picture:
    """Return the picture beneath what is drawn over it, without the colours that are unknown."""
    picture = case.picture
    lit = picture.lit or any(u.effect is Effect.LIGHT for u in case.manifest.unmodelled)
    color = picture.drawn.taken_off(picture.color) if picture.drawn else picture.color
    return replace(picture, color=color, lit=lit, colorless=case.colorless)


def drawn_over(picture: Picture) -> Integers:
    """Return which feature is drawn over pixels known beneath it, (h, w), or NOTHING."""
    if picture.drawn:
        return picture.drawn.known
    return np.full(picture.color.shape[:-1], NOTHING, np.int32)


def blind(case: Case, frame: Frame) -> Integers:
    """Return which feature keeps each pixel from being judged, (h, w): its index, or NOTHING."""
    features, picture = list(enumerate(case.manifest.unmodelled)), case.picture
    filtered = int(np.ceil(picture.sampling.filter_radius))
    out = np.full(frame.shape, NOTHING, np.int32)
    if not features and not picture.drawn:
        return out
    if not picture.drawn:  # nobody drew the scene without it: all that it may cover
        for number, feature in features:
            if feature.effect is Effect.DRAWN and feature.bounds is not None:
                out[covered(case.scene.camera, feature.bounds)] = number
    elif picture.drawn.beneath is None:  # drawn by another renderer, it may be a pixel wider
        out = largest_within(picture.drawn.feature, max(filtered, 1))
    else:
        out[:] = picture.drawn.feature
    own = case.feature_of(Effect.COLOR)[frame.instance_index]
    own = largest_within(own, filtered)  # a filter mixes in what is beside
    out = np.where(out == NOTHING, own, out)
    for number, feature in features:
        if feature.effect.everywhere:
            known = picture.known(frame.instance_index) & (feature.effect is Effect.LIGHT)
            out[~known & (out == NOTHING)] = number
    return out


def check_in_place(pixels: OpenPixels) -> Work[None]:
    """Find open pixels in which a feature is drawn, or a surface has an unknown colour."""
    yield None
    if not pixels.case.manifest.unmodelled:
        return
    number, seen = pixels.out.blind, pixels.frame.instance_index
    effects = [*(u.effect for u in pixels.case.manifest.unmodelled), None]
    is_drawn, is_recolored = (
        np.array([each is effect for each in effects])[number]
        for effect in (Effect.DRAWN, Effect.COLOR)
    )
    # Where another object is drawn over it, what lies beneath is judged.
    drawn = is_drawn & (drawn_over(pixels.case.picture) == NOTHING)
    own = pixels.case.feature_of(Effect.COLOR)[seen]
    number = np.where(drawn | (own == NOTHING), number, own)  # hair before glass: it is glass
    recolored = is_recolored | (own != NOTHING)
    recolored &= ~pixels.picture.other_object(seen)
    pixels.give(pixels.open & (drawn | recolored), NOT_MODELLED, number)
    yield None


def check_otherwise(pixels: OpenPixels) -> Work[None]:
    """Find open pixels that show the scene without an object, or one drawn in front of others."""
    case, picture = pixels.case, pixels.picture
    unseen = case.feature_of(Effect.UNSEEN)
    holes = case.feature_of(Effect.HOLDOUT)
    front = case.feature_of(Effect.IN_FRONT)
    past = np.maximum(unseen, holes)
    if pixels.open.any() and (past != NOTHING).any():
        owners = picture.owners
        if owners:
            instances = np.where(holes != NOTHING, np.int32(NOTHING), owners.instances)
            owners = replace(owners, instances=instances)
        shown = replace(picture, owners=owners, holes=holes != NOTHING)
        yield from _see(pixels, shown, unseen == NOTHING, past)
    if pixels.open.any() and (front != NOTHING).any():
        yield from _see(pixels, picture, front != NOTHING, front)


def _see(pixels: OpenPixels, picture: Picture, left: Bools, feature: Integers) -> Work[None]:
    """Find open pixels that show the instances and planes `left` (k + 1,) alone."""
    scene = pixels.case.scene
    count = len(scene.instances)
    instances = _some(scene.instances, left[:count])
    scene = replace(scene, instances=instances, planes=_some(scene.planes, left[count:]))
    left = np.append(left[:-1], True)  # nothing can be seen, too
    picture = picture.of_instances(left)
    there = replace(pixels, case=replace(pixels.case, scene=scene), picture=picture)
    traced, same = yield from traced_instead(there)
    number = feature[left][traced.instance_index]
    number = np.where(number == NOTHING, feature[pixels.frame.instance_index], number)
    where = pixels.open & same & (number != NOTHING)
    if picture.colorless is not None:
        any_color = where & ~picture.known(number) & picture.colorless[traced.instance_index]
        pixels.out.blind[any_color] = number[any_color]
    pixels.give(where, NOT_MODELLED, number)
    yield from edges.check(there)


def _some(things: Sequence[T], left: Bools) -> tuple[T, ...]:
    return tuple(thing for thing, stays in zip(things, left, strict=False) if stays)


def check_everywhere(pixels: OpenPixels) -> Work[None]:
    """Find open pixels that a feature may change wherever they are."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.effect.everywhere:
            where = pixels.open
            if feature.effect is Effect.LIGHT:  # it does not put another object there
                where = where & ~pixels.picture.other_object(pixels.frame.instance_index)
            pixels.give(where, NOT_MODELLED, float(number))
            yield None


def name_drawn(pixels: OpenPixels) -> Work[None]:
    """Name the feature drawn over pixels that are right beneath it."""
    own = pixels.case.picture
    out = pixels.out
    number = drawn_over(own)
    if (number != NOTHING).any():
        over = yield from other_color(own, pixels.frame.color)
        over &= (number != NOTHING) & ~np.isin(out.cause, _FINAL)
        out.cause[over] = NOT_MODELLED
        out.figure[over] = number[over]
        out.allowed[over] = np.nan


def covered(camera: Camera, bounds: Floats) -> Bools:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    corners = box_corners(bounds[..., None], np.eye(4)[..., None])
    x0, x1, y0, y1 = pixel_bounds(camera, corners, reach=0.5)[:, 0]
    r = camera.region
    out = np.zeros((r.height, r.width), bool)
    out[y0 - r.y0 : y1 - r.y0, x0 - r.x0 : x1 - r.x0] = True
    return out
