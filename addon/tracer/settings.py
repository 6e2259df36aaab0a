"""The user's choices: the method, the precision, the number of samples, the memory."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..methods import UNPROVEN, Method
from .coloring import Color


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

    Raises
    ------
    ValueError
        If a value is not one of those, naming those that are; or if float32 is asked for where
        the proof needs float64.
    """

    method: Method = Method.AUTO
    precision: Precision = Precision.FLOAT64
    # The colour is the mean of `samples` x `samples` rays spread evenly over the pixel; every other
    # output is that of the ray through the pixel's centre.
    samples: int = 1
    memory: int = 512 << 20  # bytes that working arrays may take, beside the scene and the picture
    # The colour of a seen surface. A comparison is about the object's own.
    color: Color = Color.OBJECT

    def __post_init__(self) -> None:
        for name, kind in (("method", Method), ("precision", Precision), ("color", Color)):
            value = getattr(self, name)
            try:
                object.__setattr__(self, name, kind(value))
            except ValueError:
                names = ", ".join(k.value for k in kind)
                raise ValueError(f"{name} is {value!r}; it must be one of {names}") from None
        if self.precision != Precision.FLOAT64 and self.method.is_proven:
            raise ValueError(
                f"precision is {self.precision.value}; {self.method.value} is proven for float64 "
                f"only: choose float64, or one of {', '.join(UNPROVEN)}"
            )
        if not 1 <= self.samples <= 64:
            raise ValueError(f"samples is {self.samples}; it must be between 1 and 64")
        if self.memory < 16 << 20:
            raise ValueError(f"memory is {self.memory} bytes; it must be at least 16 MiB")


UNPROVEN_SETTINGS = tuple(Settings(m, p) for m in UNPROVEN for p in Precision)
