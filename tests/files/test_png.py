"""PNG files: each kind is read whole, and what one says of its colours is told."""

from __future__ import annotations

import re
import struct
import zlib

import numpy as np
import pytest
from PIL import Image
from reference_tracer.files import images, png
from reference_tracer.files.images import open_picture

from .png_files import png_file


@pytest.mark.parametrize("depth", [8, 16])
@pytest.mark.parametrize(
    ("kind", "channels"), [(0, 1), (2, 3), (4, 2), (6, 4)], ids=["grey", "RGB", "grey, A", "RGBA"]
)
def test_a_png_is_read_whole(kind, channels, depth, tmp_path, rng):
    """Every level of every channel, whatever its chunks say of colour: that is told."""
    stored = rng.integers(0, 2**depth, (5, 7, channels)).astype(f">u{depth // 8}")
    gamma = b"gAMA", struct.pack(">I", 100_000)
    png_file(tmp_path / "p.png", (7, 5), depth, kind, [r.tobytes() for r in stored], gamma)
    read = open_picture(tmp_path / "p.png").read()
    straight = stored[::-1].astype(float) / (2**depth - 1)
    color = np.repeat(straight[..., :1], 3, -1) if channels < 3 else straight[..., :3]
    alpha = straight[..., -1:] if channels in (2, 4) else np.ones((5, 7, 1))
    expected = images.curve_undone(color) * alpha
    assert (read.levels, read.opaque) == (2**depth - 1, channels in (1, 3))
    assert ["gAMA says 1," in remark for remark in read.remarks] == [True]
    assert np.array_equal(read.color, np.concatenate((expected, alpha), -1).astype(np.float32))


ADAM7 = (  # where each pass begins, and its steps: x, y, dx, dy
    (0, 0, 8, 8),
    (4, 0, 8, 8),
    (0, 4, 4, 8),
    (2, 0, 4, 4),
    (0, 2, 2, 4),
    (1, 0, 2, 2),
    (0, 1, 1, 2),
)


