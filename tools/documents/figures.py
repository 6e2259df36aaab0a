"""The figures that the documents have: each is computed from the scenes that the text speaks of."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from reference_tracer.rendering import render
from reference_tracer.scene import Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_grading.command import built_in
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.options import PIXELS
from reference_tracer_grading.subjects.triangle import TRIANGLE
from reference_tracer_grading.tally import COST


@cache
def scene(name: str) -> Scene:
    """One of the exercise's scenes, as the .blend exports to."""
    return {n: s for n, s, _ in built_in()}[f"exercise_{name}"]


@cache
def traced(name: str, method: str = "certified", precision: str = "float64") -> Frame:
    return render(scene(name), Settings(method, precision))


def _whole(value: float) -> str:
    return f"{round(value):,}"


def size_of(name: str) -> str:
    camera = scene(name).camera
    return f"{camera.width} × {camera.height}"


def ortho_width() -> str:
    w = scene("orthographic").camera.window
    return f"{w.right - w.left:.3g}"


def ortho_pixel() -> str:
    camera = scene("orthographic").camera
    return f"{1000 * (camera.window.right - camera.window.left) / camera.width:.4g}"


def column_pixels() -> str:
    """How high the scene's columns are in the orthographic picture."""
    some = scene("orthographic")
    heights = {
        float(np.ptp(some.meshes[i.mesh].vertices[:, 2]))
        for i in some.instances
        if some.objects[i.object].startswith("Column")
    }
    [height] = heights
    up = some.camera.world_from_camera[2, 1]
    w = some.camera.window
    return _whole(height * up / ((w.top - w.bottom) / some.camera.height))


def half_changed() -> str:
    """Pixels of the orthographic picture that change if rays pass the pixels' corners."""
    camera = scene("orthographic").camera
    w = camera.window
    half = (w.right - w.left) / camera.width / 2
    moved = scene("orthographic").seen_by(replace(camera, window=w.moved(-half, -half)))
    color = render(moved, Settings()).color
    return _whole((color != traced("orthographic").color).any(axis=2).sum())


def constant_colors() -> str:
    """Different colours in the picture, the background's among them."""
    return _whole(len(np.unique(traced("orthographic").color.reshape(-1, 4), axis=0)))


def half_angle() -> float:
    """Half the vertical angle of view, in radians."""
    return math.atan(scene("perspective").camera.window.top)


def half_angle_degrees() -> str:
    return f"{math.degrees(half_angle()):.2f}"


def pixel_length() -> str:
    camera = scene("perspective").camera
    return f"{math.tan(half_angle()) / (camera.height / 2):.6f}"


def _misread(angle: float, height: int) -> float:
    """Pixels by which the picture's edge is off if the angle is divided before the tangent."""
    right = math.tan(angle) / (height / 2)
    wrong = math.tan(angle / (height / 2))
    return height / 2 * (1 - wrong / right)


def misread_edge() -> str:
    return f"{_misread(half_angle(), scene('perspective').camera.height):.1f}"


def misread_wide() -> str:
    """The same for half an angle of 60 degrees."""
    return _whole(_misread(math.radians(60), scene("perspective").camera.height))


def misread_corner() -> str:
    """The same at the corner of the picture."""
    camera = scene("perspective").camera
    half = math.hypot(camera.width, camera.height) / 2
    return f"{_misread(half_angle(), camera.height) * half / (camera.height / 2):.1f}"


def corner_length() -> str:
    """How long d is for a corner pixel."""
    w, camera = scene("perspective").camera.window, scene("perspective").camera
    x, y = w.right * (1 - 1 / camera.width), w.top * (1 - 1 / camera.height)
    return f"{math.hypot(x, y, 1):.4f}"


def whole_angle_factor() -> str:
    """By how much the picture shrinks if half the angle is taken for the whole one."""
    a = half_angle()
    return f"{math.tan(2 * a) / math.tan(a):.2f}"


def _on_plane() -> np.ndarray:
    frame = traced("plane")
    return (frame.instance_index != NOTHING) & (frame.triangle_index == NOTHING)


def plane_pixels() -> str:
    return _whole(_on_plane().sum())


def plane_farthest() -> str:
    return _whole(traced("plane").t[_on_plane()].max())


