"""Recorded expressions as text: `proofs/Recorded.v`, and what of it is another now."""

from __future__ import annotations

import re
import textwrap
from collections import Counter
from collections.abc import Sequence

from .nodes import Node, in_order, words
from .records import Output

HEAD = """\
(** What the tracer's own functions were seen to compute: written by `tools/record_trees.py`.

    Do not edit. Each definition is an expression of Trees.v. Its variables are the function's
    inputs, and its constants the numbers that were used. The names of functions are those in
    `addon/`. A definition that ends in _path is what the function asked of its numbers on the way,
    as it was answered: the others hold where that does. `tests/proof/test_bridge.py` records them
    anew, and fails if they are no longer these. *)
Require Import ZArith String.
From Reftrace Require Import Trees.
Open Scope Z_scope.
Open Scope string_scope.
"""
_LEAVES = frozenset({"Var", "Num", "Inf", "Given"})
_JOINED = "\0"  # a space at which no line is broken


def text(outputs: Sequence[Output]) -> str:
    return HEAD + "".join("\n" + definition(output) for output in outputs)


def definition(output: Output) -> str:
    kind = "test" if output.node.is_test else "expr"
    body = "\n".join(expression(output.node))
    comment = textwrap.fill(f"(** {output.words} *)", 98, subsequent_indent="    ")
    return f"{comment}\nDefinition {output.name} : {kind} :=\n{body}.\n"


def expression(root: Node) -> list[str]:
    """Return the lines of an expression; what is used more than once is named."""
    order = list(in_order([root]))
    uses = Counter(child for node in order for child in node.children)
    names: dict[Node, str] = {}
    lines = []
    for node in order:
        if node is not root and uses[node] > 1 and node.kind not in _LEAVES:
            value = _term(node, names)
            names[node] = f"x{len(names) + 1}"
            lines += _wrapped(f"let {names[node]} := {value} in")
    return [*lines, *_wrapped(_term(root, names))]


def _term(node: Node, names: dict[Node, str]) -> str:
    if node in names:
        return names[node]
    if node.kind in ("Var", "Given"):
        return f'{node.kind}{_JOINED}"{node.args[0]}"'
    parts = (_inner(a, names) if isinstance(a, Node) else _integer(a) for a in node.args)
    return (_JOINED if node.kind == "Num" else " ").join((node.kind, *parts))


def _inner(node: Node, names: dict[Node, str]) -> str:
    term = _term(node, names)
    return f"({term})" if node.args and node not in names else term


def _integer(value: int) -> str:
    return f"({value})" if value < 0 else str(value)


def _wrapped(line: str) -> list[str]:
    """Break a line at its spaces; `textwrap` takes five times as long."""
    lines, current = [], " "
    for word in line.split(" "):
        if len(current) + len(word) >= 100:
            lines.append(current)
            current = "   "
        current += f" {word}"
    return [line.replace(_JOINED, " ") for line in (*lines, current)]


_DEFINITION = re.compile(
    r"^\(\*\* ((?:(?!\*\)).)*) \*\)\nDefinition (\w+) : (\w+) :=\n(.*?)\.$", re.S | re.M
)


def differences(committed: str, outputs: Sequence[Output]) -> list[str]:
    """Return in words what is recorded now and is not what `proofs/` has; nothing if all is."""
    before = {m[2]: m[0] for m in _DEFINITION.finditer(committed)}
    found = []
    for output in outputs:
        concerned = f"{output.name}, {output.words}"
        concerned += f"\n  theorem concerned: {output.theorem or 'none by itself'}"
        old, new = before.pop(output.name, None), definition(output).rstrip("\n")
        if old is None:
            found.append(f"{concerned}\n  is recorded, and proofs/Recorded.v does not have it")
        elif old != new:
            a, b = _first_difference(old, new)
            found.append(
                f"{concerned}\n  proofs/Recorded.v has: ... {a}\n  recorded now is:       ... {b}"
                f"\n  as a formula, now: {words(output.node)}"
            )
    found += [f"{name} is in proofs/Recorded.v, and nothing records it" for name in before]
    if not found and text(outputs) != committed:
        found.append("proofs/Recorded.v has the same definitions in another order or form")
    return found


def _first_difference(old: str, new: str) -> tuple[str, str]:
    """Return what two texts say from shortly before they part."""
    old, new = " ".join(old.split()), " ".join(new.split())
    at = next((k for k, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), 0)
    first = max(0, at - 40)
    return old[first : at + 40], new[first : at + 40]
