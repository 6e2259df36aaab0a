"""Writes and reads scenes as .npz.

A .npz is read without pickle: it can hold numbers and nothing that runs.
"""

from __future__ import annotations

import json
import math
import warnings
from itertools import zip_longest
from pathlib import Path
from zipfile import ZipFile

import numpy as np

from .arrays import Array
from .checked_json import camera_of, whole
from .file_kinds import check_is_file
from .scene import Instance, Mesh, Plane, Scene, SceneError
from .tracer.memory import free_memory

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
        say = f"'{path}' is cut off or damaged: copy it again, or export it again ({error})"
        raise SceneError(say) from error


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
    if f"{name}.npy" not in stored.namelist():
        raise SceneError(f"it has no array '{name}': `reftrace export` writes a scene with all")
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
