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