@pytest.mark.parametrize("mode", ["L", "LA", "RGB", "RGBA", "I;16"])
def test_every_filter_is_undone(mode, tmp_path, rng):
    """Each row with a filter of its own, written out by the specification; Pillow is the judge."""
    dtype, step = (">u2", 2) if mode == "I;16" else ("u1", len(mode))
    values = rng.integers(0, 9, (40, 23, step // np.dtype(dtype).itemsize)).cumsum(1).astype(dtype)
    lines = values.view("u1").reshape(40, -1).astype(int)
    padded = np.pad(lines, ((1, 0), (step, 0)))
    left, above, corner = padded[1:, :-step], padded[:-1, step:], padded[:-1, :-step]
    off = [abs(left + above - corner - v) for v in (left, above, corner)]
    paeth = np.select(
        [(off[0] <= off[1]) & (off[0] <= off[2]), off[1] <= off[2]], (left, above), corner
    )
    predicted = 0 * left, left, above, (left + above) // 2, paeth
    kinds = np.arange(40) % 5
    rows = [bytes([k, *((lines[y] - predicted[k][y]) % 256)]) for y, k in enumerate(kinds)]
    kind = {"L": 0, "LA": 4, "RGB": 2, "RGBA": 6, "I;16": 0}[mode]
    png_file(tmp_path / "p.png", (23, 40), 8 * np.dtype(dtype).itemsize, kind, rows, filtered=True)
    assert np.array_equal(png.decode((tmp_path / "p.png").read_bytes()).values, values)
    with Image.open(tmp_path / "p.png") as judge:
        assert np.array_equal(np.asarray(judge).reshape(values.shape), values)


ALL_KINDS = [(0, d) for d in (1, 2, 4, 8, 16)] + [(3, d) for d in (1, 2, 4, 8)]


ALL_KINDS += [(kind, depth) for kind in (2, 4, 6) for depth in (8, 16)]


@pytest.mark.parametrize("interlaced", [0, 1])
@pytest.mark.parametrize(("kind", "depth"), ALL_KINDS)
@pytest.mark.parametrize("clear", [False, True])
def test_every_kind_of_png_is_what_pillow_reads(kind, depth, clear, interlaced, tmp_path, rng):
    """But Pillow looks for a clear colour after it has made 8 bits of it."""
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind]
    values = rng.integers(0, 2**depth, (9, 11, channels))
    passes = ADAM7 if interlaced else ((0, 0, 1, 1),)
    rows = []
    for x, y, dx, dy in passes:
        for row in values[y::dy, x::dx].reshape(len(values[y::dy]), -1):
            bits = row[:, None] >> np.arange(depth)[::-1] & 1
            rows.append(np.packbits(bits.astype(np.uint8)).tobytes())
    chunks = []
    if kind == 3:
        chunks.append((b"PLTE", rng.integers(0, 256, 3 * 2**depth).astype(np.uint8).tobytes()))
    if clear and kind < 4:
        alpha = rng.integers(0, 256, 2 ** (depth - 1)).astype(np.uint8)
        chunks.append((b"tRNS", alpha.tobytes() if kind == 3 else values[4, 5].astype(">u2")))
    chunks = [(name, bytes(body)) for name, body in chunks]
    png_file(tmp_path / "p.png", (11, 9), depth, kind, rows, *chunks, interlaced=interlaced)
    read = png.decode((tmp_path / "p.png").read_bytes())
    top = read.values.astype(int)
    if read.values.shape[2] < 3:
        top = top[..., [0, 0, 0, 1][: 3 + read.has_alpha]]
    assert read.has_alpha == (kind > 3 or bool(chunks and chunks[-1][0] == b"tRNS"))
    with Image.open(tmp_path / "p.png") as judge:
        if judge.mode.startswith("I"):
            assert np.array_equal(np.asarray(judge), top[..., 0])
            return
        shown = np.asarray(judge.convert("RGBA" if read.has_alpha else "RGB")).astype(int)
    if clear and kind in (0, 2):
        hole = (values == values[4, 5]).all(axis=-1)
        assert np.array_equal(top[..., 3], np.where(hole, 0, 2**depth - 1))
        shown, top = shown[..., :3], top[..., :3]
    assert np.array_equal(shown, top >> 8 if read.levels > 255 else top * 255 // read.levels)


def test_the_upper_bits_of_a_clear_level_say_nothing(tmp_path):
    """The specification, 11.3.1.1: they are masked."""
    png_file(tmp_path / "p.png", (4, 1), 2, 0, [[0b00011011]], (b"tRNS", b"\xff\xfe"))
    assert open_picture(tmp_path / "p.png").read().color[0, :, 3].tolist() == [1, 1, 0, 1]


SRGB_CHROMATICITIES = 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000


@pytest.mark.parametrize(
    ("chunks", "remarks"),
    [
        ([(b"sRGB", b"\0"), (b"gAMA", struct.pack(">I", 100_000))], []),  # sRGB counts
        ([(b"gAMA", struct.pack(">I", 45_455))], []),
        ([(b"gAMA", struct.pack(">I", 45_454))], []),
        ([(b"gAMA", struct.pack(">I", 55_556))], ["gAMA says 0.55556, sRGB is about 0.45455"]),
        ([(b"cHRM", struct.pack(">8I", *SRGB_CHROMATICITIES))], []),
        ([(b"cHRM", struct.pack(">8I", *SRGB_CHROMATICITIES[:6], 15500, 6000))], ["primaries"]),
        ([(b"iCCP", b"Display P3\0\0" + zlib.compress(b"x"))], ["colour profile 'Display P3'"]),
        ([(b"iCCP", b"P3\0\0x"), (b"gAMA", struct.pack(">I", 1))], ["colour profile 'P3'"]),
        ([(b"cICP", bytes((1, 13, 0, 1))), (b"iCCP", b"P3\0\0x")], []),
        ([(b"cICP", bytes((9, 16, 0, 1)))], [r"cICP names other colours \(9, 16, 0, 1\)"]),
        ([(b"sBIT", b"\5\6\5")], ["only 5 of 8 bits"]),
        ([(b"sBIT", b"\x08\x08\x08")], []),
        ([(b"eXIf", b"MM"), (b"oFFs", bytes(9)), (b"eXIf", b"MM")], []),
        ([(b"acTL", bytes(8))], ["its chunks acTL say is not understood"]),
        ([(b"pHYs", bytes(9)), (b"tEXt", b"Scene\0Scene"), (b"tIME", bytes(7))], []),
    ],
)
def test_what_a_png_says_of_its_pixels_is_told(chunks, remarks, tmp_path):
    png_file(tmp_path / "p.png", (2, 1), 8, 2, [bytes(6)], *chunks)
    found = open_picture(tmp_path / "p.png").read().remarks
    assert len(found) == len(remarks)
    for one, remark in zip(found, remarks, strict=True):
        assert re.search(remark, one)


@pytest.mark.parametrize(
    ("chunk_", "message"),
    [((b"CgBI", b"\x50"), "its chunk CgBI is not understood"), ((b"gAMA", b"\0"), "damaged")],
)
def test_what_a_png_must_be_understood_by_is_refused(chunk_, message, tmp_path):
    png_file(tmp_path / "p.png", (2, 1), 8, 2, [bytes(6)], chunk_)
    with pytest.raises(OSError, match=message):
        open_picture(tmp_path / "p.png").read()


def test_what_is_there_too_often_or_behind_the_end_is_told(tmp_path):
    """A viewer shows such a picture: it is read as the first of them says."""
    path, gamma = tmp_path / "a.png", (b"gAMA", struct.pack(">I", 45_455))
    png_file(path, (1, 1), 8, 0, [b"\7"], gamma, gamma)
    once = png.decode(path.read_bytes())
    assert once.remarks == ("it has more than one chunk gAMA: the first one was read",)
    png_file(path, (1, 1), 8, 0, [b"\7"], (b"tEXt", b"a\0b"), (b"tEXt", b"c\0d"))
    assert png.decode(path.read_bytes()).remarks == ()
    path.write_bytes(path.read_bytes() + b"more" * 5)
    assert png.decode(path.read_bytes()).remarks == ("20 bytes behind its end are not read",)
    png_file(path, (1, 1), 8, 3, [b"\0"], (b"PLTE", bytes(3)), (b"PLTE", bytes(3)))
    with pytest.raises(png.PngError, match="more than one chunk PLTE"):
        png.decode(path.read_bytes())
