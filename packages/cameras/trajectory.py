"""Says how far the cameras of many frames are apart, and what makes all of the one of the other.

What is wrong in every frame is said once. The cameras of neural renderers are often those of the
scene in another world: turned, scaled and moved (nerfstudio's `auto_scale_poses`, for one).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.camera_files.frame import rotation_of, rotation_vector
from reference_tracer.scene import Camera
from reference_tracer.tracer.camera import film_of

from .difference import CameraDifference, apart, explained, measured, points_before
from .steps import Steps, focal_step, mistakes

_FEW = 6  # cameras, among all, on which another world is tried first
_ASKED = 3  # cameras, among those that differ, of which an explanation is tried on all
_ONE_PLACE = 1e-20  # of the squared places: what is less is the rounding of their mean
_NEGLIGIBLE = 1e-6  # of a turn in radians, a scale less 1, and a move in shares of all places


T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Similarity:
    """A turn (3, 3), a scale and a move (3,) that take one world to another."""

    rotation: Floats
    scale: float
    move: Floats

    @classmethod
    def between(cls, own: Sequence[Camera], other: Sequence[Camera]) -> Similarity:
        """Fit the one between cameras: axes say the turn, places the scale and the move.

        Source: S. Umeyama, "Least-squares estimation of transformation parameters between two point
        patterns", PAMI 13, 1991, with the rotation from the axes. Places that are all one say no
        scale: it is 1.
        """
        axes, others = (np.array([c.world_from_camera[:3, :3] for c in cs]) for cs in (own, other))
        rotation = rotation_of(np.einsum("nij,nkj->ik", others, axes))
        places, moved = (np.array([c.origin for c in cs]) for cs in (own, other))
        turned = places @ rotation.T
        spread = turned - turned.mean(axis=0)
        square = (spread * spread).sum()
        along = (spread * (moved - moved.mean(axis=0))).sum()
        scale = along / square if square > _ONE_PLACE * (places * places).sum() else 1.0
        return cls(rotation, scale, moved.mean(axis=0) - scale * turned.mean(axis=0))

    def of(self, points: Floats) -> Floats:
        """Return where points (3, n) of the first world are in the second."""
        return self.scale * (self.rotation @ points) + self.move[:, None]

    def words(self) -> str:
        """Return the turn, the scale and the move, as far as they change anything."""
        out = []
        turn = rotation_vector(self.rotation)
        angle = np.linalg.norm(turn)
        if angle > _NEGLIGIBLE:
            out.append(f"turned by {np.degrees(angle):.4g} degrees about {_vector(turn / angle)}")
        if abs(self.scale - 1) > _NEGLIGIBLE:
            out.append(f"scaled by {self.scale:.6g}")
        if np.abs(self.move).max() > _NEGLIGIBLE:
            out.append(f"moved by {_vector(self.move)}")
        return ", ".join(out)


def _vector(values: Floats) -> str:
    return "({:.4g}, {:.4g}, {:.4g})".format(*(0.0 if abs(v) < 1e-9 else v for v in values))


@dataclass(frozen=True, eq=False)
class TrajectoryDifference:
    """Where the cameras of many frames differ, and what makes all of them of the scene's."""

    names: tuple[str, ...]
    each: tuple[CameraDifference, ...]  # measured; the worst one explained where nothing is common
    steps: Steps = ()  # what all that differ have, or what comes before the other world
    world: Similarity | None = None

    @property
    def agrees(self) -> bool:
        """Whether all cameras do."""
        return all(found.agrees for found in self.each)

    def lines(self) -> list[str]:
        """Return it as sentences: what is common once, and else what the worst one has."""
        largest = [found.largest for found in self.each]
        worst = np.argmax(largest)
        count = len(self.each)
        if self.agrees:
            return [f"{count} cameras agree: points lie at most {largest[worst]:.2g} px apart"]
        wrong = sum(not found.agrees for found in self.each)
        first, *more = self.each[worst].lines()
        out = [f"{wrong} of {count} cameras differ, {self.names[worst]} the most: {first}"]
        if not self.steps and self.world is None:
            return [*out, f"no fault is common to all; of {self.names[worst]}:", *more]
        out += ["in all that differ:"]
        out += (line for step in self.steps for line in step.lines())
        if self.world is not None:
            out += [
                f"the cameras' world is {self.world.words()}",
                "  turn, scale and move the meshes likewise, or the cameras back: loaders of NeRF "
                "and of Gaussian splatting centre and scale theirs",
            ]
        return out


