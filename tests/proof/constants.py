"""The numbers in the code of what is certified: where they stand, and what they are worth."""

from __future__ import annotations

import ast
import importlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import reference_tracer.certified as certified

FOLDER = Path(certified.__file__).parent
# Arguments of these are shapes, indices, counts and names of axes.
_STRUCTURE = frozenset(
    {
        "arange",
        "broadcast_to",
        "diff",
        "empty",
        "enumerate",
        "full",
        "ones",
        "parts",
        "range",
        "repeat",
        "reshape",
        "split",
        "take",
        "transpose",
        "zeros",
        "searchsorted",
        "all",
        "any",
        "max",
        "min",
        "sum",
        "concatenate",
        "stack",
        "groups",
        "bincount",
        "divmod",
    }
)
_PYTHONS = frozenset({"max", "min"})  # which have numbers, where numpy's methods have axes
_KEYWORDS = frozenset({"axis", "initial", "minlength", "prepend"})
_COUNTED = ast.FloorDiv | ast.Mod | ast.LShift | ast.RShift


@dataclass(frozen=True)
class Number:
    """A number of the code, all of whose operands are known: 12 * U is one."""

    module: str  # its name, without the package's
    line: int
    text: str
    value: float | int

    def __str__(self) -> str:
        return f"{self.module.replace('.', '/')}.py, line {self.line}: {self.text} = {self.value}"


def numbers() -> Iterator[Number]:
    """Yield every number that is used to compute, and not to count or to index."""
    for path in sorted(FOLDER.rglob("*.py")):
        parts = path.relative_to(FOLDER).with_suffix("").parts
        if parts[-1] != "__init__":
            module = importlib.import_module(".".join((certified.__name__, *parts)))
            yield from of_module(module, ".".join(parts), path.read_text(encoding="utf-8"))


def of_module(module: ModuleType, name: str, source: str) -> Iterator[Number]:
    tree = ast.parse(source)
    nodes: list[Any] = [*ast.walk(tree)]
    for parent in nodes:
        child: Any
        for child in ast.iter_child_nodes(parent):
            child.parent = parent
    for node in nodes:
        value = worth(node, module)
        if value is None or worth(node.parent, module) is not None or _is_structure(node):
            continue
        if isinstance(node.parent, ast.Assign) and node.parent in tree.body:
            [target] = node.parent.targets
            if isinstance(target, ast.Name) and _is_used(target.id, tree, name):
                continue  # it counts where it is used
        yield Number(name, node.lineno, ast.unparse(node), value)


def worth(node: ast.AST, module: ModuleType) -> float | int | None:
    """Return what an expression of numbers and constants of a module is worth; else None."""
    if isinstance(node, ast.Constant):
        return node.value if type(node.value) in (int, float) else None
    if isinstance(node, ast.Name):
        value = getattr(module, node.id, None) if node.id.isupper() else None
        if not isinstance(getattr(node, "ctx", None), ast.Load):
            return None
        return value if isinstance(value, int | float | np.number) else None
    if isinstance(node, ast.UnaryOp | ast.BinOp):
        inner = [worth(k, module) for k in ast.iter_child_nodes(node) if isinstance(k, ast.expr)]
        if None not in inner:
            return eval(compile(ast.Expression(node), "", "eval"), vars(module))
    return None


def _is_used(constant: str, tree: ast.Module, module: str) -> bool:
    """Return whether a module's constant is used there, or seems to be by another."""
    own = (n for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == constant)
    return any(isinstance(n.ctx, ast.Load) for n in own) or not constant.startswith("_")


def _is_structure(node: Any) -> bool:
    """Return whether a number counts, names an axis, or says which."""
    while not isinstance(node, ast.stmt):
        parent = node.parent
        if isinstance(parent, ast.Subscript) and node is parent.slice:
            return True
        if isinstance(parent, ast.keyword) and parent.arg in _KEYWORDS:
            return True
        if isinstance(parent, ast.Call) and node in parent.args:
            function = parent.func
            name = getattr(function, "attr", getattr(function, "id", ""))
            if name in _STRUCTURE and not (name in _PYTHONS and isinstance(function, ast.Name)):
                return True
        if isinstance(parent, ast.BinOp) and isinstance(parent.op, _COUNTED):
            return True
        if isinstance(parent, ast.Tuple | ast.List) and all(
            isinstance(k, ast.Constant) and type(k.value) is int for k in parent.elts
        ):
            return True
        node = parent
    return False
