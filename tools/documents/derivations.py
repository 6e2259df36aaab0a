"""Parts of `reftrace explain`'s Markdown for some pixels."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from reference_tracer.derivation import document, formulas, reproducer
from reference_tracer.derivation.derivation import derive, derive_pixel

from .figures import scene

PIXEL = Path(__file__).resolve().parents[2] / "docs" / "pixel.json"
OF_LESSONS = {  # the pixels that the lessons' commands name
    "orthographic": (200, 240),
    "perspective": (200, 240),
    "plane": (320, 229),
    "triangle": (242, 102),
}
_SUM = "s₁ + s₂ + s₃"


@cache
def blocks(name: str) -> list[str]:
    """The Markdown of a pixel: that of docs/pixel.json, or of a lesson."""
    found = derive(scene(name), *OF_LESSONS[name]) if name else derive_pixel(reproducer.read(PIXEL))
    return document.document_markdown(found).split("\n\n")


def after(name: str, heading: str, *which: int) -> str:
    """Return some of the blocks below a heading, by their numbers from 0."""
    of = blocks(name)
    first = next(k for k, block in enumerate(of) if block.startswith(heading)) + 1
    return "\n\n".join(of[first + k] for k in which)


def rows(table: str, labels: Sequence[str]) -> str:
    """Return a table's head and the steps with these labels, a row for each component."""
    head, line, *body = table.splitlines()
    kept, taken = [head, line], False
    for row in body:
        first = row.split("|")[1].strip()
        if first:
            taken = any(first == label or first.startswith(f"{label} ") for label in labels)
        if taken:
            kept.append(row)
    return "\n".join(kept)


def values() -> dict[str, str]:
    """Return each part by its name."""
    ray, test = "## 1. From the pixel to the ray", "### 2.1"
    parts = {
        "explain_errata": "\n".join(f"{k}. {e}" for k, e in enumerate(formulas.ERRATA, 1)),
        "explain_candidates": after("", "## 2. What the ray may meet", 0, 1),
        "explain_test": rows(after("", test, 0), ("t", "nₛ₂", "s₂", "s₃", _SUM))
        + f"\n\n{after('', test, 1)}",
        "derived_orthographic": rows(after("orthographic", ray, 1), ("v", "o", "d")),
        "derived_perspective": rows(after("perspective", ray, 1), ("v", "d")),
        "derived_plane": rows(after("plane", test, 0), ("d · n", "t", "x")),
        "derived_triangle": rows(after("triangle", test, 0), ("s₁", "s₂", "s₃", _SUM)),
        "judged_triangle": after("triangle", test, 1),
    }
    return {name: f"\n\n{part}\n\n" for name, part in parts.items()}  # blocks of their own
