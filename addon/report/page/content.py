"""A `Comparison`, and what else was measured -> all that a page shows, for JSON.

`page.schema.json` describes each entry. Pictures are PNG images; the numbers behind them are packed
arrays. The least useful arrays are left out where the page would grow beyond LIMIT.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compare.cause import Cause
from ...compare.comparison import Comparison
from ...explain import html
from ...images import MissingLibraryError, to_display
from ...scene import Camera, Scene
from ...study.extremes import Row
from ...study.trade import Trade
from ...tracer.certified.certainty import Certainty
from ...tracer.frame import Frame
from ...tracer.triangle import SUM_TOLERANCE
from .. import extremes as extremes_report
from .. import trade as trade_report
from . import surfaces
from .extras import Extras
from .packing import data_uri, packed, size

SCHEMA = "reference_tracer.page/1"
LIMIT = 32 << 20  # characters of the packed arrays: what a browser still opens at once

_CERTAINTY = {
    Certainty.NOT_CERTIFIED: "floating point alone decided, without a proof",
    Certainty.BOUND: "floating point decided, and its error bound leaves no doubt",
    Certainty.EXACT: "integer arithmetic decided, where the error bound left a doubt",
    Certainty.AMBIGUOUS: "the ray meets an edge, a corner or two surfaces at once: a rule decided",
}


def content(
    comparison: Comparison, extras: Extras | None = None, limit: int = LIMIT
) -> dict[str, Any]:
    """Return all that a page shows.

    Parameters
    ----------
    comparison : Comparison
    extras : Extras, optional
        What else was found out.
    limit : int
        Characters that the packed arrays may take.
    """
    scene, frame = comparison.scene, comparison.frame
    extras = extras or Extras()
    pixels, missing = _pixels(comparison, limit)
    missing = [*extras.left_out, *missing]
    return {
        "schema": SCHEMA,
        "comparison": comparison.to_dict(),
        "size": [frame.t.shape[1], frame.t.shape[0]],
        "camera": _camera(scene.camera),
        "objects": list(scene.objects),
        "object_of": scene.instance_objects[:-1].tolist(),
        "planes": [_plane(p, k) for k, p in enumerate(scene.planes, len(scene.instances))],
        "causes": _causes(comparison),
        "certainties": {
            str(int(c)): {"name": _words(c.name), "sentence": text}
            for c, text in _CERTAINTY.items()
        },
        "tolerance": {dtype.name: value for dtype, value in SUM_TOLERANCE.items()},
        "pictures": _pictures(comparison, extras.literal),
        "pixels": pixels,
        "derivations": [
            {"pixel": list(pixel), "html": html.fragment(derivation)}
            for pixel, derivation in extras.derivations.items()
        ],
        "trade": _study(extras.trade, trade_report.to_dict, _trade_plots, missing),
        "extremes": _study(extras.extremes, _extremes_dict, extremes_report.pictures, missing),
        "left_out": missing,
    }


def _camera(camera: Camera) -> dict[str, Any]:
    r, w = camera.region, camera.window
    return {
        "name": camera.name,
        "world_from_camera": camera.world_from_camera.tolist(),
        "window": [w.left, w.right, w.bottom, w.top],
        "width": camera.width,
        "height": camera.height,
        "region": [r.x0, r.y0, r.x1, r.y1],
        "orthographic": camera.projection.in_files,
        "clip": [camera.clip_start, camera.clip_end],
    }


def _plane(plane: Any, instance: int) -> dict[str, Any]:
    return {
        "instance": instance,
        "point": plane.point.tolist(),
        "normal": plane.normal.tolist(),
    }


def _causes(comparison: Comparison) -> list[dict[str, Any]]:
    """Return what there is to say of each cause, in the order of their numbers."""
    pixels = comparison.pixels
    count = pixels["by_cause"] | {"agree": pixels["agree"], "not_traced": pixels["not_traced"]}
    return [
        {
            "value": int(cause),
            "name": cause.key,
            "label": _words(cause.label),
            "sentence": cause.sentence,
            "unit": cause.unit,
            "pixels": count[cause.key],
            "color": None if cause.color is None else _hex(cause.color),
        }
        for cause in Cause
    ]


def _words(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _hex(linear: Sequence[float]) -> str:
    r, g, b, _ = to_display(np.array([[[*linear, 1.0]]]))[0, 0]
    return f"#{r:02x}{g:02x}{b:02x}"


def _pictures(comparison: Comparison, literal: Frame | None) -> list[dict[str, str]]:
    s, source = comparison.frame.statistics, comparison.case.picture.source
    found = [
        ("traced", "Traced", f"by {_words(s.method).lower()}", comparison.frame.color),
        ("blender", "Picture", source.file, comparison.picture)
        if source.file
        else ("blender", "Blender", _words(source.name).lower(), comparison.picture),
    ]
    if literal is not None:
        found.append(("literal", "Literal textbook", "s₁ + s₂ + s₃ = 1 as printed", literal.color))
    return [
        {"id": i, "label": label, "note": note, "png": data_uri(to_display(color))}
        for i, label, note, color in found
    ]


def _pixels(comparison: Comparison, limit: int) -> tuple[dict[str, Any], list[str]]:
    """Return as many of the pixels' numbers as fit, and sentences on what was left out."""
    scene, frame, causes = comparison.scene, comparison.frame, comparison.causes
    seen = surfaces.seen(frame)
    index = np.flatnonzero(causes.cause != Cause.AGREE)
    found: dict[str, Any] = {
        "differing": {
            "index": packed(index.astype(np.uint32)),
            "cause": packed(causes.cause.ravel()[index]),
            "figure": packed(causes.figure.ravel()[index]),
            "allowed": packed(causes.allowed.ravel()[index]),
        },
        "certainty": packed(frame.certainty),
        "surface": packed(seen.number),
        "surfaces": None,
        "t_offset": None,
        "colors": None,
    }
    if (identity := comparison.identity) is not None:
        found["identity"] = {"traced": packed(identity.traced), "shown": packed(identity.shown)}
    missing, taken = [], size(found)
    for name, what, made in _by_priority(scene, comparison, seen):
        part = made()
        if taken + size(part) <= limit:
            found[name], taken = part, taken + size(part)
        else:
            millions = size(part) / 1e6
            missing.append(f"{what}: left out, as they would add {millions:.0f} MB to this page.")
    if found["surfaces"] is None and found["t_offset"] is not None:
        found["t_offset"] = None
    return found, missing


