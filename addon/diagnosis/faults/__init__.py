"""The known faults: the self-check makes them, and the diagnosis looks for them."""

from __future__ import annotations

from .camera import CAMERA_FAULTS
from .colors import COLOR_FAULTS
from .fault import AnyFault, Example
from .given import GIVEN_FAULTS
from .lens import LENS_FAULTS
from .matrices import MATRIX_FAULTS
from .objects import OBJECT_FAULTS
from .order import ORDER_FAULTS
from .picture import PICTURE_FAULTS
from .triangles import TRIANGLE_FAULTS
from .view import VIEW_FAULTS

FAULTS: tuple[AnyFault, ...] = (
    *CAMERA_FAULTS,
    *MATRIX_FAULTS,
    *LENS_FAULTS,
    *VIEW_FAULTS,
    *GIVEN_FAULTS,
    *OBJECT_FAULTS,
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
