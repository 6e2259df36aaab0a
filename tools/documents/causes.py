"""An example picture for each cause: docs/images/causes.

Each shows side by side what is traced, the picture that it is compared with, and the causes in
their colours. The scenes are those of the tests. The tracer makes the other picture, too: with what
the cause excuses, or in float32, where such pixels come from.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from PIL import Image
from reference_tracer.arrays import Colors
from reference_tracer.causes.case import Alternative, without
from reference_tracer.causes.cause import Cause
from reference_tracer.causes.checks.unmodelled import covered
from reference_tracer.causes.explain import CAUSES
from reference_tracer.causes.maps import cause_map
from reference_tracer.files.images import curve, to_display
from reference_tracer.manifest import Unmodelled
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Precision, Settings

from .pictures import beside

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT))
MAKE, CASES = import_module("tests.conftest").Make, import_module("tests.cases")
sys.path.remove(str(PROJECT))

WIDTH, HEIGHT, TIMES = 30, 22, 8  # pixels that are shown, and how many times as large
ROWS = 36  # that are traced before the picture is cancelled
FLOAT32 = Settings(Method.MOLLER_TRUMBORE, Precision.FLOAT32)


@dataclass(frozen=True)
class Example:
    """A scene, another picture of it, what else a case knows, and how it is traced."""

    scene: Scene
    color: Colors
    known: Mapping[str, Any]
    frame: Frame | None = None  # if it is not all of the scene

    def shown(self) -> tuple[Colors, Colors, NDArray[np.uint8]]:
        """Return the traced picture, the other one, and the causes, (h, w)."""
        frame = self.frame or render(self.scene)
        found = result_of(CASES.find_causes(self.scene, frame, self.color, **self.known))
        return frame.color, self.color, found.cause


def _quad(film: tuple[float, ...], plane: tuple[float, float, float]) -> Mesh:
    """Return a quad by four points (x, y) of the film, in a plane: depth = c / (1 - a x - b y)."""
    x, y = np.reshape(film, (4, 2)).T
    a, b, c = plane
    depth = c / (1 - a * x - b * y)
    return Mesh(np.stack((x, y, -np.ones(4)), axis=1) * depth[:, None], [[0, 1, 2], [0, 2, 3]])


def edge() -> Example:
    """Bars a little aslant, and the camera moved by 1/300 px: rasterisers snap corners to 1/256."""
    camera, slant = MAKE.camera(WIDTH, HEIGHT, half=HEIGHT / 2), HEIGHT / 2400
    bars = []
    for left in (-11.501, -4.499, 2.502, 8.498):  # each begins at pixels' centres
        right, low, high = left + 4.3, 2 - HEIGHT / 2, HEIGHT / 2 - 2
        film = (left - slant, low, right - slant, low, right + slant, high, left + slant, high)
        bars.append(_quad(film, (0, 0, 10)))
    scene = MAKE.scene(camera, *bars)
    moved = CASES.shifted(camera, 1 / 300, -1 / 300)
    return Example(scene, render(scene.seen_by(moved)).color, {})


def depth_tie() -> Example:
    """Two quads in one plane: float32 sees now one, now the other."""
    camera, plane = MAKE.camera(WIDTH, HEIGHT, half=0.37), (0.1, 0.3, 10)
    first = _quad((-0.43, -0.3, 0.13, -0.35, 0.2, 0.28, -0.4, 0.2), plane)
    second = _quad((-0.2, -0.1, 0.43, -0.2, 0.35, 0.31, -0.15, 0.25), plane)
    scene = MAKE.scene(camera, first, second)
    return Example(scene, render(scene, FLOAT32).color, {})


def clip_plane() -> Example:
    """A quad that crosses the clip start at a small angle."""
    camera = MAKE.camera(WIDTH, HEIGHT, half=0.37, clip_start=2.0)
    depth = (2 - 3e-6, 2 + 3e-6, 2 + 2e-6, 2 - 3.5e-6)
    corners = np.array([(-3, -3), (3, -3), (3, 3), (-3, 3)])
    front = Mesh(np.column_stack((corners, np.negative(depth))), [[0, 1, 2], [0, 2, 3]])
    scene = MAKE.scene(camera, front, MAKE.quad(-9, 9, -9, 9, -5))
    return Example(scene, render(scene, FLOAT32).color, {})


def anti_aliasing() -> Example:
    """Sixteen samples a pixel."""
    scene = MAKE.room()
    return Example(scene, render(scene, Settings(samples=4)).color, {"filter_radius": 1.0})


def color() -> Example:
    """SRGB's curve applied once more."""
    scene = MAKE.room()
    shown = render(scene).color.copy()
    shown[..., :3] = curve(shown[..., :3])
    return Example(scene, shown, {"curves": ()})


