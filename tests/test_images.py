"""Pictures: the transfer function, and files with the right row on top."""

from __future__ import annotations

import sys

import numpy as np
import OpenEXR
import pytest
from PIL import Image
from reference_tracer.images import (
    MissingLibraryError,
    png,
    read_picture,
    save_exr,
    save_png,
    to_display,
)


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
    save_exr(tmp_path / "p.exr", passes)
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


@pytest.mark.parametrize(
    "use, library, module",
    [
        (lambda path: save_exr(path / "p.exr", {}), "OpenEXR", "OpenEXR"),
        (lambda path: read_picture(path / "given.exr"), "OpenEXR", "OpenEXR"),
        (lambda path: read_picture(path / "given.png"), "Pillow", "PIL"),
    ],
)
def test_missing_library_says_how_to_get_it(use, library, module, tmp_path, monkeypatch):
    for name in ("given.exr", "given.png"):
        (tmp_path / name).touch()
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingLibraryError, match=rf"{library}.*pip install"):
        use(tmp_path)
    assert len(list(tmp_path.iterdir())) == 2


def test_a_png_is_written_without_a_library(picture, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    save_png(tmp_path / "p.png", picture)
    assert (tmp_path / "p.png").read_bytes() == png(picture)
    with pytest.raises(OSError, match="nowhere"):
        save_png(tmp_path / "nowhere" / "p.png", picture)
