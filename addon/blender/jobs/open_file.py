"""The options of a comparison of the open file, and the export of its scene."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import Any

from bpy.types import Context

from ...manifest import Manifest
from ...pictures.palette import VIEWPORT, By, GivenColors, Palette
from ...scene import Scene
from ...tracer.render import Tracer
from ...tracer.settings import Settings
from ..drawing.judge import Judge
from ..drawing.judges import ENGINE
from ..drawing.picture import prepare_scene
from ..evaluating import export_for_render
from ..reading.camera import export_camera
from ..temporary import everything, temporary_scene


@dataclass(frozen=True)
class Choices:
    """How to compare."""

    settings: Settings
    judge: str  # its name in capitals, or AUTO
    as_is: bool  # Blender draws with the shading that the scene has
    colors: By | GivenColors  # where the colours come from; as it is, they are the viewport's
    identity: bool  # find each pixel's owner, too
    self_check: bool  # the comparison is tried on known faults, too
    diagnose: bool  # whether to diagnose unexplained pixels
    renderer: str = ""  # what another engine, or an image, was made by: a name in RENDERERS
    filter: float = 0.0  # pixels: how far its anti-aliasing reaches
    tracer: Tracer | None = None  # what traces; by default, this process

    @classmethod
    def of(cls, scene: Any, given: dict[str, Any]) -> Choices:
        """Return what is given; what is not, or is None, is as a `bpy.types.Scene` stores it."""
        stored = scene.reference_tracer
        own = cls(
            stored.settings(),
            (stored.engine or ENGINE) if stored.judge == ENGINE else stored.judge,
            stored.shading == "AS_IS",
            By(stored.colors.lower()),
            stored.identity,
            stored.self_check,
            stored.diagnose,
            stored.renderer.lower().replace("auto", ""),
            stored.filter,
        )
        return replace(own, **{name: value for name, value in given.items() if value is not None})


def export_open_file(
    context: Context,
    judge: Judge | None = None,
    palette: Palette = VIEWPORT,
    whole: bool = False,
) -> tuple[Scene, Manifest, Settings]:
    """Export the context's scene as a render has it, with the settings that it stores.

    For a judge, it is exported as for a comparison with its picture. The `whole` is also what its
    camera cannot see.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    scene: Any = context.scene
    layer = context.view_layer.name
    stored = scene.reference_tracer
    export_camera(scene)  # first: its errors name the user's scene, say what to do
    with temporary_scene(scene, layer, judge.ignores if judge else None, palette) as tmp:
        if judge:
            prepare_scene(tmp, judge, stored.shading == "LIKE_FOR_LIKE")
        with everything(tmp) if whole else nullcontext():
            exported, manifest = export_for_render(tmp, judge)
    return exported, manifest, stored.settings()
