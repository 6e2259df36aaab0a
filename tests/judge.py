"""What a ray sees, decided with Python's whole numbers alone: the exact judge of the tests.

Written apart from the tracer's own exact arithmetic: Cramer's rule in place of edge functions,
every triangle with every ray in place of candidates, and a ray that is truly moved in place of a
rule for signs that are zero. It takes the stored rays and the world vertices as they are: they are
the scene. With e1 = p2 - p1, e2 = p3 - p1, q = o - p1, and P = d x e2, Q = q x e1,

    o + t d = p1 + u e1 + v e2:   det = e1 . P,  u det = q . P,  v det = d . Q,  t det = e2 . Q

Every float is a whole number times a power of two, so that all of these are whole numbers. A ray is
moved by adding x v1 + x^2 v2 + ... to d, with x = 2^-k and k above the digits of anything that
occurs: a genuine ray, small enough that nothing but what was zero changes its sign. What a ray
begins on is zero however it turns: so o is moved alike, by a y that is as small beside all that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Scene
from reference_tracer.tracer.camera import camera_rays
from reference_tracer.tracer.vector import transform_points

NOTHING = -1
NONE = (NOTHING, NOTHING)
THE_RULE = ((1, 0, 0), (0, 1, 0), (0, 0, 1))  # d + (x, x^2, x^3)
OUTSIDE, EDGE, INSIDE = -1, 0, 1
AT_ONCE = 1 << 16  # pairs: some hundred MiB of whole numbers


@dataclass(frozen=True, eq=False)
class Judgement:
    """Of n pairs: `side` of the triangle's boundary that the stored line passes, (n,) int8;
    `hit` (n,) bool, whether the moved line meets it; t = `depth` / `towards` * 2^`shift`.

    A line in the triangle's plane, or parallel to it, is OUTSIDE.
    """

    side: NDArray[np.int8]
    hit: NDArray[np.bool_]
    depth: NDArray[np.object_]
    towards: NDArray[np.object_]
    shift: NDArray[np.int64]

    def t(self, k: int) -> Fraction:
        return Fraction(self.depth[k], self.towards[k]) * Fraction(2) ** int(self.shift[k])

    def within(self, start: float = 0.0, end: float = np.inf) -> NDArray[np.bool_]:
        """Which pairs meet at start <= t <= end; not at t = 0 where the ray begins there."""
        if start == 0 and end == np.inf:  # the sign says it
            return (self.side != OUTSIDE) & (self.depth * self.towards > 0)
        met = np.zeros(len(self.side), bool)
        for k in np.flatnonzero(self.side != OUTSIDE):
            t = self.t(k)
            met[k] = start <= t <= end and not (t == start == 0)
        return met


def judge_pairs(origins: NDArray, directions: NDArray, corners: NDArray) -> Judgement:
    """Judge n rays (3, n) and n triangles (3 corners, 3, n), pair by pair."""
    parts = []
    for at in range(0, corners.shape[2], AT_ONCE):
        part = slice(at, at + AT_ONCE)
        lengths, scale = integers(np.concatenate((origins[:, part], *corners[:, :, part])))
        d, direction_scale = integers(directions[:, part])
        o, *points = lengths.reshape(4, 3, -1)
        det, u, v, depth = meet(o, d, *points)
        rest = det - u - v
        front = det > 0
        weights = [np.where(front, w, -w) for w in (u, v, rest)]
        closed = (det != 0) & np.all([w >= 0 for w in weights], axis=0)
        inside = closed & np.all([w > 0 for w in weights], axis=0)
        hit = inside.copy()
        for k in np.flatnonzero(closed & ~inside):
            column = [[int(x) for x in w[:, k]] for w in (o, d, *points)]
            origin, direction, [solid] = moved(*column[:2], [column[2:]], THE_RULE)
            hit[k] = meets(origin, direction, *solid)
        side = np.where(inside, INSIDE, np.where(closed, EDGE, OUTSIDE)).astype(np.int8)
        parts.append((side, hit, depth, det, scale - direction_scale))
    return Judgement(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def integers(values: NDArray[np.float64]) -> tuple[NDArray[np.object_], NDArray[np.int64]]:
    """Return floats (k, n) as integers and the exponent of each column: float = integer * 2^e."""
    mantissa, exponent = np.frexp(values)
    exponent = np.where(mantissa == 0, 5000, exponent.astype(np.int64))  # zero has none
    least = exponent.min(axis=0)
    exponent = np.where(mantissa == 0, least, exponent)
    whole = (mantissa * 2.0**53).astype(np.int64)
    shifted = whole.astype(object) << (exponent - least).astype(object)
    return shifted, np.where(least == 5000, 0, least - 53)


def meet(o, d, p1, p2, p3):
    """Return det, u det, v det, t det of integers, or of arrays of them."""
    e1, e2, q = _sub(p2, p1), _sub(p3, p1), _sub(o, p1)
    p, r = _cross(d, e2), _cross(q, e1)
    return _dot(e1, p), _dot(q, p), _dot(d, r), _dot(e2, r)


def meets(o, d, p1, p2, p3) -> bool:
    """Return whether the line passes through the triangle's inside."""
    det, u, v, _ = meet(o, d, p1, p2, p3)
    return min(u, v, det - u - v) > 0 or max(u, v, det - u - v) < 0


