"""Speed against accuracy, measured on a scene: every method and precision, judged exactly."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import median

import numpy as np

from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.render import render
from ..tracer.settings import Method, Precision, Settings
from .judge import judge

REPEATS = 3


@dataclass(frozen=True)
class Row:
    """One choice: its median time, and the pixels whose answer exact arithmetic rejects."""

    method: str
    precision: str
    seconds: float
    wrong_pixels: int
    pixels: int


def measure(
    scene: Scene, width: int = 160, progress: Callable[[float], None] | None = None
) -> list[Row]:
    """Measure every method and precision on a scene's own camera.

    Parameters
    ----------
    scene : Scene
    width : int
        Of the picture, in pixels; its height keeps the camera's proportions.
    progress : callable, optional
        Called with the share of the work done.

    Raises
    ------
    judge.TooLargeError
        If the picture is too large to be judged exactly.
    """
    camera = scene.camera
    height = max(1, round(camera.height * width / camera.width))
    small = replace(scene, camera=replace(camera, width=width, height=height, region=None))
    choices = [Settings(m, p) for m in Method for p in Precision]
    seconds: list[list[float]] = [[] for _ in choices]
    frames: list[Frame] = []
    for repeat in range(REPEATS):  # interleaved, so that a slow moment of the machine is shared
        for k, settings in enumerate(choices):
            began = time.perf_counter()
            frame = render(small, settings)
            seconds[k].append(time.perf_counter() - began)
            if repeat == 0:
                frames.append(frame)
        if progress:
            progress(0.2 * (repeat + 1) / REPEATS)
    answers: list[set[tuple[int, int]]] = []
    for verdicts in judge(small):
        answers += verdicts
        if progress:
            progress(0.2 + 0.8 * len(answers) / (width * height))
    return [
        Row(
            s.method.value, s.precision.value, median(t), wrong_pixels(frame, answers), len(answers)
        )
        for s, t, frame in zip(choices, seconds, frames, strict=True)
    ]


def wrong_pixels(frame: Frame, answers: list[set[tuple[int, int]]]) -> int:
    """Count the pixels whose instance and triangle are none of those that may be seen."""
    given = zip(
        frame.instance_index.ravel().tolist(), frame.triangle_index.ravel().tolist(), strict=True
    )
    return int(np.sum([name not in may for name, may in zip(given, answers, strict=True)]))


def table(rows: list[Row]) -> str:
    """Return the rows as text, with the time relative to the textbook in float64."""
    base = next(r.seconds for r in rows if (r.method, r.precision) == ("textbook", "float64"))
    lines = [f"{'method':<18}{'precision':<11}{'seconds':>9}{'ratio':>7}{'wrong pixels':>18}"]
    for r in rows:
        share = f"({r.wrong_pixels / r.pixels:.2%})"
        lines.append(
            f"{r.method:<18}{r.precision:<11}{r.seconds:>9.4f}{r.seconds / base:>7.2f}"
            f"{r.wrong_pixels:>9,} {share:>8}"
        )
    return "\n".join(lines)
