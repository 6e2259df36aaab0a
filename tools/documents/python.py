"""The page of what `import reference_tracer` offers, from the docstrings."""

from __future__ import annotations

import inspect
import re
from typing import Any

import reference_tracer

_SECTION = re.compile(r"^(?P<title>[A-Z]\w+)\n-+\n", re.M)
_FIRST = (
    "load_scene",
    "save_scene",
    "render",
    "trace",
    "compare",
    "explain",
    "inside",
    "read_camera",
    "write_camera",
)


def page() -> str:
    """Return the functions that a script begins with, and then all else in a table."""
    functions = [_function(name, getattr(reference_tracer, name)) for name in _FIRST]
    rest = [name for name in reference_tracer.__all__ if name not in _FIRST]
    rows = [f"| `{name}` | {_summary(getattr(reference_tracer, name))} |" for name in rest]
    return "\n\n".join([*functions, "\n".join(["| name | what it is |", "|---|---|", *rows])])


def _summary(offered: Any) -> str:
    return (inspect.getdoc(offered) or "").split("\n\n")[0].replace("\n", " ")


def _function(name: str, function: Any) -> str:
    names = []
    for p in inspect.signature(function).parameters.values():
        if p.kind is p.KEYWORD_ONLY and "*" not in names:
            names.append("*")
        default = "" if p.default is p.empty else f"={p.default!r}"
        names.append(f"{p.name}{default}")
    text, *sections = _SECTION.split((inspect.getdoc(function) or "").replace("``", "`"))
    parts = [f"### `{name}({', '.join(names)})`", text.strip()]
    examples = dict(zip(sections[::2], sections[1::2], strict=True)).get("Examples", "")
    told, _, code = examples.partition(">>> ")
    if code:  # the empty line ends what is expected
        parts += [told.strip()] * bool(told.strip())
        block = "<!--not run: a test runs it-->", "```pycon", f">>> {code.rstrip()}", "", "```"
        parts.append("\n".join(block))
    return "\n\n".join(parts)
