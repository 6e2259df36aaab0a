"""The records of causes, faults and methods as Markdown."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from importlib import import_module

import reference_tracer_data.faults
from reference_tracer.camera_files.features import FEATURES
from reference_tracer.camera_files.files import CONVENTIONS
from reference_tracer.causes.cause import Cause
from reference_tracer.causes.explain import CAUSES
from reference_tracer.diagnosis import faults
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import TRIED, AnyFault, Effort
from reference_tracer.diagnosis.guessing import IN_PLACES
from reference_tracer.methods import Method
from reference_tracer_data.faults import DATA_FAULTS

_COST = {  # what one try takes
    Effort.NOTHING: "some hundred pixels are traced",
    Effort.VIEW: "the same",
    Effort.FILM: "one or two numbers are fitted to edges in the picture, then to a thousand pixels",
    Effort.CAMERA: "the same, of two to six numbers",
    Effort.LEFT_OUT: "some hundred pixels are traced",
    Effort.PIXELS: "some hundred pixels in some dozen ways",
    Effort.OBJECT: "up to three numbers of two objects are fitted to edges; each is traced alone",
    Effort.ANYTHING: "the whole picture is traced",
}


class _Name(str):
    """A number's name, which stands in a text where the number would, in whatever format."""

    def __format__(self, spec: str) -> str:
        return "*" + self + "*"


def values() -> dict[str, str]:
    """Return each part by its name."""
    parts = {
        "camera_conventions": camera_conventions(),
        "causes": causes(),
        "faults": faults_by_family(),
        "order": order_of_faults(),
        "methods": methods(),
    }
    return {name: f"\n\n{part}\n\n" for name, part in parts.items()}  # blocks of their own


def camera_conventions() -> str:
    """Return a table of the conventions of cameras, and what each cannot say."""
    rows = ["| `--convention` | what is written | what it cannot say |", "|---|---|---|"]
    for name, own in CONVENTIONS.items():
        lacks = ", ".join(f.short for f in FEATURES if f not in own.says)
        rows.append(f"| `{name}` | {own.title}: {own.file} | {lacks} |")
    return "\n".join(rows)


def methods() -> str:
    """Return a table of the methods by which a ray meets a triangle."""
    rows = ["| method | what it is | what it guarantees of a picture |", "|---|---|---|"]
    for method in Method:
        of = method.record
        rows.append(f"| `{method}`, *{of.label}* | {of.description} | {of.guarantees} |")
    return "\n".join(rows)


def causes() -> str:
    """Return a section for each cause of a pixel that differs, in the order of the legend."""
    parts = (_cause(c) for c in CAUSES if c.why)
    return "\n\n".join(line for part in parts for line in part)


def _cause(cause: Cause) -> Iterator[str]:
    """Yield a cause's section."""
    yield f"### {cause.label.capitalize()}"
    numbers = {name: _Name(name) for name in ("figure", "allowed", "name")}
    yield f"“{cause.sentence.format(**numbers)}” (`{cause.key}`, {cause.number})"
    yield f"![Traced, shown, causes](images/causes/{cause.key}.png)"
    yield _list(
        ("Why", cause.why),
        ("The check", cause.check),
        ("Never excused", cause.never),
        ("What to do", cause.advice),
    )


def _list(*lines: tuple[str, str]) -> str:
    """Return texts with their names as a list, without those that are empty."""
    return "\n".join(
        f"- **{name}**: {text[0].upper()}{text[1:].rstrip('.')}." for name, text in lines if text
    )


def order_of_faults() -> str:
    """Return a table of the steps of the search, in their order, with what each costs."""
    rows = [
        f"| {words} | {_COST[effort]} | {number} | {1 + IN_PLACES.index(effort)} | "
        f"{sum(f.effort == effort for f in FAULTS)} |"
        for number, (effort, words) in enumerate(TRIED.items(), 1)
    ]
    head = "| tried | at which cost | place | where most of the picture agrees | faults |"
    return "\n".join((head, "|---|---|---|---|---|", *rows))


def faults_by_family() -> str:
    """Return a section for each file's faults, in the order in which they are told."""
    families = []
    for node in ast.parse(inspect.getsource(faults)).body:
        if isinstance(node, ast.ImportFrom) and node.names[0].name.endswith("_FAULTS"):
            module = import_module(f".{node.module}", faults.__name__)
            families.append((getattr(faults, node.names[0].name), inspect.getdoc(module) or ""))
    names = [fault.name for fault in FAULTS]
    families.sort(key=lambda family: names.index(family[0][0].name))
    families.append((DATA_FAULTS, inspect.getdoc(reference_tracer_data.faults) or ""))
    return "\n\n".join(_family(*family) for family in families)


def _family(of: tuple[AnyFault, ...], said: str) -> str:
    """Return a section of faults, with what their file says of them."""
    title, _, rest = said.split("\n")[0].rstrip(".").partition(": ")
    lead = [rest[0].upper() + rest[1:] + "."] if rest else []
    return "\n\n".join([f"## {title}", *lead, *map(_fault, of)])


def _fault(fault: AnyFault) -> str:
    """Return a fault's section: what is said of it, and who makes it, and how."""
    given = {name: _Name(name) for name in (*fault.numbers, "object")} | {
        "words": fault.words or "…"
    }
    repository, _, number = fault.witness.partition("#")
    seen = f"[{fault.witness}](https://github.com/{repository}/issues/{number})"
    said = f"“{fault.sentence.format(**given)}”"
    return f"### `{fault.name}`\n\n{said}\n\n{fault.why} ({seen})"
