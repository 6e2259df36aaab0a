"""What a wrong renderer is given: the right camera and solids with one thing changed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from .description import RGBA, Description
from .renderer import Camera, Solid, Tracer, render
from .setup import camera_of, solids_of

LEVELS = 255  # of a file of eight bits


@dataclass(frozen=True, eq=False)
class Made:
    """What is drawn, and what then happens to the picture."""

    camera: Camera
    solids: tuple[Solid, ...]
    background: RGBA  # linear, alpha not multiplied
    # From all this to the picture (h, w, 4), row 0 at the top; by default one sample a pixel.
    draw: Callable[[Made], np.ndarray] | None = None
    after: Callable[[np.ndarray], np.ndarray] | None = None  # changes the finished picture
    levels: int = 0  # of the file that it is stored in; 0 for floats
    holds: str = ""  # the data in place of colours: depth, or ids
    filter_radius: float = 0.0  # pixels: of the filter that the renderer *says* it has

    def picture(self) -> np.ndarray:
        """Return linear RGBA with alpha multiplied in, (h, w, 4) float32, row 0 at the top."""
        drawn = self.draw(self) if self.draw else once(self)
        drawn = drawn if self.after is None else self.after(drawn)
        return drawn.astype(np.float32)

    def stored(self) -> np.ndarray:
        """Return the picture after a file of integers, if it is stored in one."""
        return through_file(self.picture()) if self.levels else self.picture()


Change = Callable[[Description, Made], Made | None]


@dataclass(frozen=True, eq=False)
class Fault:
    """A fault with its numbers. `make` returns None where there is nothing to get wrong."""

    key: str  # the name that the diagnosis must tell
    label: str  # its numbers, in words
    make: Change
    numbers: dict[str, Any] = field(default_factory=dict)
    only: tuple[int, ...] = (1, 2, 3, 4, 5, 6)  # the scenes in which it makes sense
    parts: tuple[Fault, ...] = ()  # those of a pair

    @property
    def name(self) -> str:
        """The key and the label."""
        return f"{self.key} ({self.label})" if self.label else self.key


def together(first: Fault, second: Fault) -> Fault:
    """Return two faults at once: the second one's change of the picture comes last."""

    def make(scene: Description, made: Made) -> Made | None:
        one = first.make(scene, made)
        both = one and second.make(scene, replace(one, after=None))
        if one is None or both is None:
            return None
        changes = [m.after for m in (one, both) if m.after]
        return replace(both, after=partial(in_turn, changes) if changes else None)

    only = tuple(n for n in first.only if n in second.only)
    key = f"{first.key} and {second.key}"
    label = f"{first.label} and {second.label}"
    return Fault(key, label, make, only=only, parts=(first, second))


def in_turn(changes: Iterable[Callable[[np.ndarray], np.ndarray]], p: np.ndarray) -> np.ndarray:
    """Change a picture by one after the other."""
    for change in changes:
        p = change(p)
    return p


def right(scene: Description) -> Made:
    """Return the right camera and solids."""
    return Made(camera_of(scene), tuple(solids_of(scene)), scene.background)


def premultiplied(color: RGBA) -> tuple[float, ...]:
    """Return straight RGBA with its alpha multiplied in."""
    return *(c * color[3] for c in color[:3]), color[3]


def once(made: Made, samples: int = 1) -> np.ndarray:
    """Return the picture of n x n samples a pixel, or data (h, w, 1) of one."""
    if made.holds:
        seen = Tracer(made.camera, made.solids)
        held = seen.depths() if made.holds == "depth" else ids_of(seen.owners())
        return held[..., None]
    return render(made.camera, made.solids, premultiplied(made.background), samples)


def ids_of(owners: np.ndarray) -> np.ndarray:
    """Return the id of each solid by its number; 0 for none."""
    return np.where(owners < 0, 0, 3 * owners + 5)


def encoded(linear: np.ndarray) -> np.ndarray:
    """Return sRGB's curve of linear values (IEC 61966-2-1), cut off to 0 to 1."""
    c = np.clip(linear, 0.0, 1.0)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def decoded(coded: np.ndarray) -> np.ndarray:
    """Return linear values of sRGB's."""
    return np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)


def through_file(
    picture: np.ndarray, to_integer: Callable[[np.ndarray], np.ndarray] = np.rint
) -> np.ndarray:
    """Return a picture (h, w, 4) as a PNG of eight bits holds it: straight, coded, rounded."""
    alpha = np.clip(picture[..., 3:], 0, 1)
    straight = picture[..., :3] / np.where(alpha > 0, alpha, 1)
    stored = np.clip(to_integer(LEVELS * encoded(straight)), 0, LEVELS) / LEVELS
    alpha = np.rint(LEVELS * alpha) / LEVELS
    return np.concatenate((decoded(stored) * alpha, alpha), axis=-1)


def with_camera(change: Callable[[Description, Camera], Camera]) -> Change:
    """Return what changes the camera alone."""
    return lambda scene, made: replace(made, camera=change(scene, made.camera))


def afterwards(change: Callable[[np.ndarray], np.ndarray], levels: int = 0) -> Change:
    """Return what changes the finished picture."""
    return lambda _, made: replace(made, after=change, levels=levels)
