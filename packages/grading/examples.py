"""Some wrong pixels of a picture, with all numbers of the ray and the triangle."""

from __future__ import annotations

import numpy as np
from reference_tracer.arrays import Places
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.world import world_corners

from .judged_scene import arrays
from .known import Ask, known
from .picture import EXCUSED, FALSE_HITS, Look, Mark
from .subjects.triangle import TRIANGLE
from .wrong_case import WrongCase

EACH = 3  # pixels of a mark


def _spread(pixel: Places) -> Places:
    """Return EACH of some pixels: the middles of as many equal parts, from the lowest row up."""
    parts = min(EACH, len(pixel))
    return pixel[(2 * np.arange(parts) + 1) * len(pixel) // (2 * parts)]


def find_examples(look: Look, ask: Ask) -> list[WrongCase]:
    """Return some pixels of each mark that counts as wrong, spread over the picture.

    The triangle is the one that is truly seen; for a false hit, the one that is shown.

    Raises
    ------
    StudentError
        If the function, which is asked about them again, fails.
    """
    judged, hits, marks = look.judged, look.hits, look.mark.ravel()
    names = (hits.instance, hits.triangle), (judged.instance, judged.triangle)
    instance, triangle = np.where(np.isin(marks, FALSE_HITS), *names)
    wrong = [np.flatnonzero(marks == m) for m in Mark if m not in (Mark.RIGHT, *EXCUSED)]
    pixel = np.concatenate([_spread(own) for own in wrong])
    pixel = pixel[triangle[pixel] != NOTHING]  # a plane is not the student's
    if not len(pixel):
        return []
    corners = world_corners(judged.scene, instance[pixel], triangle[pixel])
    question = arrays(judged.rays, pixel, corners)
    truth = known(*question)
    true = TRIANGLE.rows(np.where(truth.hit, truth.t, np.inf), truth.s)
    own = TRIANGLE.rows(*ask(*question))
    return [
        WrongCase.of(
            TRIANGLE.form,
            Mark(int(marks[p])).name.lower(),
            tuple(array[k] for array in question),
            true[k],
            own[k],
            pixel=judged.position(p),
            object=judged.scene.objects[judged.scene.instances[instance[p]].object],
        )
        for k, p in enumerate(pixel.tolist())
    ]
