"""Reads the meshes of a file by its suffix, and makes a scene of them."""

from __future__ import annotations

import warnings
from collections.abc import Hashable, Iterable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TypeVar

import numpy as np
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.files.file_kinds import check_is_file
from reference_tracer.files.scenes import Account
from reference_tracer.framing import ANGLE, BACKWARD, SIZE, Choice, axes_of, framing, shown_points
from reference_tracer.manifest import Effect, Unmodelled
from reference_tracer.opened import Opened, file_manifest
from reference_tracer.scene import Camera, Instance, Scene, SceneError, check_size

from . import FORMATS
from .contents import Contents

_BLENDERS_OBJ = "it is taken to have Y up, as Blender writes it unless told otherwise: then up=z"
_Y_UP = frozenset((".glb", ".gltf"))  # as their specification says; the others do not say
_SAYS_ITSELF = "usd"

Thing = TypeVar("Thing", bound=Hashable)


def load_meshes(path: str | Path, up: str | None = None) -> Contents:
    """Read the meshes of a file.

    `up` is the file's axis that is up, "y" or "z": by default Y of glTF, as its specification says,
    and of an .obj that Blender wrote, as it does by default; Z of the others, which do not say. A
    USD file says it itself.

    Returns
    -------
    Contents
        Z up: (x, y, z) of a file with Y up becomes (x, -z, y), to the bit.

    Raises
    ------
    SceneError
        If there is no such file, it cannot be read, or it holds no triangle.
    MissingLibraryError
        If an optional library is not installed that it takes.
    """
    path = Path(path)
    check_is_file(path)
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise SceneError(f"'{path}' is no mesh: a mesh is one of {', '.join(FORMATS)}")
    if up and FORMATS[suffix] == _SAYS_ITSELF:
        raise SceneError(f"'{path}' says itself which axis is up: leave out up=")
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # a library's, of its own work
            found: Contents = import_module(f".{FORMATS[suffix]}", __package__).read(path)
    except MissingLibraryError as error:
        raise MissingLibraryError(f"'{path}': {error}") from error
    except Exception as error:  # each library raises its own kinds
        why = str(error) or type(error).__name__
        raise SceneError(f"'{path}' cannot be read as a mesh: {why}") from error
    if not any(len(placed.mesh.triangles) for placed in found.placed):
        but = "".join(f"; {said}" for said in (*found.missing, *found.notes))
        raise SceneError(f"'{path}' holds no triangles, and a ray meets nothing else{but}")
    is_blenders = suffix == ".obj" and path.read_bytes()[:9] == b"# Blender"
    if up is None and is_blenders:
        found = replace(found, notes=(*found.notes, _BLENDERS_OBJ))
    if (up or ("y" if is_blenders or suffix in _Y_UP else "z")) == "y":
        found = _turned(found)
    return found


def _turned(found: Contents) -> Contents:
    """Return the same with Z up instead of Y."""
    placed = (
        part._replace(world_from_object=np.stack((m[0], 0 - m[2], m[1], m[3])))
        for part, m in ((part, part.world_from_object) for part in found.placed)
    )
    return replace(found, placed=tuple(placed))


def open_meshes(path: Path, choice: Choice) -> Opened:
    """Return the scene of a mesh's file with its account; see the package's function."""
    contents = load_meshes(path, choice.up)
    missing = (Unmodelled(path.name, said, effect=Effect.UNPLACED) for said in contents.missing)
    size = choice.size(SIZE)
    camera = choice.seen_by.camera if choice.seen_by else None
    if choice.eye:
        camera = choice.placed(*size)
    try:
        scene = scene_of_meshes(contents, camera, *size, choice.angle or ANGLE)
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error
    account = Account((*missing, *contents.unmodelled), contents.notes)
    return Opened(scene, file_manifest(path, scene, account))


def _numbered(things: Iterable[Thing]) -> dict[Thing, int]:
    """Return the number of each different thing, in the order in which they come."""
    return {thing: number for number, thing in enumerate(dict.fromkeys(things))}


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
    colors = np.stack((greys, greys, greys, np.ones(len(greys))), axis=1).astype(np.float32)
    instances = tuple(
        Instance(meshes[part.mesh], number, part.world_from_object, colors[number : number + 1])
        for part in placed
        for number in (objects[part.object],)
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
