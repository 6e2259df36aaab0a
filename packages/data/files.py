"""Reads data from files: .npy, .npz, .exr, and .png of integers; which array, and how it rounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array
from reference_tracer.files import exr, npz, png
from reference_tracer.files.file_kinds import mistaken
from reference_tracer.files.png.samples import PngError

from .kind import Kind
from .step import Step

SUFFIXES = (".exr", ".npy", ".npz", ".png")
_ENDS = ("rgba", "rgb", "xyz", "z", "v", "y", "r", "x")  # letters of a layer's channels, together


@dataclass(frozen=True, eq=False)
class StoredData:
    """The values of a file, of a kind of data, in its own integers or floats."""

    values: Array  # (h, w, c), row 0 at the bottom
    step: Step  # of integers with a unit of 1
    top: float  # the largest integer that it can hold; 1 of floats


def read(path: Path | Array, kind: Kind, layer: str = "", top_down: bool = False) -> StoredData:
    """Read a kind of data from a file, or take an array.

    Parameters
    ----------
    path : Path or (h, w) or (h, w, c) array
    kind : Kind
    layer : str
        The name of the array, or of the layer of channels; '' where the kind's own names decide.
    top_down : bool
        Whether an array of .npy or .npz has its first row on top. Files of pictures have.

    Raises
    ------
    MissingLibraryError
        If it is an EXR, and OpenImageIO is not installed.
    SceneError
        If an .npy or .npz cannot be read.
    OSError
        If there is no such file, it cannot be read, or it does not hold such data.
    """
    if not isinstance(path, Path):
        return _stored("array", {"": np.asarray(path)}, kind, layer, top_down)
    if not path.is_file():
        raise OSError(f"there is no file '{path}', or it is a folder or a pipe")
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise OSError(f"'{path}' holds no {kind.name}: it must be {', '.join(SUFFIXES)}")
    if said := mistaken(path):
        raise OSError(f"'{path}' {said}")
    return _stored(path, _READ[suffix](path), kind, layer, top_down or suffix in (".png", ".exr"))


def _stored(
    path: object, layers: Mapping[str, Array], kind: Kind, layer: str, top_down: bool
) -> StoredData:
    """Return the requested layer."""
    name = _chosen(path, layers, kind, layer)
    values = _shaped(path, layers[name], kind, name)
    if top_down:
        values = values[::-1]
    if values.dtype.kind not in "fiub":
        raise OSError(f"'{path}' holds {values.dtype} and not numbers")
    if values.dtype.kind == "f":
        return StoredData(values, Step(f"float{8 * min(values.dtype.itemsize, 8)}"), 1.0)
    top = 1.0 if values.dtype.kind == "b" else float(np.iinfo(values.dtype).max)
    return StoredData(values, Step(""), top)


def _npz(path: Path) -> dict[str, Array]:
    """Return the arrays that may be pictures."""
    with npz.opened(path) as held:
        return {name: held[name] for name in held if len(held.header(name).shape) in (2, 3)}


def _png(path: Path) -> dict[str, Array]:
    try:
        stored = png.decode(path.read_bytes())
    except PngError as error:
        raise OSError(f"'{path}' cannot be read, save it again: {error}") from error
    return {"": stored.values[..., :-1] if stored.has_alpha else stored.values}


def _exr(path: Path) -> dict[str, Array]:
    """Return the layers of an EXR: channels that share a name before the last dot, as one array."""
    channels = exr.read_channels(path)
    layers: dict[str, dict[str, Array]] = {}
    for name, values in channels.items():
        before, _, letter = name.rpartition(".")
        if len(letter) > 1:  # a channel with a name of its own
            before, letter = name, "V"
        layers.setdefault(before, {})[letter.lower()] = values
    out: dict[str, Array] = {}
    for name, own in layers.items():
        for letters in _ENDS:
            if set(letters) <= set(own):
                held = np.stack([own[letter] for letter in letters if letter != "a"], axis=-1)
                out.setdefault(name, held)
        if "z" in own and "x" not in own:  # beside "R", "G", "B"
            out[f"{name}.Z" if name else "Z"] = own["z"]
    return out


_READ = {".npy": lambda path: {"": npz.load_npy(path)}, ".npz": _npz, ".exr": _exr, ".png": _png}


def _chosen(path: object, layers: Mapping[str, Array], kind: Kind, layer: str) -> str:
    """Return the name of the layer that holds the kind."""
    if layer:
        if layer in layers:
            return layer
        raise OSError(f"'{path}' has no layer '{layer}': it has {_named(layers)}")
    fitting = [name for name, values in layers.items() if _fits(values, kind)]
    for wanted in kind.layers:
        own = [name for name in fitting if name.lower().rpartition(".")[2] == wanted]
        if len(own) == 1:
            return own[0]
    if len(fitting) == 1:
        return fitting[0]
    which = f"several arrays that may be {kind.name}" if fitting else f"no {kind.name}"
    do = "; layer= names the right one" if fitting else ""
    raise OSError(f"'{path}' holds {which}: it has {_named(layers)}{do}")


def _named(layers: Mapping[str, Array]) -> str:
    said = (f"{name or 'one array'} {values.shape}" for name, values in layers.items())
    return ", ".join(said) or "no array of pixels"


def _fits(values: Array, kind: Kind) -> bool:
    channels = values.shape[2] if values.ndim == 3 else 1
    return values.ndim in (2, 3) and channels in (kind.channels, 3, 4)


def _shaped(path: object, values: Array, kind: Kind, name: str) -> Array:
    """Return an array as (h, w, c), with as many channels as the kind has."""
    if values.ndim not in (2, 3) or not values.size:
        raise OSError(f"'{path}': {name or 'it'} has the shape {values.shape}, not (h, w, c)")
    values = values.reshape(*values.shape[:2], -1)
    if kind.name == "ids":  # a colour stands for an object
        return values
    if kind.channels == 1 and values.shape[2] in (3, 4):
        rgb = values[..., :3]
        if not np.array_equal(rgb, np.broadcast_to(rgb[..., :1], rgb.shape), equal_nan=True):
            say = f"'{path}': its channels differ, so that none of them is {kind.words}"
            raise OSError(f"{say}: save the values as they are, not as colours")
        values = values[..., :1]
    if values.shape[2] > kind.channels == 3:
        values = values[..., :3]  # the fourth is alpha
    if values.shape[2] != kind.channels:
        say = f"'{path}': {kind.words} take {kind.channels} channels"
        raise OSError(f"{say}, not {values.shape[2]}")
    return values
