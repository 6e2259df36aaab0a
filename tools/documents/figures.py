"""The figures that the documents have: each is computed from the scenes that the text speaks of."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
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


def sizes() -> dict[str, str]:
    """The size of each scene's picture."""
    cameras = {n: scene(n).camera for n in ("orthographic", "perspective", "plane", "triangle")}
    return {f"size_{name}": f"{own.width} × {own.height}" for name, own in cameras.items()}


def of_orthographic() -> dict[str, str]:
    """The parallel camera's film, and what changes if rays pass the pixels' corners."""
    some, camera = scene("orthographic"), scene("orthographic").camera
    w, color = camera.window, traced("orthographic").color
    across, up = w.right - w.left, camera.world_from_camera[2, 1]
    [height] = {
        float(np.ptp(some.meshes[i.mesh].vertices[:, 2]))
        for i in some.instances
        if some.objects[i.object].startswith("Column")
    }
    half = across / camera.width / 2
    moved = some.seen_by(replace(camera, window=w.moved(-half, -half)))
    return {
        "ortho_width": f"{across:.3g}",
        "ortho_pixel": f"{1000 * across / camera.width:.4g}",
        "column_pixels": _whole(height * up / ((w.top - w.bottom) / camera.height)),
        "half_changed": _whole((color != render(moved, Settings()).color).any(axis=2).sum()),
        "constant_colors": _whole(len(np.unique(color.reshape(-1, 4), axis=0))),
    }


def _misread(angle: float, height: int) -> float:
    """Pixels by which the picture's edge is off if the angle is divided before the tangent."""
    right = math.tan(angle) / (height / 2)
    wrong = math.tan(angle / (height / 2))
    return height / 2 * (1 - wrong / right)


def of_perspective() -> dict[str, str]:
    """The angle of view, and what comes of misreading it: at the edge, the corner, and of 60°."""
    camera = scene("perspective").camera
    w, half = camera.window, camera.height / 2
    angle = math.atan(w.top)  # half the vertical one
    off = _misread(angle, camera.height)
    corner = w.right * (1 - 1 / camera.width), w.top * (1 - 1 / camera.height), 1
    return {
        "half_angle_degrees": f"{math.degrees(angle):.2f}",
        "pixel_length": f"{math.tan(angle) / half:.6f}",
        "corner_length": f"{math.hypot(*corner):.4f}",
        "whole_angle_factor": f"{math.tan(2 * angle) / math.tan(angle):.2f}",
        "misread_edge": f"{off:.1f}",
        "misread_corner": f"{off * math.hypot(camera.width, camera.height) / camera.height:.1f}",
        "misread_wide": _whole(_misread(math.radians(60), camera.height)),
    }


def of_plane() -> dict[str, str]:
    """Where the plane is seen, and how its depth grows towards the horizon."""
    frame = traced("plane")
    seen = (frame.instance_index != NOTHING) & (frame.triangle_index == NOTHING)
    rows = seen.any(axis=1)
    depths = np.nanmedian(np.where(seen, frame.t, np.nan)[rows], axis=1)  # from the lowest row
    below, highest = depths[-2:]
    return {
        "plane_pixels": _whole(seen.sum()),
        "plane_farthest": _whole(frame.t[seen].max()),
        "plane_clip": _whole(scene("plane").camera.clip_end),
        "plane_top_row": str(int(np.flatnonzero(rows).max())),
        "plane_step": _whole(highest - below),
        # Rows from the highest one's centre to the horizon: 1 / t falls evenly.
        "horizon_below": f"{1 / highest / (1 / below - 1 / highest):.2f}",
    }


def of_triangle() -> dict[str, str]:
    """The pixels that the textbook's methods get wrong, of those that see a triangle."""
    certified = traced("triangle")
    seen = int((certified.triangle_index != NOTHING).sum())
    found = {
        "literal_seen": _whole(seen),
        "triangle_count": _whole(scene("triangle").triangle_count),
    }
    for name, method in (("literal", "textbook_literal"), ("textbook", "textbook")):
        for end, precision in (("", "float64"), ("_float32", "float32")):
            lost = int(traced("triangle", method, precision).wrong_against(certified).sum())
            found[f"{name}_lost{end}"] = _whole(lost)
            found[f"{name}_share{end}"] = f"{100 * lost / seen:.0f}"
    return found


def of_grading() -> dict[str, str]:
    """What is asked of a student's function, over the exercise's four scenes; the weights."""
    subjects = (result_of(prepare(name, some)) for name, some, _ in built_in())
    pairs = sum(len(some.pixel) for s in subjects for some in s.pairs)
    found = {"judged_pairs": _whole(pairs), "judged_pixels": _whole(PIXELS), "cost": f"{COST:g}"}
    return found | {f"weight_{name}": f"{weight:g}" for name, weight in TRIANGLE.weights.items()}


TOUR = Path(__file__).resolve().parents[2] / "docs" / "images" / "tutorial" / "comparison.json"


def of_tour() -> dict[str, str]:
    """Return figures of the tutorial's comparison; `window.py` leaves it there."""
    found = json.loads(TOUR.read_text(encoding="utf-8"))
    pixels = found["pixels"]
    counts = {f"tutorial_{n}": f"{pixels[n]:,}" for n in ("total", "agree", "differ", "explained")}
    x, y = found["metrics"]["largest_difference"]["pixel"]
    figures = {f"tutorial_{n}": f"{found['largest'][n]:.2g}" for n in ("figure", "allowed")}
    return counts | figures | {"tutorial_pixel": f"{x}, {y}", "tutorial_verdict": found["verdict"]}


def values() -> Mapping[str, str]:
    """Return every figure by its name."""
    found: dict[str, str] = {}
    for of in (
        sizes,
        of_orthographic,
        of_perspective,
        of_plane,
        of_triangle,
        of_grading,
        of_tour,
    ):
        found |= of()
    return found
