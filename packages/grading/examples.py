"""Some wrong pixels of a picture, with all numbers of the ray and the triangle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.world import world_corners

from .judged_scene import arrays
from .known import Ask, known
from .picture import EXCUSED, FALSE_HITS, Look, Mark

EACH = 3  # pixels of a mark


@dataclass(frozen=True, eq=False)
class Example:
    """One wrong pixel: the ray, one triangle, what is true of them, and what was answered.

    The triangle is the one that is truly seen; for a false hit, the one that is shown. `pixel` is
    (x, y) of the camera's region, from its lower left. World space, metres.
    """

    mark: Mark
    pixel: tuple[int, int]
    object: str
    origin: NDArray[np.float64]
    direction: NDArray[np.float64]
    triangle: NDArray[np.float64]  # (3, 3): p1, p2, p3
    true: tuple[float, NDArray[np.float64]]  # t (inf: no hit) and barycentrics
    answer: tuple[float, NDArray[np.float64]]

    def to_dict(self) -> dict[str, Any]:
        """Return the example as JSON can hold it; what is not finite is null."""
        return {
            "mark": self.mark.name.lower(),
            "pixel": list(self.pixel),
            "object": self.object,
            "origin": self.origin.tolist(),
            "direction": self.direction.tolist(),
            "triangle": self.triangle.tolist(),
            "certified": _answer(self.true),
            "student": _answer(self.answer),
        }


def _answer(answer: tuple[float, NDArray]) -> dict[str, Any]:
    t, s = answer
    numbers = [float(v) if np.isfinite(v) else None for v in (t, *s)]
    return {"t": numbers[0], "barycentrics": numbers[1:] if numbers[0] is not None else None}


def _spread(pixel: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return EACH of some pixels: the middles of as many equal parts, from the lowest row up."""
    parts = min(EACH, len(pixel))
    return pixel[(2 * np.arange(parts) + 1) * len(pixel) // (2 * max(parts, 1))]


def find_examples(look: Look, ask: Ask) -> list[Example]:
    """Return some pixels of each mark that counts as wrong, spread over the picture.

    Raises
    ------
    StudentError
        If the function, which is asked about them again, fails.
    """
    judged, marks = look.judged, look.mark.ravel()
    pixel = [
        p
        for m in Mark
        if m not in (Mark.RIGHT, *EXCUSED)
        for p in _spread(np.flatnonzero(marks == m)).tolist()
    ]
    if not pixel:
        return []
    shown = np.isin(marks[pixel], FALSE_HITS)
    instance = np.where(shown, look.hits.instance[pixel], judged.instance[pixel])
    triangle = np.where(shown, look.hits.triangle[pixel], judged.triangle[pixel])
    keep = triangle != NOTHING  # a plane is not the student's
    pixel, instance, triangle = np.array(pixel)[keep], instance[keep], triangle[keep]
    corners = world_corners(judged.scene, instance, triangle)
    question = arrays(judged.rays, pixel, corners)
    truth = known(*question)
    t, s = ask(*question)
    origins, directions, triangles = question
    return [
        Example(
            Mark(int(marks[p])),
            judged.position(p),
            judged.scene.objects[judged.scene.instances[instance[k]].object],
            origins[k],
            directions[k],
            triangles[k],
            (float(truth.t[k]) if truth.hit[k] else np.inf, truth.s[k]),
            (float(t[k]), s[k]),
        )
        for k, p in enumerate(pixel.tolist())
    ]
