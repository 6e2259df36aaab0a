"""Compares the objects of two scenes, and names each difference as a diagnosis does."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.causes.case import Variant
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import AnyFault, Guess
from reference_tracer.scene import Plane, Scene
from reference_tracer.wording import count_of

from .geometry import DIGITS, ROUNDINGS, Objects
from .matching import matched, points_alike
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


def _of_fault(name: str, object_: str, sentence: str = "", words: str = "") -> Difference:
    """Return a difference that a fault of the diagnosis explains, in its words."""
    fault, guess = _FAULT[name], Guess(object=object_, words=words)
    return Difference(object_, name, sentence or fault.sentence_of(guess), _advice(fault, guess))


def _advice(fault: AnyFault, guess: Guess) -> str:
    return "" if "{" in fault.advice else fault.advice_of(guess)


def differences(
    first: Scene, second: Scene, variants: Sequence[Variant] = ()
) -> tuple[Difference, ...]:
    """Return how the objects of the second scene differ from those of the first.

    `variants` are scenes with faults that only Blender can make, of the first. What all objects, or
    most, have in common is said once, and the rest beside that.
    """
    own, other = Objects.of(first), Objects.of(second)
    shared = own.triangles.keys() & other.triangles
    if len(other.triangles) == 1 < len(own.triangles) and not shared:
        name = next(iter(other.triangles))  # the file has no objects
        own, variants = own.joined(name), ()
    made = [(v, Objects.of(v.scene)) for v in variants]
    names = _paired(own, other)
    moves, out = _compared(own, other, names, made)
    common = _common(own, other, names, moves)
    if common is not None:
        move, of = common
        out_of_all = _of_all(move, _allowed(own, other, of, names[of]))
        own, *others = (o.moved_by(move) for o in (own, *(o for _, o in made)))
        made = [(v, o) for (v, _), o in zip(made, others, strict=True)]
        moves, out = _compared(own, other, names, made, MARGIN)
        out.insert(0, out_of_all)
    for name, move in moves.items():
        out.append(_moved(name, move, _allowed(own, other, name, names[name])))
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
    off = abs(float(n @ (second.point - first.point)))
    return float(np.abs(n - m).max()) <= ROUNDINGS and off <= 2 * (ROUNDINGS * size + DIGITS)


def _allowed(own: Objects, other: Objects, name: str, shown: str) -> float:
    """Return how far digits may move a coordinate of an object and its partner, metres."""
    return max(own.tolerance(name), other.tolerance(shown))


def _compared(
    own: Objects,
    other: Objects,
    names: dict[str, str],
    made: Sequence[tuple[Variant, Objects]],
    times: int = 1,
) -> tuple[dict[str, Move], list[Difference]]:
    """Return how objects are moved, and what else differs of those with a partner.

    `times` is how many tolerances an object in place may be off.
    """
    moves: dict[str, Move] = {}
    out: list[Difference] = []
    for name in names:
        triangles, shown = own.triangles[name], other.triangles[names[name]]
        tolerance = times * _allowed(own, other, name, names[name])
        found = _of_object(name, triangles, shown, tolerance, made)
        if found is not None:
            out += found
        elif move := move_between(triangles, shown, tolerance):
            moves[name] = move
            out += _turned_over(name, move.of(triangles), shown, 8 * tolerance)
        else:
            out.append(_of_triangles(name, triangles, shown, tolerance))
    return moves, out


def _common(
    own: Objects, other: Objects, names: dict[str, str], moves: dict[str, Move]
) -> tuple[Move, str] | None:
    """Return a transform that most of several objects have in common, and whose it is, if any.

    An object with symmetries is moved in several ways: so each way is tried on all objects.
    """
    for of, move in [*moves.items()][:_TRIED]:
        alike = 0
        for name in moves:
            there = move.of(own.triangles[name])
            tolerance = MARGIN * _allowed(own, other, name, names[name])
            found = matched(there, other.triangles[names[name]], tolerance)
            alike += int((found.same + found.turned > 0).all())
        if 2 * alike > len(names) > 1:
            return move, of
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


def _paired(own: Objects, other: Objects) -> dict[str, str]:
    """Return which objects have one name: as it is, or as formats write names."""
    plain = {_plain(name): name for name in reversed(other.triangles)}
    same = {name: name for name in own.triangles if name in other.triangles}
    taken = set(same.values())
    for name in own.triangles:
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
    made: Sequence[tuple[Variant, Objects]],
) -> list[Difference] | None:
    """Return how an object differs that is in place, or as a variant has it; None if neither."""
    there, back = matched(own, other, tolerance), matched(other, own, tolerance)
    if (there.same + there.turned > 0).all() and (back.same + back.turned > 0).all():
        found = list(_turned_over(name, own, other, tolerance))
        if len(other) > len(own):
            times = len(other) / len(own)
            say = f"'{name}' is there {times:.3g} times in one place"
            found.append(Difference(name, "object_twice", say, _FAULT["object_twice"].advice))
        elif len(other) < len(own):
            doubles = count_of(len(own) - len(other), "triangle")
            say = f"{doubles} of '{name}' that are there twice are there once"
            found.append(Difference(name, "doubles_left_out", say))
        return found
    for variant, objects in made:
        same = objects.triangles.get(name)
        if same is None or len(same) != len(other) or not variant.fault:
            continue
        found_there = matched(same, other, tolerance)
        if (found_there.same + found_there.turned > 0).all():
            words = f"'{name}'" if variant.fault != "subdivision" else f"'{name}', {variant.words}"
            return [_of_fault(variant.fault, name, words=words)]
    return None


def _turned_over(name: str, own: Floats, other: Floats, tolerance: float) -> Iterator[Difference]:
    """Yield that triangles have their other side in front."""
    found = matched(own, other, tolerance)
    turned = int(((found.same == 0) & (found.turned > 0)).sum())
    if turned:
        which = "all normals" if turned == len(own) else f"the normals of {turned:,} triangles"
        yield _of_fault("flipped_winding", name, f"{which} of '{name}' are turned over")


def _of_triangles(name: str, own: Floats, other: Floats, tolerance: float) -> Difference:
    """Return how the triangles of an object differ that no transform explains."""
    counts = f"{len(other):,} triangles, not {len(own):,}"
    for level in _LEVELS:
        if len(other) == len(own) * 4.0**level:
            say = f"'{name}' has {counts}: as with {abs(level)} {'more' if level > 0 else 'fewer'}"
            return _of_fault("subdivision", name, f"{say} levels of subdivision")
    points = own.reshape(-1, 3), other.reshape(-1, 3)
    there = matched(own, other, tolerance)
    same = int((there.same + there.turned > 0).sum())
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


def _missing(own: Objects, other: Objects, names: dict[str, str]) -> Iterator[Difference]:
    """Yield the objects that have no partner of their name."""
    left = [name for name in own.triangles if name not in names]
    more = [name for name in other.triangles if name not in names.values()]
    for name in more:
        alike = _found(own, [*left, *names], other, name)
        if alike is None:
            yield Difference(name, "object_added", f"'{name}' is not in the first scene")
            continue
        of, move = alike
        where = move.words(_allowed(own, other, of, name))
        where = "" if where == "unchanged" else f", {where}"
        if of in left:
            left.remove(of)
            yield Difference(of, "object_renamed", f"'{of}' is called '{name}'{where}")
        else:
            yield _of_fault("object_twice", of, f"'{of}' is there twice: again as '{name}'{where}")
    for name in left:
        yield _of_fault("object_missing", name)


def _found(
    own: Objects, names: Sequence[str], other: Objects, shown: str
) -> tuple[str, Move] | None:
    """Return the first of some objects that has another's triangles, and how it is moved."""
    for name in names:
        tolerance = _allowed(own, other, name, shown)
        move = move_between(own.triangles[name], other.triangles[shown], tolerance)
        if move is not None:
            return name, move
    return None
