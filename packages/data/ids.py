"""Ids: a number, or a colour, for each object; whose is whose is named, or found from the picture.

Found from the picture, an object's own value is the one that most of its pixels have, that of the
most pixels first; two objects never have one value. So a picture is right if all pixels of an
object have one value, and no pixel of another object, or of none, has it. Objects that have
exchanged their values agree then: only a table of names finds that.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array, Bools, Floats
from reference_tracer.files.file_kinds import check_is_file
from reference_tracer.pictures import colors_file
from reference_tracer.pictures.palette import eight_bits
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.hits import NOTHING, Hits

from .kind import Kind
from .seen import Seen

LAYERS = ("ids", "id", "object_index", "indexob", "object index", "instance_index", "segmentation")
PRESUMED = "which id is whose is told from the picture: objects that exchanged theirs agree"

_EXACT = 2.0**53  # below which float64 holds all integers
_NEAR = 1e-6  # of a linear colour as floats


def numbers_of(values: Array) -> Floats:
    """Return a number for each pixel's value or colour (h, w, c), equal for equal ones, (h, w).

    It is the value itself where float64 can hold it; NaN is equal to NaN.
    """
    exact = values.dtype.kind == "b" or bool((np.abs(values.astype(np.float64)) < _EXACT).all())
    if values.shape[2] == 1 and exact:
        return values[..., 0].astype(np.float64)
    flat = values.reshape(-1, values.shape[2])
    codes = [np.unique(channel, return_inverse=True)[1].reshape(-1) for channel in flat.T]
    every = np.unique(np.stack(codes, axis=1), axis=0, return_inverse=True)[1]
    return np.asarray(every.reshape(values.shape[:2]), np.float64)


def ids_of(own: Mapping[str, float], seen: Seen) -> Floats:
    """Return the ids of what n pixels see, (n, 1); NaN of objects without one."""
    table = np.array([own.get(name, np.nan) for name in seen.scene.objects])
    return table[seen.scene.instance_objects[seen.instance]][:, None]


def kind_of(own: Mapping[str, float], presumed: str = "") -> Kind:
    """Return the kind of ids in which objects have numbers of their own."""
    return Kind(
        "ids",
        "ids of objects",
        1,
        partial(ids_of, own),
        LAYERS,
        follows_t=False,
        empty=(),
        presumed=presumed,
    )


def owners_of(
    scene: Scene, hits: Hits, ids: Floats, known: Mapping[str, float] | None = None
) -> tuple[dict[str, float], Bools, int]:
    """Return each object's id, as n hits and the ids (n,) say, and which pixels show none of them.

    What is seen beside all objects has an id of its own, or none: its pixels are the second. The
    third is how many pixels are right then. Ids that are `known` stay as they are.
    """
    seen = scene.instance_objects[hits.instance]
    values, value = np.unique(ids, return_inverse=True)
    pairs, count = np.unique(np.stack((seen, value.reshape(-1))), axis=1, return_counts=True)
    own = dict(known or {})
    blank = np.zeros(len(ids), bool)
    taken = {*np.flatnonzero(np.isin(values, [*own.values()])).tolist()}
    given = set(range(len(scene.objects))) if own else set()
    for number in np.argsort(-count, kind="stable"):
        thing, of = (int(n) for n in pairs[:, number])
        if thing in given or of in taken:
            continue
        given.add(thing)
        taken.add(of)
        if thing == NOTHING:
            blank = ids == values[of]
        else:
            own[scene.objects[thing]] = float(values[of])
    table = np.array([*(own.get(name, np.nan) for name in scene.objects), np.nan])
    right = (ids == table[seen]) | (blank & (seen == NOTHING))
    return own, blank, int(right.sum())


def named(path: Path, values: Array, numbers: Floats, scene: Scene) -> dict[str, float]:
    """Return the id of each object of a scene as a table has it, as a number of `numbers`.

    Raises
    ------
    SceneError
        If the file is no table, or lacks an object of the scene.
    """
    colors = _table(path, values)
    if lacking := [name for name in scene.objects if name not in colors]:
        raise SceneError(f"'{path}' has no id for '{lacking[0]}'")
    out = {}
    for number, name in enumerate(scene.objects):
        apart = np.abs(values.astype(np.float64) - colors[name]).max(axis=-1)
        same = np.flatnonzero(apart <= (_NEAR if values.dtype.kind == "f" else 0))
        # One that is not in the picture has a number that no pixel has.
        out[name] = float(numbers.flat[same[0]]) if len(same) else -1.5 - number
    return out


def _table(path: Path, values: Array) -> dict[str, Floats]:
    """Return the value of each object as a picture of some type has it, (c,)."""
    check_is_file(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(content, dict) and content.get("schema") == colors_file.SCHEMA:
            slots = colors_file.read(path).slots
            return {name: _as_stored(colors[0], values) for (name, _), colors in slots.items()}
        table: dict[str, Floats] = {
            name: np.array(own, np.float64) for name, own in content.items()
        }
        for own in table.values():
            np.broadcast_to(own, values.shape[2:])
    except (AttributeError, TypeError, ValueError, RecursionError) as error:
        example = '{"Cube": 1, "Ball": 2}, or [255, 0, 0] for a colour'
        say = f"'{path}' is no table of ids for {values.shape[2]} channels"
        raise SceneError(f"{say} (such as {example}, or a colors.json)") from error
    return table


def _as_stored(linear: Floats, values: Array) -> Floats:
    """Return a linear colour as a picture of floats, or of integers in sRGB, has it."""
    if values.dtype.kind == "f":
        return np.asarray(linear, np.float64)
    return eight_bits(linear).astype(np.float64) * (np.iinfo(values.dtype).max // 255)