def moved(o, d, solids: Sequence, by: Sequence) -> tuple[list[int], list[int], list]:
    """Return o, d and solids with the ray moved along `by`, all lengths times one power of two.

    Solids are three corners each, or a point and a normal. Unless the ray begins on one of them,
    moving o as well would change nothing but the time this takes.
    """
    points = [p for s in solids for p in (s if len(s) == 3 else s[:1])]
    begins = any(_dot(_sub(s[0], o), _normal(s)) == 0 for s in solids)
    d = move(d, by, [o, d, *by, *points])
    if not begins:
        return o, d, list(solids)
    k = _shift([o, d, *by, *points])
    grown = [[[x << k * len(by) for x in p] for p in s] for s in solids]
    grown = [s if len(s) == 3 else [s[0], old[1]] for s, old in zip(grown, solids, strict=True)]
    return move(o, by, [], k), d, grown


def _normal(solid: Sequence):
    if len(solid) == 2:
        return solid[1]
    return _cross(_sub(solid[1], solid[0]), _sub(solid[2], solid[0]))


def move(v, by: Sequence, beside: Sequence, k: int = 0) -> list[int]:
    """Return (v + x by[0] + x^2 by[1] + ...) / x^len(by), x = 2^-k small beside all of these."""
    k = k or _shift(beside)
    for step in by:
        v = [(a << k) + b for a, b in zip(v, step, strict=True)]
    return list(v)


def _shift(vectors: Sequence) -> int:
    digits = max(abs(x) for v in vectors for x in v).bit_length()
    return 8 * digits + 64  # a comparison of two t has products of six of them


@dataclass(frozen=True)
class Sight:
    """What a ray sees, as names (instance, triangle), NONE for nothing.

    `seen` by the rule's own ray; `may` by any ray that is infinitesimally moved; `touched` is all
    that the textbook leaves open: whatever the closed triangles have nearest, and what is behind
    edges.
    """

    seen: tuple[int, int]
    may: frozenset[tuple[int, int]]
    touched: frozenset[tuple[int, int]]


def judge(scene: Scene) -> list[Sight]:
    """Return what the rays through the pixels' centres see, row by row from the lowest."""
    region, camera = scene.camera.region, scene.camera
    x, y = np.meshgrid(np.arange(region.x0, region.x1), np.arange(region.y0, region.y1))
    rays = camera_rays(camera, x.ravel() + 0.5, y.ravel() + 0.5)
    shape = (3, x.size)
    names, corners = [], [np.zeros((3, 3, 0))]
    for i, instance in enumerate(scene.instances):
        mesh = scene.meshes[instance.mesh]
        world = transform_points(instance.world_from_object, mesh.vertices.T)
        corners.append(world[:, mesh.triangles.T].transpose(1, 0, 2))
        names += [(i, k) for k in range(len(mesh.triangles))]
    planes = [
        ((len(scene.instances) + i, NOTHING), plane.point, plane.normal)
        for i, plane in enumerate(scene.planes)
    ]
    return sights(
        np.broadcast_to(rays.origins, shape),
        np.broadcast_to(rays.directions, shape),
        np.concatenate(corners, axis=2),
        names,
        planes,
        camera.clip_start,
        camera.clip_end,
    )


