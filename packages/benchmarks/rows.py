"""The results: a row for each scene, size, camera and method, and the machine."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np

LIBRARIES = "embreex", "trimesh", "rtree", "bpy"
Key = tuple[str, int, int, str, str, str]


@dataclass
class Row:
    """One picture. Seconds are medians of the rounds, None where something was not run."""

    scene: str
    triangles: int
    width: int  # pixels
    height: int
    camera: str  # perspective or orthographic
    method: str
    precision: str
    trace_s: float | None = None  # ids, t, barycentrics
    render_s: float | None = None  # the whole frame with all passes
    picture_s: float | None = None  # colour and certified owners: a frame of which no more is asked
    outputs_s: float | None = None  # that, t and barycentrics
    embreex_ids_s: float | None = None  # triangles alone
    embreex_trace_s: float | None = None  # and t, barycentrics, normals
    embreex_build_s: float | None = None
    rtree_s: float | None = None
    bvhtree_s: float | None = None
    cycles_s: float | None = None  # the whole render, 1 sample, 1 thread
    workbench_s: float | None = None  # the whole render
    peak_bytes: int | None = None  # of `trace`, beside the scene
    render_peak_bytes: int | None = None  # of `render`
    # Rays really traced, where seconds are for the whole picture; fewer than it has: extrapolated.
    embreex_rays: int | None = None
    rtree_rays: int | None = None
    bvhtree_rays: int | None = None
    bvhtree_build_s: float | None = None
    embreex_differs: float | None = None  # share of pixels in which embreex names another triangle
    rounds: int = 0
    stages: dict[str, float] = field(default_factory=dict)  # seconds, by stage, of `render`

    @property
    def key(self) -> Key:
        """The key of a row."""
        return self.scene, self.width, self.height, self.camera, self.method, self.precision

    @property
    def pixels(self) -> int:
        """Of the picture."""
        return self.width * self.height


@dataclass
class CommandRow:
    """The cost of a command in a process of its own: CPU seconds, and times `import bpy`.

    Medians of the rounds, and the least and the most of the ratio of two times of one round.
    """

    name: str
    cpu_s: float
    ratio: float
    ratio_least: float
    ratio_most: float
    rounds: int = 0
    waited_s: float | None = None  # what a user waits for, where that was measured


@dataclass
class Bench:
    """All rows so far."""

    machine: dict[str, str | int | bool | None]
    quick: bool = False
    rows: list[Row] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)  # what was left out, and why
    interrupted: int = 0  # by a signal: the exit code for it
    commands: list[CommandRow] = field(default_factory=list)
    # Seconds of what was timed, by its name: those of its rounds, without the one that warms up.
    times: dict[str, list[float]] = field(default_factory=dict)

    def keep(self, name: str, seconds: Iterable[float]) -> None:
        """Keep the seconds of some rounds; a clock may be too coarse for one."""
        if found := [s for s in seconds if s > 0]:
            self.times[name] = found

    def note(self, text: str) -> None:
        """Say something, once."""
        if text not in self.notes:
            self.notes.append(text)


def machine(one_core: bool) -> dict[str, str | int | bool | None]:
    """Return the facts of this machine that times depend on; None for a library that is missing."""
    return {
        "python": platform.python_version(),
        "numpy": np.__version__,
        "cpu_count": os.cpu_count(),
        "machine": platform.machine(),
        "processor": _processor(),
        "system": platform.system(),
        "one_core": one_core,
        **{name: _version(name) for name in LIBRARIES},
    }


def _processor() -> str:
    """Return the processor's name, where the system says it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def _version(library: str) -> str | None:
    try:
        return version(library)
    except PackageNotFoundError:
        return None
