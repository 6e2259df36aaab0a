"""Draws the user's scene again, to find the owner of each pixel of Blender's picture.

For that, each object has a colour of its own. What is instanced shows the colour of the object that
instances it, and counts as that object. Where hair and the like are drawn is found by a picture
without them. The user's objects are drawn, never copies of them: those have no simulation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple, TypeAlias

import bpy
import numpy as np

from ...arrays import Colors
from ...causes.checks.unmodelled import covered
from ...manifest import Effect, Manifest, Unmodelled
from ...pictures.certificate import CameraCertificate
from ...pictures.drawn_over import DrawnOver
from ...pictures.identity import MOST_OBJECTS, NOTHING, Owners, colors_of, decode
from ...pictures.palette import VIEWPORT, Palette
from ...pictures.picture import Picture
from ...scene import Scene, SceneError
from ..evaluating import evaluated
from ..temporary import drawn, show_in, temporary_scene
from ..turns import Turns, once
from .judge import Judge
from .left_out import left_out, separable
from .picture import picture, prepare_scene
from .shading import anti_aliasing, use_view_shading
from .stand_ins import STANDS_FOR, stand_ins


@dataclass(frozen=True)
class Plan:
    """How the user's scene is drawn: the same each time."""

    scene: bpy.types.Scene
    layer: str
    judge: Judge
    like_for_like: bool = True
    view_shading: Any = None  # the 3D view's shading that is used
    palette: Palette = VIEWPORT
    left_out: tuple[Unmodelled, ...] = ()  # objects that are never drawn

    @contextmanager
    def prepared(self) -> Iterator[tuple[Any, dict[str, Any]]]:
        """Give a new temporary scene that is set up to be drawn, and with what settings it is."""
        with (
            temporary_scene(self.scene, self.layer, self.judge.ignores, self.palette) as tmp,
            left_out(tmp, self.left_out),
        ):
            if self.view_shading:
                use_view_shading(tmp, self.view_shading)
            used = prepare_scene(tmp, self.judge, self.like_for_like)
            used["shading_of"] = "3D view" if self.view_shading else "scene"
            used["anti_aliasing"] = anti_aliasing(tmp, self.judge, self.like_for_like)
            yield tmp, used | {"colors": self.palette.by.value}

    def drawn(self, export: Export, identity: bool) -> Drawn:
        """Have Blender evaluate the scene once, export it and draw it.

        With `identity` it is also found whose surface each pixel shows, unless something that draws
        itself is to be left out for that.
        """
        if not any(map(_is_changed, bpy.data.objects)):
            return self._drawn(export, identity)
        own = self.judge if self.judge.needs_window else None
        with self.prepared() as (tmp, used):
            drawing = evaluated(tmp, own, once(partial(export, tmp, used)))
        return drawing.again(identity=identity)

    def _drawn(self, export: Export, identity: bool) -> Drawn:
        """Export and draw one evaluation."""
        with self.prepared() as (tmp, used):
            return evaluated(tmp, self.judge, turns(tmp, used, export, identity))


def _is_changed(obj: Any) -> bool:
    """Return whether exporting an evaluation changes what Blender draws of it.

    A plane leaves the scene, and what shares its collection is copied anew; to read a mesh in Edit
    Mode changes which of its faces are hidden.
    """
    return bool(obj.mode == "EDIT" or obj.reference_tracer.infinite_plane)


class Drawing(NamedTuple):
    """A plan, and what was exported by it."""

    plan: Plan
    exported: Scene
    manifest: Manifest
    used: dict[str, Any]  # the settings that it is drawn with
    certificate: CameraCertificate | None = None  # how close its camera is to Blender's

    def again(self, features: Sequence[Unmodelled] = (), identity: bool = False) -> Drawn:
        """Draw the scene anew, without some features that draw themselves."""
        plan = replace(self.plan, left_out=(*self.plan.left_out, *features))
        return plan._drawn(lambda *_: self._replace(plan=plan), identity)


