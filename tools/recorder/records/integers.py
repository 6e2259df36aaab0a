"""`certified/exact.py`, `ties.py`, `order.py`: what is computed, and decided, in integers.

Each record is a whole function, with all its branches. What it calls, if that is recorded by
itself, is a name of the proofs in it.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from unittest import mock

from reference_tracer.certified import exact, order, ties
from reference_tracer.certified.exact import PERTURBATION, Hit, IntegerBatch
from reference_tracer.certified.integers import ZERO

from ..whole import Asked, Whole, folded, least, listed, most, term, tree, triple, whole
from .record import Output

Z = "({} : Z)"
CORNERS = tuple(f"{k}1 {k}2 {k}3" for k in "oabc")
RAY = "dx dy dz"
_HITS = tuple(f"T{k} D{k} n{k}x n{k}y n{k}z" for k in (1, 2))


@dataclass(frozen=True)
class WholeRecord:
    """A function of integers: its Coq name, its inputs and its type there, and how it is called."""

    name: str
    function: str
    inputs: str
    type: str
    call: Callable[[], str]
    theorem: str
    note: str = ""

    def output(self) -> Output:
        """Record it."""
        words = f"{self.function}{f', {self.note}' if self.note else ''}"
        text = f"Definition {self.name} {self.inputs} : {self.type} :=\n  {tree(self.call)}."
        return Output(self.name, text, words, self.theorem)


def batch(**known) -> IntegerBatch:
    """Return a batch of one ray and one triangle, with what is `known` of it otherwise."""
    out = IntegerBatch.__new__(IntegerBatch)
    given = dict(origins=[whole(CORNERS[0])], directions=[whole(RAY)], planes=[], _known={})
    vars(out).update(given | dict(corners=[[whole(v)] for v in CORNERS[1:]]) | known)
    return out


def _hit_term(hit: Hit) -> str:
    parts = (
        term(hit.numerator),
        term(hit.denominator),
        triple(hit.normal),
        listed(map(term, hit.edges)),
        *(listed(map(triple, v)) for v in (hit.sides, hit.spans)),
        triple(hit.direction),
    )
    return f"(MakeHit {' '.join(parts)})"


def _option(hit: Hit | None) -> str:
    return "None" if hit is None else f"(Some {_hit_term(hit)})"


@contextmanager
def _python():
    """Python's `min` and `max` of integers, in these modules."""
    with ExitStack() as stack:
        for module in (exact, order):
            for name, of in (("min", least), ("max", most)):
                stack.enter_context(mock.patch.object(module, name, folded(of), create=True))
        yield


def _triangle() -> str:
    numerator, normal, sides, spans = batch()._triangle(whole(CORNERS[0]), 0)
    parts = term(numerator), triple(normal), *(listed(map(triple, v)) for v in (sides, spans))
    return f"({', '.join(parts)})"


def _hit_of(**known) -> str:
    own = batch(_clipped=lambda hit: hit, **known)
    with _python():
        return _option(own.hit(0, 0))


def _of_first_ray(**known) -> str:
    own = batch(origins=[whole(CORNERS[0]), ZERO], directions=[whole(RAY), ZERO], **known)
    numerator, denominator, normal = own.of_first_ray(0)
    return f"({term(numerator)}, {term(denominator)}, {triple(normal)})"


def _one_hit(edges=(), sides=(), spans=(), number=1) -> Hit:
    t, d, *normal = whole(_HITS[number - 1])
    return Hit(t, d, tuple(normal), edges, sides, spans, whole(RAY))


def _clipped(start: bool, end: bool) -> str:
    limits = (whole(f"{k}_n {k}_s") if there else None for k, there in (("a", start), ("b", end)))
    own = batch(_open=Asked("open"))
    own._start, own._end = limits
    return "false" if own._clipped(_one_hit()) is None else "true"


def _t() -> str:
    return term(batch(_shift=Whole("shift")).t(_one_hit()))


@contextmanager
def _signs():
    """`_sign`, which is recorded by itself."""

    def sign(value, m, span, d, _moves) -> Whole:
        parts = term(value), triple(m), triple(span), triple(d)
        return Whole(f"(_sign {' '.join(parts)} moves)")

    with mock.patch.object(exact, "_sign", sign):
        yield


def _difference_of_hits() -> str:
    with _signs():
        return term(exact.sign_of_difference(_one_hit(), _one_hit(number=2), None))


def _intersection() -> str:
    w, span = exact.intersection(_one_hit(), _one_hit(number=2))
    return f"({triple(w)}, {triple(span)})"


def _sign(moves) -> str:
    m, span, d = map(whole, ("mx my mz", "sx sy sz", RAY))
    return term(exact._sign(Whole("value"), m, span, d, moves))


