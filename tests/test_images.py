"""Pictures: the transfer function, and files with the right row on top."""

from __future__ import annotations

import re
import struct
import sys
import time
import zlib

import numpy as np
import OpenEXR
import pytest
from PIL import Image
from reference_tracer import exr, images, png
from reference_tracer.exr import MissingLibraryError
from reference_tracer.images import open_picture, read_picture, save_png, to_display


def opaque(values):
    values = np.asarray(values, float)
    return np.stack((values, values, values, np.ones_like(values)), axis=-1)[None]


def decoded(bytes_):
    """Return the linear value of a display value, IEC 61966-2-1."""
    v = np.asarray(bytes_, float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def test_known_greys():
    shown = to_display(opaque([0, 1, 0.5, 0.2140, 0.0031308, 0.001]))[0, :, 0]
    assert shown.tolist() == [0, 255, 188, 127, 10, 3]


def test_display_is_the_nearest_byte():
    linear = np.linspace(0, 1, 4001)
    shown = to_display(opaque(linear))[0, :, 0].astype(int)
    assert (np.diff(shown) >= 0).all()
    assert (decoded(shown - 0.501) <= linear + 1e-9)[shown > 0].all()
    assert (decoded(shown + 0.501) >= linear - 1e-9)[shown < 255].all()


def test_out_of_range_and_not_a_number():
    shown = to_display(opaque([-1, 2, np.inf, -np.inf, np.nan]))[0]
    assert shown[:, 0].tolist() == [0, 255, 255, 0, 0]
    assert (shown[:, 3] == 255).all()


def test_alpha_is_premultiplied():
    half = np.array([[[0.25, 0.5, 0.0, 0.5], [0.3, 0.3, 0.3, 0.0]]])
    assert to_display(half)[0, 0].tolist() == [188, 255, 0, 128]
    assert to_display(half)[0, 1, 3] == 0


@pytest.fixture
def picture(rng):
    return rng.integers(0, 256, (5, 7, 4), dtype=np.uint8)


@pytest.mark.parametrize("shape", [(1, 1), (5, 7), (40, 30)])
def test_png_has_row_0_at_the_bottom(shape, rng, tmp_path):
    picture = rng.integers(0, 256, (*shape, 4), dtype=np.uint8)
    save_png(tmp_path / "p.png", picture)
    with Image.open(tmp_path / "p.png") as read:
        assert (read.format, read.mode, read.size) == ("PNG", "RGBA", shape[::-1])
        assert np.array_equal(np.asarray(read)[::-1], picture)


def test_exr_holds_every_pass(tmp_path, rng):
    passes = {
        "color": rng.random((5, 7, 4), np.float32),
        "depth": np.where(rng.random((5, 7)) < 0.2, np.inf, 2.0),
        "normal": rng.normal(size=(5, 7, 3)),
        "object_index": rng.integers(-1, 2**24, (5, 7), dtype=np.int32),
        "rows_done": np.ones(5, bool),
    }
    exr.save(tmp_path / "p.exr", passes)
    with OpenEXR.File(str(tmp_path / "p.exr"), separate_channels=True) as file:
        channels = {name: c.pixels[::-1] for name, c in file.channels().items()}
    assert set(channels) == {
        *"RGBA",
        "depth.V",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "object_index.V",
    }
    for index, name in enumerate("RGBA"):
        assert np.array_equal(channels[name], passes["color"][..., index])
    for index, name in enumerate("XYZ"):
        assert np.array_equal(
            channels[f"normal.{name}"], passes["normal"][..., index].astype(np.float32)
        )
    assert np.array_equal(channels["depth.V"], passes["depth"])
    assert np.array_equal(channels["object_index.V"], passes["object_index"])


def test_the_same_picture_is_the_same_file(tmp_path, picture):
    """Of another time, too: OpenImageIO would store when it was written."""
    exr.save(tmp_path / "first.exr", {"color": picture})
    time.sleep(1.1)
    exr.save(tmp_path / "second.exr", {"color": picture})
    assert (tmp_path / "first.exr").read_bytes() == (tmp_path / "second.exr").read_bytes()


@pytest.mark.parametrize(
    "use",
    [
        lambda path: exr.save(path / "p.exr", {}),
        lambda path: read_picture(path / "given.exr"),
    ],
)
def test_missing_library_says_how_to_get_it(use, tmp_path, monkeypatch):
    (tmp_path / "given.exr").write_bytes(b"v/1\x01")
    monkeypatch.setitem(sys.modules, "OpenImageIO", None)
    with pytest.raises(
        MissingLibraryError, match=r"OpenImageIO: pip install \"reference_tracer\[images\]\""
    ):
        use(tmp_path)
    assert len(list(tmp_path.iterdir())) == 1


def chunk(kind, content):
    body = kind + content
    return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))


