"""Prepares the open scene for comparison with a picture that Blender need not have made.

The scene may have been another then: a flag hides an object, or it was the frame before or after.
And the picture may have gone through one of Blender's view transforms. To know what these do,
Blender saves a picture of the colours that the traced scene can show. This needs constant colours:
with colours that change between corners, no view transform is tried.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.types import Context

from ...arrays import Colors, Floats
from ...causes.case import Alternative, Case
from ...causes.checks.hidden import with_object
from ...files.images import curve_undone
from ...manifest import Manifest
from ...pictures.palette import VIEWPORT, By, GivenColors, Palette
from ...pictures.picture import Curve, Picture
from ...scene import Scene, without
from ...tracer.settings import Settings
from ..drawing.drawings import Drawing, Plan, drawn_by_others
from ..drawing.judges import AUTO, judge_named
from ..drawing.picture import read
from ..evaluating import export_at
from ..reading.export import export
from ..reading.palettes import automatic, noted, palette_by
from ..temporary import made_for, temporary_scene
from ..versions import set_format
from .open_file import export_open_file
from .variants import variants

COMMON = ("Filmic", "AgX", "Khronos PBR Neutral", "Standard")
MOST = 16  # alternatives: each of them is traced where pixels have no cause
MOST_COLORS = 4096


def gather_against(
    context: Context,
    picture: Picture | Callable[[Drawing], Picture],
    settings: Settings,
    self_check: bool = False,
    colors: By | GivenColors = By.VIEWPORT,
) -> Case:
    """Export the context's scene as a render has it, for a picture of unknown origin.

    The picture was drawn in these colours, or is made of a drawing of what is exported.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    palette, scene, manifest = exported_in(context, colors)
    judge = judge_named(AUTO, background=True, is_panorama=not scene.camera.projection.is_linear)
    layer = context.view_layer.name
    drawing = Drawing(Plan(context.scene, layer, judge, palette=palette), scene, manifest, {})
    shown = picture if isinstance(picture, Picture) else picture(drawing)
    return Case(
        scene,
        manifest,
        settings,
        replace(shown, drawn=drawn_by_others(drawing)),
        alternatives=alternatives(context, scene, manifest, palette),
        curves=view_transforms(context.scene, scene),
        self_check=self_check,
        variants=partial(variants, context.scene.name_full, layer, judge.ignores, palette),
    )


def exported_in(context: Context, colors: By | GivenColors) -> tuple[Palette, Scene, Manifest]:
    """Export the context's scene as a render has it, in colours; return these, too.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or lacks a colour.
    """
    palette = palette_by(context.scene, colors)
    scene, manifest, _ = export_open_file(context, palette=palette)
    if colors == By.AUTOMATIC:
        palette = automatic(context.scene, scene, manifest)
        if palette.by != By.VIEWPORT:
            scene, manifest, _ = export_open_file(context, palette=palette)
    return palette, scene, noted(palette, scene, manifest)


def alternatives(
    context: Context, scene: Scene, manifest: Manifest, palette: Palette = VIEWPORT
) -> tuple[Alternative, ...]:
    """Return scenes that differ in one flag or the frame from one exported as a render has it."""
    layer = context.view_layer.name
    with (
        temporary_scene(context.scene, layer, palette=palette) as tmp,
        context.temp_override(scene=tmp, view_layer=tmp.view_layers[0]),
    ):
        other, viewport = export(bpy.context.evaluated_depsgraph_get())
    drawn, seen = ({entry.name: entry for entry in m.objects} for m in (manifest, viewport))
    # By object: why it is hidden on one side, and what makes the scene without that flag.
    hidden: dict[str, tuple[str, Callable[[Scene], Scene]]] = {}
    for name in sorted(seen.keys() & drawn.keys()):
        if drawn[name].hidden and seen[name].exported:
            hidden[name] = drawn[name].reason, partial(with_object, other=other, name=name)
        elif seen[name].hidden and drawn[name].exported:
            hidden[name] = seen[name].reason, partial(without, names=[name])
    out = []
    every = scene
    for name, (reason, change) in islice(hidden.items(), MOST):
        out.append(Alternative(name, reason, change(scene)))
        every = change(every)
    if len(out) > 1:  # one object may lie before another
        reasons = dict.fromkeys(one.reason for one in out)
        out.append(Alternative("', '".join(one.object for one in out), ", ".join(reasons), every))
    return (*out, *_frames(context, palette))


