"""Measures speed against accuracy on a scene through its own camera.

Each choice of method, precision, samples and resolution is a row: what it takes (seconds, bytes),
and what it gets wrong. Pixels and t are held against the certified picture, coverage against a
converged one.
"""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from statistics import median
from typing import Any

from ..arrays import Colors
from ..methods import Method
from ..rendering import steps
from ..scene import Region, Scene
from ..tracer.frame import Frame
from ..tracer.progress import Progress, Work, scaled
from ..tracer.settings import UNPROVEN_SETTINGS, Precision, Settings
from .advice import advice, mark
from .converged import converged, coverage_error, samples_of
from .trade import Trade, TradeRow
from .truth import largest_t_error

WIDTH, SAMPLES = 160, 4  # by default: a quarter of a minute for a scene of 20,000 triangles
SMALLER = (1, 2, 4)  # the widths measured: the largest, a half and a quarter of it

# More samples are measured for these: the exercise's, the fastest, and the one with a proof.
SAMPLED = (
    Settings(Method.TEXTBOOK, Precision.FLOAT64),
    Settings(Method.MOLLER_TRUMBORE, Precision.FLOAT32),
    Settings(Method.CERTIFIED),
)

REPEATS = 3  # of every row: the fewest that have a middle
# Where one is so short that the machine's noise shows: four that agree on which of two is faster
# do so by chance as seldom as six of seven.
SHORT_REPEATS = 4
SHORT = 0.1  # seconds
MORE_REPEATS = 7  # where noise does show
NOISE = 1.05  # the middle of the rounds, in the shortest of them


@dataclass(eq=False)
class Choice:
    """A row on its way: what is chosen, and what was measured so far."""

    settings: Settings
    scene: Scene  # of the row's resolution
    measured: dict[str, Any] = field(default_factory=dict)  # by the field of `TradeRow`
    rounds: list[float] = field(default_factory=list)

    @property
    def is_timed(self) -> bool:
        """Whether more rounds would tell little: half of them are as fast as the fastest."""
        count, middle = len(self.rounds), median(self.rounds or [0.0])
        quiet = middle >= SHORT or (count >= SHORT_REPEATS and middle <= NOISE * min(self.rounds))
        return count >= REPEATS and quiet

    @property
    def cost(self) -> float:
        """About how long it takes, in some unit: rays, and a look at every triangle for each."""
        camera = self.scene.camera
        return self.settings.samples**2 * (camera.width * camera.height + self.scene.triangle_count)

    def row(self) -> TradeRow:
        """Return the row."""
        settings, camera = self.settings, self.scene.camera
        return TradeRow(
            method=settings.method.value,
            precision=settings.precision.value,
            samples=settings.samples,
            width=camera.width,
            height=camera.height,
            seconds=median(self.rounds),
            rounds=tuple(self.rounds),
            **self.measured,
        )


# Measures choices against the converged colour of the largest picture: a row each.
Every = Callable[[list[Choice], Colors], Work[list[TradeRow]]]


def measure(
    scene: Scene,
    width: int | None = None,
    samples: int = SAMPLES,
    name: str = "",
    every: Every | None = None,
) -> Work[Trade]:
    """Measure what a scene's user can trade; closed before its end, it leaves nothing behind.

    Parameters
    ----------
    scene : Scene
        Its border is left out: the picture is that of the whole camera.
    width : int, optional
        Of the picture, in pixels; its height keeps the camera's proportions. By default WIDTH, or
        the camera's where that is less.
    samples : int
        Up to `samples` x `samples` a pixel are measured.
    name : str
        Of the scene, for those who read the result.
    every : Every, optional
        Where the rows are measured, if not here.

    Raises
    ------
    arithmetic.AssumptionError
        If nothing can be certified on this machine.
    SceneError, ValueError
        If the width or the number of samples is out of range.
    """
    choices = choose(scene, min(WIDTH, scene.camera.width) if width is None else width, samples)
    camera = choices[0].scene.camera
    pixels, each = camera.width * camera.height, sum(c.cost for c in choices)
    k = samples_of(pixels, samples)
    rays = k * k * pixels
    first = rays / (rays + 6 * each)
    words = f"tracing {k} × {k} rays a pixel"
    truth = yield from scaled(converged(choices[0].scene, k), 0.0, first, words)
    rows = mark((yield from scaled((every or rows_of)(choices, truth), first, 1 - first)))
    return Trade(name, rows, advice(rows), k)


