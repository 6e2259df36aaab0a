"""Compares the objects of two scenes, and names each difference as a diagnosis does."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.causes.case import Variant
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import AnyFault, Guess
from reference_tracer.scene import Plane, Scene
from reference_tracer.wording import count_of

from .geometry import DIGITS, ROUNDINGS, Shape, Shapes, shapes_of
from .matching import Matched, matched, points_alike
from .moves import MARGIN, Move, move_between

_FAULT: dict[str, AnyFault] = {fault.name: fault for fault in FAULTS}
_TRIED = 16  # transforms, at most, that may be all objects'
_LEVELS = (-3, -2, -1, 1, 2, 3)  # of subdivision, each of which makes four triangles of one


@dataclass(frozen=True)
class Difference:
    """How an object of the second scene differs from the first's."""

    object: str  # '' of all
    kind: str  # the name of a fault of the diagnosis, or of this package
    sentence: str
    advice: str = ""

    def lines(self) -> Iterator[str]:
        """Yield it as lines of text."""
        yield self.sentence
        if self.advice:
            yield f"  what to do: {self.advice}"

    def to_dict(self) -> dict[str, str]:
        """Return it as JSON can hold it."""
        return vars(self).copy()


class Pair(NamedTuple):
    """An object of the first scene, and its partner in the second."""

    name: str
    own: Shape
    other: Shape

    @property
    def tolerance(self) -> float:
        """How far digits may move a coordinate of either, metres."""
        return max(self.own.tolerance, self.other.tolerance)


def _of_fault(name: str, object_: str, sentence: str = "", words: str = "") -> Difference:
    """Return a difference that a fault of the diagnosis explains, in its words."""
    fault, guess = _FAULT[name], Guess(object=object_, words=words)
    advice = "" if "{" in fault.advice else fault.advice_of(guess)
    return Difference(object_, name, sentence or fault.sentence_of(guess), advice)


def differences(
    first: Scene, second: Scene, variants: Sequence[Variant] = ()
) -> tuple[Difference, ...]:
    """Return how the objects of the second scene differ from those of the first.

    `variants` are scenes with faults that only Blender can make, of the first. What all objects, or
    most, have in common is said once, and the rest beside that.
    """
    own, other = shapes_of(first), shapes_of(second)
    if len(other) == 1 < len(own) and not own.keys() & other.keys():
        own = dict.fromkeys(other, Shape.joined(own.values()))  # the file has no objects
        variants = ()
    made = [(v, shapes_of(v.scene)) for v in variants]
    names = _paired(own, other)
    pairs = [Pair(name, own[name], other[shown]) for name, shown in names.items()]
    moves, out = _compared(pairs, made)
    if common := _common(pairs, moves):
        move, tolerance = common
        own = {name: shape.moved_by(move) for name, shape in own.items()}
        made = [(v, {n: shape.moved_by(move) for n, shape in of.items()}) for v, of in made]
        pairs = [pair._replace(own=own[pair.name]) for pair in pairs]
        moves, out = _compared(pairs, made, MARGIN)
        out.insert(0, _of_all(move, tolerance))
    out += [_moved(p.name, moves[p.name], p.tolerance) for p in pairs if p.name in moves]
    out += _missing(own, other, names)
    out += _of_planes(first, second)
    return tuple(out)


def _of_planes(first: Scene, second: Scene) -> Iterator[Difference]:
    """Yield how infinite planes differ, which have no triangles."""
    own, other = map(_planes_of, (first, second))
    for name, planes in own.items():
        for plane in planes:
            if name not in other:
                yield _of_fault("object_missing", name)
            elif not any(_alike(plane, p) for p in other[name]):
                yield Difference(name, "plane_moved", f"the infinite plane '{name}' lies elsewhere")
    for name in other:
        if name not in own:
            yield Difference(name, "object_added", f"'{name}' is not in the first scene")


def _planes_of(scene: Scene) -> dict[str, list[Plane]]:
    out: dict[str, list[Plane]] = {}
    for plane in scene.planes:
        out.setdefault(scene.objects[plane.object], []).append(plane)
    return out


def _alike(first: Plane, second: Plane) -> bool:
    """Return whether two planes are the same, with the same side in front."""
    size = float(max(np.abs(first.point).max(), np.abs(second.point).max()))
    n, m = (p.normal / np.sqrt((p.normal * p.normal).sum()) for p in (first, second))
    off = abs(n @ (second.point - first.point))
    return float(np.abs(n - m).max()) <= ROUNDINGS and off <= 2 * (ROUNDINGS * size + DIGITS)


def _compared(
    pairs: Sequence[Pair], made: Sequence[tuple[Variant, Shapes]], times: int = 1
) -> tuple[dict[str, Move], list[Difference]]:
    """Return how objects are moved, and what else differs of those with a partner.

    `times` is how many tolerances an object in place may be off.
    """
    moves: dict[str, Move] = {}
    out: list[Difference] = []
    for pair in pairs:
        own, other = pair.own.triangles, pair.other.triangles
        tolerance = times * pair.tolerance
        found = _of_object(pair.name, own, other, tolerance, made)
        if found is not None:
            out += found
        elif move := move_between(own, other, tolerance):
            moves[pair.name] = move
            out += _turned_over(pair.name, matched(move.of(own), other, 8 * tolerance))
        else:
            out.append(_of_triangles(pair.name, own, other, tolerance))
    return moves, out


