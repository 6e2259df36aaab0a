"""Formulas written otherwise, in real numbers the same."""

from __future__ import annotations

from dataclasses import replace

from reference_tracer.derivation.expressions import Negated, Operation


def reordered(tree, rng):
    """Let operands and signs change places at random."""
    match tree:
        case Operation(sign, left, right):
            left, right = reordered(left, rng), reordered(right, rng)
            if rng.random() < 0.5:
                if sign in ("+", "·", " "):
                    return Operation(sign, right, left)
                if sign in ("−", "×"):
                    return Negated(Operation(sign, right, left))
            return Operation(sign, left, right)
        case Negated(of):
            return Negated(reordered(of, rng))
    return tree


def rewritten(program, rng):
    """Reorder all formulas of a program."""
    formulas = {label: reordered(tree, rng) for label, tree in program.formulas.items()}
    return replace(program, formulas=formulas)
