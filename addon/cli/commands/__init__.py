"""The commands, a file each: `add` declares a command's options.

One with many options makes a frozen record of what was parsed, which checks it, and works from
that. `reftrace` has all of them, `blender --command` all that are part of the add-on. A command is
imported once it is asked for, so that `--help` takes no time.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from types import ModuleType


@dataclass(frozen=True)
class Command:
    """One command."""

    help: str
    is_own: bool = True  # part of the add-on; else of a package beside it


def module(name: str) -> ModuleType:
    """Import a command of the add-on."""
    return import_module(f".{name}", __package__)


COMMANDS = {  # in the order of `--help`
    "compare": Command(
        "trace a scene and compare it with Blender's own picture, or with any other"
    ),
    "trace": Command("trace a scene or a mesh into a picture"),
    "explain": Command(
        "show the maths of one pixel's ray: every step, in float32, float64 and exactly"
    ),
    "visible": Command("find which faces a camera sees, each with a witness or a proof", False),
    "rays": Command("find what any rays meet in a scene, certified, in bulk", False),
    "judge": Command("judge students' own ray/triangle tests (this runs their code)", False),
    "conform": Command("judge a renderer or an exporter on forty small scenes", False),
    "verify": Command("check a certificate of `trace`, by a program that knows no tracer", False),
    "trade": Command(
        "measure what every method, precision, number of samples and size costs on a scene"
    ),
    "extremes": Command("find where every method breaks: far away, tiny, edge-on, and so on"),
    "bench": Command("measure the speed of the tracer beside embreex, Cycles and others", False),
    "diff": Command("list object by object how two files of a scene differ", False),
    "export": Command("export a .blend to a scene that needs no Blender"),
    "camera": Command("write a scene's camera for other programs, or check one of theirs", False),
}
