"""Writes a comparison as a folder: three pictures, all arrays, the page, and the JSON."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import chain
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np

from ..arrays import Array, Colors, parts
from ..causes.case import Case
from ..causes.cause import UNEXPLAINED
from ..causes.explain import CAUSES
from ..causes.maps import cause_map
from ..comparison.comparing import compared, diagnosed
from ..comparison.comparison import SCHEMA, Comparison
from ..comparison.extras import Extras
from ..comparison.extras import extras as find_extras
from ..comparison.verdict import Verdict
from ..diagnosis.regions import Region, regions, sides
from ..files import images, png
from ..tracer.frame import PASSES
from ..tracer.progress import Progress, Work, scaled
from . import page
from .folders import replacing, write_json

PICTURES = "traced", "blender", "difference"
ARRAYS, JSON = "frame.npz", "comparison.json"
_LEVEL = 1  # of zlib
# Noisy arrays: zlib's run-length strategy is nearly enough, and two to three times as fast.
_NOISY = "depth", "t", "position", "barycentrics"
_ROWS = 32  # of an array that are copied and deflated at a time
NAMES = *(f"{name}.png" for name in PICTURES), ARRAYS, page.NAME, JSON


def write(
    directory: str | Path, comparison: Comparison, extras: Extras | None = None
) -> Work[None]:
    """Write the pictures, `frame.npz`, `page.html` with the extras, and `comparison.json`.

    In small steps; all or none, in a folder that is made where it is not there: see
    :func:`folders.replacing`.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    colors = comparison.frame.color, comparison.picture, cause_picture(comparison)
    with replacing(Path(directory), NAMES) as new:
        stored = {}
        for name, color in zip(PICTURES, colors, strict=True):
            stored[name] = png.encode(images.to_display(color))
            (new / f"{name}.png").write_bytes(stored[name])
            yield None
        height = comparison.frame.shape[0]
        yield from _write_arrays(new / ARRAYS, height, _arrays(comparison))
        page.write(new / page.NAME, comparison, extras, stored)
        write_json(new / JSON, comparison.to_dict())


def written(
    folder: Path,
    case: Case,
    diagnose: bool,
    trade: bool = False,
    extremes: bool = False,
    literal: bool = True,
) -> Work[Comparison]:
    """Compare, find what else the page shows, and write; then diagnose, and write again.

    Who ends it in the midst of the diagnosis has the comparison in the folder without it. If the
    work fails, a folder without results says why. The page has the literal textbook's picture if
    that is wanted.
    """
    there, safe = (0.2, 0.8) if trade or extremes else (0.5, 0.6)
    with failure_written(folder):
        found = yield from scaled(compared(case, literally=literal), 0.0, there)
        extras = find_extras(found, trade, extremes, literal)
        more = yield from scaled(extras, there, safe - there)
        yield from scaled(write(folder, found, more), safe, 0.0, "writing")
        if diagnose:
            found = yield from diagnosed(found, f" ({folder / page.NAME})")
        if found.diagnosis:
            yield from scaled(write(folder, found, more), 1.0, 0.0, "writing")
    yield Progress(1.0)
    return found


def _arrays(comparison: Comparison) -> Iterator[tuple[str, Iterator[Array]]]:
    """Yield all arrays by name, one after the other: together they take much memory.

    Each comes as blocks of rows, below one another.
    """
    for each in PASSES:
        yield each.name, comparison.frame.blocks(each.name)
    # The object that each side shows, as a number among the JSON's names, where it is known.
    if owners := comparison.identity:
        yield "owner_traced", iter([owners.traced])
        yield "owner_shown", iter([owners.shown])
    yield "blender", iter([comparison.picture])
    for name in ("cause", "blind", "figure", "allowed"):
        values: Array = getattr(comparison.causes, name)
        yield f"cause_{name}" if name in ("figure", "allowed") else name, iter([values])


def _write_arrays(
    path: Path, height: int, arrays: Iterable[tuple[str, Iterator[Array]]]
) -> Work[None]:
    """Write what `numpy.savez_compressed` does, larger by a tenth and in less time."""
    with ZipFile(path, "w", ZIP_DEFLATED, compresslevel=_LEVEL) as stored:
        for name, blocks in arrays:
            with stored.open(f"{name}.npy", "w", force_zip64=True) as file:
                if name in _NOISY:  # zipfile has no parameter for it
                    by = zlib.compressobj(_LEVEL, zlib.DEFLATED, -15, strategy=zlib.Z_RLE)
                    file._compressor = by  # type: ignore[attr-defined]
                first = next(blocks)
                head = {
                    "descr": np.lib.format.dtype_to_descr(first.dtype),
                    "fortran_order": False,
                    "shape": (height, *first.shape[1:]),
                }
                np.lib.format.write_array_header_1_0(file, head)
                for block in chain([first], blocks):
                    for rows in parts(len(block), _ROWS):
                        file.write(np.ascontiguousarray(block[rows]))
            yield None


def cause_picture(comparison: Comparison) -> Colors:
    """Return the map of causes over the dimmed traced picture, (h, w, 4) linear RGBA."""
    return cause_map(comparison.frame.color, comparison.causes.cause)


def differing_regions(comparison: Comparison) -> list[Region]:
    """Return the regions of unexplained pixels; if there are none, of all that differ."""
    cause = comparison.causes.cause
    mask = cause == UNEXPLAINED
    if not mask.any():
        mask = np.isin(cause, [c for c in CAUSES if c.explains])
    shown = sides(comparison.scene, comparison.frame, comparison.identity)
    return regions(mask, shown, causes=cause)


@contextmanager
def failure_written(directory: str | Path) -> Iterator[None]:
    """Write a `comparison.json` that says why there is no comparison, if what is done here fails.

    Results that are in the folder stay as they are: a misspelt name must not cost them.
    """
    try:
        yield
    except Exception as error:
        said = {"type": type(error).__name__, "message": str(error)}
        content = {"schema": SCHEMA, "verdict": Verdict.FAILED, "error": said}
        if not all(Path(directory, name).exists() for name in (page.NAME, JSON)):
            # Where the folder cannot be written, that may be what the error is.
            with suppress(OSError), replacing(Path(directory), (JSON,)) as new:
                write_json(new / JSON, content)
        raise