def _common(pairs: Sequence[Pair], moves: dict[str, Move]) -> tuple[Move, float] | None:
    """Return a transform that most of several objects have in common, if any.

    And the tolerance of the object whose it is. An object with symmetries is moved in several ways:
    so each way is tried on all objects.
    """
    moved = [pair for pair in pairs if pair.name in moves]
    for first in moved[:_TRIED]:
        move = moves[first.name]
        alike = 0
        for own, other, tolerance in ((p.own, p.other, MARGIN * p.tolerance) for p in moved):
            there = matched(move.of(own.triangles), other.triangles, tolerance).there
            alike += bool(there.all())
        if 2 * alike > len(pairs) > 1:
            return move, first.tolerance
    return None


_UP = {"-90": "y", "90": "z"}  # by how much a file is turned about X whose other axis is up


def _of_all(move: Move, tolerance: float) -> Difference:
    words = Move(move.axes, move.by, np.zeros(3)).words(tolerance)
    up = next((axis for by, axis in _UP.items() if f"turned by {by} degrees about X" in words), "")
    advice = f"if the file has {up.upper()} up, --set up={up} turns it" if up else ""
    return Difference("", "scene_moved", f"all objects are {words}", advice)


def _moved(name: str, move: Move, tolerance: float) -> Difference:
    words = move.words(tolerance)
    kind = "object_scaled" if words.startswith("scaled") else "object_moved"
    return _of_fault(kind, name, f"'{name}' is {words}")


def _paired(own: Shapes, other: Shapes) -> dict[str, str]:
    """Return which objects have one name: as it is, or as formats write names."""
    plain = {_plain(name): name for name in reversed(other)}
    same = {name: name for name in own if name in other}
    taken = set(same.values())
    for name in own:
        near = plain.get(_plain(name))
        if name not in same and near is not None and near not in taken:
            same[name] = near
            taken.add(near)
    return same


def _plain(name: str) -> str:
    return re.sub(r"\W+", "_", re.sub(r" \(node \d+\)$", "", name)).lower()


def _of_object(
    name: str,
    own: Floats,
    other: Floats,
    tolerance: float,
    made: Sequence[tuple[Variant, Shapes]],
) -> list[Difference] | None:
    """Return how an object differs that is in place, or as a variant has it; None if neither."""
    there, back = matched(own, other, tolerance), matched(other, own, tolerance)
    if there.there.all() and back.there.all():
        found = list(_turned_over(name, there))
        if len(other) > len(own):
            times = len(other) / len(own)
            say = f"'{name}' is there {times:.3g} times in one place"
            found.append(Difference(name, "object_twice", say, _FAULT["object_twice"].advice))
        elif len(other) < len(own):
            doubles = count_of(len(own) - len(other), "triangle")
            say = f"{doubles} of '{name}' that are there twice are there once"
            found.append(Difference(name, "doubles_left_out", say))
        return found
    for variant, shapes in made:
        same = shapes[name].triangles if name in shapes else other[:0]
        if len(same) != len(other) or not variant.fault:
            continue
        if matched(same, other, tolerance).there.all():
            words = f"'{name}'" if variant.fault != "subdivision" else f"'{name}', {variant.words}"
            return [_of_fault(variant.fault, name, words=words)]
    return None


def _turned_over(name: str, found: Matched) -> Iterator[Difference]:
    """Yield that triangles have their other side in front."""
    turned = ((found.same == 0) & (found.turned > 0)).sum()
    if turned:
        count = len(found.same)
        which = "all normals" if turned == count else f"the normals of {turned:,} triangles"
        yield _of_fault("flipped_winding", name, f"{which} of '{name}' are turned over")


def _of_triangles(name: str, own: Floats, other: Floats, tolerance: float) -> Difference:
    """Return how the triangles of an object differ that no transform explains."""
    counts = f"{len(other):,} triangles, not {len(own):,}"
    for level in _LEVELS:
        if len(other) == len(own) * 4.0**level:
            say = f"'{name}' has {counts}: as with {abs(level)} {'more' if level > 0 else 'fewer'}"
            return _of_fault("subdivision", name, f"{say} levels of subdivision")
    points = own.reshape(-1, 3), other.reshape(-1, 3)
    same = matched(own, other, tolerance).there.sum()
    if len(other) < len(own) and same == len(other):
        return _of_fault(
            "triangles_missing", name, f"'{name}' lacks {len(own) - same:,} of its triangles"
        )
    if len(own) == len(other) and points_alike(*points, tolerance):
        say = f"{len(own) - same:,} of {len(own):,} triangles of '{name}' are cut otherwise"
        return _of_fault("other_diagonal", name, f"{say}, from the same corners")
    size = np.abs(np.ptp(points[1], axis=0) - np.ptp(points[0], axis=0)).max()
    say = (
        f"'{name}' has other triangles: {counts}; {same:,} are the same, and its extent differs by"
    )
    return Difference(name, "other_triangles", f"{say} {size:.3g} m at most")


def _missing(own: Shapes, other: Shapes, names: dict[str, str]) -> Iterator[Difference]:
    """Yield the objects that have no partner of their name."""
    left = [name for name in own if name not in names]
    for name in other:
        if name in names.values():
            continue
        for of in (*left, *names):
            pair = Pair(of, own[of], other[name])
            if move := move_between(pair.own.triangles, pair.other.triangles, pair.tolerance):
                break
        else:
            yield Difference(name, "object_added", f"'{name}' is not in the first scene")
            continue
        where = move.words(pair.tolerance)
        where = "" if where == "unchanged" else f", {where}"
        if of in left:
            left.remove(of)
            yield Difference(of, "object_renamed", f"'{of}' is called '{name}'{where}")
        else:
            yield _of_fault("object_twice", of, f"'{of}' is there twice: again as '{name}'{where}")
    for name in left:
        yield _of_fault("object_missing", name)
