"""What the user can trade: the method, the precision, the number of samples, the memory."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np


class Method(StrEnum):
    """How a ray meets a triangle; `triangle.py` has the formulas."""

    TEXTBOOK_LITERAL = "textbook_literal"
    TEXTBOOK = "textbook"
    MOLLER_TRUMBORE = "moller_trumbore"


class Precision(StrEnum):
    """The floating-point type of rays and vertices."""

    FLOAT32 = "float32"
    FLOAT64 = "float64"

    @property
    def dtype(self) -> np.dtype:
        """The numpy type."""
        return np.dtype(self.value)


@dataclass(frozen=True)
class Settings:
    """One choice of how to trace.

    Parameters
    ----------
    method : Method or str
    precision : Precision or str
    samples : int
        Colour is the mean of `samples` x `samples` rays spread evenly over the pixel; every
        other output is that of the ray through the pixel's centre.
    memory : int
        Bytes that the working arrays may take, beside the scene and the picture.

    Raises
    ------
    ValueError
        If a value is not one of those, naming those that are.
    """

    method: Method | str = Method.TEXTBOOK
    precision: Precision | str = Precision.FLOAT64
    samples: int = 1
    memory: int = 256 << 20

    def __post_init__(self) -> None:
        for name, kind in (("method", Method), ("precision", Precision)):
            value = getattr(self, name)
            try:
                object.__setattr__(self, name, kind(value))
            except ValueError:
                names = ", ".join(k.value for k in kind)
                raise ValueError(f"{name} is {value!r}; it must be one of {names}") from None
        if not 1 <= self.samples <= 64:
            raise ValueError(f"samples is {self.samples}; it must be between 1 and 64")
        if self.memory < 16 << 20:
            raise ValueError(f"memory is {self.memory} bytes; it must be at least 16 MiB")
