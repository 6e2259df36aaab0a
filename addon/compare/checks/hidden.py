"""What only one side has: an object, another frame of the scene, or what the tracer does not model.

An object that the picture is known to show, and that the tracer was told to leave out, is named by
the manifest. An alternative is believed where tracing it gives what the picture shows, and only if
it does so in most of the open pixels that it changes at all. What is not modelled is named by the
manifest, too, with the box that it may cover.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...scene import Camera, Scene
from ...tracer import shading
from ...tracer.camera import film_of
from ...tracer.frame import Frame
from ...tracer.progress import Work, scaled
from ...tracer.render import steps
from ...tracer.settings import Settings
from ..case import Alternative
from ..cause import Cause, Hidden
from . import edges
from .probe import OpenPixels, blocks

CONFIRMED = 0.5  # of the open pixels that an alternative changes


def check(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that show what only one side has."""
    why = {e.name: e.reason for e in pixels.case.manifest.objects if e.hidden}
    for number, name in enumerate(pixels.picture.names):
        if name in why:
            where = pixels.open & (pixels.picture.owner == number)
            if where.any():
                pixels.settle(where, Cause.HIDDEN, _named(pixels, Hidden(name, why[name])))
            yield 0.0
    alternatives = pixels.case.alternatives
    for number, other in enumerate(alternatives):
        if pixels.open.any():
            share = 1 / len(alternatives)
            yield from scaled(_look_at(pixels, other), number * share, share)


def _named(pixels: OpenPixels, hidden: Hidden) -> float:
    """Add to the hidden objects; return the index."""
    pixels.out.hidden.append(hidden)
    return float(len(pixels.out.hidden) - 1)


def _look_at(pixels: OpenPixels, other: Alternative) -> Work[None]:
    """Settle open pixels that show what an alternative does; yields the share that is done.

    Whose surfaces are shown is numbered for the traced scene, and not asked for.
    """
    picture = replace(pixels.picture, owner=None, owners=None)
    traced = Frame.empty(other.scene)
    yield from scaled(steps(other.scene, Settings(), traced), 0.0, 0.5)
    changed = pixels.open & (traced.color != pixels.frame.color).any(axis=-1)
    same = changed.copy()
    for rows in blocks(same.shape):
        ramp = shading.interpolated(other.scene, traced.instance_index[rows])
        same[rows] &= ~picture.at(rows).other_color(traced.color[rows], ramp)
        yield 0.5
    if same.sum() <= CONFIRMED * changed.sum():
        return
    pixels.settle(same, Cause.HIDDEN, _named(pixels, Hidden(other.object, other.reason)))
    # Its edges are as uncertain as those of the traced scene.
    there = replace(pixels, case=replace(pixels.case, scene=other.scene), picture=picture)
    yield from scaled(edges.check(there), 0.5, 0.5)


def without(scene: Scene, name: str) -> Scene:
    """Return a scene without an object."""
    number = scene.objects.index(name)
    return replace(
        scene,
        instances=tuple(i for i in scene.instances if i.object != number),
        planes=tuple(p for p in scene.planes if p.object != number),
    )


def with_object(scene: Scene, other: Scene, name: str) -> Scene:
    """Return a scene with an object of another one."""
    number = other.objects.index(name)
    first, index = len(scene.meshes), len(scene.objects)
    own = [i for i in other.instances if i.object == number]
    used = sorted({i.mesh for i in own})
    instances = [replace(i, mesh=first + used.index(i.mesh), object=index) for i in own]
    planes = [replace(p, object=index) for p in other.planes if p.object == number]
    return replace(
        scene,
        meshes=(*scene.meshes, *(other.meshes[m] for m in used)),
        instances=(*scene.instances, *instances),
        planes=(*scene.planes, *planes),
        objects=(*scene.objects, name),
    )


def unmodelled_in_its_place(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that the box of a feature may cover."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.bounds is not None and not feature.everywhere and pixels.open.any():
            inside = pixels.open & covered(pixels.case.scene.camera, feature.bounds)
            pixels.settle(inside, Cause.NOT_MODELLED, float(number))
            yield 0.0


def unmodelled_everywhere(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that a feature may change wherever they are."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.everywhere:
            allowed = pixels.open
            if feature.recolours:  # light does not put another object there
                allowed = allowed & ~pixels.picture.other_object(pixels.frame.instance_index)
            pixels.settle(allowed, Cause.NOT_MODELLED, float(number))
            yield 0.0


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    r = camera.region
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    px, py, depth = film_of(camera, corners)
    out = np.zeros((r.height, r.width), bool)
    if depth.max() < camera.clip_start or depth.min() > camera.clip_end:
        return out
    if not camera.projection.is_parallel and depth.min() <= camera.clip_start:
        return ~out  # around the eye: anywhere
    x0, x1 = int(max(np.floor(px.min()) - r.x0, 0)), int(np.ceil(min(px.max(), r.x1)) - r.x0)
    y0, y1 = int(max(np.floor(py.min()) - r.y0, 0)), int(np.ceil(min(py.max(), r.y1)) - r.y0)
    out[y0 : max(y1, 0), x0 : max(x1, 0)] = True
    return out
