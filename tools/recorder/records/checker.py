"""`packages/verify/verify.py`: what the checker of certificates decides of a pixel, in integers.

Each record is a whole function, as in integers.py. A name that begins with `h` is a hit: `Met` in
proofs/checker/Leaf.v, as are the functions that one record takes from another.
"""

from __future__ import annotations

from contextlib import ExitStack, contextmanager
from types import SimpleNamespace
from unittest import mock

from reference_tracer_verify import verify
from reference_tracer_verify.verify import Exact, Hit

from ..whole import Asked, Whole, folded, least, listed, most, term, triple, whole
from .integers import WholeRecord

_AXES = (1, 0, 0), (0, 1, 0), (0, 0, 1)
_Z = "({} : Z)"
_CORNERS = tuple(f"{k}1 {k}2 {k}3" for k in "oabc")
_RAY = "dx dy dz"
_CLIP = "start start_by last last_by"
_EDGES = [(f"m{k}x m{k}y m{k}z", f"s{k}x s{k}y s{k}z") for k in "123"]
_ALL_EDGES = " ".join(f"{m} {s}" for m, s in _EDGES)
_HITS = tuple(f"i{k} j{k} T{k} D{k} n{k}x n{k}y n{k}z" for k in (1, 2))


@contextmanager
def _with(**replaced):
    """Let the module have other functions."""
    with ExitStack() as stack:
        for name, value in replaced.items():
            stack.enter_context(mock.patch.object(verify, name, value, create=True))
        yield


def _exact(triangles: int = 1, **known) -> Exact:
    """Return one ray, and surface 0: a triangle, unless there are none."""
    out = Exact.__new__(Exact)
    of = SimpleNamespace(triangles=triangles, names=["name"])
    vars(out).update(origins=[whole(_CORNERS[0])], directions=[whole(_RAY)], of=of, **known)
    return out


def _sides() -> list:
    return [(whole(m), whole(s)) for m, s in _EDGES]


def _tuples(edges) -> str:
    """Return a list of tuples of integers and vectors."""
    texts = ([triple(k) if isinstance(k, tuple) else term(k) for k in edge] for edge in edges)
    return listed(f"({', '.join(text)})" for text in texts)


def _surface(corners, **known) -> str:
    own = _exact(corners=lambda _: [whole(v) for v in corners], **known)
    top, normal, sides = own.surface_from(0, 0)
    return f"({term(top)}, {triple(normal)}, {_tuples(sides)})"


def _hit(sides: list) -> str:
    """Return the hit of a surface that `surface_from` has made."""
    start, start_by, last, last_by = whole(_CLIP)
    own = _exact(clip=[(start, start_by), (last, last_by)])
    own.surface = lambda *_: (Whole("T"), whole("nx ny nz"), sides)
    with _with(min=folded(least), max=folded(most)):
        hit = own.hit(0, 0)
    if hit is None:
        return "None"
    numbers = hit.name, term(hit.top), term(hit.bottom), triple(hit.normal)
    return f"(Some (MakeMet {' '.join(numbers)} {_tuples(hit.edges)} {triple(hit.d)}))"


def _moved() -> str:
    e, m, edge, d = Whole("e"), *map(whole, ("mx my mz", "sx sy sz", _RAY))
    return term(verify.moved(e, m, edge, d, _AXES))


def _by_name(e, m, edge, d, _moves) -> Whole:
    """`moved`, which is recorded by itself."""
    return Whole(f"(moved {term(e)} {triple(m)} {triple(edge)} {triple(d)} moves)")


def _is_crossed() -> str:
    edges = [(e, *side) for e, side in zip(whole("e1 e2 e3"), _sides(), strict=True)]
    hit = Hit("", 0, Whole("D"), (), edges, whole(_RAY))
    with _with(moved=_by_name):
        return "true" if hit.is_crossed(None) else "false"


def _is_before() -> str:
    hits = []
    for names in _HITS:
        i, j, top, bottom, *normal = whole(names)
        hits.append(Hit((i, j), top, bottom, tuple(normal), (), whole(_RAY)))
    with _with(moved=_by_name):
        return "true" if hits[0].is_before(hits[1], None) else "false"


class _Ratio:
    """A fraction: Python compares them exactly."""

    __hash__ = None

    def __init__(self, top: Whole, bottom: Whole) -> None:
        self.top, self.bottom = top, bottom

    def _to(self, other: _Ratio, test: str) -> Asked:
        four = self.top, self.bottom, other.top, other.bottom
        return Asked(f"({test} (compare_ratios {' '.join(map(term, four))}))")

    def __lt__(self, other: _Ratio) -> Asked:
        return self._to(other, "is_lt")

    def __le__(self, other: _Ratio) -> bool:
        return not self._to(other, "is_gt")

    def __eq__(self, other: object) -> Asked:  # type: ignore[override]
        return self._to(other, "is_eq")


