"""Changes of one object in a few numbers: moved, scaled, turned.

They are one family. Each is fitted to the edges that are found in the picture (`matching.py`), for
which no ray is traced, and then to the pixels around the object.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from ...arrays import Bools, Floats
from ...projections import ORTHOGRAPHIC
from ...scene import Instance, Scene
from ...tracer.progress import Work
from ...tracer.vector import transform_points
from ...tracer.world import box_corners
from .fault import Values, with_instances
from .fitting import FOUND
from .looked import Looked
from .matching import Fitted, fitted, matches, seen_by
from .search import Search, values_of
from .stand import rotation

FINEST = 1 / 128  # pixels
DEPTHS = (1.0, 0.5, 0.6, 0.7, 0.8, 0.9)  # of that at which it would be as large as what is shown
TURNS = (*range(-165, 0, 15), *range(15, 181, 15))  # degrees, where edges say nothing
FACTORS = (-1.0, 0.25, 0.35, 0.5, 0.7, 1.4, 2.0, 2.8, 4.0)  # likewise, along one axis


@dataclass(frozen=True, eq=False)
class Change:
    """A change of an object in a few numbers."""

    kind: str
    # The matrix (4, 4) of an instance, from its own, the bounds of its mesh, and the numbers.
    matrix: Callable[..., Floats]
    none: Values  # the numbers that change nothing
    axes: Callable[[Looked], Floats]  # changes of them by about a pixel, (m, k) columns
    starts: Callable[[Looked], Iterable[Values]]  # where edges moved too far to be found
    words: Callable[..., str] = lambda *numbers: ""
    unseen: Callable[[Looked], Floats | None] = lambda looked: None  # changes that nobody sees

    def of(self, scene: Scene, name: str, values: Values) -> Scene:
        """Return a scene with an object changed."""

        def changed(instance: Instance) -> Instance:
            own, bounds = instance.world_from_object, scene.meshes[instance.mesh].bounds
            return replace(instance, world_from_object=self.matrix(own.copy(), bounds, *values))

        return with_instances(scene, name, changed)

    def matched(self, looked: Looked) -> Fitted | None:
        """Return the change with which the object's edges are where the picture has them."""
        places = looked.displacement(), np.zeros(2)

        def first() -> Fitted | None:
            found = (self._matched(looked, about) for about in places)
            return next((f for f in found if f and f.share >= FOUND), None)

        return looked.evidence.once(f"changed {id(self)} {looked.name}", first)

    def _matched(self, looked: Looked, about: Floats) -> Fitted | None:
        evidence, axes, own = looked.evidence, self.axes(looked), looked.alone.instances[0]
        camera, bounds = evidence.case.scene.camera, looked.alone.meshes[own.mesh].bounds
        places = matches(evidence, looked.name, looked.seen, tuple(about))
        points = transform_points(np.linalg.pinv(own.world_from_object), places.points)

        def seen(units: Floats) -> Floats:
            numbers = self.none + axes @ units
            matrix = self.matrix(own.world_from_object.copy(), bounds, *numbers)
            return seen_by(camera, transform_points(matrix, points))

        return fitted(places, seen, axes.shape[1])

    def search(self, looked: Looked, least: float = 0.0) -> Search:
        """Return a search among the numbers with which the pixels around an object are right."""
        axes = self.axes(looked)
        found = None if looked.kept else self.matched(looked)
        near = axes @ found.axes if found else axes

        def right(numbers: Values) -> Work[Bools | None]:
            return (yield from looked.right(self.of(looked.alone, "", numbers)))

        return Search(right, near, FINEST, least, self.unseen(looked))


def _moved(matrix: Floats, bounds: Floats, *by: float) -> Floats:
    matrix[:3, 3] += by
    return matrix


def _moves(looked: Looked) -> Floats:
    """Return the moves by about a pixel; nearer looks the same to an orthographic camera."""
    parallel = looked.evidence.case.scene.camera.projection is ORTHOGRAPHIC
    return looked.axes()[:, : 2 if parallel else 3]


def _unseen_moves(looked: Looked) -> Floats:
    seen = _moves(looked).shape[1]
    return looked.axes()[:, seen:]


def _places(looked: Looked) -> Iterable[Values]:
    """Return where its middle is shown, at some depths: what is shown of it may be hidden, too."""
    if not (looked.kept or looked.is_left):
        return []
    axes = _moves(looked)
    depths = (factor / looked.growth for factor in DEPTHS)
    return [values_of(axes @ looked.start(depth)[: axes.shape[1]]) for depth in depths]