def plane_clip() -> str:
    return _whole(scene("plane").camera.clip_end)


def plane_top_row() -> str:
    """The highest row in which the plane is seen."""
    return str(int(np.flatnonzero(_on_plane().any(axis=1)).max()))


def _depths() -> np.ndarray:
    """Depths of the plane in the rows that see it, from the lowest."""
    t = np.where(_on_plane(), traced("plane").t, np.nan)
    return np.nanmedian(t[_on_plane().any(axis=1)], axis=1)


def horizon_below() -> str:
    """By how many rows the highest row's centre is below the horizon: 1 / t falls evenly."""
    below, highest = 1 / _depths()[-2:]
    return f"{highest / (below - highest):.2f}"


def plane_step() -> str:
    """Metres from the highest row's depth to that of the row below."""
    below, highest = _depths()[-2:]
    return _whole(highest - below)


def _lost(name: str, method: str, precision: str) -> tuple[int, int]:
    """Pixels that see another surface than the certified one, and those that see a triangle."""
    certified = traced(name)
    wrong = traced(name, method, precision).wrong_against(certified)
    return int(wrong.sum()), int((certified.triangle_index != NOTHING).sum())


def literal_lost() -> str:
    return _whole(_lost("triangle", "textbook_literal", "float64")[0])


def literal_seen() -> str:
    return _whole(_lost("triangle", "textbook_literal", "float64")[1])


def literal_share() -> str:
    lost, seen = _lost("triangle", "textbook_literal", "float64")
    return f"{100 * lost / seen:.0f}"


def literal_share_float32() -> str:
    lost, seen = _lost("triangle", "textbook_literal", "float32")
    return f"{100 * lost / seen:.0f}"


def textbook_lost() -> str:
    return _whole(_lost("triangle", "textbook", "float64")[0])


def textbook_lost_float32() -> str:
    return _whole(_lost("triangle", "textbook", "float32")[0])


def triangle_count() -> str:
    return _whole(scene("triangle").triangle_count)


def judged_pairs() -> str:
    """Pairs that a student's function is asked about, over the exercise's four scenes."""
    subjects = (result_of(prepare(name, some)) for name, some, _ in built_in())
    return _whole(sum(len(some.pixel) for s in subjects for some, _ in s.pairs))


def judged_pixels() -> str:
    return _whole(PIXELS)


TOUR = Path(__file__).resolve().parents[2] / "docs" / "images" / "tutorial" / "comparison.json"


def of_tour() -> dict[str, str]:
    """Return figures of the tutorial's comparison; `window.py` leaves it there."""
    found = json.loads(TOUR.read_text(encoding="utf-8"))
    pixels = found["pixels"]
    counts = {f"tutorial_{n}": f"{pixels[n]:,}" for n in ("total", "agree", "differ", "explained")}
    x, y = found["metrics"]["largest_difference"]["pixel"]
    figures = {f"tutorial_{n}": f"{found['largest'][n]:.2g}" for n in ("figure", "allowed")}
    return counts | figures | {"tutorial_pixel": f"{x}, {y}", "tutorial_verdict": found["verdict"]}


WEIGHED = {f"weight_{name}": f"{weight:g}" for name, weight in TRIANGLE.weights.items()}
SIZES = {f"size_{n}": n for n in ("orthographic", "perspective", "plane", "triangle")}
_FIGURES: tuple[Callable[[], str], ...] = (
    ortho_width,
    ortho_pixel,
    column_pixels,
    half_changed,
    constant_colors,
    half_angle_degrees,
    pixel_length,
    corner_length,
    whole_angle_factor,
    misread_edge,
    misread_corner,
    misread_wide,
    plane_pixels,
    plane_farthest,
    plane_clip,
    plane_top_row,
    plane_step,
    horizon_below,
    literal_lost,
    literal_seen,
    literal_share,
    literal_share_float32,
    textbook_lost,
    textbook_lost_float32,
    triangle_count,
    judged_pairs,
    judged_pixels,
)


def values() -> Mapping[str, str]:
    """Return every figure by its name."""
    sizes = {key: size_of(name) for key, name in SIZES.items()}
    graded = {"cost": f"{COST:g}"} | WEIGHED
    return {f.__name__: f() for f in _FIGURES} | sizes | graded | of_tour()