class _Least:
    """The edge functions of a hit: something that is 0 if one of them is."""

    def __init__(self, hit: str) -> None:
        self.hit = hit

    def __bool__(self) -> bool:
        return not Asked(f"(on_edge {self.hit})")


class _Named(Hit):
    """A hit by its name, and what is asked of it."""

    def is_crossed(self, _moves) -> Asked:
        return Asked(f"(is_crossed moves {self.name})")

    def is_before(self, other: Hit, _moves) -> Asked:
        return Asked(f"(is_before moves {self.name} {other.name})")


def _named(count: int) -> list[_Named]:
    return [
        _Named(h, Whole(f"(top {h})"), Whole(f"(bottom {h})"), (), [(_Least(h), (), ())], ())
        for h in (f"h{k}" for k in range(count))
    ]


def _first(count: int) -> str:
    hit = verify.first(_named(count), None)
    return "None" if hit is None else f"(Some {hit.name})"


def _first_by_name(hits, moves) -> Hit:
    """`first`, which is recorded by itself."""
    given = listed(map(triple, moves)), listed(hit.name for hit in hits)
    return Hit(f"(first {' '.join(given)})", 0, 0, (), (), ())


def _sees(count: int) -> str:
    """The ways in which a ray is moved for ties are left to others: here there are none."""
    with _with(Fraction=_Ratio, first=_first_by_name, ways=lambda _: []):
        seen, ties = verify.sees(_named(count))
    name = "None" if seen is None else f"(Some {seen.name})"
    return f"({seen.name if ties else name}, {'true' if ties else 'false'})"


def _hits(count: int) -> str:
    return f"({' '.join(f'h{k}' for k in range(count))} : Met)"


_SURFACE = "Z * Integers * list (Integers * Integers)"
_AT = f"(name : Contest.name) {_Z.format(f'{_RAY} T nx ny nz {_CLIP}')}"

CHECKER = (
    WholeRecord(
        "check_triangle",
        "verify.Exact.surface_from",
        _Z.format(" ".join(_CORNERS)),
        _SURFACE,
        lambda: _surface(_CORNERS[1:]),
        "LeafCode.triangle_is",
        "of a triangle",
    ),
    WholeRecord(
        "check_plane",
        "verify.Exact.surface_from",
        _Z.format(f"{_CORNERS[0]} px py pz nx ny nz"),
        _SURFACE,
        lambda: _surface(["px py pz", *["nx ny nz"] * 2], triangles=0),
        "LeafCode.plane_is",
        "of a plane",
    ),
    WholeRecord(
        "check_hit",
        "verify.Exact.hit",
        f"{_AT} {_Z.format(_ALL_EDGES)}",
        "option Met",
        lambda: _hit(_sides()),
        "LeafCode.hit_is",
        "of a triangle",
    ),
    WholeRecord(
        "check_plane_hit",
        "verify.Exact.hit",
        _AT,
        "option Met",
        lambda: _hit([]),
        "LeafCode.plane_hit_is",
        "of a plane",
    ),
    WholeRecord(
        "check_moved",
        "verify.moved",
        _Z.format(f"e mx my mz sx sy sz {_RAY}"),
        "Z",
        _moved,
        "LeafCode.moved_is",
        "by the rule",
    ),
    WholeRecord(
        "check_is_crossed",
        "verify.Hit.is_crossed",
        f"{_Z.format(f'D {_RAY} e1 e2 e3 {_ALL_EDGES}')} (moves : list Integers)",
        "bool",
        _is_crossed,
        "LeafCode.is_crossed_is",
        "of a triangle",
    ),
    WholeRecord(
        "check_is_before",
        "verify.Hit.is_before",
        f"{_Z.format(' '.join((*_HITS, _RAY)))} (moves : list Integers)",
        "bool",
        _is_before,
        "LeafCode.is_before_is",
    ),
    *(
        WholeRecord(
            f"check_first_of_{count}",
            "verify.first",
            f"(moves : list Integers) {_hits(count)}",
            "option Met",
            lambda count=count: _first(count),
            f"LeafCode.first_of_{count}_is",
            f"of {count} hits",
        )
        for count in (1, 2, 3)
    ),
    *(
        WholeRecord(
            f"check_sees_{count}",
            "verify.sees",
            _hits(count),
            "option Met * bool",
            lambda count=count: _sees(count),
            f"LeafCode.sees_{count}_is",
            f"of {count} hits: who, and whether there are ties",
        )
        for count in (1, 2, 3)
    ),
)
HEAD = """\
(** Generated by `tools/record_trees.py`: do not edit. How to read it: README.md beside it. *)
Require Import ZArith Reals List Bool.
From Reftrace Require Import Integers Leaf.
From Reftrace Require Contest.
Import ListNotations.
Open Scope Z_scope.

Definition is_lt (c : comparison) : bool := match c with Lt => true | _ => false end.
Definition is_eq (c : comparison) : bool := match c with Eq => true | _ => false end.
Definition is_gt (c : comparison) : bool := match c with Gt => true | _ => false end.
"""
