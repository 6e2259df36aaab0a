"""Checks for an object, or another frame of the scene, that only one side has.

The manifest names objects that the tracer was told to leave out: if the picture is known to show
one, this is the cause. An alternative scene is believed if tracing it gives what the picture shows
in nearly all of the pixels that it changes at all, as a fault must: a picture that is wrong in
another way agrees with it here and there. Then it excuses only those.
"""

from __future__ import annotations

from dataclasses import replace

from ...arrays import Bools
from ...rendering import frame_of
from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ...tracer.settings import Settings
from ..case import PRECISE, Alternative
from ..cause import AGREE, Cause, Causes, Hidden
from . import anti_aliasing, edges
from .probe import OpenPixels, by_blocks

HIDDEN = Cause(
    10,
    "hidden",
    "hidden for one side",
    "only one side shows {name}",
    "index",
    (0.08, 0.2, 0.08),
    explains=True,
    warns=True,
    why="One side hides an object, by a flag or a collection of the scene, or shows another frame.",
    check="Blender's picture shows such an object. For another program's picture, the scene is "
    "traced with the object hidden or shown, and must give what the picture shows in 97 % "
    "of the pixels that this changes.",
    never="An object that nothing hides; one that is there in part; any other damage.",
    advice="show the object to both sides, or hide it from both",
)


def check(pixels: OpenPixels) -> Work[None]:
    """Find open pixels that show what only one side has."""
    why = {e.name: e.reason for e in pixels.case.manifest.objects if e.hidden}
    if owners := pixels.picture.owners:
        for number, name in enumerate(owners.names):
            if name in why:
                where = pixels.open & (owners.pixels == number)
                if where.any():
                    pixels.give(where, HIDDEN, _named(pixels, Hidden(name, why[name])))
                yield None
    for other in pixels.case.alternatives:
        if pixels.open.any():
            yield from _look_at(pixels, other)


def _named(pixels: OpenPixels, hidden: Hidden) -> float:
    """Append a hidden object; return its index."""
    pixels.out.hidden.append(hidden)
    return float(len(pixels.out.hidden) - 1)


def _look_at(pixels: OpenPixels, other: Alternative) -> Work[None]:
    """Find open pixels that show what an alternative does.

    Their objects are not compared, as the picture has them by the instances of the traced scene.
    """
    case = replace(pixels.case, scene=other.scene)
    colorless = case.colorless
    picture = replace(pixels.picture, owners=None, colorless=colorless)
    there = replace(pixels, case=case, picture=picture)
    traced, same = yield from traced_instead(there)
    there = replace(there, frame=traced)
    changed = picture.sees_apart(traced, pixels.frame)
    changed &= pixels.open | (pixels.out.cause == AGREE)
    changed &= ~colorless[traced.instance_index]  # any colour would be the right one
    needed = PRECISE * changed.sum()
    right = same & changed
    if right.sum() <= changed.sum() / 2:
        return  # so much is no edge
    if right.sum() < needed:
        right |= yield from _at_edges(there, changed & ~same)
    if right.sum() < needed:
        return
    same &= changed & pixels.open
    pixels.give(same, HIDDEN, _named(pixels, Hidden(other.object, other.reason)))
    # Its edges are as uncertain as those of the traced scene.
    yield from _edges(there)


def _edges(there: OpenPixels) -> Work[None]:
    """Find open pixels at the edges of an alternative scene."""
    yield from anti_aliasing.check(there)
    yield from edges.check(there)


def _at_edges(there: OpenPixels, asked: Bools) -> Work[Bools]:
    """Return which of the given pixels (h, w) rounding may have made; gives them no cause."""
    out = Causes.none(asked.shape)
    trial = replace(there, out=out, open=asked.copy())
    yield from _edges(trial)
    return out.cause != AGREE


def traced_instead(pixels: OpenPixels) -> Work[tuple[Frame, Bools]]:
    """Trace the case's scene, which is not the one that was traced; return which pixels show it."""
    traced = yield from frame_of(pixels.case.scene, Settings())

    def alike(rows: slice) -> Bools:
        part, seen = pixels.picture.at(rows), traced.instance_index[rows]
        return part.shows(traced, rows) & ~part.other_object(seen)

    same = yield from by_blocks(traced.shape, alike)
    return traced, same


def with_object(scene: Scene, other: Scene, name: str) -> Scene:
    """Return a scene with an object added from another scene."""
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
