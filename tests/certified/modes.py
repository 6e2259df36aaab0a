"""Switches how this thread's floating point works, as a native library can: x86-64 with glibc."""

from __future__ import annotations

import ctypes
import platform
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

import pytest

GLIBC_X86 = platform.machine() in ("x86_64", "AMD64") and platform.libc_ver()[0] == "glibc"
ON_X86 = pytest.mark.skipif(not GLIBC_X86, reason="sets the control word of x86-64 through glibc")
UP, DOWN, TO_ZERO = 0x4000, 0x2000, 0x6000  # bits of MXCSR
FLUSHES, TAKES_FOR_ZERO = 0x8000, 0x40  # subnormal results; subnormal operands
MODES = {
    "up": UP,
    "down": DOWN,
    "to zero": TO_ZERO,
    "flush": FLUSHES,
    "subnormals are zero": TAKES_FOR_ZERO,
    "both": FLUSHES | TAKES_FOR_ZERO,
}


@cache
def _libm() -> ctypes.CDLL:
    return ctypes.CDLL("libm.so.6")


def switch(bits: int) -> None:
    """Set these bits of MXCSR, and clear the other modes."""
    environment = (ctypes.c_uint32 * 8)()
    _libm().fegetenv(environment)
    environment[7] = environment[7] & ~(TO_ZERO | FLUSHES | TAKES_FOR_ZERO) | bits
    _libm().fesetenv(environment)


@contextmanager
def switched_back() -> Iterator[None]:
    """Whatever is switched meanwhile, have it as it should be afterwards."""
    try:
        yield
    finally:
        switch(0)