# The point that stays: the object's origin, the middle of its base, its middle.
ABOUT = "", ", about the middle of its base", ", about its middle"


def _scaled(about: int, axis: Floats, matrix: Floats, bounds: Floats, *factors: float) -> Floats:
    corners = box_corners(bounds[..., None], matrix[..., None])[..., 0]
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle = (low + high) / 2
    point = (matrix[:3, 3].copy(), np.array((*middle[:2], low[2])), middle)[about]
    matrix[:3, :3] *= 1 + axis * (np.array(factors) - 1)
    matrix[:3, 3] = point + factors[0] * (matrix[:3, 3] - point)
    return matrix


def _factors(count: int, looked: Looked) -> Floats:
    """Return the factors that move the object's rim by about a pixel."""
    return np.eye(count) * 2 / max(looked.width, 2.0)


def _longer(factors: Values, axes: Sequence[str]) -> str:
    """Say along which of its own axes an object is longer, or mirrored."""
    own = zip(factors, axes, strict=True)
    said = ((f"{f:.4g} times as long" if f != -1 else "mirrored", name) for f, name in own)
    return ", ".join(f"{words} along its own {name}" for words, name in said)


def nearest_rotation(axes: Floats) -> Floats:
    """Return the rotation nearest to all three axes (polar decomposition: Higham 1986), (3, 3)."""
    u, _, v = np.linalg.svd(axes)
    return np.asarray(u @ v)


def _turned(own: bool, axes: Floats, matrix: Floats, bounds: Floats, *degrees: float) -> Floats:
    """Turn an object about its origin, by a vector along some axes: its own, or the world's."""
    about = axes @ np.radians(degrees)
    if own:
        about = nearest_rotation(matrix[:3, :3]) @ about
    matrix[:3, :3] = rotation(about) @ matrix[:3, :3]
    return matrix


def _degrees(count: int, looked: Looked) -> Floats:
    return np.degrees(_factors(count, looked))


def _turns(looked: Looked) -> Iterable[Values]:
    return product(range(-60, 61, 30), repeat=3)


def _any_turn(*degrees: float) -> str:
    angle = float(np.linalg.norm(degrees))
    x, y, z = np.array(degrees) / (angle or 1.0)
    return f"{angle:.4g} degrees about ({x:.3f}, {y:.3f}, {z:.3f}) in the world"


def _about(axis: int, own: bool) -> Change:
    """Return the turn about one of an object's own axes, or the world's."""
    of = "its own" if own else "the world's"
    return Change(
        "turned",
        partial(_turned, own, np.eye(3)[:, axis:][:, :1]),
        (0.0,),
        partial(_degrees, 1),
        lambda looked: [(float(angle),) for angle in TURNS],
        lambda degrees: f"{degrees:.4g} degrees about {of} {'XYZ'[axis]}",
    )


def _along(axis: int) -> Change:
    """Return the stretch along one of an object's own axes."""
    return Change(
        "scaled",
        partial(_scaled, 0, np.eye(3)[axis]),
        (1.0,),
        partial(_factors, 1),
        lambda looked: [(factor,) for factor in FACTORS],
        lambda *factors: _longer(factors, "XYZ"[axis]),
    )


def _larger(about: int) -> Change:
    """Return the scale about one of the points."""
    return Change(
        "scaled",
        partial(_scaled, about, np.ones(3)),
        (1.0,),
        partial(_factors, 1),
        lambda looked: [(looked.growth,), (1.0,)],
        lambda factor: f"{factor:.4g} times as large{ABOUT[about]}",
    )


# Each group has those of the fewest numbers first.
MOVED = (Change("moved", _moved, (0.0, 0.0, 0.0), _moves, _places, unseen=_unseen_moves),)
SCALED = (
    *map(_larger, range(len(ABOUT))),
    *map(_along, range(3)),
    Change(
        "scaled",
        partial(_scaled, 0, np.ones(3)),
        (1.0, 1.0, 1.0),
        partial(_factors, 3),
        lambda looked: [],
        lambda *factors: _longer(factors, "XYZ"),
    ),
)
TURNED = (
    *(_about(axis, own) for own in (True, False) for axis in range(3)),
    Change(
        "turned",
        partial(_turned, False, np.eye(3)),
        (0.0, 0.0, 0.0),
        partial(_degrees, 3),
        _turns,
        _any_turn,
    ),
)
CHANGES = (*MOVED, *SCALED, *TURNED)