def rows_of(choices: list[Choice], truth: Colors) -> Work[list[TradeRow]]:
    """Measure choices; of a width the certified ones are what the others are held against."""
    looking = _look_at_all(choices, truth)
    yield from scaled(looking, 0.0, 1 / 3, "looking at errors and memory")
    yield from scaled(_time_all(choices), 1 / 3, 2 / 3, "taking times")
    return [choice.row() for choice in choices]


def choose(scene: Scene, width: int, samples: int) -> list[Choice]:
    """Return what is measured, the largest picture first."""
    ladder = [*UNPROVEN_SETTINGS, Settings(Method.CERTIFIED)]
    widths = sorted({-(-width // share) for share in SMALLER}, reverse=True)
    scenes = [at_width(scene, w) for w in widths]
    found = [Choice(s, small) for small in scenes for s in ladder]
    more = [replace(s, samples=n) for n in levels(samples) if n > 1 for s in SAMPLED]
    return found + [Choice(s, scenes[0]) for s in more]


def at_width(scene: Scene, width: int) -> Scene:
    """Return the scene through the whole of its camera, `width` pixels wide."""
    camera = scene.camera
    height = max(1, round(camera.height * width / camera.width))
    whole = Region(0, 0, width, height)
    return replace(scene, camera=replace(camera, width=width, height=height, region=whole))


def levels(samples: int) -> list[int]:
    """Return the numbers of samples that are measured: 1, 2, 4, 8 and so on, and the last."""
    Settings(samples=samples)  # which says what it may be
    return sorted({1 << k for k in range(samples.bit_length())} | {samples})


def _look_at_all(choices: list[Choice], truth: Colors) -> Work[None]:
    """Render each once, untimed, for its memory and its errors, the certified ones first."""
    total, done = sum(c.cost for c in choices), 0.0
    certified: dict[int, Frame] = {}  # by the picture's width
    for choice in sorted(choices, key=lambda c: not c.settings.method.is_proven):
        frame, peak = yield from scaled(_look(choice), done / total, choice.cost / total)
        done += choice.cost
        proven = certified.setdefault(choice.scene.camera.width, frame)
        choice.measured = {
            "wrong_pixels": int(frame.wrong_against(proven).sum()),
            "largest_t_error": largest_t_error(frame, proven),
            "peak_bytes": peak,
            "coverage_error": coverage_error(frame.color, truth),
        }


def _look(choice: Choice) -> Work[tuple[Frame, int]]:
    """Render with tracemalloc watching, to which numpy tells its memory; return the most, too."""
    ours = not tracemalloc.is_tracing()
    if ours:
        tracemalloc.start()
    try:
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        most = 0
        frame = Frame.empty(choice.scene)
        # A scene keeps tables once they are made: each row makes its own.
        for event in steps(replace(choice.scene), choice.settings, frame):
            held, peak = tracemalloc.get_traced_memory()
            most = max(most, peak - before)
            yield event
            before += tracemalloc.get_traced_memory()[0] - held  # what others took meanwhile
            tracemalloc.reset_peak()
        return frame, most
    finally:
        if ours:
            tracemalloc.stop()


def _time_all(choices: list[Choice]) -> Work[None]:
    """Time all, round by round, so that a slow moment of the machine is shared.

    Every other round goes backwards, so that none has always the same one before it.
    """
    for number in range(MORE_REPEATS):
        some = [c for c in choices if not c.is_timed]
        total, done = MORE_REPEATS * sum(c.cost for c in some), number / MORE_REPEATS
        for choice in some if number % 2 == 0 else reversed(some):
            yield from scaled(_repeat(choice), done, choice.cost / total)
            done += choice.cost / total
    yield Progress(1.0)


def _repeat(choice: Choice) -> Work[None]:
    """Render once; only the steps count, not what happens between them."""
    frame = Frame.empty(choice.scene)
    yield from steps(choice.scene, choice.settings, frame)
    choice.rounds.append(frame.statistics.seconds)
