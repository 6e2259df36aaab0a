"""Blender's own exporters judge the readers of mesh files: a table of scenes and formats.

A scene is exported by Blender with its default options, read again, and traced with the scene's own
camera. Every pixel must show the object that the scene's own export shows: only beside edges, as
far as the file's digits move them, it may be the other one. What an exporter itself leaves out or
adds is a `Cell`, with its reason: the same is done to the scene in Blender.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray
from reference_tracer.blender.reading.export import export
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, Scene
from reference_tracer.tracer.vector import transform_points
from reference_tracer_meshes.load import load_meshes, scene_of_meshes

from .exporter_scenes import make_scene
from .scenes import Build

HALF = 2.0**-24  # of a float32's value: what rounding to it may change
# A point is the sum of four products of float32 with a matrix that is rounded itself; glTF has
# matrices taken apart, a node for each parent.
ROUNDINGS = 4
OF_NODES = 8
DIGITS = 5e-7  # metres: OBJ has six digits after the point
DIRECTIONS = 16
NOTHING = ""


@dataclass(frozen=True)
class Format:
    """A format with the options that Blender's exporter has by default."""

    name: str
    suffix: str
    write: Callable[[str], object]
    up: str | None  # that the default options give it; None: as it is read by default
    has_objects: bool
    roundings: int = ROUNDINGS
    digits: float = 0.0  # metres


def _gltf(kind: str) -> Callable[[str], object]:
    return lambda path: bpy.ops.export_scene.gltf(filepath=path, export_format=kind)


FORMATS = (
    Format("obj", "obj", lambda p: bpy.ops.wm.obj_export(filepath=p), None, True, digits=DIGITS),
    Format("ply", "ply", lambda p: bpy.ops.wm.ply_export(filepath=p), None, False),
    Format(
        "ply, ascii",
        "ply",
        lambda p: bpy.ops.wm.ply_export(filepath=p, ascii_format=True),
        None,
        False,
        digits=DIGITS,
    ),
    Format("stl", "stl", lambda p: bpy.ops.wm.stl_export(filepath=p), None, False),
    Format("glb", "glb", _gltf("GLB"), None, True, OF_NODES),
    Format("gltf", "gltf", _gltf("GLTF_SEPARATE"), None, True, OF_NODES),
    Format("usd", "usdc", lambda p: bpy.ops.wm.usd_export(filepath=p), None, True, OF_NODES),
)


@dataclass(frozen=True)
class Cell:
    """Why a file holds another scene than Blender shows, and how to have Blender show that."""

    reason: str
    as_written: Callable[[], object]


def _show(*names: str) -> None:
    for name in names:
        obj = bpy.data.objects[name]
        obj.hide_viewport = False
        obj.hide_set(False)


def _show_all() -> None:
    for child in bpy.context.view_layer.layer_collection.children:
        child.exclude = False
    _show(*bpy.data.objects.keys())


def _hide(name: str) -> None:
    bpy.data.objects[name].hide_viewport = True


def _without_modifiers() -> None:
    for obj in bpy.data.objects:
        for modifier in obj.modifiers:
            modifier.show_viewport = False
    _show_all()


def _in_world_space() -> None:
    for obj in bpy.data.objects:
        if obj.type == "MESH":
            obj.data.transform(obj.matrix_world)
            obj.matrix_world = Matrix()


_SCALED = Cell("a polygon that is not flat is cut by its scaled shape", _in_world_space)
_WRITES_HIDDEN = bpy.app.version >= (5, 2, 0)  # 4.2, 4.5 and 5.0 do not
_EYE = Cell("what only the eye hides is written", lambda: _show("Hidden"))


def _at_rest() -> None:
    bpy.data.armatures["Rig"].pose_position = "REST"


_GLTF = {
    "posed_rig": Cell("bones are written at rest", _at_rest),
    "modifiers": Cell("modifiers are not applied; hidden objects are written", _without_modifiers),
    "metaballs": Cell("metaballs are not written", lambda: _hide("Metaball")),
    "node_instances": Cell("instances of geometry nodes are not written", lambda: _hide("Points")),
    "hidden_and_empty": Cell("hidden and excluded objects are written", _show_all),
}


def _as_cages() -> None:
    for obj in bpy.data.objects:
        for modifier in obj.modifiers:
            modifier.show_viewport = modifier.type != "SUBSURF"


def _without_keys() -> None:
    for keys in bpy.data.shape_keys:
        for block in keys.key_blocks:
            block.value = 0


