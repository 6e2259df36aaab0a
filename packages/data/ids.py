"""Ids: a number, or a colour, for each object. Which one is whose is found from the picture itself.

The value that most of an object's pixels have is taken for the object's own, that of the most
pixels first; two objects never have one value. So a picture is right if all pixels of an object
have one value, and no pixel of another object, or of none, has it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from reference_tracer.arrays import Array, Bools, Floats
from reference_tracer.scene import Scene
from reference_tracer.tracer.hits import NOTHING, Hits

from .kind import Kind
from .seen import Seen

LAYERS = ("ids", "id", "object_index", "indexob", "object index", "instance_index", "segmentation")

_EXACT = 2.0**53  # below which float64 holds all integers


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


def kind_of(own: Mapping[str, float]) -> Kind:
    """Return the kind of ids in which objects have numbers of their own."""

    def made(seen: Seen) -> Floats:
        table = np.array([own.get(name, np.nan) for name in seen.scene.objects])
        return table[seen.scene.instance_objects[seen.instance]][:, None]

    return Kind("ids", "ids of objects", 1, made, LAYERS, follows_t=False, empty=())


def owners_of(scene: Scene, hits: Hits, ids: Floats) -> tuple[dict[str, float], Bools, int]:
    """Return each object's id, as n hits and the ids (n,) say, and which pixels show none of them.

    What is seen beside all objects has an id of its own, or none: its pixels are the second. The
    third is how many pixels are right then.
    """
    seen = scene.instance_objects[hits.instance]
    values, value = np.unique(ids, return_inverse=True)
    pairs, count = np.unique(np.stack((seen, value.reshape(-1))), axis=1, return_counts=True)
    own: dict[str, float] = {}
    blank = np.zeros(len(ids), bool)
    right = 0
    taken: set[int] = set()
    given: set[int] = set()
    for number in np.argsort(-count, kind="stable"):
        thing, of = (int(n) for n in pairs[:, number])
        if thing in given or of in taken:
            continue
        given.add(thing)
        taken.add(of)
        right += int(count[number])
        if thing == NOTHING:
            blank = ids == values[of]
        else:
            own[scene.objects[thing]] = float(values[of])
    return own, blank, right
