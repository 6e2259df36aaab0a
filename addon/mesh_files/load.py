"""Reads the meshes of a file by its suffix, and makes a scene of them."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Hashable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from ..arrays import Floats
from ..file_kinds import check_is_file
from ..framing import ANGLE, BACKWARD, axes_of, framing, shown_points
from ..scene import Camera, Instance, Scene, SceneError, check_size
from .contents import Contents
from .gltf import read_gltf
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .stl import read_stl
from .usd import read_usd

READERS: dict[str, Callable[[Path], Contents]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".off": read_off,
    ".stl": read_stl,
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".usd": read_usd,
    ".usda": read_usd,
    ".usdc": read_usd,
    ".usdz": read_usd,
}
_BLENDERS_OBJ = "it is taken to have Y up, as Blender writes it unless told otherwise: then --up z"
_Y_UP = frozenset((".glb", ".gltf"))  # as their specification says; the others do not say

Thing = TypeVar("Thing", bound=Hashable)


def load_meshes(path: str | Path, up: str | None = None) -> Contents:
    """Read the meshes of a file.

    `up` is the file's axis that is up, "y" or "z": by default Y of glTF, as its specification says,
    and of an .obj that Blender wrote, as it does by default; Z of the others, which do not say.

    Returns
    -------
    Contents
        Z up: (x, y, z) of a file with Y up becomes (x, -z, y), to the bit.

    Raises
    ------
    SceneError
        If there is no such file, it cannot be read, or it holds no triangle.
    """
    path = Path(path)
    check_is_file(path)
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise SceneError(f"'{path}' is no mesh: a mesh is one of {', '.join(READERS)}")
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # a library's, of its own work
            found = READERS[suffix](path)
    except Exception as error:  # each reader raises its own kinds
        why = str(error) or type(error).__name__
        raise SceneError(f"'{path}' cannot be read as a mesh: {why}") from error
    if not any(len(placed.mesh.triangles) for placed in found.placed):
        but = "".join(f"; {said}" for said in (*found.missing, *found.notes))
        raise SceneError(f"'{path}' holds no triangles, and a ray meets nothing else{but}")
    is_blenders = suffix == ".obj" and path.read_bytes()[:9] == b"# Blender"
    if up is None and is_blenders:
        found = replace(found, notes=(*found.notes, _BLENDERS_OBJ))
    default = found.up or ("y" if is_blenders or suffix in _Y_UP else "z")
    if (up or default) == "y":
        found = _turned(found)
    return found


def _turned(found: Contents) -> Contents:
    """Return the same with Z up instead of Y."""
    placed = (
        part._replace(world_from_object=np.stack((m[0], 0 - m[2], m[1], m[3])))
        for part, m in ((part, part.world_from_object) for part in found.placed)
    )
    return Contents(tuple(placed), found.notes, found.missing)


def _numbered(things: Iterable[Thing]) -> dict[Thing, int]:
    """Return the number of each different thing, in the order in which they come."""
    return {thing: number for number, thing in enumerate(dict.fromkeys(things))}


def _instance(mesh: int, number: int, matrix: Floats, greys: Floats) -> Instance:
    grey = greys[number]
    return Instance(mesh, number, matrix, np.array([[grey, grey, grey, 1]], np.float32))


def scene_of_meshes(
    contents: Contents,
    camera: Camera | None,
    width: int,
    height: int,
    angle: float = ANGLE,
) -> Scene:
    """Return a scene of meshes, each object in its own grey.

    It is seen by `camera`, or else by one that frames the meshes, with a vertical angle of view of
    `angle` degrees.

    Raises
    ------
    SceneError
        If there are no meshes, they are too large, or the picture has no pixel.
    """
    placed = contents.placed
    if not placed:
        raise SceneError("There are no meshes to make a scene of: load_meshes gives some.")
    objects = _numbered(part.object for part in placed)
    meshes = _numbered(part.mesh for part in placed)  # by identity
    greys = np.linspace(0.8, 0.3, len(objects))
    instances = tuple(
        _instance(meshes[part.mesh], objects[part.object], part.world_from_object, greys)
        for part in placed
    )
    shown = tuple(meshes)
    if camera is None:
        points = shown_points(shown, instances)
        check_size(width, height)
        try:
            with np.errstate(all="ignore"):  # Camera refuses what is not finite
                camera = framing(points, axes_of(BACKWARD), width, height, angle)
        except SceneError as error:
            raise SceneError("it is too large to be framed: scale it down") from error
    return Scene(camera, shown, instances, objects=tuple(objects))
