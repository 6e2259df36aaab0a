"""Numerical stability: what each method makes of each scenario, against exact arithmetic.

In come scenarios; out go rows, one for each scale, method and precision. The plain methods are held
against the certified picture. What is certified is itself held against what it has no part in: the
oracle, on a sample of the rays with every triangle; and, where it is known how often a ray must
cross the scene's surfaces, even or odd, on all rays.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ..methods import Method
from ..tracer.camera import Rays
from ..tracer.candidates import Pairs
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.nearest import within_clip
from ..tracer.progress import Work, result_of, scaled
from ..tracer.render import render
from ..tracer.settings import PLAIN_SETTINGS, Precision, Settings
from .extreme_rows import BreakingPoint, Row, breaking_points
from .oracle import scene_sights
from .scenarios.sweeps import ALL, Scenario
from .truth import Truth, crossings, keys, number, pixel_rays, sample, truth_of

__all__ = ["BreakingPoint", "Row", "breaking_points", "measure"]

JUDGED = 16  # rays of a scene, with every triangle: a tenth of a second


def measure(
    scenarios: Sequence[Scenario] = ALL, rays: int | None = None, judged: int = JUDGED
) -> Work[list[Row]]:
    """Trace every scenario at every scale by every method; yields the share of the work done.

    Parameters
    ----------
    scenarios : sequence of Scenario
    rays : int, optional
        About as many of each scene, instead of its own number.
    judged : int
        Rays of each scene about which the oracle is asked.

    Returns
    -------
    list of Row

    Raises
    ------
    certainty.AssumptionError
        If nothing can be certified in this process.
    """
    rows: list[Row] = []
    scenes = [(s, scale) for s in scenarios for scale in s.scales]
    for done, (scenario, scale) in enumerate(scenes):
        width, height = _size(scenario, rays)
        scene = scenario.build(scale, width, height)
        begun, step = done / len(scenes), 1 / len(scenes) / (len(PLAIN_SETTINGS) + 1)
        truth = yield from scaled(truth_of(scene), begun, step)
        for k, settings in enumerate(PLAIN_SETTINGS, start=1):
            yield begun + k * step
            rows.append(_plain_row(scenario, scale, truth, settings))
        rows.append(_certified_row(scenario, scale, truth, judged))
    yield 1.0
    return rows


def _size(scenario: Scenario, rays: int | None) -> tuple[int, int]:
    if rays is None:
        return scenario.width, scenario.height
    height = max(1, round((rays * scenario.height / scenario.width) ** 0.5))
    return max(1, round(rays / height)), height


def _plain_row(scenario: Scenario, scale: float, truth: Truth, settings: Settings) -> Row:
    scene, camera = truth.scene, truth.scene.camera
    frame = render(scene, settings)
    method = settings.method.function

    def test(rays: Rays, pairs: Pairs) -> NDArray[np.bool_]:
        hit, t, _ = method(rays, *pairs.corners)
        return hit & within_clip(camera, t)

    count = result_of(crossings(scene, settings, test)).count
    off = frame.wrong_against(truth.frame).ravel()
    found = frame.triangle_index.ravel() != NOTHING
    wrong = np.flatnonzero(off & found)
    name = number(scene, frame.instance_index.flat[wrong], frame.triangle_index.flat[wrong])
    true = np.isin(keys(scene, wrong, name), truth.crossed.keys)
    return Row(
        scenario.name,
        scale,
        settings.method.value,
        settings.precision.value,
        rays=off.size,
        missed=int((off & ~found).sum()),
        doubled=int((count > truth.crossed.count).sum()),
        wrong=len(wrong),
        refused=frame.statistics.refused + _not_finite(pixel_rays(camera, settings.precision)),
        order=int(true.sum()),
        largest_t_error=_largest_t_error(frame, truth.frame),
        across=scenario.across,
        seen=_seen(truth.frame),
    )


def _seen(frame: Frame) -> int:
    return int((frame.instance_index != NOTHING).sum())


def _not_finite(rays: Rays) -> int:
    finite = np.isfinite(rays.origins).all(axis=0) & np.isfinite(rays.directions).all(axis=0)
    return int((~finite).sum())


def _largest_t_error(frame: Frame, certified: Frame) -> float | None:
    same = (
        (frame.instance_index == certified.instance_index)
        & (frame.triangle_index == certified.triangle_index)
        & np.isfinite(certified.t)
    )
    if not same.any():
        return None
    t, exact = frame.t[same], certified.t[same]
    ulp = np.spacing(exact)
    with np.errstate(over="ignore"):  # a plain t may be off by more ulp than there are doubles
        errors = np.abs(t / ulp - exact / ulp)  # divided first: a difference may overflow, too
    return float(errors.max())


def _certified_row(scenario: Scenario, scale: float, truth: Truth, judged: int) -> Row:
    frame, scene = truth.frame, truth.scene
    count = truth.crossed.count
    sees = frame.instance_index.ravel() != NOTHING
    # That the nearest is one of all, and that none of all is missed, holds for every ray.
    missed, wrong = ~sees & (count > 0), sees & (count == 0)
    doubled = np.zeros(count.size, bool)
    if scenario.odd is not None:  # which of the two it is can't be told
        missed |= count % 2 != scenario.odd
    worst = None
    pixels = sample(frame, judged)
    for pixel, sight in zip(pixels.tolist(), scene_sights(scene, pixels), strict=True):
        given = int(frame.instance_index.flat[pixel]), int(frame.triangle_index.flat[pixel])
        right = given == sight.seen
        missed[pixel] = count[pixel] < sight.crossings or (not right and not sees[pixel])
        wrong[pixel] = not right and sees[pixel]
        doubled[pixel] = count[pixel] > sight.crossings
        if right and sight.t is not None:
            worst = max(worst or 0.0, _ulps(float(frame.t.flat[pixel]), sight.t))
    statistics = frame.statistics
    return Row(
        scenario.name,
        scale,
        Method.CERTIFIED.value,
        Precision.FLOAT64.value,
        rays=count.size,
        missed=int(missed.sum()),
        doubled=int(doubled.sum()),
        wrong=int(wrong.sum()),
        refused=statistics.refused + _not_finite(pixel_rays(scene.camera, Precision.FLOAT64)),
        largest_t_error=worst,
        exact=statistics.pairs_exact / statistics.pairs_tested if statistics.pairs_tested else 0.0,
        judged=len(pixels),
        across=scenario.across,
        seen=_seen(frame),
    )


def _ulps(t: float, exact: Fraction) -> float:
    return float(abs(Fraction(t) - exact) / Fraction(float(np.spacing(t))))
