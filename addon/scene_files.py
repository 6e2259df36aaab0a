"""Writes and reads scenes as .npz, and reads meshes from OBJ, PLY, STL and glTF files.

A .npz is read without pickle: it can hold numbers and nothing that runs.
"""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Iterator
from dataclasses import replace
from itertools import takewhile, zip_longest
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np

from .arrays import Array, Floats
from .checked_json import camera_of, whole
from .framing import ANGLE, BACKWARD, axes_of, framing, shown_points
from .mesh_files.gltf import read_gltf
from .scene import Camera, Instance, Mesh, Plane, Scene, SceneError, check_size, drop_non_finite
from .tracer.memory import free_memory

Placed = tuple[Mesh, Floats]  # with its world_from_object, (4, 4)

MESH_SUFFIXES = (".obj", ".ply", ".stl", ".glb", ".gltf")
_SCHEMA = "reference_tracer.scene/1"
_ARRAYS = {  # the arrays of a .npz and their shapes, by what has them
    "mesh": {"vertices": "n3", "triangles": "n3", "slots": "n", "corner_colors": "n34"},
    "instance": {"world_from_object": "44", "colors": "n4"},
    "plane": {"point": "3", "normal": "3", "color": "4"},
}


def save_scene(path: str | Path, scene: Scene) -> None:
    """Write a scene to a compressed .npz."""
    head = {
        "schema": _SCHEMA,
        "camera": scene.camera.to_dict(),
        "objects": scene.objects,
        "background": scene.background.tolist(),
        "meshes": [
            {"name": m.name, "corner_colors": m.corner_colors is not None} for m in scene.meshes
        ],
        "instances": [{"mesh": i.mesh, "object": i.object} for i in scene.instances],
        "planes": [{"object": p.object} for p in scene.planes],
    }
    arrays: dict[str, Array] = {"scene": np.array(json.dumps(head, default=np.generic.item))}
    parts = scene.meshes, scene.instances, scene.planes
    for (part, names), things in zip(_ARRAYS.items(), parts, strict=True):
        for k, thing in enumerate(things):
            held = {f"{part}{k}_{name}": getattr(thing, name) for name in names}
            arrays |= {name: array for name, array in held.items() if array is not None}
    with open(path, "wb") as file:  # given a name, numpy would add .npz to one in capitals
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # none is "allow_pickle"


def load_scene(path: str | Path) -> Scene:
    """Read a scene from a .npz that :func:`save_scene` wrote.

    Raises
    ------
    SceneError
        If there is no such file, it is not a scene, or its content is inconsistent.
    """
    check_is_file(path)
    try:
        with ZipFile(path) as stored, warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # of headers that an older numpy wrote
            return _scene(stored)
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error
    except Exception as error:  # zip, zlib, numpy, JSON: each has its own ways to say no
        raise SceneError(f"'{path}' is not a scene that Reference Tracer wrote: {error}") from error


def _scene(stored: ZipFile) -> Scene:
    head = json.loads(str(_array(stored, "scene", "", "U")))
    if head.get("schema") != _SCHEMA:
        raise SceneError(f"its schema is {head.get('schema')!r}, not {_SCHEMA!r}")

    def arrays(kind: str, k: int, without: str = "") -> dict[str, Array]:
        shapes = {name: shape for name, shape in _ARRAYS[kind].items() if name != without}
        return {name: _array(stored, f"{kind}{k}_{name}", s) for name, s in shapes.items()}

    meshes = [
        Mesh(**arrays("mesh", k, "" if m["corner_colors"] else "corner_colors"), name=m["name"])
        for k, m in enumerate(head["meshes"])
    ]
    instances = [
        Instance(whole(i, "mesh", ""), whole(i, "object", ""), **arrays("instance", k))
        for k, i in enumerate(head["instances"])
    ]
    planes = [
        Plane(whole(p, "object", ""), **arrays("plane", k)) for k, p in enumerate(head["planes"])
    ]
    camera = camera_of(head["camera"])
    background, objects = np.array(head["background"]), tuple(map(str, head["objects"]))
    return Scene(camera, tuple(meshes), tuple(instances), tuple(planes), background, objects)


def _array(stored: ZipFile, name: str, shape: str, kinds: str = "fiu") -> Array:
    """Return one array of a .npz, once its header says that it is what is asked for."""
    info = stored.getinfo(f"{name}.npy")
    read = np.lib.format
    with stored.open(info) as file:
        read.read_magic(file)
        own, _, dtype = read.read_array_header_1_0(file)
        fits = all(n == str(m) or (n == "n" and m is not None) for n, m in zip_longest(shape, own))
        if not fits or dtype.kind not in kinds:
            raise SceneError(f"{name} holds {own} of {dtype}, not ({', '.join(shape)}) numbers")
        size = math.prod(own) * dtype.itemsize
        if size >= info.file_size:
            raise SceneError(f"{name} is not as long as it says: write the file again")
        if size > 1 << 20 and size > (free_memory() or size):  # systems kill who takes too much
            raise SceneError(f"{name} takes {size / 2**30:.1f} GiB, more than is free")
        file.seek(0)
        return read.read_array(file, allow_pickle=False)


