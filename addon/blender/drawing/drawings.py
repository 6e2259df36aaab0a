"""Draws the user's scene again, to find whose surface each pixel of Blender's picture shows.

For that, each object has a colour of its own. What is instanced shows the colour of the object that
instances it, and counts as that object. Where hair and the like are drawn is found by a picture
without them. The user's objects are drawn, never copies of them: those have no simulation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np

from ...arrays import Colors
from ...causes.checks.unmodelled import covered
from ...manifest import Effect, Manifest, Unmodelled
from ...pictures.identity import MOST_OBJECTS, NOTHING, UNKNOWN, Owners, colors_of, decode
from ...pictures.palette import VIEWPORT, Palette
from ...pictures.picture import DrawnOver, Picture
from ...scene import Scene, SceneError
from ..engine import export_for_judge
from ..reading.unmodelled import HAIR, is_hair
from ..temporary import drawn, leave_out, temporary_scene
from ..values import in_colors, is_animated, untold
from .judge import Judge
from .picture import picture, prepare_scene
from .shading import anti_aliasing, use_view_shading
from .stand_ins import STANDS_FOR, stand_ins

_HIDING = ("hide_render", "hide_viewport")


@dataclass(frozen=True)
class Plan:
    """How the user's scene is drawn: the same each time."""

    scene: Any  # bpy.types.Scene
    layer: str
    judge: Judge
    like_for_like: bool = True
    view_shading: Any = None  # of the 3D view whose shading is used
    palette: Palette = VIEWPORT
    left_out: tuple[Unmodelled, ...] = ()  # objects that are never drawn

    @contextmanager
    def prepared(self) -> Iterator[tuple[Any, dict[str, Any]]]:
        """Give a new temporary scene that is set up to be drawn, and with what settings it is."""
        with (
            temporary_scene(self.scene, self.layer, self.judge.ignores, self.palette) as tmp,
            left_out(tmp, self.layer, self.left_out),
        ):
            if self.view_shading:
                use_view_shading(tmp, self.view_shading)
            used = prepare_scene(tmp, self.like_for_like)
            used["shading_of"] = "3D view" if self.view_shading else "scene"
            used["anti_aliasing"] = anti_aliasing(tmp, self.judge, self.like_for_like)
            yield tmp, used | {"colors": self.palette.by.value}


@dataclass(frozen=True, kw_only=True)
class Drawing(Plan):
    """A plan, and what was exported by it."""

    exported: Scene
    manifest: Manifest

    @classmethod
    def of(cls, plan: Plan, exported: Scene, manifest: Manifest) -> Drawing:
        """Return the drawing of what was exported by a plan, or by another drawing."""
        return cls(**vars(plan) | {"exported": exported, "manifest": manifest})

    @contextmanager
    def begun(self) -> Iterator[tuple[Any, Scene]]:
        """Give a new temporary scene, set up as for the first picture, and as :meth:`planes_in`."""
        with self.prepared() as (tmp, _), self.planes_in(tmp) as scene:
            yield tmp, scene

    def planes_in(self, tmp: Any) -> AbstractContextManager[Scene]:
        """Have planes drawn, for a while; gives the scene with them in the colours drawn."""
        owners = self.manifest.owners[len(self.exported.instances) :]
        return stand_ins(tmp, self.layer, self.exported, owners)

    def exported_again(self) -> Drawing:
        """Export the scene without what is left out."""
        with self.prepared() as (tmp, _):
            exported, manifest, _ = export_for_judge(tmp, self.layer, self.judge)
        return Drawing.of(self, exported, manifest)

    def picture(self, tmp: Any, like_for_like: bool) -> Colors:
        """Draw a temporary scene; raises what :func:`.picture.picture` does."""
        return picture(tmp, self.layer, self.judge, self.exported.camera, like_for_like)

    def without(self, features: Sequence[Unmodelled]) -> Colors:
        """Draw the scene without some features that draw themselves."""
        with self.begun() as (tmp, _), left_out(tmp, self.layer, features):
            return self.picture(tmp, self.like_for_like)


