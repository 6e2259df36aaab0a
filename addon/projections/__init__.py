"""The types of cameras: a record each, by its name; a file each has the formulas."""

from __future__ import annotations

from .equirectangular import Equirectangular
from .orthographic import Orthographic
from .perspective import Perspective
from .projection import Projection as Projection

PERSPECTIVE, ORTHOGRAPHIC = Perspective(), Orthographic()
EQUIRECTANGULAR = Equirectangular()
PROJECTIONS: dict[str, Projection] = {
    p.name: p for p in (PERSPECTIVE, ORTHOGRAPHIC, EQUIRECTANGULAR)
}


def projection_of(value: object) -> Projection | None:
    """Return the projection that a file's "orthographic" means; None for none."""
    found = [p for p in PROJECTIONS.values() if p.in_files == value]
    return found[0] if found and isinstance(value, bool | str) else None