def png_file(path, size, depth, kind, rows, *chunks, interlaced=0, filtered=False):
    """Write a PNG by the letter of its specification, rows as bytes from the top."""
    header = struct.pack(">2I5B", *size, depth, kind, 0, 0, interlaced)
    stored = zlib.compress(b"".join(b"\0" * (not filtered) + bytes(row) for row in rows))
    every = (b"IHDR", header), *chunks, (b"IDAT", stored), (b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*c) for c in every))


@pytest.mark.parametrize("depth", [8, 16])
@pytest.mark.parametrize(
    ("kind", "channels"), [(0, 1), (2, 3), (4, 2), (6, 4)], ids=["grey", "RGB", "grey, A", "RGBA"]
)
def test_a_png_is_read_whole(kind, channels, depth, tmp_path, rng):
    """Every level of every channel, whatever its chunks say of colour: that is told."""
    stored = rng.integers(0, 2**depth, (5, 7, channels)).astype(f">u{depth // 8}")
    gamma = b"gAMA", struct.pack(">I", 100_000)
    png_file(tmp_path / "p.png", (7, 5), depth, kind, [r.tobytes() for r in stored], gamma)
    read = read_picture(tmp_path / "p.png")
    straight = stored[::-1].astype(float) / (2**depth - 1)
    color = np.repeat(straight[..., :1], 3, -1) if channels < 3 else straight[..., :3]
    alpha = straight[..., -1:] if channels in (2, 4) else np.ones((5, 7, 1))
    expected = images.curve_undone(color) * alpha
    assert (read.levels, read.opaque) == (2**depth - 1, channels in (1, 3))
    assert ["gAMA says 1," in remark for remark in read.remarks] == [True]
    assert np.array_equal(read.color, np.concatenate((expected, alpha), -1).astype(np.float32))


@pytest.mark.parametrize("depth", [1, 2, 4])
@pytest.mark.parametrize("palette", [False, True])
@pytest.mark.parametrize("clear", [False, True])
def test_few_levels_a_palette_and_a_clear_color(depth, palette, clear, tmp_path):
    most = 2**depth - 1
    table = np.arange(3 * (most + 1), dtype=np.uint8) * 5
    chunks = [(b"PLTE", table.tobytes())] * palette
    if clear:  # the level 1, half of it where there is a palette
        chunks.append((b"tRNS", b"\xff\x80" if palette else b"\0\1"))
    png_file(tmp_path / "p.png", (8 // depth, 1), depth, 3 * palette, [[0b10110100]], *chunks)
    read = read_picture(tmp_path / "p.png")
    bits = np.unpackbits(np.uint8([0b10110100])).reshape(-1, depth)
    level = bits @ (1 << np.arange(depth)[::-1])
    shown = table.reshape(-1, 3)[level] / 255 if palette else level[:, None].repeat(3, 1) / most
    alpha = np.where(level == 1, 128 / 255 if palette else 0, 1) if clear else np.ones(len(level))
    assert read.levels == 255 and read.opaque is not clear
    assert np.array_equal(read.color[0, :, 3], alpha.astype(np.float32))
    expected = images.curve_undone(shown) * alpha[:, None]
    np.testing.assert_allclose(read.color[0, :, :3], expected, rtol=1e-6)


# The corner and the steps of the passes that interlace a PNG (its specification, 8.1).
ADAM7 = (0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2)
ADAM7 = *ADAM7, (0, 1, 1, 2)


def test_an_interlaced_png(tmp_path, rng):
    stored = rng.integers(0, 2**16, (9, 11, 3)).astype(">u2")
    rows = [row.tobytes() for x, y, dx, dy in ADAM7 for row in stored[y::dy, x::dx]]
    png_file(tmp_path / "p.png", (11, 9), 16, 2, rows, interlaced=1)
    expected = images.curve_undone(stored[::-1] / 65535).astype(np.float32)
    assert np.array_equal(read_picture(tmp_path / "p.png").color[..., :3], expected)


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
    assert read_picture(tmp_path / "p.png").color[0, :, 3].tolist() == [1, 1, 0, 1]


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
        ([(b"eXIf", b"MM"), (b"acTL", bytes(8))], ["its chunks acTL, eXIf say is not understood"]),
        ([(b"pHYs", bytes(9)), (b"tEXt", b"Scene\0Scene"), (b"tIME", bytes(7))], []),
    ],
)
def test_what_a_png_says_of_its_pixels_is_told(chunks, remarks, tmp_path):
    png_file(tmp_path / "p.png", (2, 1), 8, 2, [bytes(6)], *chunks)
    found = read_picture(tmp_path / "p.png").remarks
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
        read_picture(tmp_path / "p.png")


