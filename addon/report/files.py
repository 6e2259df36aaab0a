"""What a comparison leaves in a folder: three pictures, every output, and the JSON."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare.comparison import SCHEMA, Comparison
from ..images import to_display
from .pictures import difference

PICTURES = "traced", "blender", "difference"

SavePng = Callable[[Path, NDArray[np.uint8]], None]


def write(directory: str | Path, comparison: Comparison, save_png: SavePng) -> None:
    """Write `traced.png`, `blender.png`, `difference.png`, `frame.npz` and `comparison.json`.

    Parameters
    ----------
    directory : path
        Made where it is not there.
    comparison : Comparison
    save_png : callable
        Writes an (h, w, 4) uint8 picture, row 0 at the bottom: `images.save_png`, or Blender's own.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    colors = comparison.frame.color, comparison.picture, difference(comparison)
    for name, color in zip(PICTURES, colors, strict=True):
        save_png(directory / f"{name}.png", to_display(color))
    causes = comparison.causes
    np.savez_compressed(
        directory / "frame.npz",
        **comparison.frame.passes(),
        blender=comparison.picture,
        cause=causes.cause,
        cause_figure=causes.figure,
        cause_allowed=causes.allowed,
    )
    _write_json(directory, comparison.to_dict())


def write_failure(directory: str | Path, error: BaseException) -> None:
    """Write a `comparison.json` that says why there is no comparison.

    What an earlier run left goes: it would pass for this one's.
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    for name in (*(f"{picture}.png" for picture in PICTURES), "frame.npz"):
        (directory / name).unlink(missing_ok=True)
    _write_json(
        directory,
        {
            "schema": SCHEMA,
            "verdict": "failed",
            "error": {"type": type(error).__name__, "message": str(error)},
        },
    )


def _write_json(directory: Path, content: dict[str, Any]) -> None:
    text = json.dumps(content, indent=2, allow_nan=False)
    (directory / "comparison.json").write_text(text + "\n", encoding="utf-8")
