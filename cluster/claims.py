"""What a worker says that rays see, as bytes; and the same read, as what it may be but need not be.

A claim is of owners: whose surface each ray sees, and how that was decided. t, the barycentrics and
the colours follow from the owners, and are found here, not believed. Only where integers decided
who is nearest, t and the barycentrics come along: they are checked, too (`checks.py`).
"""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from numpy.typing import DTypeLike, NDArray
from reference_tracer.scene import Scene
from reference_tracer.tracer.certified.certainty import Certainty
from reference_tracer.tracer.certified.reasons import Reason
from reference_tracer.tracer.hits import NOTHING, Hits, LazyHits, Measured, Name, Statistics, Ties

Expected = tuple[DTypeLike, tuple[int | None, ...]]  # None: any length


def packed(*arrays: NDArray) -> bytes:
    """Return arrays as bytes, without pickle."""
    with BytesIO() as file:
        for array in arrays:
            np.lib.format.write_array(file, np.asarray(array, order="C"), allow_pickle=False)
        return file.getvalue()


def unpacked(data: bytes, *expected: Expected) -> list[NDArray]:
    """Return arrays from bytes, each of the type and shape that is expected.

    Raises
    ------
    ValueError
        If they are others, or are no arrays.
    """
    if type(data) is not bytes:
        raise ValueError(f"it is {type(data).__name__}, not bytes")
    file, out = BytesIO(data), []
    for dtype, shape in expected:
        array = np.lib.format.read_array(file, allow_pickle=False)
        fits = array.ndim == len(shape) and all(
            n in (None, m) for n, m in zip(shape, array.shape, strict=True)
        )
        if not fits or (array.dtype.kind != "U" if dtype is str else array.dtype != dtype):
            raise ValueError(f"it has {array.dtype} {array.shape}, not {dtype} {shape}")
        out.append(array)
    return out


@dataclass(eq=False)
class Claim:
    """What n rays see, row by row, as a worker says."""

    names: NDArray[np.int32]  # (2, n): instance and triangle
    certainty: NDArray[np.uint8]  # (n,)
    known: Measured
    ties: Ties
    statistics: str  # JSON

    @classmethod
    def of(cls, hits: Hits, statistics: Statistics) -> Claim:
        """Return what hits say."""
        names, every = np.stack((hits.instance, hits.triangle)), np.arange(len(hits))
        known = Measured.none()
        if isinstance(hits, LazyHits):
            known = hits.known
        elif hits.certainty.any():  # certified in halves, for want of memory
            known = Measured(every, np.vstack((hits.t, hits.s)))
        s = statistics
        counts = s.pairs_tested, {r.name: n for r, n in s.reasons.items()}, s.culling, s.stages
        return cls(names, hits.certainty, known, hits.ties, json.dumps(counts))

    def packed(self) -> bytes:
        """Return it as bytes."""
        of = vars(self.known).values(), vars(self.ties).values()
        return packed(self.names, self.certainty, *of[0], *of[1], np.array(self.statistics))

    @classmethod
    def read(cls, data: bytes, scene: Scene, count: int, certified: bool) -> Claim:
        """Return what a worker says of so many rays, if that is a claim at all.

        Raises
        ------
        ValueError
            If it is not.
        """
        index, number = (np.int64, (None,)), (np.int32, (None,))
        names, certainty, ray, values, *ties, told = unpacked(
            *(data, (np.int32, (2, count)), (np.uint8, (count,))),
            *(index, (np.float64, (4, None)), index, index, number, number, number, (str, ())),
        )
        claim = cls(names, certainty, Measured(ray, values), Ties(*ties), str(told))
        if not claim._is_sound(scene, certified):
            raise ValueError("it names what is not there")
        return claim

    def _is_sound(self, scene: Scene, certified: bool) -> bool:
        """Return whether all that it names is there."""
        ties, known, count = self.ties, self.known, len(self.certainty)
        levels = list(Certainty)[1:] if certified else [Certainty.NOT_CERTIFIED]
        return (
            _ascends(ties.ray, count)
            and _ascends(known.ray, count)
            and known.values.shape[1] == len(known.ray)
            and (certified or not (len(known.ray) or len(ties.ray)))
            and len(ties.ray) == len(ties.start) == len(ties.count)
            and len(ties.instance) == len(ties.triangle)
            and bool(((ties.start >= 0) & (ties.count > 0)).all())
            and bool((ties.start + ties.count <= len(ties.instance)).all())
            and bool(np.isin(self.certainty, levels).all())
            and _are_there(scene, *self.names)
            and _are_there(scene, ties.instance, ties.triangle)
        )

    def about(self, ray: NDArray[np.integer]) -> tuple[bytes, bytes, dict[int, frozenset[Name]]]:
        """Return what it says of some rays, to be compared."""
        tied = np.flatnonzero(np.isin(ray, self.ties.ray))
        ties = {k: self.ties[int(ray[k])] for k in tied.tolist()}
        return self.names[:, ray].tobytes(), self.certainty[ray].tobytes(), ties

    def count_in(self, statistics: Statistics) -> None:
        """Add what it says that it took, which nobody checks."""
        try:
            pairs, reasons, culling, stages = json.loads(self.statistics)
            statistics.pairs_tested += int(pairs)
            statistics.reasons += Counter({Reason[k]: int(n) for k, n in reasons.items()})
            statistics.culling += Counter({str(k): int(n) for k, n in culling.items()})
            statistics.stages.update({str(k): float(n) for k, n in stages.items()})
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise ValueError(f"its statistics cannot be read: {error}") from error


def _ascends(ray: NDArray[np.int64], count: int) -> bool:
    """Return whether these are numbers of so many rays, in their order."""
    return bool((np.diff(ray, prepend=-1, append=count) > 0).all())


def _are_there(scene: Scene, instance: NDArray[np.int32], triangle: NDArray[np.int32]) -> bool:
    """Return whether a scene has all of these surfaces, of which NOTHING is one."""
    first = len(scene.instances)
    sizes = np.array([0, *(len(m.triangles) for m in scene.meshes)])[scene.instance_meshes + 1]
    if not ((instance >= NOTHING) & (instance < first + len(scene.planes))).all():
        return False
    on_mesh = (instance >= 0) & (instance < first)
    size = np.append(sizes, np.zeros(len(scene.planes) + 1, int))[instance]
    return bool(np.where(on_mesh, (triangle >= 0) & (triangle < size), triangle == NOTHING).all())