class Drawn(NamedTuple):
    """Blender's drawing of one evaluation."""

    drawing: Drawing  # what was exported has its planes in the colours drawn
    pixels: Colors
    owners: Owners | None  # of each pixel, if requested and known


# Exports an evaluated depsgraph, given the temporary scene and the settings that it is drawn with.
Export: TypeAlias = Callable[[Any, dict[str, Any], Any], Drawing]


def turns(
    tmp: bpy.types.Scene, used: dict[str, Any], export: Export, identity: bool = False
) -> Turns[Drawn]:
    """Export an evaluation, have it drawn, and again in a colour for each object."""
    depsgraph = yield False
    drawing = export(tmp, used, depsgraph)
    manifest = drawing.manifest
    of_planes = manifest.owners[len(drawing.exported.instances) :]
    drawing = drawing._replace(exported=stand_ins(tmp, drawing.exported, of_planes))
    plan = drawing.plan
    gone = {(u.object, u.feature) for u in plan.left_out}
    identity &= all((u.object, u.feature) in gone for u in separable(manifest))
    names = _owner_names(tmp) if identity else {}
    by = plan.judge, drawing.exported.camera, depsgraph
    pixels = yield from picture(tmp, *by, plan.like_for_like, not names)
    owners = (yield from _owners(drawing, tmp, names)) if names else None
    return Drawn(drawing, pixels, owners)


def _owner_names(tmp: Any) -> dict[str, str]:
    """Return the owner that each object of a temporary scene shows, by the objects' names.

    There is none if there are more objects than colours can tell apart.
    """
    planes = [o for o in tmp.collection.objects if STANDS_FOR in o]
    objects = (*drawn(tmp), *planes)
    owners = {o.name_full: o.get(STANDS_FOR) or o.name_full for o in objects}
    return owners if len(set(owners.values())) <= MOST_OBJECTS else {}


def _owners(drawing: Drawing, tmp: bpy.types.Scene, owners: Mapping[str, str]) -> Turns[Owners]:
    """Draw a temporary scene again, in a colour for each owner, and return each pixel's owner."""
    names = tuple(dict.fromkeys(owners.values()))
    colors = dict(zip(names, colors_of(len(names)), strict=True))
    judge = drawing.plan.judge
    prepare_scene(tmp, judge, True)
    depsgraph = yield False
    show_in(tmp, depsgraph, {name: colors[owner] for name, owner in owners.items()})
    pixels = yield from picture(tmp, judge, drawing.exported.camera, depsgraph)
    return Owners.of(names, decode(pixels, len(names)), drawing.manifest.owners)


def with_what_draws_itself(
    drawing: Drawing, shown: Picture, identity: bool = False
) -> tuple[Picture, Manifest]:
    """Return a picture of Blender's with where hair and the like are, and what is beneath them.

    With `identity`, whose surface is beneath them is found, too. In the manifest those that are
    nowhere to be seen have no effect.
    """
    manifest = drawing.manifest
    features = {n: u for n, u in enumerate(manifest.unmodelled) if u.effect is Effect.DRAWN}
    if not features:
        return shown, manifest
    separate = separable(manifest)
    beneath = shown.color
    if separate:
        without = drawing.again(separate, identity)
        beneath = without.pixels
        shown = replace(shown, owners=without.owners)
    over = (shown.color != beneath).any(axis=-1)  # by however little
    known = np.where(over[..., None], beneath, np.float32(np.nan))
    if len(separate) < len(features):  # what lies beneath goes with it: that is not known
        over |= (beneath != drawing.again(list(features.values())).pixels).any(axis=-1)
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
        shown = Picture(drawing.again().pixels)
    except (SceneError, RuntimeError):  # there is nothing to draw with: all that it may cover
        return None
    drawn = with_what_draws_itself(drawing, shown)[0].drawn
    return drawn and DrawnOver(drawn.feature)
