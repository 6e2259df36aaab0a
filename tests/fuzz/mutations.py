"""Valid files made hostile: bits turned, parts cut, doubled or swapped, numbers replaced.

Formats with checksums are changed inside of them too, so that more than the checksum is met.
"""

from __future__ import annotations

import io
import json
import re
import struct
import warnings
import zipfile
import zlib
from typing import Any

import numpy as np

NUMBERS = (
    "nan",
    "inf",
    "-inf",
    "1e999",
    "-1",
    "0",
    "-0",
    "1",
    "2",
    "0.5",
    "1e308",
    "-1e308",
    "1e-320",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "9223372036854775808",
    "1" + "0" * 40,
    "",
    "x",
    "1//2",
    "true",
    "null",
    "[]",
    "{}",
    '"5"',
    "0x10",
    "1_0",
    "\u0663",
    "\ud800",
)
VALUES: tuple[Any, ...] = (
    None,
    True,
    False,
    -1,
    0,
    1,
    2,
    0.5,
    2**31,
    2**63,
    10**40,
    1e308,
    1e-320,
    float("nan"),
    float("inf"),
    -float("inf"),
    "",
    "x",
    "5",
    "\ud800",
    "inf",
    [],
    {},
    [1, 2],
    [[]],
    {"a": 1},
    [float("nan")] * 4,
    [1e308] * 4,
    [[0] * 4] * 4,
    "x" * 999,
)
WORDS = 0, 1, 2, 7, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 2**62
DTYPES = "f2 f4 f8 i1 i4 i8 u4 u8 ? c8 U3 S3 m8 g V4 i4,f4 >i4 >f8".split()


