"""Faults of data: what a file of depths, normals, positions or ids holds in place of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from reference_tracer.diagnosis.faults import OF_COLORS
from reference_tracer.diagnosis.faults.fault import AnyFault, Effort

from .depth import DEPTH_FAULTS
from .ids import ID_FAULTS
from .moving import by_points
from .storing import STORING_FAULTS
from .vectors import VECTOR_FAULTS

DATA_FAULTS: tuple[AnyFault, ...] = (
    *DEPTH_FAULTS,
    *VECTOR_FAULTS,
    *ID_FAULTS,
    *STORING_FAULTS,
)


def faults_of_data(known: Sequence[AnyFault]) -> list[AnyFault]:
    """Return the faults that are looked for in data: those of scenes, and those of data.

    Depths say where an object is. An array is turned over more often than a camera is mirrored: of
    two faults that do as well, that is the first, and both are tried.
    """
    other: dict[str, dict[str, Any]] = {
        "object_moved": {"find": by_points},
        "mirrored_y": {"effort": Effort.NOTHING},
    }
    of_scenes = [replace(f, **other.get(f.name, {})) for f in known if f.name not in OF_COLORS]
    return sorted((*of_scenes, *DATA_FAULTS), key=lambda fault: fault.name != "rows")
