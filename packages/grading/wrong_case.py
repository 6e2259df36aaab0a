"""Some cases, or pixels of a scene, that were answered wrongly, with all numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reference_tracer.arrays import Floats
from reference_tracer.report.folders import finite

from .form import Arrays, Form


@dataclass(frozen=True)
class WrongCase:
    """One case: what was given, what is true, and what was answered; what is not finite is null."""

    group: str  # of the cases; of a pixel its mark
    given: Mapping[str, Any]  # by the names of the form
    certified: tuple[float | None, ...]  # the numbers of the parts
    student: tuple[float | None, ...]
    place: int = 0  # which of the numbers of its answer these are, if there are several
    pixel: tuple[int, int] | None = None  # of a scene: x, y of the camera's region, from below
    object: str = ""  # of a scene: whose triangle it is

    @classmethod
    def of(
        cls,
        form: Form,
        group: str,
        given: Arrays,
        true: Floats,
        own: Floats,
        **where: Any,
    ) -> WrongCase:
        """Return a case of arrays; `where` has the fields after these."""
        names = (field.name for field in form.given)
        numbers = dict(zip(names, (array.tolist() for array in given), strict=True))
        certified, student = (tuple(map(finite, row.tolist())) for row in (true, own))
        return cls(group, numbers, certified, student, **where)
