"""Scenes with the faults for which Blender is needed, for the diagnosis.

An exporter that goes wrong takes another camera, frame, matrix or mesh than the scene's; only
Blender has these. They are exported when a diagnosis asks for them. The user's scene stays as it
is.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import islice

import bpy

from ....causes.case import MOST_VARIANTS, WHOLE, Variant
from ....errors import EXPECTED
from ....pictures.palette import VIEWPORT, Palette
from ...evaluating import export_for_render
from ...temporary import everything, temporary_scene
from . import cameras, frames, layers, matrices, meshes
from .origin import Origin

KINDS = (
    cameras.variants,
    matrices.variants,
    meshes.variants,
    layers.variants,
    frames.variants,  # last: another frame moves what the others look at
)


def variants(
    name: str, layer: str, ignored: Collection[str] | None, palette: Palette = VIEWPORT
) -> Iterator[Variant]:
    """Yield a scene with all that its view leaves out, then with one fault each.

    Until the last there is a temporary copy of the scene.

    Parameters
    ----------
    name : str
        Of a `bpy.types.Scene`, in full. If there is none any more, there are no variants.
    layer : str
        A view layer of it.
    ignored : collection of str, optional
        What the judge does not show: see `temporary_scene`.
    palette : Palette
        The colours of the comparison.
    """
    scene = next((s for s in bpy.data.scenes if s.name_full == name), None)
    if scene is None or layer not in scene.view_layers:
        return
    scene.view_layers[layer].update()  # the world matrices of its objects
    with temporary_scene(scene, layer, ignored, palette) as tmp, everything(tmp):
        try:
            origin = Origin(scene, layer, tmp, export_for_render(tmp)[0], palette)
        except EXPECTED:
            return
        yield Variant(WHOLE, origin.exported)
        yield from islice(_made(origin), MOST_VARIANTS - 1)


def _made(origin: Origin) -> Iterator[Variant]:
    for kind in KINDS:
        try:
            yield from kind(origin)
        except EXPECTED:  # what cannot be exported cannot have been shown
            continue