def _is_crossed() -> str:
    """A sign is 1, -1 or another number: a set tells no more of it."""
    own = _one_hit(
        whole("e1 e2 e3"),
        tuple(whole(f"m{k}x m{k}y m{k}z") for k in "123"),
        tuple(whole(f"s{k}x s{k}y s{k}z") for k in "123"),
    )
    with _signs():
        sign = exact._sign

        def told(*given) -> int:
            value = sign(*given)
            return (
                1 if Asked(f"(1 =? {value.term})") else -1 if Asked(f"(-1 =? {value.term})") else 0
            )

        with mock.patch.object(exact, "_sign", told):
            return "true" if own.is_crossed(None) else "false"


def _of_first(shared: bool) -> str:
    """`_scaled`, an integer times a power of two, rounded once, is Flocq's `num`."""
    given = [(Whole(f"T{k}"), Whole(f"D{k}"), whole(f"n{k}x n{k}y n{k}z")) for k in (1, 2)]
    own = mock.Mock(unit=Whole("unit"), of_first_ray=lambda k: given[k])

    def scaled(value, exponent) -> str:
        return f"(num {term(value)} {term(exponent)})"

    with _python(), mock.patch.object(order, "_scaled", scaled):
        base, *v, sign = order._difference(own, 0, 1, shared)
    parts = [k if isinstance(k, str) else f"(num {term(int(k))} 0)" for k in (base, *v, sign)]
    return f"({parts[0]}, F3 {' '.join(parts[1:4])}, {parts[4]})"


class _Surface:
    """A surface of `Contest.v`: its name, and in `Met` its hit."""

    __hash__ = object.__hash__

    def __init__(self, name: str) -> None:
        self.name = name

    def __lt__(self, other: _Surface) -> Asked:
        return Asked(f"(Contest.before {self.name} {other.name})")

    @property
    def on_edge(self) -> Asked:
        return Asked(f"(Contest.on_edge a {self.name})")

    def is_crossed(self, _moves) -> Asked:
        return Asked(f"(Contest.is_crossed a {self.name})")


class _Order:
    """Comparison of two surfaces: a term of Coq's type `comparison`."""

    __hash__ = None

    def __init__(self, of: str, one: _Surface, other: _Surface) -> None:
        self._term = f"(Contest.{of} a {one.name} {other.name})"

    def __lt__(self, _zero: int) -> Asked:
        return Asked(f"(is_lt {self._term})")

    def __le__(self, _zero: int) -> bool:
        return not Asked(f"(is_gt {self._term})")

    def __eq__(self, _zero: object) -> Asked:  # type: ignore[override]
        return Asked(f"(is_eq {self._term})")


def _surfaces(count: int) -> list[tuple[_Surface, _Surface]]:
    return [(own, own) for own in map(_Surface, [f"s{k}" for k in range(count)])]


def _compared(of: str):
    return mock.patch.object(ties, of, lambda one, other, *_: _Order(of, one, other))


def _first(count: int) -> str:
    hits = _surfaces(count)
    with _compared("sign_of_difference"):
        best = ties._first(hits, PERTURBATION)
    return f"Some s{best}" if best >= 0 else "None"


def _settled(count: int) -> str:
    """Who is seen is `_first`, recorded by itself; which ways there are, and the ties, are left."""
    hits = _surfaces(count)
    with (
        _compared("gap"),
        mock.patch.object(ties, "_first", lambda *_: 0),
        mock.patch.object(ties, "_ways", lambda _: []),
    ):
        _, found = ties.seen_and_ties(hits)
    return "false" if found else "true"


_ONE = Z.format(f"{_HITS[0]} {RAY}")
_TWO = Z.format(f"{' '.join(_HITS)} {RAY}")
_SIGN = "value mx my mz sx sy sz dx dy dz"
_LIMITS = "(a_n a_s b_n b_s : Z) (open : bool)"
_EDGES = " ".join(f"{k}{n}{c}" for k in "ms" for n in "123" for c in "xyz")
_PLANE = "px py pz nx ny nz"
_PLANES = [(whole("px py pz"), whole("nx ny nz"))]

