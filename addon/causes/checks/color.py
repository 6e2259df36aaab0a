"""Colour only: the same object in another shade, by the light or by a transform of the colours.

A transform is looked for in the surfaces that differ, with one sample for each of their colours, so
that a large surface does not outvote the others. Pixels at edges and of the background prove
nothing. It has to hold for the whole picture: a surface that agrees without it, and would not with
it, refutes it. Then the objects in another shade are named, and stay unexplained.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...arrays import Array, Bools, Floats, Index, Places
from ...pictures.bounds import largest_within
from ...pictures.curves import FIT, FITTED_SHARE, candidates
from ...pictures.metrics import boundary
from ...pictures.picture import MAJORITY, Curve, Picture, straight
from ...pictures.storage import difference
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ...tracer.vector import grouped
from ..cause import AGREE, UNEXPLAINED, Cause, Shade
from .probe import OpenPixels, blocks, other_color

COLOR = Cause(
    9,
    "color",
    "colour only",
    "the same object in another shade: {figure:.3g} is left after the transform that the "
    "comparison names (allowed: {allowed:.3g})",
    "of 1",
    (0.4, 0.7, 0.7),
    explains=True,
    warns=True,
    see_through=True,
    place="in another shade",
    why="The colours of the whole picture are changed: by light, which the tracer does not "
    "have, or by a transform of another program's picture.",
    check="In a lit picture, the same object is shown. In another program's picture, one "
    "transform makes the surfaces agree; the figure is the difference that remains after it.",
    never="A single object in another shade; a transform of all objects but one.",
    advice="compare like for like, or undo the transform that the comparison names",
)

ENOUGH = 4096  # pixels on which a transform is tried
FEW = 512  # pixels of an object that are compared with other surfaces' colours
REFUTING = 0.01  # the largest share of surfaces' pixels that agree only without a transform
SHADES = 16  # the most objects that are named


def check(pixels: OpenPixels) -> Work[None]:
    """Find open pixels that show the same object in another shade.

    The others are then compared as if the picture had been made by the transform that was found.
    """
    if pixels.picture.lit:
        pixels.out.transform = "light that the tracer does not have"
    elif pixels.case.curves is None or not pixels.open.any():
        return
    else:
        where = _judged(pixels) & (pixels.open | (pixels.out.cause == AGREE))
        found = yield from find_transform(pixels.frame, pixels.picture, where, pixels.case.curves)
        if found is None:
            return
        pixels.out.transform = found.name
        pixels.out.made_by = found.of
        pixels.picture = replace(pixels.picture, transform=found.of)
    for rows in blocks(pixels.open.shape):
        picture = pixels.picture.at(rows)
        color = pixels.frame.color[rows]
        instance = pixels.frame.instance_index[rows]
        if picture.lit:
            left, _ = difference(color, picture.color)
            same = picture.same_object(instance)
            pixels.give(pixels.open[rows] & same, COLOR, np.max(left, axis=-1), 1.0, rows)
        else:
            same = ~picture.other_color(color) & ~picture.other_object(instance)
            pixels.give(pixels.open[rows] & same, COLOR, *picture.difference(color), rows)
        yield None


def find_transform(
    frame: Frame, picture: Picture, interior: Bools, more: Sequence[Curve] = ()
) -> Work[Curve | None]:
    """Return the transform that makes a picture's (h, w) differing surfaces agree, or None.

    Only the pixels `interior` (h, w) are tested, which are traced, and away from edges. `more`
    are tried besides CURVES, such as the scene's own view transform. Surfaces that agree already
    have to agree with the transform, too.
    """
    surface = interior & (frame.instance_index != NOTHING)
    where = surface & (yield from other_color(picture, frame.color))
    right = surface & ~where
    asked = np.flatnonzero(where)
    if not len(asked):
        return None
    where = np.zeros_like(surface)
    where.flat[asked[:: -(-len(asked) // ENOUGH)]] = True
    some, colors = picture.at(where), frame.color[where]
    group = groups(np.column_stack((frame.instance_index[where], colors)))
    found: list[tuple[float, Curve]] = []
    first, shown = medians(some.color, group)
    for named in candidates(straight(colors[first]), straight(shown), picture.storage.levels, more):
        agree = ~replace(some, transform=named.of).other_color(colors)
        of_group = np.bincount(group, agree) / np.bincount(group)
        # Of the pixels, or of their groups if that is less.
        share = min(float(agree.mean()), float((of_group > MAJORITY).mean()))
        yield None
        if share > named.share:
            found.append((share, named))
    for _, named in sorted(found, key=lambda pair: -pair[0]):
        after = yield from other_color(replace(picture, transform=named.of), frame.color)
        if not _refuted(frame, surface, right & after):
            return named
    return None


def _judged(pixels: OpenPixels) -> Bools:
    """Return the pixels (h, w) away from edges in which something is known of the colour."""
    return ~boundary(pixels.frame) & (pixels.out.blind < 0)


def _refuted(frame: Frame, surface: Bools, wrong: Bools) -> bool:
    """Return whether a transform makes too many pixels wrong, or most of an instance."""
    count = int(np.max(frame.instance_index)) + 1
    many = np.bincount(frame.instance_index[surface], minlength=count)
    bad = np.bincount(frame.instance_index[wrong], minlength=count)
    return bool((bad > MAJORITY * many).any() or bad.sum() > REFUTING * many.sum())


def name_shades(pixels: OpenPixels) -> Work[None]:
    """Name the objects that stay unexplained because they are shown in another shade as a whole.

    Each of an object's colours must have become one other colour, or all must have by one
    transform. If its pixels may show what is around the object, most must have another colour.
    """
    frame, picture = pixels.frame, pixels.picture
    inside = _judged(pixels) & (frame.instance_index != NOTHING)
    inside &= ~picture.other_object(frame.instance_index)
    if picture.lit or not picture.has_colors:
        return
    if not (inside & (pixels.out.cause == UNEXPLAINED)).any():
        return
    # Pixels that differ and have the cause to agree were passed over.
    wrong = inside & np.isin(pixels.out.cause, (UNEXPLAINED, AGREE))
    wrong &= yield from other_color(picture, frame.color)
    shown = frame.object_index
    count = np.bincount(shown[wrong])
    share = count / np.maximum(np.bincount(shown[inside])[: len(count)], 1)
    for number in np.argsort(-count, kind="stable")[:SHADES]:
        where = wrong & (shown == number)
        if share[number] > MAJORITY and _is_its_own(frame, picture, where):
            found = yield from find_transform(frame, picture, where, pixels.case.curves or ())
            if found or _one_other_each(picture.at(where), frame.color[where]):
                name = pixels.case.scene.objects[number]
                how = found.name if found else ""
                pixels.out.shades.append(Shade(name, int(count[number]), how))
        yield None


def _is_its_own(frame: Frame, picture: Picture, where: Bools) -> bool:
    """Return whether most of an object's pixels (h, w) show no other surface's colour."""
    if picture.at(where).known(frame.instance_index[where]).all():
        return True
    own = frame.object_index == frame.object_index[where][0]
    near = largest_within(own, 1)  # with its neighbours, however small they are
    shown, others = picture.color[where], frame.color[~own]
    shown = shown[:: -(-len(shown) // FEW)]
    others = np.concatenate((frame.color[near & ~own], others[:: -(-len(others) // ENOUGH) or 1]))
    taken = np.zeros(len(shown), bool)
    for color in np.unique(others, axis=0)[:ENOUGH]:
        taken |= (np.abs(shown - color) < FIT).all(axis=1)
    return bool(taken.mean() < MAJORITY)


def _one_other_each(picture: Picture, colors: Array) -> bool:
    """Return whether each traced colour of n pixels is shown as one other."""
    some = slice(None, None, -(-len(colors) // ENOUGH))
    picture, colors = picture.at(some), colors[some]
    group = groups(colors)
    _, middle = medians(picture.color, group)
    if 2 * len(middle) > len(group) > 1:  # colours between corners: each is another
        return False
    alike = ~replace(picture, color=middle[group]).other_color(picture.color)
    return bool(alike.mean() > FITTED_SHARE)


def groups(keys: Array) -> Index:
    """Return a number for each of n keys (n, c), equal for equal keys, (n,)."""
    return np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)


def medians(shown: Array, group: Index) -> tuple[Places, Floats]:
    """Return each group's first pixel, (k,), and its median shown colour, (k, 4)."""
    every = grouped(group, int(np.max(group)) + 1)
    first = np.array([own[0] for own in every])
    return first, np.array([np.median(shown[own], axis=0) for own in every])
