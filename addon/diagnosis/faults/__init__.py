"""The known faults: the self-check makes them, and the diagnosis looks for them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from .camera import CAMERA_FAULTS
from .colors import COLOR_FAULTS
from .fault import AnyFault, Effort, Example
from .given import GIVEN_FAULTS
from .lens import LENS_FAULTS
from .matrices import MATRIX_FAULTS
from .objects import OBJECT_FAULTS
from .order import ORDER_FAULTS
from .picture import PICTURE_FAULTS
from .triangles import TRIANGLE_FAULTS
from .view import VIEW_FAULTS


def _at(effort: Effort, faults: Iterable[AnyFault]) -> tuple[AnyFault, ...]:
    """Return faults, those without numbers with another effort; what sums up with its reasons."""
    own = ((f, Effort.VIEW if f.sums_up else f.effort or effort) for f in faults)
    return tuple(replace(f, effort=e) for f, e in own)


FAULTS: tuple[AnyFault, ...] = (
    *CAMERA_FAULTS,
    *_at(Effort.VIEW, MATRIX_FAULTS),
    *_at(Effort.VIEW, LENS_FAULTS),
    *_at(Effort.LEFT_OUT, VIEW_FAULTS),
    *GIVEN_FAULTS,
    *_at(Effort.LEFT_OUT, OBJECT_FAULTS),
    *TRIANGLE_FAULTS,
    *COLOR_FAULTS,
    *ORDER_FAULTS,
    *PICTURE_FAULTS,
)
# Faults of a picture's colours: not searched in depths and other data.
OF_COLORS = {f.name for f in (*COLOR_FAULTS, *PICTURE_FAULTS)} - {"rows", "row_off"}
OF_COLORS |= {f.name for f in FAULTS if f.after}
# Those that the self-check makes, and how, in the order in which it does.
EXAMPLES: tuple[tuple[AnyFault, Example], ...] = tuple(
    (fault, example) for fault in FAULTS for example in fault.examples
)
