"""Hidden for one side: an object that only one side shows, or the scene in another frame.

An object that the picture is known to show, and that the tracer was told to leave out, is named by
the manifest. An alternative is believed where tracing it gives what the picture shows, and only if
it does so in most of the open pixels that it changes at all.
"""

from __future__ import annotations

from dataclasses import replace

from ...scene import Instance, Plane, Scene
from ...tracer import shading
from ...tracer.frame import Frame
from ...tracer.progress import Work, scaled
from ...tracer.render import steps
from ...tracer.settings import Settings
from ..case import Alternative
from ..cause import Cause, Hidden
from . import edges
from .open_pixels import OpenPixels, blocks

CONFIRMED = 0.5  # of the open pixels that an alternative changes


def check(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that show what only one side has."""
    for number, hidden in pixels.case.absent():
        where = pixels.open & (pixels.picture.owner == number)
        if where.any():
            pixels.settle(where, Cause.HIDDEN, _named(pixels, hidden))
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
    instances: list[Instance] = [
        replace(i, mesh=first + used.index(i.mesh), object=index) for i in own
    ]
    planes: list[Plane] = [replace(p, object=index) for p in other.planes if p.object == number]
    return replace(
        scene,
        meshes=(*scene.meshes, *(other.meshes[m] for m in used)),
        instances=(*scene.instances, *instances),
        planes=(*scene.planes, *planes),
        objects=(*scene.objects, name),
    )
