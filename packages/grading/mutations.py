"""Changes one thing of a right program: a sign, an order, a letter, a term, a condition.

Each mutation is a program that a student may have written, with the sentence that says what is
wrong with it. What it answers is found by running it: see `matching.py`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from reference_tracer.derivation.expressions import (
    PRODUCT,
    Letter,
    Negated,
    Operation,
    Tree,
    parse,
    printed,
)

from .programs import CONSTANTS, Condition, Program, condition

_OPPOSITE = {"≥": "<", "≤": ">", ">": "<", "<": ">"}
_ASCII = str.maketrans("₁₂₃ₛ²", "123s2", "‖")


class Edit(NamedTuple):
    """One formula as it may be written wrongly: how that is called, and what is wrong with it."""

    kind: str
    what: str
    tree: Tree


@dataclass(frozen=True)
class Mutation:
    """One thing that is wrong: its name, a sentence for the student, and what replaces what."""

    name: str
    sentence: str
    formulas: Mapping[str, Tree]
    conditions: Mapping[Condition, tuple[Condition, ...]]
    choice: str = ""

    def apart_from(self, other: Mutation) -> bool:
        """Return whether the two change different places."""
        return not (
            self.formulas.keys() & other.formulas.keys()
            or self.conditions.keys() & other.conditions.keys()
            or (self.choice and other.choice)
        )

    def of(self, program: Program) -> Program:
        """Return a program with this mutation."""
        return replace(
            program,
            formulas={**program.formulas, **self.formulas},
            conditions=tuple(n for c in program.conditions for n in self.conditions.get(c, (c,))),
            choice=self.choice or program.choice,
        )


def mutations(program: Program) -> Iterator[Mutation]:
    """Yield all mutations of a program: its slips, its conditions, each place of its formulas.

    Where several answer alike, the first gives the name.
    """
    for slip in program.slips:
        formulas = {label: parse(right) for label, right in slip.formulas.items()}
        conditions = {
            condition(old): tuple(map(condition, new)) for old, new in slip.conditions.items()
        }
        yield Mutation(slip.name, slip.sentence, formulas, conditions, slip.choice)
    for old in program.conditions:
        name = "hits_behind" if old.left == Letter("t") else "edge_not_tested"
        yield Mutation(name, f"{old} is not tested", {}, {old: ()})
        turned = old._replace(comparison=_OPPOSITE[old.comparison])
        yield Mutation("condition_opposite", f"{turned} is tested, for {old}", {}, {old: (turned,)})
    known = set().union(*program.kinds) - program.formulas.keys()
    for label, right in program.formulas.items():
        kinds = tuple(kind & known for kind in program.kinds)
        for kind, what, tree in _edits(right, kinds):
            text = f"{what}: {label} = {printed(tree)} is computed, for {label} = {printed(right)}"
            yield Mutation(f"{label.translate(_ASCII)}_{kind}", text, {label: tree}, {})
        known.add(label)


def _edits(tree: Tree, kinds: tuple[frozenset[str], ...]) -> Iterator[Edit]:
    """Yield a formula with one thing changed, at each place in it."""
    yield from _whole(tree)
    match tree:
        case Letter(name):
            for kind in kinds:
                for other in sorted(kind - {name}) if name in kind else ():
                    yield Edit("letter", f"{other} stands for {name}", Letter(other))
            for other in CONSTANTS if name in CONSTANTS else ():
                if other != name:
                    yield Edit("constant", f"{other} stands for {name}", Letter(other))
        case Negated(of):
            for edit in _edits(of, kinds):
                yield edit._replace(tree=Negated(edit.tree))
        case Operation(sign, left, right):
            for edit in _edits(left, kinds):
                yield edit._replace(tree=Operation(sign, edit.tree, right))
            for edit in _edits(right, kinds):
                yield edit._replace(tree=Operation(sign, left, edit.tree))


def _whole(tree: Tree) -> Iterator[Edit]:
    """Yield what may be wrong with a formula, or a part of one, as a whole."""
    match tree:
        case Negated(of):
            yield Edit("sign", "the minus is missing", of)
        case Operation("+", left, right):
            yield Edit("sign", "a plus is a minus", Operation("−", left, right))
            yield Edit("term", f"{printed(left)} is missing", right)
            yield Edit("term", f"{printed(right)} is missing", left)
        case Operation("−", left, right):
            yield Edit("sign", "a minus is a plus", Operation("+", left, right))
            turned = Operation("−", right, left)
            yield Edit("order", "the difference is taken the other way", turned)
            yield Edit("term", f"{printed(right)} is missing", left)
        case Operation("×", left, right):
            yield Edit("order", "the factors of × are exchanged", Operation("×", right, left))
        case Operation("/", left, right):
            yield Edit("division", f"the division by {printed(right)} is missing", left)
            yield Edit("division", f"{printed(right)} multiplies", Operation(PRODUCT, left, right))
            yield Edit("order", "the fraction is upside down", Operation("/", right, left))
        case Operation("·", left, right):
            yield Edit("sign", "it has the other sign", Negated(tree))
