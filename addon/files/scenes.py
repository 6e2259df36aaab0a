"""Writes and reads scenes as .npz."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import accumulate, pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..manifest import Effect, Manifest, Unmodelled
from ..scene import Instance, Mesh, Plane, Scene, SceneError
from . import npz
from .checked_json import Content, camera_of, numbers, part, whole

_SCHEMA = "reference_tracer.scene/3"
_TEXT = 1 / 8  # of what a file may take: lists of JSON take several times as much as their text
_FLOATS = {4: np.float32, 8: np.float64}  # by the bytes of a number
_Parts = tuple[tuple[Mesh, ...], tuple[Instance, ...], tuple[Plane, ...]]


class Account(NamedTuple):
    """The account of a scene's source that its file holds."""

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
    head = {
        "schema": _SCHEMA,
        "camera": scene.camera.to_dict(),
        "objects": scene.objects,
        "background": scene.background.tolist(),
        "meshes": [mesh.name for mesh in scene.meshes],
        "planes": [
            {name: np.asarray(value).tolist() for name, value in vars(plane).items()}
            for plane in scene.planes
        ],
    }
    if manifest:
        lacks = [u.to_dict() for u in manifest.lacks]
        head |= {"unmodelled": lacks, "notes": manifest.notes}
    text = np.array(json.dumps(head, default=np.generic.item))
    npz.save(path, {"scene": text} | _mesh_arrays(scene.meshes) | _instance_arrays(scene.instances))


def _mesh_arrays(meshes: Sequence[Mesh]) -> dict[str, Array]:
    """Return what meshes hold, one after the other, and of each how much of it is its own."""
    counts = [
        (len(m.vertices), len(m.triangles), m.corner_colors is not None, m.vertices.itemsize)
        for m in meshes
    ]
    colors = [m.corner_colors for m in meshes if m.corner_colors is not None]
    return {
        "meshes": np.array(counts, np.int64).reshape(-1, 4),
        "vertices": np.concatenate([np.zeros((0, 3), np.float32), *(m.vertices for m in meshes)]),
        "triangles": np.concatenate([np.zeros((0, 3), np.int32), *(m.triangles for m in meshes)]),
        "slots": np.concatenate([np.zeros(0, np.int32), *(m.slots for m in meshes)]),
        "corner_colors": np.concatenate([np.zeros((0, 3, 4), np.float32), *colors]),
    }


def _instance_arrays(instances: Sequence[Instance]) -> dict[str, Array]:
    rows = [(i.mesh, i.object, len(i.colors)) for i in instances]
    matrices = [i.world_from_object for i in instances]
    return {
        "instances": np.array(rows, np.int64).reshape(-1, 3),
        "world_from_object": np.array(matrices, np.float64).reshape(-1, 4, 4),
        "colors": np.concatenate([np.zeros((0, 4), np.float32), *(i.colors for i in instances)]),
    }


def load_scene(path: str | Path) -> Scene:
    """Read a scene from a .npz that :func:`save_scene` wrote.

    Raises
    ------
    SceneError
        If there is no such file, it is not a scene, or its content is inconsistent.
    """
    with npz.opened(path) as stored:
        head = _head(stored)
        camera, background = camera_of(head["camera"]), np.array(head["background"])
        return Scene(camera, *_parts(stored, head), background, tuple(map(str, head["objects"])))


def load_account(path: str | Path) -> Account:
    """Read what a scene's .npz says of its source; raises what :func:`load_scene` raises."""
    with npz.opened(path) as stored:
        head: Content = {"unmodelled": [], "notes": []} | _head(stored)
        lacks = tuple(_unmodelled(u) for u in part(head, "unmodelled", "", list))
        return Account(lacks, tuple(map(str, part(head, "notes", "", list))))


def _head(stored: npz.Arrays) -> Content:
    text = stored.checked("scene", "", "U")
    if text.nbytes > stored.limit * _TEXT:
        raise SceneError(f"its text has {text.nbytes // 4:,} letters, too many for such a file")
    head: Content = json.loads(str(text))
    if head.get("schema") != _SCHEMA:
        raise SceneError(f"its schema is {head.get('schema')!r}, not {_SCHEMA!r}")
    return head


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


def _parts(stored: npz.Arrays, head: Content) -> _Parts:
    vertices, triangles, colored, sizes = stored.checked("meshes", "n4", "iu").T.tolist()
    corners = [is_colored * count for is_colored, count in zip(colored, triangles, strict=True)]
    held = zip(
        part(head, "meshes", "", list),
        sizes,
        _shares(stored, "vertices", "n3", vertices),
        _shares(stored, "triangles", "n3", triangles),
        _shares(stored, "slots", "n", triangles),
        _shares(stored, "corner_colors", "n34", corners),
        colored,
        strict=True,
    )
    meshes = tuple(
        Mesh(v.astype(_FLOATS[size], copy=False), t, s, c if is_colored else None, str(name))
        for name, size, v, t, s, c, is_colored in held
    )
    used, objects, rows = stored.checked("instances", "n3", "iu").T.tolist()
    matrices = stored.checked("world_from_object", "n44")
    colors = _shares(stored, "colors", "n4", rows)
    instances = tuple(Instance(*each) for each in zip(used, objects, matrices, colors, strict=True))
    return meshes, instances, tuple(map(_plane, part(head, "planes", "", list)))


def _plane(p: Content) -> Plane:
    point, normal = (numbers(p, name, "planes.", (3,)) for name in ("point", "normal"))
    return Plane(whole(p, "object", "planes."), point, normal, np.array(p["color"]))


def _shares(stored: npz.Arrays, name: str, shape: str, counts: Sequence[int]) -> Iterator[Array]:
    """Yield as many rows of an array as each of its owners has."""
    array = stored.checked(name, shape)
    if min(counts, default=0) < 0 or sum(counts) != len(array):
        raise SceneError(f"{name} has {len(array):,} rows, and {sum(counts):,} are used")
    return (array[begin:end] for begin, end in pairwise(accumulate(counts, initial=0)))
