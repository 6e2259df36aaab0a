"""The scene as the other side may have it: with an object shown or hidden, or in another frame.

An alternative is believed where tracing it gives what the picture shows, and only if it does so in
most of the open pixels that it changes at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..scene import Instance, Plane, Scene
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import steps
from ..tracer.settings import Settings
from .again import look_again
from .cause import Cause, Hidden, Settler
from .shown import Shown

MOST = 0.5  # of the open pixels that an alternative changes


@dataclass(frozen=True, eq=False)
class Alternative:
    """A scene that differs in one thing, of the same camera and size."""

    object: str
    reason: str
    scene: Scene


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


def look_elsewhere(
    frame: Frame,
    shown: Shown,
    alternatives: Sequence[Alternative],
    band: NDArray[np.float64],
    settle: Settler,
) -> Work[None]:
    """Settle open pixels that show what an alternative does; yields the share that is done.

    Whose surfaces are shown is numbered for the traced scene, and not asked for.
    """
    shown = replace(shown, owner=None, owners=None)
    for number, other in enumerate(alternatives):
        if not settle.open.any():
            return
        traced = Frame.empty(other.scene)
        share = 1 / len(alternatives)
        yield from scaled(steps(other.scene, Settings(), traced), number * share, share / 2)
        ramp = shading.interpolated(other.scene, traced.instance_index)
        changed = settle.open & (traced.color != frame.color).any(axis=-1)
        same = changed & ~shown.other_color(traced.color, ramp)
        if same.sum() <= MOST * changed.sum():
            continue
        settle.out.hidden.append(Hidden(other.object, other.reason))
        settle(same, Cause.HIDDEN, float(len(settle.out.hidden) - 1))
        # Its edges are as uncertain as those of the traced scene.
        again = look_again(other.scene, shown, band, settle)
        yield from scaled(again, (number + 0.5) * share, share / 2)