_USD = {
    "shape_keys": Cell("shape keys are written apart, and not read", _without_keys),
    "modifiers": Cell("subdivision is written as a scheme, and not read", _as_cages),
    "curves": Cell("a curve is written as hair, which is named", lambda: _hide("Curve")),
    "hidden_and_empty": _EYE,
}
CELLS: dict[tuple[str, str], Cell] = {
    **{("scales", suffix): _SCALED for suffix in ("obj", "ply")},
    **({("hidden_and_empty", suffix): _EYE for suffix in ("ply", "stl")} if _WRITES_HIDDEN else {}),
    **{(scene, suffix): cell for scene, cell in _GLTF.items() for suffix in ("glb", "gltf")},
    **{(scene, "usdc"): cell for scene, cell in _USD.items()},
}

Owners = NDArray[np.str_]  # (h, w): the name of the object that a pixel shows


@dataclass(frozen=True)
class Row:
    """One cell of the table."""

    scene: str
    format: str
    differ: int  # pixels
    beside_edges: int  # of these
    reach: float  # pixels: how far the file's digits may move an edge
    reason: str  # what the exporter leaves out, or adds
    seen: int = 0  # pixels in which the scene shows something
    error: str = ""

    @property
    def elsewhere(self) -> int:
        """How many pixels are wrong."""
        return self.differ - self.beside_edges

    @property
    def is_right(self) -> bool:
        """Whether the file was read as Blender wrote it."""
        return not (self.elsewhere or self.error)


def judge(
    name: str,
    folder: Path,
    build: Build,
    formats: Iterable[Format] = FORMATS,
    stated: bool = True,
    seed: int = 0,
) -> Iterator[Row]:
    """Yield a scene's row for each format; if not `stated`, by the scene as it is shown."""
    for kind in formats:
        cell = CELLS.get((name, kind.suffix))
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        make_scene(name, build, seed)
        path = folder / f"{name}.{kind.suffix}"
        kind.write(str(path))
        if stated and cell:
            cell.as_written()
            bpy.context.view_layer.update()
        own = export(bpy.context.evaluated_depsgraph_get())[0]
        yield _row(name, kind, own, path, cell.reason if cell else "")


def _row(name: str, kind: Format, own: Scene, path: Path, reason: str) -> Row:
    reach = reach_of(own, kind)
    size = own.camera.width, own.camera.height
    wanted = owners(own, kind)
    seen = int((wanted != NOTHING).sum())
    try:
        scene = scene_of_meshes(load_meshes(path, kind.up), own.camera, *size)
    except Exception as error:
        return Row(name, kind.name, 0, 0, reach, reason, seen, f"{type(error).__name__}: {error}")
    found = owners(scene, kind)
    differ = wanted != found
    beside = np.zeros_like(differ)
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    for dx, dy in zip(reach * np.cos(angles), reach * np.sin(angles), strict=True):
        if (differ & ~beside).any():
            beside |= differ & (owners(moved(own, dx, dy), kind) == found)
    return Row(name, kind.name, int(differ.sum()), int(beside.sum()), reach, reason, seen)


def owners(scene: Scene, kind: Format) -> Owners:
    """Return the object that each pixel shows, as the format can tell them apart."""
    names = [canonical(scene.objects[i.object], kind) for i in scene.instances]
    return np.array([*names, NOTHING])[render(scene).instance_index]


def canonical(name: str, kind: Format) -> str:
    """Return an object's name as a file of this format, and its reader, have it."""
    if not kind.has_objects:
        return "something"
    if kind.suffix == "obj":
        return name.replace(" ", "_")
    if kind.suffix == "usdc":
        return re.sub(r"(_\d+)+$", "", re.sub(r"\W", "_", name))  # instances are numbered
    return re.sub(r" \(node \d+\)$", "", name)


def moved(scene: Scene, dx: float, dy: float) -> Scene:
    """Return a scene with rays that pass (dx, dy) pixels beside the pixels' centres."""
    window, camera = scene.camera.window, scene.camera
    x = dx * (window.right - window.left) / camera.width
    y = dy * (window.top - window.bottom) / camera.height
    window = replace(
        window,
        left=window.left + x,
        right=window.right + x,
        bottom=window.bottom + y,
        top=window.top + y,
    )
    return scene.seen_by(replace(camera, window=window))


def reach_of(scene: Scene, kind: Format) -> float:
    """Return how far a file's digits may move a point in the picture, twice that, in pixels."""
    points = np.concatenate([_world(scene, i) for i in scene.instances])
    error = kind.roundings * HALF * np.abs(points).max() + kind.digits
    return 2 * error / pixel_size(scene.camera, points)


def _world(scene: Scene, instance: Any) -> NDArray[np.float64]:
    return transform_points(instance.world_from_object, scene.meshes[instance.mesh].vertices.T).T


def pixel_size(camera: Camera, points: NDArray[np.float64]) -> float:
    """Return the size of a pixel at the nearest of the points, in metres."""
    backward, position = camera.world_from_camera[:3, 2:].T
    depth = ((position - points) * backward).sum(axis=1)
    nearest = max(depth.min(), camera.clip_start)
    return float(nearest * (camera.window.right - camera.window.left) / camera.width)