def not_modelled() -> Example:
    """Hair on the box."""
    scene, shown = MAKE.room(), render(MAKE.room()).color.copy()
    hair = Unmodelled("Hair", "hair", bounds=np.array([(0.3, -0.8, -0.9), (1.1, 0.1, 0.3)]))
    y, x = np.indices(shown.shape[:2])
    shown[covered(scene.camera, hair.bounds) & ((x + y) % 4 == 0)] = 1
    return Example(scene, shown, {"unmodelled": [hair]})


def hidden() -> Example:
    """The box is hidden in the viewport."""
    scene = replace(MAKE.room(), objects=("Ball", "Box", "Wall"))
    other = without(scene, ["Box"])
    known = {"alternatives": [Alternative("Box", "hidden in the viewport", other)]}
    return Example(scene, render(other).color, known)


def not_decidable() -> Example:
    """The room thousands of kilometres from the origin, and its corners as float32 has them."""
    room, far = MAKE.room(), 3e6 * np.array((1.0, -0.6, 0.4))
    matrix = room.camera.world_from_camera.copy()
    matrix[:3, 3] += far
    moved = [replace(mesh, vertices=mesh.vertices + far) for mesh in room.meshes]
    rounded = [replace(m, vertices=np.float32(m.vertices).astype(float)) for m in moved]
    scene = room.seen_by(replace(room.camera, world_from_camera=matrix))
    other = replace(scene, meshes=tuple(rounded))
    return Example(replace(scene, meshes=tuple(moved)), render(other).color, {})


def unexplained() -> Example:
    """The box left out, and nothing hides it."""
    return replace(hidden(), known={})


def not_traced() -> Example:
    """Stopped before the end."""
    scene = MAKE.room()
    whole, frame = render(scene), Frame.empty(scene)
    for name in ("color", "instance_index", "triangle_index"):
        getattr(frame, name)[:ROWS] = getattr(whole, name)[:ROWS]
    frame.rows_done[:ROWS] = True
    return Example(scene, whole.color, {}, frame)


EXAMPLES: Mapping[str, Callable[[], Example]] = {
    f.__name__: f
    for f in (
        edge,
        depth_tie,
        clip_plane,
        anti_aliasing,
        color,
        not_modelled,
        hidden,
        not_decidable,
        unexplained,
        not_traced,
    )
}


def picture(cause: Cause) -> NDArray[np.uint8]:
    """Return the part of a picture that has the most of a cause, (h, w, 4), row 0 at the bottom."""
    traced, shown, causes = EXAMPLES[cause.key]().shown()
    has = causes == cause
    count = sliding_window_view(has, (HEIGHT, WIDTH)).sum(axis=(2, 3))
    corners = np.argwhere(count == count.max())
    middle = np.argwhere(has).mean(axis=0) - (HEIGHT / 2, WIDTH / 2)
    y, x = corners[np.linalg.norm(corners - middle, axis=1).argmin()]
    parts = (traced, shown, cause_map(traced, causes))
    cut = (to_display(p)[y : y + HEIGHT, x : x + WIDTH] for p in parts)
    return beside(*(p.repeat(TIMES, axis=0).repeat(TIMES, axis=1) for p in cut))


def write(folder: Path) -> None:
    """Write them all as PNG."""
    folder.mkdir(parents=True, exist_ok=True)
    for cause in CAUSES:
        if cause.why:
            made = np.ascontiguousarray(picture(cause)[::-1])
            Image.fromarray(made).save(folder / f"{cause.key}.png", optimize=True)