def sights(origins, directions, corners, names=None, planes=(), start=0.0, end=np.inf):
    """Return the Sight of n rays on m triangles, all with all; a triangle's name is (0, index)."""
    count, n = corners.shape[2], origins.shape[1]
    names = names or [(0, k) for k in range(count)]
    found = [[] for _ in range(n)]
    step = max(1, AT_ONCE // max(count, 1))
    for at in range(0, n if count else 0, step):
        ray = np.repeat(np.arange(at, min(at + step, n)), count)
        triangle = np.tile(np.arange(count), len(ray) // count)
        result = judge_pairs(origins[:, ray], directions[:, ray], corners[:, :, triangle])
        for k in np.flatnonzero(result.within(start, end)):
            which = int(triangle[k])
            meeting = (result.t(k), bool(result.side[k] == EDGE), names[which], which)
            found[ray[k]].append(meeting)
    for k, meetings in enumerate(found):
        o, d = ([Fraction(float(x)) for x in v[:, k]] for v in (origins, directions))
        for name, point, normal in planes:
            p, w = ([Fraction(float(x)) for x in v] for v in (point, normal))
            if _dot(d, w):
                t = _dot(_sub(p, o), w) / _dot(d, w)
                if start <= t <= end and not (t == start == 0):
                    meetings.append((t, False, name, (p, w)))
    return [_sight(origins[:, k], directions[:, k], corners, m) for k, m in enumerate(found)]


def _sight(o, d, corners, meetings: list) -> Sight:
    if not meetings:
        return Sight(NONE, frozenset((NONE,)), frozenset((NONE,)))
    sure = min((t for t, at_edge, *_ in meetings if not at_edge), default=None)
    front = [m for m in meetings if sure is None or m[0] == sure or (m[1] and m[0] < sure)]
    touched = frozenset(name for _, _, name, _ in front) | ({NONE} if sure is None else set())
    if len(front) == 1 and not front[0][1]:
        return Sight(front[0][2], touched, touched)
    o, d = ([Fraction(float(x)) for x in v] for v in (o, d))
    shapes = [
        (name, what if isinstance(what, tuple) else corners[:, :, what].tolist())
        for _, _, name, what in front
    ]
    # One scale for all lengths (a plane's normal has its own, which cancels).
    lengths = _common([o, *(p for _, s in shapes for p in (s if len(s) == 3 else s[:1]))])
    (d,), origin, rest = _common([d]), lengths[0], iter(lengths[1:])
    solids = [
        (name, [next(rest) for _ in s] if len(s) == 3 else [next(rest), *_common(s[1:])])
        for name, s in shapes
    ]
    seen = _moved_sight(origin, d, solids, THE_RULE)
    may = {seen}
    for normal in _turning(origin, d, solids):
        along = _cross(normal, d)  # d moved along it stays on the boundary; `normal` leaves it
        for s, r in product((1, -1), repeat=2):
            beside = [s * x for x in along], [r * x for x in normal]
            by = (move([0, 0, 0], beside, beside),)  # one way: o, where it moves, goes along with d
            may.add(_moved_sight(origin, d, solids, by))
    return Sight(seen, frozenset(may), touched)


def _moved_sight(o, d, solids, by) -> tuple[int, int]:
    o, d, shapes = moved(o, d, [s for _, s in solids], by)
    solids = [(name, s) for (name, _), s in zip(solids, shapes, strict=True)]
    best = None
    for name, solid in solids:
        if len(solid) == 2:
            p, n = solid
            depth, towards = _dot(_sub(p, o), n), _dot(d, n)
        elif meets(o, d, *solid):
            towards, _, _, depth = meet(o, d, *solid)
        else:
            continue
        meeting = (Fraction(depth, towards), name)
        best = meeting if best is None or meeting < best else best
    return best[1] if best else NONE


def _turning(o, d, solids) -> set[tuple[int, ...]]:
    """Normals m, d . m = 0, of all planes through the ray at which what is seen may change."""
    found, levels = set(), []
    for _, solid in solids:
        if len(solid) == 2:
            levels.append((_dot(_sub(solid[0], o), solid[1]), solid[1]))
            continue
        e1, e2, q = _sub(solid[1], solid[0]), _sub(solid[2], solid[0]), _sub(o, solid[0])
        u, v, det = _cross(e2, q), _cross(q, e1), _cross(e2, e1)
        edges = (u, e2), (v, e1), (_sub(_sub(det, u), v), _sub(e2, e1))
        found |= {tuple(m if any(m) else _cross(e, d)) for m, e in edges if _dot(d, m) == 0}
        levels.append((_dot(e2, v), det))
    for (depth1, n1), (depth2, n2) in combinations(levels, 2):
        w = [depth1 * b - depth2 * a for a, b in zip(n1, n2, strict=True)]
        if _dot(d, w) == 0:
            found.add(tuple(w if any(w) or depth1 else _cross(_cross(n1, n2), d)))
    return {m for m in found if any(m)}


def _common(vectors: Sequence) -> list[list[int]]:
    """Return vectors of floats or fractions as integers, all times one power of two."""
    exact = [[Fraction(x) for x in v] for v in vectors]
    scale = max(x.denominator for v in exact for x in v)
    return [[int(x * scale) for x in v] for v in exact]


def _sub(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