def _frames(context: Context, palette: Palette) -> list[Alternative]:
    """Return the scene a frame before and a frame later, if something in the file is animated."""
    if not len(bpy.data.actions):
        return []
    out = []
    now = context.scene.frame_current
    layer = context.view_layer.name
    with temporary_scene(context.scene, layer, palette=palette) as tmp:
        for frame in (now - 1, now + 1):
            reason = f"the picture is of frame {frame}, the scene is at {now}"
            out.append(Alternative("what is animated", reason, export_at(tmp, frame)))
    return out


def view_transforms(user: bpy.types.Scene, scene: Scene) -> tuple[Curve, ...]:
    """Return the view transform of the user's scene, then the common ones that this Blender has.

    They hold for the colours of what was exported of it; the user's scene stays as it is.
    """
    table = np.unique(scene.color_table[:, :3], axis=0)
    if len(table) > MOST_COLORS or any(m.corner_colors is not None for m in scene.meshes):
        return ()
    with temporary_scene(user) as tmp:
        return tuple(
            Curve(f"the view transform {name}", _looked_up(table, shown))
            for name, shown in _shown(tmp, table)
        )


def _shown(tmp: bpy.types.Scene, table: Colors) -> Iterator[tuple[str, Floats]]:
    """Yield each view transform's name and what it makes of colours (n, 3), sRGB's curve undone."""
    output = tmp.render.image_settings
    view: Any = output.view_settings if output.color_management == "OVERRIDE" else tmp.view_settings
    own = view.view_transform
    plain = (view.exposure, view.gamma, view.look) == (0.0, 1.0, "None")
    more = f" with exposure {view.exposure:+.3g}, gamma {view.gamma:.3g}, look '{view.look}'"
    yield f"'{own}'" + ("" if plain else more), _saved(tmp, table)
    view.look = "None"
    view.exposure = 0.0
    view.gamma = 1.0
    for name in COMMON:
        with suppress(TypeError):  # this Blender does not have it
            view.view_transform = name
        if view.view_transform == name and not (plain and name == own):
            yield f"'{name}'", _saved(tmp, table)


def _saved(tmp: bpy.types.Scene, table: Colors) -> Floats:
    """Return colours (n, 3) as Blender writes them to a PNG of 16 bits, sRGB's curve undone."""
    own: Any = bpy.data.images.new("Reference Tracer Colours", len(table), 1, float_buffer=True)
    image = made_for(tmp, own)
    opaque = np.ones((len(table), 1), np.float32)
    image.pixels.foreach_set(np.hstack((table, opaque)).ravel())
    tmp.render.dither_intensity = 0.0
    set_format(tmp.render, "PNG", "RGB", "16")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "colours.png"
        image.save_render(str(path), scene=tmp)
        return curve_undone(read(tmp, path, "Non-Color")[0, :, :3].astype(np.float64))


def _looked_up(table: Colors, shown: Floats) -> Any:
    """Return the function that maps each colour of a table (n, 3) to what is shown of it."""

    def transform(color: Floats) -> Floats:
        flat = color.reshape(-1, 3)
        found, index = np.unique(flat, axis=0, return_inverse=True)
        nearest = [int(np.abs(table - c).sum(axis=1).argmin()) for c in found]
        return shown[nearest][index.reshape(-1)].reshape(color.shape)

    return transform
