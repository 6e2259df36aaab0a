"""What Blender tells of its own picture by drawing the scene again, on temporary scenes of its own.

Whose surface each pixel shows is found with a colour an object. What is instanced shows the colour
of the object that instances it, and counts as that. Where hair and the like are drawn is found
without them. The user's objects are drawn, never copies: those have no simulation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...compare.checks.unmodelled import covered
from ...compare.identity import MOST_OBJECTS, NOTHING, UNKNOWN, colors_of, decode
from ...compare.picture import Picture, numbered
from ...manifest import Effect, Manifest, Unmodelled
from ...scene import Scene, SceneError
from ..reading.planes import stand_ins
from ..reading.unmodelled import HAIR, is_hair
from .judges import Judge
from .temporary import STANDS_FOR, drawn, in_colors, is_animated, leave_out, temporary_scene, untold
from .viewport import picture, prepare_scene, use_view_shading


@dataclass(frozen=True)
class Drawing:
    """How the user's scene is drawn, whenever it is: the same each time."""

    scene: Any
    layer: str
    judge: Judge
    like_for_like: bool
    view_shading: Any  # of the 3D view whose shading is used, or None
    exported: Scene
    manifest: Manifest

    @contextmanager
    def begun(self) -> Iterator[Any]:
        """Give a new temporary scene, as it was for the first picture."""
        planes = self.manifest.owners[len(self.exported.instances) :]
        with temporary_scene(self.scene, self.layer, self.judge) as tmp:
            if self.view_shading:
                use_view_shading(tmp, self.view_shading)
            prepare_scene(tmp, self.like_for_like)
            with stand_ins(tmp, self.layer, self.exported, planes):
                yield tmp

    def picture(self, tmp: Any, like_for_like: bool) -> NDArray[np.float32]:
        """Draw a temporary scene; raises what :func:`viewport.picture` does."""
        return picture(tmp, self.layer, self.judge, self.exported.camera, like_for_like)

    def without(self, features: Sequence[Unmodelled]) -> NDArray[np.float32]:
        """Draw the scene without some features that draw themselves."""
        with self.begun() as tmp, left_out(tmp, self.layer, features):
            return self.picture(tmp, self.like_for_like)


@contextmanager
def left_out(tmp: Any, layer: str, features: Sequence[Unmodelled]) -> Iterator[None]:
    """Leave hair, and objects that draw what is no triangle, out of a temporary scene, for a while.

    An animation would show again what was hidden: such an object leaves the scene.
    """
    of_hair = {u.object for u in features if u.feature == HAIR}
    others = {name for u in features if u.feature != HAIR for name in (u.object, *u.by)}
    growing = (o for o in bpy.data.objects if o.name_full in of_hair)
    hair = {s.settings for o in growing for s in o.particle_systems if is_hair(s.settings)}
    hiding = "hide_render", "hide_viewport"
    objects = {o for o in bpy.data.objects if o.name_full in others}
    old = {o for o in objects if o.type == "GPENCIL"}  # 4.2 would hide it from the user, too
    leave_out(tmp, layer, old | {o for o in objects if is_animated(o, *hiding)})
    whole = dict.fromkeys(objects - old, np.bool_(True))
    with ExitStack() as stack:
        for name in hiding:
            stack.enter_context(untold(bpy.data.objects, name, whole))
        for name in ("render_type", "display_method"):
            none = bpy.types.ParticleSettings.bl_rna.properties[name].enum_items["NONE"].value
            values = dict.fromkeys(hair, np.int32(none))
            stack.enter_context(untold(bpy.data.particles, name, values))
        yield


def with_what_draws_itself(drawing: Drawing, shown: Picture) -> tuple[Picture, Manifest]:
    """Return a picture of Blender's with where hair and the like are, and what is beneath them.

    In the manifest those that are nowhere to be seen have no effect.
    """
    manifest = drawing.manifest
    features = {n: u for n, u in enumerate(manifest.unmodelled) if u.effect is Effect.DRAWN}
    if not features:
        return shown, manifest
    apart = _apart(manifest)
    beneath = drawing.without(apart) if apart else shown.color
    over = (shown.color != beneath).any(axis=-1)  # by however little
    known = np.where(over[..., None], beneath, np.float32(np.nan))
    if len(apart) < len(features):  # what lies beneath goes with it: that is not known
        over |= (beneath != drawing.without(list(features.values()))).any(axis=-1)
    number, unseen = np.full(over.shape, NOTHING, np.int32), set()
    number[over] = min(features)
    for n, feature in reversed(features.items()):
        if feature.bounds is not None:
            here = over & covered(drawing.exported.camera, feature.bounds)
            number[here] = n
            unseen |= set() if here.any() else {n}
    told = (
        replace(u, effect=Effect.NONE, bounds=None) if n in unseen else u
        for n, u in enumerate(manifest.unmodelled)
    )
    shown = replace(shown, drawn=number, beneath=known)
    return shown, replace(manifest, unmodelled=tuple(told))


def drawn_by_others(drawing: Drawing) -> NDArray[np.int32] | None:
    """Return what draws itself in each pixel, (h, w), by Blender's own drawing; None for nothing.

    Of a picture that Blender did not draw: nobody knows what is beneath.
    """
    if not any(u.effect is Effect.DRAWN for u in drawing.manifest.unmodelled):
        return None
    try:
        with drawing.begun() as tmp:
            shown = Picture(drawing.picture(tmp, True))
    except (SceneError, RuntimeError):  # there is nothing to draw with: all that it may cover
        return None
    return with_what_draws_itself(drawing, shown)[0].drawn


def _apart(manifest: Manifest) -> list[Unmodelled]:
    """Return what draws itself, and can be left out without anything that is traced."""
    traced = {e.name for e in manifest.objects if e.exported} | set(manifest.owners)
    drawn_itself = (u for u in manifest.unmodelled if u.effect is Effect.DRAWN)
    return [u for u in drawn_itself if u.feature == HAIR or traced.isdisjoint((u.object, *u.by))]


def with_identity(drawing: Drawing, shown: Picture) -> Picture:
    """Return a picture of Blender's with whose surface each pixel shows.

    That is not known where there are more objects than colours tell apart. What draws itself is
    left out, if it can be.
    """
    manifest = drawing.manifest
    with drawing.begun() as tmp, left_out(tmp, drawing.layer, _apart(manifest)):
        # The layer's own list has the stand-ins of planes once it is evaluated: that is too early.
        planes = [o for o in tmp.collection.objects if STANDS_FOR in o]
        objects = list(dict.fromkeys((*drawn(tmp, drawing.layer), *planes)))
        owners = [o.get(STANDS_FOR) or o.name_full for o in objects]
        names = tuple(dict.fromkeys(owners))
        if len(names) > MOST_OBJECTS:
            return shown
        number = {name: n for n, name in enumerate(names)}
        prepare_scene(tmp, True)
        tmp.display.shading.color_type = "OBJECT"
        own = [o.color[:] for o in objects if is_animated(o, "color")]
        colors = colors_of(len(names))[[number[owner] for owner in owners]]
        with in_colors(objects, colors):
            owner = decode(drawing.picture(tmp, True), len(names))
    if own:  # these show their own colours again, which may be those of other objects' numbers
        of_animated = decode(np.array([own], np.float32), len(names))
        owner[np.isin(owner, of_animated[of_animated >= 0])] = UNKNOWN
    return replace(shown, owner=owner, owners=numbered(names, manifest.owners), names=names)