@pytest.mark.parametrize("of", ["gradient", "noise"])
def test_a_picture_that_another_program_filtered(of, tmp_path, rng):
    y, x = np.mgrid[:61, :83]
    smooth = np.stack((x * 3, y * 4, x + y, 255 - x), axis=-1) % 256
    values = (smooth if of == "gradient" else rng.integers(0, 256, smooth.shape)).astype(np.uint8)
    Image.fromarray(values).save(tmp_path / "p.png", optimize=True)
    assert np.array_equal(png.decode((tmp_path / "p.png").read_bytes()).values, values)


def test_a_pictures_size_is_known_before_its_pixels(tmp_path):
    """Which may be many, or damaged."""
    png_file(tmp_path / "p.png", (100_000, 100_000), 1, 0, [])
    exr.save(tmp_path / "p.exr", {"color": np.ones((4, 6, 4))})
    sizes = [
        (f.width, f.height) for f in (open_picture(tmp_path / f"p.{s}") for s in ("png", "exr"))
    ]
    assert sizes == [(100_000, 100_000), (6, 4)]
    with pytest.raises(OSError, match="fewer pixels than it says"):
        open_picture(tmp_path / "p.png").read()


def test_a_damaged_chunk_is_named(tmp_path, picture):
    content = bytearray(png.encode(picture))
    content[60] ^= 1
    (tmp_path / "p.png").write_bytes(content)
    with pytest.raises(OSError, match=r"p\.png' cannot be read, save it again: its chunk IDAT"):
        read_picture(tmp_path / "p.png")


@pytest.mark.parametrize("side", [2**31 - 1, 2**32 - 1])
def test_a_picture_that_is_said_to_be_larger_than_any_memory(side):
    header = struct.pack(">2I5B", side, side, 16, 6, 0, 0, 0)
    parts = chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(bytes(9))), chunk(b"IEND", b"")
    with pytest.raises(png.PngError, match="fewer pixels"):
        png.decode(png.SIGNATURE + b"".join(parts))


@pytest.mark.torture
def test_a_picture_of_more_than_179_megapixels(tmp_path):
    rows = [bytes(1600)] * 14_000  # 1 bit each
    png_file(tmp_path / "p.png", (12_800, 14_000), 1, 0, rows)
    read = read_picture(tmp_path / "p.png")
    assert read.color.shape == (14_000, 12_800, 4)


@pytest.mark.parametrize("name", ["p.png", "p.exr"])
@pytest.mark.parametrize("share", [0.02, 0.5, 0.98])
def test_a_truncated_picture_is_named_in_one_line(name, share, tmp_path, rng, capfd):
    whole = rng.random((40, 30, 4), np.float32)
    save_png(tmp_path / name, to_display(whole)) if name == "p.png" else exr.save(
        tmp_path / name, {"color": whole}
    )
    content = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(content[: int(share * len(content))])
    with pytest.raises(OSError, match=rf"{name}' cannot be read, save it again: .") as error:
        read_picture(tmp_path / name)
    assert "\n" not in str(error.value) and capfd.readouterr() == ("", "")


def test_a_damaged_name_of_a_channel_is_no_error_of_its_own(tmp_path):
    """The library quotes the file's bytes, which are no UTF-8."""
    exr.save(tmp_path / "p.exr", {"color": np.ones((4, 4, 4))})
    content = (tmp_path / "p.exr").read_bytes()
    (tmp_path / "p.exr").write_bytes(
        content.replace(b"channels\0chlist", b"ch\xffnnels\0chli\xfft")
    )
    with pytest.raises(OSError, match=r"p\.exr' cannot be read"):
        read_picture(tmp_path / "p.exr")


@pytest.mark.parametrize("name", ["p.png", "p.exr"])
def test_the_picture_of_another_format(name, tmp_path, picture):
    save_png(tmp_path / "other.png", picture)
    content = (tmp_path / "other.png").read_bytes()
    if name == "p.png":
        content = b"P6 1 1 255\n\0\0\0"  # a PPM
    (tmp_path / name).write_bytes(content)
    with pytest.raises(OSError, match=rf"{name}' is (no .png|a PNG picture)"):
        read_picture(tmp_path / name)


def test_a_png_is_written_without_a_library(picture, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    save_png(tmp_path / "p.png", picture)
    assert (tmp_path / "p.png").read_bytes() == png.encode(picture)
    with pytest.raises(OSError, match="nowhere"):
        save_png(tmp_path / "nowhere" / "p.png", picture)
