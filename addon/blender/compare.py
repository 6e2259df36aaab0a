"""Trace and Compare, up to where Blender is no longer needed, and from where it is again.

`gather` makes everything that only Blender can give, in one uninterrupted call. What it returns
holds no reference to Blender's data, so that tracing may go on while the user works.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..compare.comparison import Comparison, trace_and_compare
from ..manifest import Manifest
from ..report import files, folders, page
from ..scene import Scene
from ..scene_files import diagnosed
from ..tracer.progress import Work, scaled
from ..tracer.render import Steps, steps
from ..tracer.settings import Settings
from . import images
from .camera import export_camera
from .engine import export_for_render
from .export import export
from .planes import stand_ins
from .temporary import temporary_scene
from .unmodelled import of_shading
from .viewport import (
    SAMPLE_RADIUS,
    anti_aliasing,
    choose_source,
    picture,
    prepare,
    use_view_shading,
)


@dataclass(frozen=True, eq=False)
class Gathered:
    """The exported scene, how to trace it, and Blender's own picture of it."""

    scene: Scene
    manifest: Manifest
    settings: Settings
    picture: NDArray[np.float32]
    blender: dict[str, Any]

    def steps(self, trace: Steps = steps) -> Work[Comparison]:
        """Do the work that is left; yields the share of it that is done."""
        manifest = yield from diagnosed(self.scene, self.manifest)
        return (
            yield from trace_and_compare(
                self.scene, manifest, self.settings, self.picture, self.blender, trace
            )
        )


def gather(
    context: Any,
    settings: Settings | None = None,
    judge: str | None = None,
    as_is: bool | None = None,
) -> Gathered:
    """Export the context's scene and view layer, and have Blender draw them.

    Parameters
    ----------
    context : bpy.types.Context
    settings, judge, as_is : optional
        In place of what the scene stores.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    RuntimeError
        If Blender makes no picture of it.
    """
    scene, layer = context.scene, context.view_layer.name
    stored = scene.reference_tracer
    like_for_like = stored.shading == "LIKE_FOR_LIKE" if as_is is None else not as_is
    settings = settings or stored.settings()
    if like_for_like:  # Blender's picture has one sample in a pixel: so has the traced one
        settings = replace(settings, samples=1)
    source = choose_source(judge or stored.judge)
    view_shading = None if like_for_like or source != "viewport" else _solid_shading(context)
    export_camera(scene)  # first, as its errors name the user's scene and say what to do
    with temporary_scene(scene, layer, source) as tmp:
        if view_shading:
            use_view_shading(tmp, view_shading)
        used = prepare(tmp, like_for_like)
        used["shading_of"] = "3D view" if view_shading else "scene"
        used["anti_aliasing"] = smooth = anti_aliasing(tmp, source, like_for_like)
        if source == "viewport":
            with context.temp_override(scene=tmp, view_layer=tmp.view_layers[layer]):
                exported, manifest = export(bpy.context.evaluated_depsgraph_get())
        else:
            exported, manifest = export_for_render(tmp)
        if not like_for_like:
            own = [
                replace(u, object=f"scene '{scene.name}'") for u in of_shading(tmp, source, smooth)
            ]
            manifest = replace(manifest, unmodelled=(*manifest.unmodelled, *own))
        with stand_ins(tmp, layer, exported) as exported:
            drawn = picture(tmp, layer, source, exported.camera, like_for_like)
    blender = {
        "version": bpy.app.version_string,
        "source": source,
        "sample_radius": SAMPLE_RADIUS[source],
        "settings": used,
    }
    return Gathered(exported, manifest, settings, drawn, blender)


def compare_to_folder(
    context: Any,
    directory: str,
    trace: Steps = steps,
    trade: bool = False,
    extremes: bool = False,
    **choices: Any,
) -> Work[Comparison]:
    """Gather at once; return the work of tracing, comparing and writing the files.

    With `trade` and `extremes`, these are measured for the page, too. On failure the folder's JSON
    says why. Raises what :func:`gather` and `compare.compare` raise, and OSError.
    """
    folder = made(directory)  # now, not after all the work
    with _failure_written(folder):
        work = gather(context, **choices).steps(trace)
        return _written(folder, work, trade, extremes, trace)


def made(directory: str) -> Path:
    """Return a folder that is there now; its path is as Blender writes it, or as the shell does.

    Raises
    ------
    OSError
        If it cannot be made or written.
    """
    folder = Path(bpy.path.abspath(directory))  # // is beside the file
    folders.make(folder)
    return folder


def _written(
    folder: Path, work: Work[Comparison], trade: bool, extremes: bool, trace: Steps
) -> Work[Comparison]:
    share = 0.2 if trade or extremes else 0.8  # of the comparison
    with _failure_written(folder):
        comparison = yield from scaled(work, 0.0, share)
        finding = page.extras(comparison, trade, extremes, trace)
        extras = yield from scaled(finding, share, 1 - share)
        files.write(folder, comparison, images.save_png, extras)
    yield 1.0
    return comparison


@contextmanager
def _failure_written(folder: Path) -> Iterator[None]:
    try:
        yield
    except Exception as error:
        with suppress(OSError):  # which may be what the error is
            files.write_failure(folder, error)
        raise


def export_open_file(context: Any) -> tuple[Scene, Manifest, Settings]:
    """Export the context's scene as a render has it, with the settings that it stores.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    export_camera(context.scene)
    with temporary_scene(context.scene, context.view_layer.name) as tmp:
        exported, manifest = export_for_render(tmp)
    return exported, manifest, context.scene.reference_tracer.settings()


def _solid_shading(context: Any) -> Any:
    """Return the solid shading of the 3D view the user is in, else of the window's first one."""
    areas = [context.area, *(context.window.screen.areas if context.window else ())]
    for area in areas:
        if area and area.type == "VIEW_3D" and area.spaces.active.shading.type == "SOLID":
            return area.spaces.active.shading
    return None