def damaged(content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    """Change some bytes, mostly once."""
    data = bytearray(content)
    for _ in range(rng.geometric(0.6)):
        at, long = (int(v) for v in rng.integers(0, len(data) + 1, 2))
        long = min(long, int(2 ** rng.uniform(0, 9)))
        how = rng.integers(0, 8)
        if how == 0 and at < len(data):
            data[at] ^= 1 << int(rng.integers(8))
        elif how == 1:
            data[at : at + long] = rng.bytes(long)
        elif how == 2:
            del data[at : at + long]
        elif how == 3:
            data[at:at] = data[max(0, at - long) : at]
        elif how == 4:
            start = int(rng.integers(0, len(other) + 1))
            data[at : at + long] = other[start : start + long]
        elif how == 5:
            word, size = WORDS[rng.integers(len(WORDS))], (1, 2, 4, 8)[rng.integers(4)]
            word = word % 2 ** (8 * size)
            data[at : at + size] = word.to_bytes(size, ("little", "big")[rng.integers(2)])
        elif how == 6 and rng.random() < 0.4:
            del data[at:]
        else:
            data = bytearray(renumbered(bytes(data), rng))
    return bytes(data)


def renumbered(content: bytes, rng: np.random.Generator) -> bytes:
    """Replace a number that is written out."""
    found = list(re.finditer(rb"-?\d[\d.eE+-]*", content[:100_000]))
    if not found:
        return content
    start, end = found[rng.integers(len(found))].span()
    number = NUMBERS[rng.integers(len(NUMBERS))].encode("utf-8", "surrogatepass")
    return content[:start] + number + content[end:]


def changed(value: Any, rng: np.random.Generator) -> Any:
    """Return JSON with one value in it replaced, left out or doubled."""
    keys = list(value) if isinstance(value, dict) else range(len(value) if _is_list(value) else 0)
    if not len(keys) or rng.random() < 0.15:
        return VALUES[rng.integers(len(VALUES))]
    key, out = keys[rng.integers(len(keys))], value.copy()
    how = rng.random()
    if how < 0.1:
        del out[key]
    elif how < 0.15 and _is_list(out):
        out.insert(key, out[key])
    else:
        out[key] = changed(out[key], rng)
    return out


def _is_list(value: Any) -> bool:
    return isinstance(value, list)


def json_file(content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    if rng.random() < 0.3:
        return damaged(content, rng, other)
    value = json.loads(content)
    for _ in range(rng.geometric(0.6)):
        value = changed(value, rng)
    return json.dumps(value).encode()


def npz_file(content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    if rng.random() < 0.2:
        return damaged(content, rng, other)
    with zipfile.ZipFile(io.BytesIO(content)) as stored:
        members = {name: stored.read(name) for name in stored.namelist()}
    names = sorted(members)
    for _ in range(rng.geometric(0.6)):
        is_head = "scene.npy" in members and rng.random() < 0.4
        name = "scene.npy" if is_head else names[rng.integers(len(names))]
        how = rng.random()
        if how < 0.05:
            members.pop(name, None)
        elif how < 0.15:
            members[name] = members.get(names[rng.integers(len(names))], b"")
        elif how < 0.3:
            members[name] = damaged(members.get(name, b""), rng, content)
        elif name in members:
            members[name] = _array(members[name], rng)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as stored:
        for name, member in members.items():
            stored.writestr(name, member)
    return out.getvalue()


def _array(member: bytes, rng: np.random.Generator) -> bytes:
    try:
        array = np.load(io.BytesIO(member))
        is_head = array.dtype.kind == "U" and not array.ndim and str(array)[:1] == "{"
        head = json.loads(str(array)) if is_head else None
    except Exception:  # damaged before
        return member
    how = rng.integers(0, 4)
    with np.errstate(all="ignore"):
        if is_head:
            array = np.array(json.dumps(changed(head, rng)))
        elif how == 0:
            dtype = DTYPES[rng.integers(len(DTYPES))]
            array = np.zeros(array.shape, dtype) if "," in dtype else _cast(array, dtype)
        elif how == 1:
            shapes = [(-1,), (*array.shape, 1), (1, *array.shape), array.shape[::-1]]
            array = array.reshape(shapes[rng.integers(4)])
        elif how == 2 and array.ndim:
            array = array[: rng.integers(0, len(array) + 1)]
        elif array.size and array.dtype.kind != "U":
            number = (np.nan, np.inf, 1e308, -1e308, 1e39, 1e-320, 0, -1, 99, 2**31)[
                rng.integers(10)
            ]
            array = array.copy()
            if array.dtype.kind == "i" and not abs(number) < 2**40:
                number = -(2**31)
            where = array.reshape(-1)[rng.integers(array.size) :: 1 + rng.integers(array.size)]
            where[:] = np.array(number, np.float64).astype(array.dtype)
    out = io.BytesIO()
    np.lib.format.write_array(out, array)
    return out.getvalue()


def _cast(array: np.ndarray, dtype: str) -> np.ndarray:
    try:
        with warnings.catch_warnings(action="ignore"):  # complex numbers lose a part
            return array.astype(dtype)
    except (TypeError, ValueError):
        return array


def png_file(content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    """Change chunks, and mostly make their checksums right again."""
    if rng.random() < 0.3:
        return damaged(content, rng, other)
    chunks, at = [], 8
    while at < len(content):
        (size,) = struct.unpack(">I", content[at : at + 4])
        chunks.append([content[at + 4 : at + 8], content[at + 8 : at + 8 + size]])
        at += 12 + size
    own = dict(chunks)[b"IDAT"]
    for _ in range(rng.geometric(0.6)):
        number = 0 if rng.random() < 0.4 else int(rng.integers(len(chunks)))
        kind, body = chunks[number]
        how = rng.random()
        if how < 0.1:
            chunks.insert(int(rng.integers(len(chunks))), [kind, body])
        elif how < 0.15 and len(chunks) > 1:
            del chunks[number]
        elif kind == b"IDAT" and body == own and how < 0.6:
            chunks[number][1] = zlib.compress(damaged(zlib.decompress(body), rng, other))
            break  # what is damaged may be no stream any more
        else:
            chunks[number][1] = damaged(body, rng, other)
    parts = (kind + body for kind, body in chunks)
    every = (struct.pack(">I", len(p) - 4) + p + struct.pack(">I", zlib.crc32(p)) for p in parts)
    return content[:8] + b"".join(every)


def glb_file(content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    """Change what is said of the arrays."""
    if rng.random() < 0.3:
        return damaged(content, rng, other)
    (size,) = struct.unpack("<I", content[12:16])
    value, rest = json.loads(content[20 : 20 + size]), content[20 + size :]
    for _ in range(rng.geometric(0.6)):
        value = changed(value, rng)
    text = json.dumps(value).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<3I", 0x46546C67, 2, 20 + len(text) + len(rest))
    return head + struct.pack("<I", len(text)) + b"JSON" + text + rest


MUTATIONS = {
    ".npz": npz_file,
    ".json": json_file,
    ".png": png_file,
    ".glb": glb_file,
    ".gltf": json_file,
}


def mutated(suffix: str, content: bytes, rng: np.random.Generator, other: bytes) -> bytes:
    return MUTATIONS.get(suffix, damaged)(content, rng, other)