def _by_priority(
    scene: Scene, comparison: Comparison, seen: surfaces.Surfaces
) -> list[tuple[str, str, Callable[[], dict[str, Any]]]]:
    """Return the name, description and maker of each optional array, the most useful first."""
    frame = comparison.frame
    return [
        (
            "surfaces",
            "The triangles that are seen, and with them t and the derivation of every pixel",
            lambda: surfaces.table(scene, seen),
        ),
        (
            "t_offset",
            "The last bits of t",
            lambda: packed(surfaces.t_offsets(scene, frame, seen)),
        ),
        (
            "colors",
            "The linear colours of every pixel (those of the screen are there)",
            lambda: {"traced": packed(frame.color), "blender": packed(comparison.picture)},
        ),
    ]


def _trade_plots(trade: Trade) -> Iterable[tuple[str, NDArray[np.uint8]]]:
    yield "tradeoff", trade_report.picture(trade)


def _extremes_dict(rows: Sequence[Row]) -> dict[str, Any]:
    """Return what `extremes.json` holds, without its thousands of rows, which the plots show."""
    return {k: v for k, v in extremes_report.to_dict(rows).items() if k != "rows"}


def _study(found: Any, to_dict: Callable, plots: Callable, missing: list[str]) -> Any:
    """Return a study for JSON, with its plots if Matplotlib is installed."""
    if found is None:
        return None
    shown = []
    try:
        for name, picture in plots(found):
            shown.append({"name": name, "png": data_uri(picture)})
    except MissingLibraryError as error:
        missing.append(f"Plots: {error}.")
    return to_dict(found) | {"plots": shown}
