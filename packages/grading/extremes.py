"""Shows how far a student's function holds as scenes grow extreme, beside the textbook's formulas.

For each scale of each scenario it counts the rays that see another surface than the certified one.
That costs no marks: in float64 every plain formula gives way somewhere. The yardstick is the
textbook in float64, and Möller and Trumbore.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.methods import Method
from reference_tracer.study.scenarios.sweeps import SCENARIOS, Scenario
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.progress import Progress, Work, result_of
from reference_tracer.tracer.triangle import TESTS

from .judged_scene import JudgedScene, prepare
from .known import Ask
from .picture import EXCUSED, Mark, look

_FINE = {m.name.lower() for m in (Mark.RIGHT, *EXCUSED)}
YARDSTICKS = Method.TEXTBOOK, Method.MOLLER_TRUMBORE
WIDTH, HEIGHT = 12, 9  # pixels of a picture


@dataclass(frozen=True, eq=False)
class ExtremeScene:
    """A scenario at one of its scales, with the rays that each yardstick loses."""

    scenario: Scenario
    scale: float
    judged: JudgedScene
    yardsticks: dict[str, int]


@dataclass(frozen=True)
class ExtremeRow:
    """The rays that a student's function loses there; counts are of rays."""

    scenario: str
    scale: float
    rays: int
    lost: int  # that see another surface than the certified one
    pixels: dict[str, int]  # how many have each mark, by its name; what none has is left out
    yardsticks: dict[str, int]  # lost by the textbook's formulas, and by others, in float64

    @property
    def wrong(self) -> bool:
        """Whether something is wrong that rounding does not excuse."""
        return not set(self.pixels) <= _FINE


@dataclass(frozen=True)
class Held:
    """The first scale of a scenario at which a ray is lost; None for never."""

    scenario: str
    student: float | None
    wrong: float | None  # the first at which something is wrong that rounding does not excuse
    yardsticks: dict[str, float | None]


def extreme_scenes(scenarios: Sequence[Scenario] = SCENARIOS) -> Work[list[ExtremeScene]]:
    """Prepare every scale of some scenarios, in small pictures."""
    every = [(s, scale) for s in scenarios for scale in s.scales]
    out = []
    for done, (scenario, scale) in enumerate(every):
        yield Progress(done / len(every))
        scene = scenario.build(scale, WIDTH, HEIGHT)
        judged = result_of(prepare(scenario.name, scene, pixels=None))
        lost = {m.value: result_of(look(judged, plain(m))).lost for m in YARDSTICKS}
        out.append(ExtremeScene(scenario, scale, judged, lost))
    return out


def plain(method: Method) -> Ask:
    """Return one of the tracer's own unproven methods as a student would have written it."""
    test = TESTS[method]

    def intersect(origins: Floats, directions: Floats, triangles: Floats) -> tuple[Floats, Floats]:
        hit, t, s = test(Rays(origins.T, directions.T), *triangles.transpose(1, 2, 0))
        with np.errstate(invalid="ignore"):
            return np.where(hit & (t > 0), t, np.inf), s.T

    return intersect


def try_extremes(
    scenes: Sequence[ExtremeScene], ask: Ask, before: Callable[[], None] = lambda: None
) -> Work[list[ExtremeRow]]:
    """Return what a function loses of every scene; `before` is called before each."""
    rows = []
    for done, e in enumerate(scenes):
        yield Progress(done / len(scenes))
        before()
        found = result_of(look(e.judged, ask))
        pixels = {name: n for name, n in found.counts.items() if n}
        rays = len(e.judged.t)
        rows.append(ExtremeRow(e.scenario.name, e.scale, rays, found.lost, pixels, e.yardsticks))
    return rows


def held(rows: Sequence[ExtremeRow]) -> list[Held]:
    """Return up to where each scenario holds, in the order of the rows."""
    sweeps: dict[str, list[ExtremeRow]] = {}
    for row in rows:
        sweeps.setdefault(row.scenario, []).append(row)
    return [
        Held(
            name,
            next((r.scale for r in sweep if r.lost), None),
            next((r.scale for r in sweep if r.wrong), None),
            {
                m: next((r.scale for r in sweep if r.yardsticks[m]), None)
                for m in sweep[0].yardsticks
            },
        )
        for name, sweep in sweeps.items()
    ]
