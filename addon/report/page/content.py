"""Gathers all that a page shows, for JSON: a comparison, and what else was measured.

`page.schema.json` describes each entry. Pictures are PNG images; the numbers behind them are packed
arrays. The least useful arrays are left out where the page would grow beyond MOST_CHARACTERS.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import ModuleType
from typing import TypeVar

import numpy as np

from ...causes.cause import AGREE, UNEXPLAINED
from ...causes.explain import CAUSES
from ...certainty import Certainty
from ...comparison.comparison import Comparison
from ...comparison.extras import Extras
from ...comparison.put_right import pictures_put_right
from ...derivation.formulas import ERRATA, PLANE, TRIANGLE, VECTORS
from ...diagnosis.regions import Region, regions, sides
from ...files import png
from ...files.images import data_uri, hex_color, to_display
from ...tracer.triangle import SUM_TOLERANCE
from .. import extremes as extremes_report
from .. import trade as trade_report
from ..shown import data, shown
from . import arrays
from .arrays import packed

T = TypeVar("T")
SCHEMA = "reference_tracer.page/3"
MOST_CHARACTERS = 32 << 20  # characters of the packed arrays: what a browser still opens at once


def content(
    comparison: Comparison,
    extras: Extras | None = None,
    limit: int = MOST_CHARACTERS,
    stored: Mapping[str, bytes] | None = None,
) -> dict[str, object]:
    """Return all that a page shows.

    `extras` is what else was found out. The packed arrays take at most `limit` characters. `stored`
    has the PNG files of pictures that are encoded already: "traced" and "blender".
    """
    scene, frame = comparison.scene, comparison.frame
    extras = extras or Extras()
    pixels, missing = _pixels(comparison, limit)
    return {
        "schema": SCHEMA,
        "comparison": comparison.to_dict(),
        "size": [frame.shape[1], frame.shape[0]],
        "camera": scene.camera.to_dict(),
        "objects": list(scene.objects),
        "object_of": scene.instance_objects[:-1].tolist(),
        "planes": [
            {"instance": k, "point": p.point.tolist(), "normal": p.normal.tolist()}
            for k, p in enumerate(scene.planes, len(scene.instances))
        ],
        "causes": _causes(comparison),
        "certainties": {
            str(int(c)): {"name": _words(name), "sentence": c.sentence, "color": c.color}
            for name, c in Certainty.__members__.items()
        },
        "tolerance": {str(dtype): value for dtype, value in SUM_TOLERANCE.items()},
        "formulas": {"plane": PLANE, "triangle": TRIANGLE, "vectors": sorted(VECTORS)},
        "errata": ERRATA,
        "pictures": [
            *_pictures(comparison, extras.literal, stored or {}),
            *_put_right(comparison),
        ],
        "regions": [r.to_dict() for r in _unexplained(comparison)],
        "pixels": pixels,
        "derivations": [*map(shown, extras.derivations.values())],
        "trade": _study(trade_report, extras.trade, trade_report.text_cells),
        # Without its thousands of rows, which the plot shows.
        "extremes": _study(extremes_report, extras.extremes),
        "left_out": [*extras.left_out, *missing],
    }


def _causes(comparison: Comparison) -> list[dict[str, object]]:
    """Return the text, the colour and the count of each cause, in the order of their numbers."""
    counts = comparison.counts
    count = {**counts.by_cause, "agree": counts.agree, "not_traced": counts.not_traced}
    return [
        {
            "value": int(cause),
            "name": cause.key,
            "label": _words(cause.label),
            "place": cause.place or cause.label,
            "sentence": cause.sentence,
            "unit": cause.unit,
            "pixels": count[cause.key],
            "color": None if cause.color is None else hex_color((*cause.color, 1.0)),
        }
        for cause in CAUSES
    ]


def _words(name: str) -> str:
    return name.replace("_", " ").capitalize()


def _pictures(
    comparison: Comparison, literal: np.ndarray | None, stored: Mapping[str, bytes]
) -> list[dict[str, str]]:
    s, source = comparison.frame.statistics, comparison.case.picture.source
    found = [
        ("traced", "Traced", f"by {_words(s.method).lower()}", comparison.frame.color, png.LEVEL),
        ("blender", "Picture", source.file, comparison.picture, png.LEVEL)
        if source.file
        else ("blender", "Blender", _words(source.name).lower(), comparison.picture, png.LEVEL),
    ]
    if literal is not None:
        note = "s₁ + s₂ + s₃ = 1 as printed"
        found.append(("literal", "Literal textbook", note, literal, png.NOISY))
    return [
        {
            "id": i,
            "label": label,
            "note": note,
            "png": data_uri(stored.get(i) or png.encode(to_display(color), level)),
        }
        for i, label, note, color, level in found
    ]


def _put_right(comparison: Comparison) -> Iterator[dict[str, str]]:
    """Yield the picture that each fault changes, put right."""
    told = comparison.diagnosis.told if comparison.diagnosis else ()
    for number, side, color in pictures_put_right(comparison):
        yield {
            "id": f"put_right_{number}",
            "of": side,
            "label": "Put right" if len(told) == 1 else f"Put right, {number + 1}",
            "note": told[number].sentence,
            "png": data_uri(png.encode(to_display(color))),
        }


def _unexplained(comparison: Comparison) -> list[Region]:
    """Return the regions of unexplained pixels, which the page frames."""
    shown = sides(comparison.scene, comparison.frame, comparison.identity)
    return regions(comparison.causes.cause == UNEXPLAINED, shown)


def _pixels(comparison: Comparison, limit: int) -> tuple[dict[str, object], list[str]]:
    """Return as many of the pixels' numbers as fit, and sentences on what was left out."""
    frame, causes = comparison.frame, comparison.causes
    seen = arrays.seen(frame)
    index = np.flatnonzero(causes.cause != AGREE)
    differing = {"index": packed(index.astype(np.uint32))}
    for name in ("cause", "figure", "allowed"):
        differing[name] = packed(getattr(causes, name).ravel()[index])
    found: dict[str, object] = {
        "differing": differing,
        "certainty": packed(frame.certainty),
        "surface": packed(seen.number),
        **dict.fromkeys(("surfaces", "t_offset", "colors")),
    }
    if (identity := comparison.identity) is not None:
        found["identity"] = {"traced": packed(identity.traced), "shown": packed(identity.shown)}
    missing, taken = [], arrays.size(found)
    scene, both = comparison.scene, {"traced": frame.color, "blender": comparison.picture}
    triangles = (
        "The triangles that are seen, and with them t and the derivation of every pixel and the "
        "pictures of objects, facing, normal, depth and triangles"
    )
    colors = "The linear colours of every pixel (those of the screen are there)"
    for name, what, made in (  # the most useful first
        ("surfaces", triangles, lambda: arrays.surface_table(scene, seen)),
        ("t_offset", "The last bits of t", lambda: packed(arrays.t_offsets(scene, frame, seen))),
        ("colors", colors, lambda: {side: packed(color) for side, color in both.items()}),
    ):
        part = made()
        size = arrays.size(part)
        if taken + size <= limit:
            found[name], taken = part, taken + size
        else:
            millions = size / 1e6
            missing.append(f"{what}: left out, as they would add {millions:.0f} MB to this page.")
    if found["surfaces"] is None:
        found["t_offset"] = None
    return found, missing


def _study(
    report: ModuleType, found: T | None, table: Callable[[T], object] | None = None
) -> dict[str, object] | None:
    """Return a study as its module of `report` has it, with its plot, and its table as text."""
    if found is None:
        return None
    held = {k: v for k, v in report.to_dict(found).items() if k != "rows"}
    if table:
        held["table"] = table(found)
    return held | {"plot": data(report.plot(found))}
