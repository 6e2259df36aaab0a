"""Faults of data: what a file of depths, normals, positions or ids holds in place of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from reference_tracer.diagnosis.faults import OF_COLORS
from reference_tracer.diagnosis.faults.fault import AnyFault

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
    two faults that do as well, that is the first.
    """
    of_scenes = [
        replace(fault, find=by_points) if fault.name == "object_moved" else fault
        for fault in known
        if fault.name not in OF_COLORS
    ]
    return sorted((*of_scenes, *DATA_FAULTS), key=lambda fault: fault.name != "rows")
