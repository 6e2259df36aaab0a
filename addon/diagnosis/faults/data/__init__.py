"""Faults of data: what a file of depths, normals, positions or ids holds in place of them."""

from __future__ import annotations

from ..fault import AnyFault
from .depth import DEPTH_FAULTS
from .ids import ID_FAULTS
from .storing import STORING_FAULTS
from .vectors import VECTOR_FAULTS

DATA_FAULTS: tuple[AnyFault, ...] = (
    *DEPTH_FAULTS,
    *VECTOR_FAULTS,
    *ID_FAULTS,
    *STORING_FAULTS,
)
