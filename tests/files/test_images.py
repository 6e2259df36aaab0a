"""Pictures: the transfer function, and files with the right row on top."""

from __future__ import annotations

import struct
import sys
import time
import zlib

import numpy as np
import OpenEXR
import pytest
from PIL import Image
from reference_tracer.files import exr, png
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.files.images import open_picture, save_png, to_display

from .png_files import chunk, png_file


def opaque(values):
    values = np.asarray(values, float)
    return np.stack((values, values, values, np.ones_like(values)), axis=-1)[None]


def decoded(bytes_):
    """Return the linear value of a display value, IEC 61966-2-1."""
    v = np.asarray(bytes_, float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


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
        "Z",
        "N.X",
        "N.Y",
        "N.Z",
        "object_index.V",
    }
    for index, name in enumerate("RGBA"):
        assert np.array_equal(channels[name], passes["color"][..., index])
    for index, name in enumerate("XYZ"):
        assert np.array_equal(
            channels[f"N.{name}"], passes["normal"][..., index].astype(np.float32)
        )
    assert np.array_equal(channels["Z"], passes["depth"])
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
        lambda path: open_picture(path / "given.exr").read(),
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
        open_picture(tmp_path / "p.png").read()


@pytest.mark.parametrize("side", [2**31 - 1, 2**32 - 1])
def test_a_picture_that_is_said_to_be_larger_than_any_memory(side):
    header = struct.pack(">2I5B", side, side, 16, 6, 0, 0, 0)
    parts = chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(bytes(9))), chunk(b"IEND", b"")
    with pytest.raises(png.PngError, match="fewer pixels"):
        png.decode(png.SIGNATURE + b"".join(parts))


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
        open_picture(tmp_path / name).read()
    assert "\n" not in str(error.value) and capfd.readouterr() == ("", "")


def test_a_damaged_name_of_a_channel_is_no_error_of_its_own(tmp_path):
    """The library quotes the file's bytes, which are no UTF-8."""
    exr.save(tmp_path / "p.exr", {"color": np.ones((4, 4, 4))})
    content = (tmp_path / "p.exr").read_bytes()
    (tmp_path / "p.exr").write_bytes(
        content.replace(b"channels\0chlist", b"ch\xffnnels\0chli\xfft")
    )
    with pytest.raises(OSError, match=r"p\.exr' cannot be read"):
        open_picture(tmp_path / "p.exr").read()
