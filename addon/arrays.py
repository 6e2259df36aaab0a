"""Short names for the types of arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]  # of any type
Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]
Reals = NDArray[np.floating]  # of either precision
Colors = NDArray[np.float32]  # (..., 4) linear RGBA, premultiplied alpha
Index = NDArray[np.integer]
Places = NDArray[np.intp]  # what numpy's searches return
Numbers = NDArray[np.int32]
Bytes = NDArray[np.uint8]
