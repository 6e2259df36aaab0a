"""The commands, a file each: `add` declares a command's options.

One with many options makes a frozen record of what was parsed, which checks it, and works from
that. `reftrace` has all of them, `blender --command` all that are part of the add-on. A command is
imported once it is asked for, so that `--help` takes no time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType


@dataclass(frozen=True)
class Command:
    """One command."""

    help: str
    module: Callable[[], ModuleType] | None  # imports it; None where a package has it


def _compare() -> ModuleType:
    from . import compare

    return compare


def _trace() -> ModuleType:
    from . import trace

    return trace


def _explain() -> ModuleType:
    from . import explain

    return explain


def _trade() -> ModuleType:
    from . import trade

    return trade


def _extremes() -> ModuleType:
    from . import extremes

    return extremes


def _export() -> ModuleType:
    from . import export

    return export


COMMANDS = {  # in the order of `--help`
    "compare": Command(
        "trace a scene and compare it with Blender's own picture, or with any other", _compare
    ),
    "trace": Command("trace a scene or a mesh into a picture", _trace),
    "explain": Command(
        "show the maths of one pixel's ray: every step, in float32, float64 and exactly", _explain
    ),
    "visible": Command("find which faces a camera sees, each with a witness or a proof", None),
    "rays": Command("find what any rays meet in a scene, certified, in bulk", None),
    "judge": Command("judge students' own ray/triangle tests (this runs their code)", None),
    "conform": Command("judge a renderer or an exporter on forty small scenes", None),
    "verify": Command("check a certificate of `trace`, by a program that knows no tracer", None),
    "trade": Command(
        "measure what every method, precision, number of samples and size costs on a scene", _trade
    ),
    "extremes": Command(
        "find where every method breaks: far away, tiny, edge-on, and so on", _extremes
    ),
    "bench": Command("measure the speed of the tracer beside embreex, Cycles and others", None),
    "diff": Command("list object by object how two files of a scene differ", None),
    "export": Command("export a .blend to a scene that needs no Blender", _export),
    "camera": Command("write a scene's camera for other programs, or check one of theirs", None),
}