@np.errstate(invalid="ignore", divide="ignore", over="ignore")  # of points behind a camera
def trajectory_difference(
    names: Sequence[str], own: Sequence[Camera], other: Sequence[Camera]
) -> TrajectoryDifference:
    """Compare the cameras of two or more frames with the scene's, pair by pair."""
    each = [measured(*pair) for pair in zip(own, other, strict=True)]
    found = TrajectoryDifference(tuple(names), tuple(each))
    wrong = [k for k, one in enumerate(each) if not one.agrees]
    if not wrong:
        return found
    pairs = [(own[k], other[k], each[k].allowed) for k in wrong]
    # A camera that looks along an axis may hide what is wrong: several are asked.
    for k in _spread(wrong, _ASKED):
        for steps in explained(each[k], own[k], other[k]).explanations:
            if all(_sees_as(_with(a, steps), b, allowed) for a, b, allowed in pairs):
                return replace(found, steps=steps)
    every = [(a, b, one.allowed) for a, b, one in zip(own, other, each, strict=True)]
    if len(wrong) == len(each) and (common := _in_another_world(every)):
        return replace(found, steps=common[0], world=common[1])
    worst = int(np.argmax([one.largest for one in each]))
    each[worst] = explained(each[worst], own[worst], other[worst])
    return replace(found, each=tuple(each))


_Pairs = Sequence[tuple[Camera, Camera, float]]  # the scene's, the other, the pixels allowed


def _with(camera: Camera, steps: Steps) -> Camera:
    """Return a camera with the faults of another one, in the same way and with the same numbers."""
    for step in steps:
        camera = step.change(camera) or camera
    return camera


def _sees_as(
    camera: Camera, other: Camera, allowed: float, world: Similarity | None = None
) -> bool:
    """Return whether a camera sees points as the other one does, where these are in its world."""
    points = points_before(camera if world else other, camera)
    others = world.of(points) if world else points
    return bool(np.all(apart(film_of(camera, points), film_of(other, others)) <= allowed))


def _in_another_world(pairs: _Pairs) -> tuple[Steps, Similarity] | None:
    """Return a world, and what is wrong before it, of which all cameras are the scene's."""
    few = _spread(pairs, _FEW)
    for steps in _before(few[len(few) // 2]):
        if _world(few, steps) and (world := _world(pairs, steps)) and world.words():
            return steps, world
    return None


def _spread(every: Sequence[T], most: int) -> list[T]:
    """Return some items, spread over all."""
    count = min(most, len(every))
    return [every[k * len(every) // count] for k in range(count)]


def _before(pair: tuple[Camera, Camera, float]) -> list[Steps]:
    """Return what may be wrong with every camera of another world: first nothing."""
    own, other, _ = pair
    lens = focal_step(own, other)
    alone: list[Steps] = [(), (lens,)] if lens else [()]
    return alone + [(step,) for step in mistakes(own)]


def _world(pairs: _Pairs, steps: Steps) -> Similarity | None:
    """Return the world in which the others see what the scene's cameras with a fault do."""
    own = [_with(camera, steps) for camera, _, _ in pairs]
    world = Similarity.between(own, [other for _, other, _ in pairs])
    if not world.scale > 0:
        return None
    every = zip(own, pairs, strict=True)
    is_one = all(_sees_as(camera, other, allowed, world) for camera, (_, other, allowed) in every)
    return world if is_one else None
