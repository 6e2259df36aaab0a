"""Finds what each method makes of each scenario, and the scale at which it breaks.

The unproven methods are held against the certified picture. The certified picture is held against
its definition, in integers, on a sample of the rays with every surface; and, where it is known
whether a ray must cross the scene's surfaces an even or an odd number of times, on all rays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Bools
from ..certified.definition import definition
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.progress import Progress, Work, scaled
from ..tracer.settings import UNPROVEN_SETTINGS, Precision, Settings
from .scenarios.sweeps import SCENARIOS, Scenario
from .truth import CERTIFIED, Truth, largest_t_error, pixel_rays, plain_of, sample, truth_of

JUDGED = 16  # rays of a scene, with every triangle: a tenth of a second


@dataclass(frozen=True)
class ExtremesRow:
    """The result of a method in a precision for a scenario at a scale; the counts are of rays."""

    scenario: str
    scale: float
    method: str
    precision: str
    rays: int
    missed: int  # the certified ray sees a surface, the method nothing
    doubled: int  # the method says to cross more triangles than the certified ray does
    # The method sees another surface than the certified one, or one where there is none. Where a
    # ray meets an edge, every surface that the certified ray may see is right.
    wrong: int
    refused: int  # triangles and rays that are not finite in this precision, and so are left out
    # In ulp of the certified t (float64), over rays that see the same surface; None without one.
    # For the certified row, against the exact t, rounded once: 0.
    largest_t_error: float | None = None
    exact: float | None = None  # certified: share of the pairs that integers decided
    judged: int = 0  # certified: rays that were held against the definition

    @property
    def lost(self) -> int:
        """Rays that see nothing or something else than they should."""
        return self.missed + self.wrong

    @property
    def share(self) -> float:
        """`lost` as a share of the rays."""
        return self.lost / self.rays


Scenes = Sequence[tuple[Scenario, float]]
# Finds the rows of all scenes, in their order; its parameters are as of `measure`.
Every = Callable[[Scenes, int | None, int], Work[list[ExtremesRow]]]


class BreakingPoint(NamedTuple):
    """The first scale of a scenario at which a method goes wrong, each way; None for never."""

    scenario: str
    method: str
    precision: str
    missed: float | None
    wrong: float | None
    doubled: float | None
    lost: float | None  # the first of `missed` and `wrong`


def breaking_points(rows: Sequence[ExtremesRow]) -> list[BreakingPoint]:
    """Return where each method first goes wrong in each sweep, in the order of the rows."""
    sweeps: dict[tuple[str, str, str], list[ExtremesRow]] = {}
    for row in rows:
        sweeps.setdefault((row.scenario, row.method, row.precision), []).append(row)

    def first(rows: list[ExtremesRow], count: str) -> float | None:
        return next((r.scale for r in rows if getattr(r, count)), None)

    counts = "missed", "wrong", "doubled", "lost"
    return [
        BreakingPoint(*name, *(first(some, count) for count in counts))
        for name, some in sweeps.items()
    ]


def written(scale: float | None) -> str:
    """Return a scale in few letters: 1e+08 as 1e8, 179.999 as it is, none as a dot."""
    if scale is None:
        return "."
    if scale == 0 or 1e-2 <= abs(scale) < 1e4:
        return f"{scale:.10g}"
    mantissa, exponent = f"{scale:.1e}".split("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def measure(
    scenarios: Sequence[Scenario] = SCENARIOS,
    rays: int | None = None,
    judged: int = JUDGED,
    every: Every | None = None,
) -> Work[list[ExtremesRow]]:
    """Trace every scenario at every scale by every method.

    Parameters
    ----------
    scenarios : sequence of Scenario
    rays : int, optional
        About as many of each scene, instead of its own number.
    judged : int
        Rays of each scene that are held against the definition.
    every : Every, optional
        Where the rows are found, if not here.

    Raises
    ------
    arithmetic.AssumptionError
        If nothing can be certified in this process.
    """
    scenes = [(s, scale) for s in scenarios for scale in s.scales]
    if every:
        return (yield from every(scenes, rays, judged))
    rows: list[ExtremesRow] = []
    for done, (scenario, scale) in enumerate(scenes):
        words = f"{scenario.title}, {scenario.scale_name} {written(scale)}"
        work = rows_of(scenario, scale, rays, judged)
        rows += yield from scaled(work, done / len(scenes), 1 / len(scenes), words)
    yield Progress(1.0)
    return rows


def rows_of(
    scenario: Scenario, scale: float, rays: int | None, judged: int
) -> Work[list[ExtremesRow]]:
    """Trace a scenario at a scale by every method; parameters are as of :func:`measure`."""
    scene, step = scenario.build(scale, *_size(scenario, rays)), 1 / (len(Precision) + 1)
    truth = yield from scaled(truth_of(scene), 0.0, step)
    found = {}
    for k, precision in enumerate(Precision, start=1):
        found[precision] = yield from scaled(plain_of(scene, precision), k * step, step)
    rows = [
        _plain_row(scenario, scale, truth, settings, found[settings.precision][settings.method])
        for settings in UNPROVEN_SETTINGS
    ]
    return [*rows, _certified_row(scenario, scale, truth, judged)]


def _size(scenario: Scenario, rays: int | None) -> tuple[int, int]:
    if rays is None:
        return scenario.width, scenario.height
    height = max(1, round((rays * scenario.height / scenario.width) ** 0.5))
    return max(1, round(rays / height)), height


def _plain_row(
    scenario: Scenario, scale: float, truth: Truth, settings: Settings, plain: Truth
) -> ExtremesRow:
    frame = plain.frame
    off = frame.wrong_against(truth.frame).ravel()
    found = frame.triangle_index.ravel() != NOTHING
    errors = off & ~found, plain.count > truth.count, off & found
    t_error = largest_t_error(frame, truth.frame, in_ulp=True)
    return _row(scenario, scale, frame, settings, errors, largest_t_error=t_error)


def _row(
    scenario: Scenario,
    scale: float,
    frame: Frame,
    settings: Settings,
    errors: tuple[Bools, Bools, Bools],
    **more: Any,
) -> ExtremesRow:
    """Return a row, given which rays are missed, doubled and wrong; and what not all rows have."""
    precision = settings.precision
    rays = pixel_rays(frame.scene.camera, precision)
    finite = np.isfinite(rays.origins).all(axis=0) & np.isfinite(rays.directions).all(axis=0)
    refused = frame.statistics.refused + int((~finite).sum())
    missed, doubled, wrong = (int(which.sum()) for which in errors)
    return ExtremesRow(
        scenario.name,
        scale,
        settings.method.value,
        precision.value,
        finite.size,
        missed,
        doubled,
        wrong,
        refused,
        **more,
    )


def _certified_row(scenario: Scenario, scale: float, truth: Truth, judged: int) -> ExtremesRow:
    frame, count = truth.frame, truth.count
    sees = frame.instance_index.ravel() != NOTHING
    # Check on every ray: seen implies crossed, crossed implies seen.
    missed, wrong = ~sees & (count > 0), sees & (count == 0)
    doubled = np.zeros(count.size, bool)
    if scenario.odd is not None:  # nobody can tell whether such a ray missed or doubled a surface
        missed |= count % 2 != scenario.odd
    errors = []
    pixels = sample(frame, judged)
    for pixel, exact in zip(pixels.tolist(), definition(frame.scene, pixels), strict=True):
        given = int(frame.instance_index.flat[pixel]), int(frame.triangle_index.flat[pixel])
        right = given == exact.name
        missed[pixel] = count[pixel] < exact.crossings or (not right and not sees[pixel])
        wrong[pixel] = not right and sees[pixel]
        doubled[pixel] = count[pixel] > exact.crossings
        if right and exact.t < np.inf:
            t = float(frame.t.flat[pixel])
            errors.append(abs(t - exact.t) / float(np.spacing(exact.t)))
    return _row(
        scenario,
        scale,
        frame,
        CERTIFIED,
        (missed, doubled, wrong),
        largest_t_error=max(errors, default=None),
        exact=frame.statistics.pairs_exact / max(1, frame.statistics.pairs_tested),
        judged=len(pixels),
    )
