"""Short names for the types of arrays. Those of vectors are in `tracer/vector.py`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]  # of any one type; of dtype object where they are fractions
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Colors = NDArray[np.float32]  # (..., 4) linear RGBA, premultiplied alpha
Floats = NDArray[np.floating]  # float64, but where an unproven method is asked for float32
Index = NDArray[np.integer]
Integers = NDArray[np.int32]
Where = Array | slice | tuple[Array, ...]  # some of the items of an array
Places = NDArray[np.intp]  # what numpy's searches return