INTEGERS = (
    WholeRecord(
        "whole_triangle",
        "exact.IntegerBatch._triangle",
        Z.format(" ".join(CORNERS)),
        "Z * Integers * list Integers * list Integers",
        _triangle,
        "IntegersCode.triangle_is",
    ),
    WholeRecord(
        "whole_hit",
        "exact.IntegerBatch.hit",
        Z.format(" ".join((RAY, *CORNERS))),
        "option Hit",
        _hit_of,
        "IntegersCode.hit_is",
        "of a triangle, before the clip range",
    ),
    WholeRecord(
        "whole_plane",
        "exact.IntegerBatch.hit",
        Z.format(f"{RAY} {CORNERS[0]} {_PLANE}"),
        "option Hit",
        lambda: _hit_of(planes=_PLANES),
        "IntegersCode.plane_is",
        "of a plane, before the clip range",
    ),
    WholeRecord(
        "whole_of_first_ray",
        "exact.IntegerBatch.of_first_ray",
        Z.format(" ".join((RAY, *CORNERS))),
        "Z * Z * Integers",
        _of_first_ray,
        "IntegersCode.of_first_ray_is",
        "of a triangle",
    ),
    WholeRecord(
        "whole_of_first_ray_plane",
        "exact.IntegerBatch.of_first_ray",
        Z.format(f"{RAY} {CORNERS[0]} {_PLANE}"),
        "Z * Z * Integers",
        lambda: _of_first_ray(planes=_PLANES),
        "IntegersCode.of_first_ray_is",
        "of a plane",
    ),
    *(
        WholeRecord(
            f"whole_clipped_{name}",
            "exact.IntegerBatch._clipped",
            f"{_ONE} {_LIMITS}",
            "bool",
            lambda start=start, end=end: _clipped(start, end),
            f"IntegersCode.clipped_{name}_is",
            f"{name}: whether the hit is seen",
        )
        for name, start, end in (
            ("both", True, True),
            ("start", True, False),
            ("end", False, True),
            ("never", False, False),
        )
    ),
    WholeRecord(
        "whole_t",
        "exact.IntegerBatch.t",
        f"(division : Z -> Z -> option R) {_ONE} (shift : Z)",
        "option R",
        _t,
        "IntegersCode.t_is",
    ),
    WholeRecord(
        "whole_gap",
        "exact.gap",
        _TWO,
        "Z",
        lambda: term(exact.gap(_one_hit(), _one_hit(number=2))),
        "IntegersCode.gap_is",
    ),
    WholeRecord(
        "whole_intersection",
        "exact.intersection",
        _TWO,
        "Integers * Integers",
        _intersection,
        "IntegersCode.intersection_is",
    ),
    WholeRecord(
        "whole_sign_of_difference",
        "exact.sign_of_difference",
        f"{_TWO} (moves : list Integers)",
        "Z",
        _difference_of_hits,
        "IntegersCode.sign_of_difference_is",
    ),
    WholeRecord(
        "whole_sign",
        "exact._sign",
        Z.format(_SIGN),
        "Z",
        lambda: _sign(PERTURBATION),
        "IntegersCode.sign_is",
        "moved by the rule",
    ),
    WholeRecord(
        "whole_sign_one_way",
        "exact._sign",
        Z.format(f"{_SIGN} ux uy uz"),
        "Z",
        lambda: _sign((whole("ux uy uz"),)),
        "IntegersCode.sign_one_way_is",
        "moved one way",
    ),
    WholeRecord(
        "whole_is_crossed",
        "exact.Hit.is_crossed",
        f"{_ONE} {Z.format(f'e1 e2 e3 {_EDGES}')} (moves : list Integers)",
        "bool",
        _is_crossed,
        "IntegersCode.is_crossed_is",
    ),
    *(
        WholeRecord(
            f"whole_difference_{name}",
            "order._difference",
            f"{Z.format(' '.join(_HITS))} (unit : Z)",
            "float * floats * float",
            lambda shared=shared: _of_first(shared),
            f"IntegersCode.difference_{name}_is",
            note,
        )
        for name, shared, note in (
            ("from_point", True, "rays from one point"),
            ("parallel", False, "parallel rays"),
        )
    ),
    *(
        WholeRecord(
            f"whole_first_of_{count}",
            "ties._first",
            f"(a : Contest.answers) ({' '.join(f's{k}' for k in range(count))} : Contest.surface)",
            "option Contest.surface",
            lambda count=count: _first(count),
            f"IntegersCode.first_of_{count}_is",
            f"of {count} hits",
        )
        for count in (1, 2, 3)
    ),
    *(
        WholeRecord(
            f"whole_no_ties_{count}",
            "ties.seen_and_ties",
            f"(a : Contest.answers) ({' '.join(f's{k}' for k in range(count))} : Contest.surface)",
            "bool",
            lambda count=count: _settled(count),
            f"IntegersCode.no_ties_{count}_is",
            f"of {count} hits: whether there are no ties",
        )
        for count in (1, 2)
    ),
)
HEAD = """\
(** Generated by `tools/record_trees.py`: do not edit. How to read it: README.md beside it. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import IEEE754.Binary.
From Reftrace Require Import Trees Integers Ties Hits CodeAnswers.
From Reftrace Require Contest.
Import ListNotations.
Open Scope Z_scope.

Definition is_lt (c : comparison) : bool := match c with Lt => true | _ => false end.
Definition is_eq (c : comparison) : bool := match c with Datatypes.Eq => true | _ => false end.
Definition is_gt (c : comparison) : bool := match c with Gt => true | _ => false end.
"""
