"""Encodes and decodes a worker's untrusted answer: which surface each ray sees.

A claim is of owners: whose surface each ray sees, and how that was decided. t, the barycentrics and
the colours follow from the owners, and are found here, not believed. Only where integers decided
who is nearest, t and the barycentrics come along.
"""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from numpy.typing import DTypeLike, NDArray
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified.measures import Known
from reference_tracer.scene import Scene
from reference_tracer.tracer.hits import NOTHING, Hits, Statistics
from reference_tracer.tracer.ties import Ties

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
    """A worker's answer for n rays, row by row."""

    names: NDArray[np.int32]  # (2, n): instance and triangle
    certainty: NDArray[np.uint8]  # (n,)
    known: Known  # of all rays that integers decided, and no other
    ties: Ties
    statistics: Statistics  # of which only counts are told

    @classmethod
    def of(cls, hits: Hits, statistics: Statistics) -> Claim:
        """Return what hits say."""
        decided = _decided(hits.certainty)
        values = hits.measured(decided)
        names = np.stack((hits.instance, hits.triangle))
        return cls(names, hits.certainty, Known(decided, values), hits.ties, statistics)

    def packed(self) -> bytes:
        """Return it as bytes."""
        s, ties = self.statistics, vars(self.ties).values()
        counts = s.pairs_tested, {r.name: n for r, n in s.reasons.items()}, s.culling, s.stages
        told = np.array(json.dumps(counts))
        return packed(self.names, self.certainty, self.known.values, *ties, told)

    @classmethod
    def read(cls, data: bytes, scene: Scene, count: int, certified: bool) -> Claim:
        """Return what a worker says of so many rays, if that is a claim at all.

        Raises
        ------
        Exception
            If it is not: numpy and Python raise many kinds on what was made to be no such thing.
        """
        index, number = (np.int64, (None,)), (np.int32, (None,))
        names, certainty, values, *ties, told = unpacked(
            data,
            (np.int32, (2, count)),
            (np.uint8, (count,)),
            (np.float64, (4, None)),
            index,
            index,
            number,
            number,
            number,
            (str, ()),
        )
        known = Known(_decided(certainty), values)
        claim = cls(names, certainty, known, Ties(*ties), _statistics(str(told)))
        if not claim._is_sound(scene, certified):
            raise ValueError("it names what is not there")
        return claim

    def _is_sound(self, scene: Scene, certified: bool) -> bool:
        """Return whether all that it names is there."""
        ties, levels = self.ties, (Certainty.BOUND, Certainty.AMBIGUOUS) if certified else (0, 0)
        return (
            bool(levels[0] <= np.min(self.certainty) <= np.max(self.certainty) <= levels[1])
            and self.known.values.shape[1] == len(self.known.ray)
            and _ascends(ties.ray, len(self.certainty))
            and (certified or not len(ties.ray))
            and len(ties.ray) == len(ties.start) == len(ties.count)
            and len(ties.instance) == len(ties.triangle)
            and bool(((ties.start >= 0) & (ties.count > 0)).all())
            and bool((ties.start <= len(ties.instance) - ties.count).all())
            and _are_there(scene, *self.names)
            and _are_there(scene, ties.instance, ties.triangle)
        )

    def about(self, ray: NDArray[np.integer]) -> tuple:
        """Return what it says of some rays, which ascend, to be compared."""
        tied = np.flatnonzero(np.isin(ray, self.ties.ray))
        ties = {k: self.ties[int(ray[k])] for k in tied.tolist()}
        known = self.known.values[:, np.isin(self.known.ray, ray)]
        return *(v.tobytes() for v in (self.names[:, ray], self.certainty[ray], known)), ties

    def count_in(self, statistics: Statistics) -> None:
        """Add what it says that it took, which nobody checks."""
        own = self.statistics
        statistics.pairs_tested += own.pairs_tested
        statistics.reasons += own.reasons
        statistics.culling += own.culling
        for stage, seconds in own.stages.items():
            statistics.stages[stage] = statistics.stages.get(stage, 0.0) + seconds


def _decided(certainty: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Return the rays of which integers were asked who is nearest."""
    return np.flatnonzero(certainty > Certainty.BOUND)


def _statistics(told: str) -> Statistics:
    """Return counts from JSON, if they can be such."""
    pairs, reasons, culling, stages = json.loads(told)
    every = pairs, *reasons.values(), *culling.values(), *stages.values()
    if not all(0 <= n < 1 << 63 for n in every) or not "".join((*culling, *stages)).isprintable():
        raise ValueError("its statistics are no counts")
    return Statistics(
        pairs_tested=int(pairs),
        reasons=Counter({Reason[k]: int(n) for k, n in reasons.items()}),
        culling=Counter({k: int(n) for k, n in culling.items()}),
        stages={k: float(n) for k, n in stages.items()},
    )


def _ascends(ray: NDArray[np.int64], count: int) -> bool:
    """Return whether these are numbers of so many rays, in their order."""
    return bool((np.diff(ray, prepend=-1, append=count) > 0).all())


def _are_there(scene: Scene, instance: NDArray[np.int32], triangle: NDArray[np.int32]) -> bool:
    """Return whether a scene has all of these surfaces, of which NOTHING is one."""
    others = np.zeros(len(scene.planes) + 1, np.int32)  # NOTHING, -1, is the last one
    if np.max(instance, initial=NOTHING) >= len(scene.instances) + len(scene.planes):
        return False
    if min(np.min(v, initial=NOTHING) for v in (instance, triangle)) < NOTHING:
        return False
    sizes = np.array([-1, *(len(m.triangles) or -1 for m in scene.meshes)], np.int32)
    size = np.r_[sizes[scene.instance_meshes + 1], others].take(instance)
    return bool((triangle < size).all() and ((triangle < 0) == (size == 0)).all())
