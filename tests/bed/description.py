"""What describes a scene of the test bed: data as Blender has them, for both renderers."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

RGBA = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class Shape:
    """Polygons in object space: triangles or quads, cut along their first corner's diagonal."""

    vertices: np.ndarray  # (v, 3) float32, metres
    faces: np.ndarray  # (n, 3) or (n, 4) indices

    def triangles(self, other_diagonal: bool = False) -> np.ndarray:
        """Return the triangles, (m, 3); those of a quad stand one behind the other."""
        if self.faces.shape[1] == 3:
            return self.faces
        cut = ((0, 1, 3), (1, 2, 3)) if other_diagonal else ((0, 1, 2), (0, 2, 3))
        return self.faces[:, cut].reshape(-1, 3)

    def slots(self, count: int) -> np.ndarray:
        """Return which of so many material slots each triangle has, (m,): in turn, by faces."""
        return np.repeat(np.arange(len(self.faces)), self.faces.shape[1] - 2) % count


@dataclass(frozen=True, eq=False)
class Pose:
    """Where something is: what Blender multiplies to its matrix."""

    own: np.ndarray = field(default_factory=lambda: np.eye(4))  # the basis, at frame 0
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # metres a frame, in its parent's space
    spin: float = 0.0  # radians a frame, about its own Z
    parent: np.ndarray | None = None  # (4, 4) world
    parent_inverse: np.ndarray | None = None
    instancer: np.ndarray | None = None  # (4, 4) world, of the empty that instances a collection

    def basis(self, frame: float) -> np.ndarray:
        """Return the own matrix at a frame."""
        c, s = np.cos(self.spin * frame), np.sin(self.spin * frame)
        turned = np.eye(4)
        turned[:2, :2] = (c, -s), (s, c)
        out = self.own @ turned
        out[:3, 3] += np.multiply(self.velocity, frame)
        return out

    def world(self, frame: float) -> np.ndarray:
        """Return world_from_object at a frame, (4, 4)."""
        out = self.basis(frame)
        for outer in (self.parent_inverse, self.parent, self.instancer):
            out = out if outer is None else outer @ out
        return out

    @property
    def moves(self) -> bool:
        """Whether it is animated."""
        return self.spin != 0 or any(self.velocity)


@dataclass(frozen=True, eq=False)
class Item:
    """An object. `shape` is what a render shows."""

    name: str
    shape: Shape
    color: RGBA
    pose: Pose = field(default_factory=Pose)
    levels: tuple[Shape, ...] = ()  # by the level of subdivision; `shape` is levels[level]
    level: int = 0
    viewport: Shape | None = None  # with the modifiers of the viewport
    plain: Shape | None = None  # without any modifier
    rest: Shape | None = None  # undeformed
    hidden: bool = False  # in a render
    other_layer: bool = False  # in a view layer that is not rendered
    more: tuple[RGBA, ...] = ()  # the colours of further material slots

    @property
    def colors(self) -> tuple[RGBA, ...]:
        """The colours of its material slots."""
        return self.color, *self.more

    def world(self, frame: float) -> np.ndarray:
        """Return world_from_object at a frame, (4, 4)."""
        return self.pose.world(frame)


@dataclass(frozen=True, eq=False)
class Lens:
    """A camera's data, named as in Blender: millimetres, metres, and shifts without a unit."""

    focal: float = 50.0
    sensor_width: float = 36.0
    sensor_height: float = 24.0
    fit: str = "AUTO"  # AUTO, HORIZONTAL, VERTICAL
    shift_x: float = 0.0
    shift_y: float = 0.0
    parallel: bool = False
    ortho_scale: float = 6.0
    clip_start: float = 0.1
    clip_end: float = 1000.0


@dataclass(frozen=True, eq=False)
class Film:
    """The picture's size as a render's settings have it."""

    resolution_x: int
    resolution_y: int
    percentage: int = 100
    aspect_x: float = 1.0
    aspect_y: float = 1.0
    # Columns x0 and x1, rows y0 and y1 from the *lower* edge, of the whole picture.
    border: tuple[int, int, int, int] | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows of the whole picture."""
        share = self.percentage
        return self.resolution_x * share // 100, self.resolution_y * share // 100

    @property
    def cut(self) -> tuple[int, int, int, int]:
        """The border, or the whole picture."""
        return self.border or (0, self.size[0], 0, self.size[1])


@dataclass(frozen=True, eq=False)
class Description:
    """A scene."""

    number: int
    name: str
    items: tuple[Item, ...]
    lens: Lens
    film: Film
    eye: Pose  # of the camera; may carry a scale
    background: RGBA
    frame: float = 1.0
    others: tuple[tuple[str, Lens, Pose], ...] = ()  # further cameras

    @cached_property
    def shown(self) -> tuple[Item, ...]:
        """What a render shows."""
        return tuple(i for i in self.items if not (i.hidden or i.other_layer))

    def item(self, name: str) -> Item:
        """Return the item of a name."""
        return next(i for i in self.items if i.name == name)
