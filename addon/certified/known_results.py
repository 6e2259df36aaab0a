"""Operations of floats, and what they must return: the bits of numbers, and of their results."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats

# Numbers are written as their bits: decimals and powers would pass through the arithmetic that is
# to be checked, and a comparison of floats may take subnormals for zero, too.
ONE, TWO, THREE, INF = 0x3FF0000000000000, 0x4000000000000000, 0x4008000000000000, 0x7FF << 52
ABOVE_ONE = ONE + 1  # 1 + 2^-52
NEAR_ONE = 0x3FF0000000400000  # 1 + 2^-30
HALF = 0x3FE0000000000000
LEAST = 0x1  # 2^-1074
NORMAL = 0x0010000000000000  # 2^-1022
MINUS = 1 << 63
NEAREST, SMALL, TINY = "rounding to nearest", "subnormal results", "subnormal operands"
Case = tuple[str, int, int, int]  # what is checked, x, y, and their result

ADD: tuple[Case, ...] = (
    (NEAREST, ONE, 0x3CA0000000000000, ONE),  # 1 + 2^-53
    (NEAREST, ONE, 0x3CB8000000000000, ONE + 2),  # 1 + 3 2^-53
    (NEAREST, ONE, 0x3CA0000008000000, ABOVE_ONE),  # 1 + 2^-53 + 2^-78: x87 rounds it twice
    (SMALL, 0x0018000000000000, NORMAL | MINUS, 0x0008000000000000),
    (TINY, LEAST, LEAST, 0x2),
)
SUBTRACT: tuple[Case, ...] = (
    (NEAREST, ONE, 0x3C90000000000000, ONE),  # 1 - 2^-54
    (NEAREST, ONE, 0x3CA8000000000000, ONE - 2),  # 1 - 3 2^-54
    (TINY, LEAST, LEAST | MINUS, 0x2),
    (SMALL, 0x0018000000000000, NORMAL, 0x0008000000000000),
)
MULTIPLY: tuple[Case, ...] = (
    (NEAREST, NEAR_ONE, NEAR_ONE, 0x3FF0000000800000),
    (NEAREST, ABOVE_ONE, 0x3FF8000000000000, 0x3FF8000000000002),  # 3 / 2 + 3 2^-53
    (SMALL, NORMAL, HALF, 0x0008000000000000),
    # 2^-1046 (1 + 2^-30)^2: what has rounded to 53 digits before is a tie.
    (SMALL, 0x0170000000400000, 0x3D10000000400000, 0x10000001),
    (TINY, LEAST, 0x43B0000000000000, 0x0090000000000000),  # 2^60
)
DIVIDE: tuple[Case, ...] = (
    (NEAREST, ONE, THREE, 0x3FD5555555555555),
    (NEAREST, ONE, 0x4024000000000000, 0x3FB999999999999A),  # 1 / 10
    (SMALL, NORMAL, TWO, 0x0008000000000000),
    (TINY, LEAST, NORMAL, 0x3CB0000000000000),
)
LARGEST: tuple[Case, ...] = (
    (TINY, LEAST, 0, LEAST),
    (TINY, 0, LEAST, LEAST),
    (TINY, LEAST, 0x2, 0x2),
)
LEAST_OF: tuple[Case, ...] = (
    (TINY, LEAST | MINUS, 0, LEAST | MINUS),
    (TINY, 0, LEAST | MINUS, LEAST | MINUS),
    (TINY, LEAST, 0x2, LEAST),
)
NEXT: tuple[Case, ...] = (
    (SMALL, 0, INF, LEAST),
    (SMALL, NORMAL, INF | MINUS, NORMAL - 1),
    (TINY, LEAST, INF, 0x2),
    (NEAREST, ONE, INF, ABOVE_ONE),
    (NEAREST, ONE | MINUS, INF, (ONE - 1) | MINUS),
)
FLOOR: tuple[Case, ...] = (
    (TINY, LEAST | MINUS, 0, ONE | MINUS),
    (NEAREST, ONE - 1, 0, 0),
    (NEAREST, HALF | MINUS, 0, ONE | MINUS),
)
CEIL: tuple[Case, ...] = (
    (TINY, LEAST, 0, ONE),
    (NEAREST, ABOVE_ONE, 0, TWO),
    (NEAREST, HALF | MINUS, 0, MINUS),
)
LESS: tuple[Case, ...] = (
    (TINY, 0, LEAST, ONE),
    (TINY, LEAST | MINUS, 0, ONE),
    (TINY, LEAST, 0, 0),
)
MANTISSA: tuple[Case, ...] = (
    (TINY, LEAST, 0, HALF),
    (NEAREST, THREE, 0, 0x3FE8000000000000),
)
POWER: tuple[Case, ...] = (  # of two
    (TINY, LEAST, 0, 0xC090C40000000000),  # -1073
    (NEAREST, THREE, 0, TWO),
)


def floats(bits: Sequence[int]) -> Floats:
    """Return float64s of their bits, (n,)."""
    return np.array(bits, np.uint64).view(np.float64)


# By Python: an integer made a float, and quotients of integers.
INTEGERS: tuple[tuple[str, int, int, int], ...] = (
    (NEAREST, (1 << 53) + 1, 1, 0x4340000000000000),
    (NEAREST, (1 << 53) + 3, 1, 0x4340000000000002),
    (NEAREST, 1, 3, 0x3FD5555555555555),
    (NEAREST, 1, 10, 0x3FB999999999999A),
    (SMALL, 3, 1 << 1075, 0x2),
    (SMALL, (1 << 80) + 1, 1 << 1155, LEAST),
)
