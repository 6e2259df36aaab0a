"""What the tracer does not model: it excuses the pixels in which it is seen, and no others.

- Hair and the like draw themselves: the picture without them says where, and what lies beneath.
- Where the colours of a surface are not known, as of glass, whose surface it is still is.
- What is drawn in front of others, or not at all, is traced so, and must be what is shown.

A pixel in which a fault would be excused is blind: the comparison says how many are, and why.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...manifest import Effect
from ...scene import Camera
from ...tracer.candidates import pixel_bounds
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work, scaled
from ..bounds import largest_within
from ..case import Case
from ..cause import Cause
from ..picture import Picture
from . import edges
from .hidden import traced_instead
from .probe import OpenPixels, blocks

_FINAL = (Cause.UNEXPLAINED, Cause.NOT_TRACED, Cause.NOT_DECIDABLE)  # whatever is drawn over it


def as_known(case: Case) -> Picture:
    """Return the case's picture with what is not known of its colours, and with what is beneath."""
    picture, effects = case.picture, {u.effect for u in case.manifest.unmodelled}
    lit = picture.lit or Effect.LIGHT in effects
    picture = replace(picture, lit=lit, colorless=case.colorless)
    if picture.beneath is None:
        return picture
    color = np.where(known_beneath(picture)[..., None], picture.beneath, picture.color)
    return replace(picture, color=color)


def known_beneath(picture: Picture) -> NDArray[np.bool_]:
    """Return where, (h, w), it is known what lies beneath something that draws itself."""
    return (picture.drawn != NOTHING) & np.isfinite(picture.beneath).all(axis=-1)


def blind(case: Case, frame: Frame) -> NDArray[np.int32]:
    """Return which feature keeps each pixel from being judged, (h, w): its index, else NOTHING."""
    features, picture = list(enumerate(case.manifest.unmodelled)), case.picture
    out = np.full(frame.shape, NOTHING, np.int32)
    filtered = int(np.ceil(picture.filter_radius))
    if picture.beneath is not None:
        out[:] = picture.drawn
    elif picture.drawn is not None:  # another renderer's may be a pixel wider
        out = largest_within(picture.drawn, max(filtered, 1))
    else:  # nobody drew the scene without it: all that it may cover
        for number, feature in features:
            if feature.effect is Effect.DRAWN and feature.bounds is not None:
                out[covered(case.scene.camera, feature.bounds)] = number
    own = case.feature_of(Effect.COLOR)[frame.instance_index]
    own = largest_within(own, filtered)  # a filter mixes in what is beside
    out = np.where(out == NOTHING, own, out)
    for number, feature in features:
        if feature.effect.everywhere:
            known = picture.known(frame.instance_index) & (feature.effect is Effect.LIGHT)
            out[~known & (out == NOTHING)] = number
    return out


def check_in_place(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels in which a feature is drawn, or the colour of a surface is not known."""
    number, picture = pixels.out.blind, pixels.picture
    effects = np.array([*(u.effect for u in pixels.case.manifest.unmodelled), None])[number]
    drawn, recolored = (effects == effect for effect in (Effect.DRAWN, Effect.COLOR))
    if picture.beneath is not None:
        drawn &= ~known_beneath(picture)  # what lies beneath is judged
    own = pixels.case.feature_of(Effect.COLOR)[pixels.frame.instance_index]
    number = np.where(drawn | (own == NOTHING), number, own)  # hair before glass: it is glass
    recolored |= own != NOTHING
    recolored &= ~picture.other_object(pixels.frame.instance_index)
    pixels.settle(pixels.open & (drawn | recolored), Cause.NOT_MODELLED, number)
    yield 1.0


def check_otherwise(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that show what is seen past an object, or one drawn in front of others."""
    case, picture = pixels.case, pixels.picture
    unseen, holes, front = map(case.feature_of, (Effect.UNSEEN, Effect.HOLDOUT, Effect.IN_FRONT))
    past, is_hole = np.maximum(unseen, holes), holes != NOTHING
    if pixels.open.any() and (past != NOTHING).any():
        owners = picture.owners
        if owners is not None:
            owners = np.where(is_hole, np.int32(NOTHING), owners)
        shown = replace(picture, owners=owners, holes=is_hole)
        yield from scaled(_see(pixels, shown, unseen == NOTHING, past), 0.0, 0.5)
    if pixels.open.any() and (front != NOTHING).any():
        yield from scaled(_see(pixels, picture, front != NOTHING, front), 0.5, 0.5)


def _see(
    pixels: OpenPixels, picture: Picture, kept: NDArray[np.bool_], feature: NDArray[np.int32]
) -> Work[None]:
    """Settle open pixels that show what some of the instances and planes (k + 1,) do alone."""
    scene = pixels.case.scene
    shown = (*scene.instances, *scene.planes)
    alone = [s for s, keep in zip(shown, kept, strict=False) if keep]
    count = int(kept[: len(scene.instances)].sum())
    scene = replace(scene, instances=tuple(alone[:count]), planes=tuple(alone[count:]))
    kept = np.append(kept[:-1], True)  # nothing is to be seen everywhere
    per_instance = {name: getattr(picture, name) for name in ("owners", "colorless", "holes")}
    picture = replace(
        picture, **{name: None if v is None else v[kept] for name, v in per_instance.items()}
    )
    there = replace(pixels, case=replace(pixels.case, scene=scene), picture=picture)
    traced, same = yield from scaled(traced_instead(there), 0.0, 0.5)
    number = feature[kept][traced.instance_index]
    number = np.where(number == NOTHING, feature[pixels.frame.instance_index], number)
    where = pixels.open & same & (number != NOTHING)
    any_color = where & ~picture.known(number) & picture.colorless[traced.instance_index]
    pixels.out.blind[any_color] = number[any_color]
    pixels.settle(where, Cause.NOT_MODELLED, number)
    yield from scaled(edges.check(there), 0.5, 0.5)


def check_everywhere(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that a feature may change wherever they are."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.effect.everywhere:
            where = pixels.open
            if feature.effect is Effect.LIGHT:  # it does not put another object there
                where = where & ~pixels.picture.other_object(pixels.frame.instance_index)
            pixels.settle(where, Cause.NOT_MODELLED, float(number))
            yield 0.0


def settle_drawn(pixels: OpenPixels) -> Work[None]:
    """Name what draws itself over pixels that were judged, and found to be right, beneath it."""
    own, out = pixels.case.picture, pixels.out
    if own.beneath is None:
        return
    for rows in blocks(own.drawn.shape):
        part = own.at(rows)
        over = known_beneath(part) & part.other_color(pixels.frame.color[rows])
        over &= ~np.isin(out.cause[rows], _FINAL)
        out.cause[rows][over] = Cause.NOT_MODELLED
        out.figure[rows][over], out.allowed[rows][over] = part.drawn[over], np.nan
        yield 1.0


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8).T
    (x0, x1, y0, y1), r = pixel_bounds(camera, corners[..., None], 0.5)[:, 0], camera.region
    out = np.zeros((r.height, r.width), bool)
    out[y0 - r.y0 : y1 - r.y0, x0 - r.x0 : x1 - r.x0] = True
    return out
