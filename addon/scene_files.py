"""Writes and reads scenes as .npz.

A .npz is read without pickle: it can hold numbers and nothing that runs.
"""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Callable, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple, TypeVar
from zipfile import ZipFile

import numpy as np

from .arrays import Array
from .checked_json import Content, camera_of, numbers, part, whole
from .file_kinds import check_is_file
from .manifest import Effect, Manifest, Unmodelled
from .scene import Instance, Mesh, Plane, Scene, SceneError
from .tracer.memory import free_memory

T = TypeVar("T")

_SCHEMA = "reference_tracer.scene/2"
_READ = "reference_tracer.scene/1", _SCHEMA  # the first had "orthographic" for "projection"
_ARRAYS = {  # the arrays of a .npz and their shapes, by what has them
    "mesh": {"vertices": "n3", "triangles": "n3", "slots": "n", "corner_colors": "n34"},
    "instance": {"world_from_object": "44", "colors": "n4"},
    "plane": {"point": "3", "normal": "3", "color": "4"},
}


class Account(NamedTuple):
    """What a scene's file said of where it came from."""

    lacks: tuple[Unmodelled, ...] = ()
    notes: tuple[str, ...] = ()


def save_scene(path: str | Path, scene: Scene, manifest: Manifest | None = None) -> None:
    """Write a scene to a compressed .npz.

    Parameters
    ----------
    path : str or Path
    scene : Scene
    manifest : Manifest, optional
        What the scene's source holds and the scene lacks: a comparison of the file knows it, too.
    """
    save_arrays(path, arrays_of(scene, manifest))


def arrays_of(scene: Scene, manifest: Manifest | None = None) -> dict[str, Array]:
    """Return a scene as the arrays of its file, by their names."""
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
    if manifest:
        lacks = [u.to_dict() for u in manifest.lacks]
        head |= {"unmodelled": lacks, "notes": manifest.notes}
    arrays: dict[str, Array] = {"scene": np.array(json.dumps(head, default=np.generic.item))}
    parts = scene.meshes, scene.instances, scene.planes
    for (kind, names), things in zip(_ARRAYS.items(), parts, strict=True):
        for k, thing in enumerate(things):
            held = {f"{kind}{k}_{name}": getattr(thing, name) for name in names}
            arrays |= {name: array for name, array in held.items() if array is not None}
    return arrays


def save_arrays(path: str | Path, arrays: Mapping[str, Array]) -> None:
    """Write arrays to a compressed .npz."""
    with open(path, "wb") as file:  # given a name, numpy would add .npz to one in capitals
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # none is "allow_pickle"


def load_scene(path: str | Path) -> Scene:
    """Read a scene from a .npz that :func:`save_scene` wrote.

    Raises
    ------
    SceneError
        If there is no such file, it is not a scene, or its content is inconsistent.
    """
    return _read(path, _scene)


def load_account(path: str | Path) -> Account:
    """Read what a scene's .npz says of its source; raises what :func:`load_scene` raises."""
    return _read(path, _account)


def _read(path: str | Path, of: Callable[[ZipFile], T]) -> T:
    check_is_file(path)
    try:
        with ZipFile(path) as stored, warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # of headers that an older numpy wrote
            return of(stored)
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error
    except Exception as error:  # zip, zlib, numpy, JSON: each has its own ways to say no
        say = f"'{path}' is cut off or damaged: copy it again, or export it again ({error})"
        raise SceneError(say) from error


def _head(stored: ZipFile) -> Content:
    head: Content = json.loads(str(_array(stored, "scene", "", "U")))
    if head.get("schema") not in _READ:
        raise SceneError(f"its schema is {head.get('schema')!r}, not {_SCHEMA!r}")
    return head


def _account(stored: ZipFile) -> Account:
    head: Content = {"unmodelled": [], "notes": []} | _head(stored)
    lacks = tuple(_unmodelled(u) for u in part(head, "unmodelled", "", list))
    return Account(lacks, tuple(map(str, part(head, "notes", "", list))))


def _unmodelled(u: Content) -> Unmodelled:
    where, effects = "unmodelled.", {effect.key: effect for effect in Effect}
    if (effect := part(u, "effect", where, str)) not in effects:
        raise SceneError(f"unmodelled.effect is '{effect}'; it must be one of {', '.join(effects)}")
    bounds = None if u.get("bounds") is None else numbers(u, "bounds", where, (2, 3))
    return Unmodelled(
        part(u, "object", where, str),
        part(u, "feature", where, str),
        part(u, "detail", where, str),
        bounds,
        effects[effect],
        tuple(map(str, part(u, "by", where, list))),
    )


def _scene(stored: ZipFile) -> Scene:
    head = _head(stored)

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
