"""Writes each pixel's owner as Cryptomatte has it, with the objects' own names.

An object's id is the MurmurHash3 of its name, as a float32 with the same bits; a manifest has the
names. Each pixel has one object, that of its centre, with a coverage of 1.

References
----------
Friedman and Jones, "Fully automatic ID mattes with support for motion blur and transparency",
SIGGRAPH 2015 posters; "Cryptomatte specification", version 1.2.0, github.com/Psyop/Cryptomatte.
Appleby, MurmurHash3_x86_32, github.com/aappleby/smhasher.
"""

from __future__ import annotations

import json

import numpy as np

from ..arrays import Colors
from ..tracer.frame import Frame

LAYER = "CryptoObject"
_MASK = 0xFFFFFFFF


def _rotated(value: int, by: int) -> int:
    return (value << by | value >> (32 - by)) & _MASK


def hashed(name: str) -> int:
    """Return the MurmurHash3_x86_32 of a name's UTF-8, seeded with 0."""
    data = name.encode("utf-8")
    padded = data + bytes(-len(data) % 4)
    out = 0
    for start in range(0, len(padded), 4):
        block = int.from_bytes(padded[start : start + 4], "little")
        out ^= _rotated(block * 0xCC9E2D51 & _MASK, 15) * 0x1B873593 & _MASK
        if start + 4 <= len(data):
            out = (_rotated(out, 13) * 5 + 0xE6546B64) & _MASK
    out ^= len(data)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35)):
        out = (out ^ out >> shift) * factor & _MASK
    return out ^ out >> 16


def id_of(name: str) -> int:
    """Return the bits of the float32 that stands for a name: no NaN, no infinity, no subnormal."""
    bits = hashed(name)
    exponent = bits >> 23 & 0xFF
    return bits ^ 1 << 23 if exponent in (0, 0xFF) else bits


def layer(frame: Frame) -> Colors:
    """Return the layer's first pair of ids and coverages, (h, w, 4) float32; zero for nothing."""
    bits = np.array([*(id_of(name) for name in frame.scene.objects), 0], np.uint32)
    out = np.zeros((*frame.shape, 4), np.float32)
    out[..., 0] = bits.view(np.float32)[frame.object_index]
    out[..., 1] = frame.object_index >= 0
    return out


def header(frame: Frame) -> dict[str, str]:
    """Return what a file's header says of the layer, by the names of its attributes."""
    key = f"cryptomatte/{hashed(LAYER):08x}"[:-1]  # seven digits
    names = {name: f"{id_of(name):08x}" for name in frame.scene.objects}
    return {
        f"{key}/name": LAYER,
        f"{key}/hash": "MurmurHash3_32",
        f"{key}/conversion": "uint32_to_float32",
        f"{key}/manifest": json.dumps(names, ensure_ascii=False, separators=(",", ":")),
    }