@contextmanager
def left_out(tmp: Any, layer: str, features: Sequence[Unmodelled]) -> Iterator[None]:
    """Leave hair, and objects that draw what is no triangle, out of a temporary scene, for a while.

    Where an animation would show again what was hidden, the object leaves the scene.
    """
    growing = {u.object for u in features if u.feature == HAIR}
    others = {name for u in features if u.feature != HAIR for name in (u.object, *u.by)}
    objects = {o for o in bpy.data.objects if o.name_full in others}
    old: set[Any] = {o for o in objects if str(o.type) == "GPENCIL"}  # 4.2 would not show it again
    leave_out(tmp, layer, old | {o for o in objects if is_animated(o, *_HIDING)})
    hidden = dict.fromkeys(objects - old, np.bool_(True))
    with ExitStack() as stack:
        for name in _HIDING:
            stack.enter_context(untold(bpy.data.objects, name, hidden))
        stack.enter_context(_without_hair(growing))
        yield


@contextmanager
def _without_hair(objects: set[str]) -> Iterator[None]:
    """Draw no hair of some objects, by their names, for a while."""
    settings = {
        system.settings
        for obj in bpy.data.objects
        if obj.name_full in objects
        for system in obj.particle_systems
        if is_hair(system.settings)
    }
    with ExitStack() as stack:
        for name in ("render_type", "display_method"):
            items: Any = bpy.types.ParticleSettings.bl_rna.properties[name]
            values = dict.fromkeys(settings, np.int32(items.enum_items["NONE"].value))
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
    separate = _separate(manifest)
    beneath = drawing.without(separate) if separate else shown.color
    over = (shown.color != beneath).any(axis=-1)  # by however little
    known = np.where(over[..., None], beneath, np.float32(np.nan))
    if len(separate) < len(features):  # what lies beneath goes with it: that is not known
        over |= (beneath != drawing.without(list(features.values()))).any(axis=-1)
    number = np.full(over.shape, NOTHING, np.int32)
    number[over] = min(features)
    unmodelled = list(manifest.unmodelled)
    for n, feature in reversed(features.items()):
        if feature.bounds is not None:
            here = over & covered(drawing.exported.camera, feature.bounds)
            number[here] = n
            if not here.any():
                unmodelled[n] = replace(feature, effect=Effect.NONE, bounds=None)
    shown = replace(shown, drawn=DrawnOver(number, known))
    return shown, replace(manifest, unmodelled=tuple(unmodelled))


def drawn_by_others(drawing: Drawing) -> DrawnOver | None:
    """Return what draws itself in each pixel, by Blender's own drawing; None for nothing.

    Of a picture that Blender did not draw: nobody knows what is beneath.
    """
    if not any(u.effect is Effect.DRAWN for u in drawing.manifest.unmodelled):
        return None
    try:
        with drawing.begun() as (tmp, _):
            shown = Picture(drawing.picture(tmp, True))
    except (SceneError, RuntimeError):  # there is nothing to draw with: all that it may cover
        return None
    drawn = with_what_draws_itself(drawing, shown)[0].drawn
    return drawn and DrawnOver(drawn.feature)


def _separate(manifest: Manifest) -> list[Unmodelled]:
    """Return what draws itself and can be left out without leaving out what is traced."""
    traced = {e.name for e in manifest.objects if e.exported} | set(manifest.owners)
    drawn_itself = (u for u in manifest.unmodelled if u.effect is Effect.DRAWN)
    return [u for u in drawn_itself if u.feature == HAIR or traced.isdisjoint((u.object, *u.by))]


def with_identity(drawing: Drawing, shown: Picture) -> Picture:
    """Return a picture of Blender's with whose surface each pixel shows.

    With more objects than colours can tell apart, the picture is returned as it is. What draws
    itself is left out where that is possible.
    """
    manifest = drawing.manifest
    with drawing.begun() as (tmp, _), left_out(tmp, drawing.layer, _separate(manifest)):
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
        own_colors = [o.color[:] for o in objects if is_animated(o, "color")]
        with in_colors(objects, colors_of(len(names))[[number[owner] for owner in owners]]):
            owner = decode(drawing.picture(tmp, True), len(names))
    if own_colors:  # these objects show their own colours, which may be other objects' numbers
        of_animated = decode(np.array([own_colors], np.float32), len(names))
        owner[np.isin(owner, of_animated[of_animated >= 0])] = UNKNOWN
    return replace(shown, owners=Owners.of(names, owner, manifest.owners))