def check_is_file(path: str | Path) -> None:
    """Raise a SceneError if there is no such file, or it cannot be read."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise SceneError(f"'{path}' is no file but a folder, or a pipe: name a file")
    try:
        Path(path).open("rb").close()
    except FileNotFoundError:
        raise SceneError(f"there is no file '{path}'") from None
    except (OSError, ValueError) as error:  # a name may be too long, or none
        raise SceneError(f"'{path}' cannot be read: {getattr(error, 'strerror', error)}") from error


def load_meshes(path: str | Path, up: str | None = None) -> list[Placed]:
    """Read the meshes of an OBJ, PLY, STL, GLB or glTF file.

    `up` is the file's axis that is up, "y" or "z": by default Y of glTF, as its specification
    says, and Z of the others, which do not say.

    Returns
    -------
    list of (Mesh, world_from_object)
        Z up: (x, y, z) of a file with Y up becomes (x, -z, y), to the bit. Triangles that are not
        finite are left out.

    Raises
    ------
    SceneError
        If there is no such file, it cannot be read, or it holds no triangle.
    """
    path = Path(path)
    check_is_file(path)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # trimesh's, of its own work
            kind = path.suffix.lower().lstrip(".")
            is_gltf = kind in ("glb", "gltf")
            is_y_up = (up or ("y" if is_gltf else "z")) == "y"
            if is_gltf:
                found = read_gltf(path).placed
                out = [(replace(p.mesh, name=p.object), p.world_from_object) for p in found]
            else:
                out = _read_by_trimesh(path, kind)
    except Exception as error:  # each of trimesh's readers raises its own kinds
        why = str(error)
        if "unexpected length" in why:  # trimesh takes a PLY's first list for the length of all
            why = "it is cut off, or its faces differ in length: save it as triangles"
        raise SceneError(f"'{path}' cannot be read as a mesh: {why}") from error
    if is_y_up:
        out = [(mesh, np.stack((m[0], 0 - m[2], m[1], m[3]))) for mesh, m in out]
    if not any(len(mesh.triangles) for mesh, _ in out):
        raise SceneError(f"'{path}' holds no triangles.")
    return out


def _read_by_trimesh(path: Path, kind: str) -> list[Placed]:
    import trimesh

    if kind == "ply":
        _refuse_strips(path)
    loaded: Any = trimesh.load(
        path, file_type=kind, force="scene", process=False, skip_materials=True
    )
    return [m for node in loaded.graph.nodes_geometry for m in _mesh_of(loaded, node)]


def _refuse_strips(path: Path) -> None:
    """Raise a SceneError if a PLY has triangle strips, which trimesh would leave out."""
    with path.open("rb") as file:
        head = iter(file.readline, b"")
        if any(line.startswith(b"element tristrips") for line in takewhile(_is_head, head)):
            raise SceneError("it holds triangle strips: save it as triangles")


def _is_head(line: bytes) -> bool:
    return not line.startswith(b"end_header")


def _mesh_of(loaded: Any, node: str) -> Iterator[Placed]:
    """Yield the mesh of a node of a trimesh.Scene, if it has triangles."""
    matrix, name = loaded.graph[node]
    geometry = loaded.geometry[name]
    faces = getattr(geometry, "faces", None)  # a point cloud has none
    if faces is not None and len(faces):
        vertices, keep = drop_non_finite(np.asarray(geometry.vertices), faces)
        yield Mesh(vertices, faces[keep], name=str(name)), np.array(matrix)


def scene_of_meshes(
    meshes: list[Placed],
    camera: Camera | None,
    width: int,
    height: int,
    angle: float = ANGLE,
) -> Scene:
    """Return a scene of meshes, each in its own grey.

    It is seen by `camera`, or else by one that frames the meshes, with a vertical angle of view of
    `angle` degrees.

    Raises
    ------
    SceneError
        If there are no meshes, they are too large, or the picture has no pixel.
    """
    if not meshes:
        raise SceneError("There are no meshes to make a scene of: load_meshes gives some.")
    greys = np.linspace(0.8, 0.3, len(meshes))
    instances = tuple(
        Instance(k, k, matrix, np.array([[g, g, g, 1]], np.float32))
        for k, ((_, matrix), g) in enumerate(zip(meshes, greys, strict=True))
    )
    shown = tuple(mesh for mesh, _ in meshes)
    names = tuple(mesh.name for mesh in shown)
    if camera is None:
        points = shown_points(shown, instances)
        check_size(width, height)
        try:
            with np.errstate(all="ignore"):  # Camera refuses what is not finite
                camera = framing(points, axes_of(BACKWARD), width, height, angle)
        except SceneError as error:
            raise SceneError("it is too large to be framed: scale it down") from error
    return Scene(camera, shown, instances, objects=names)
