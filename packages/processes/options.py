"""The options for a program's limits, of the commands that run one."""

from __future__ import annotations

import math
from argparse import Namespace

from reference_tracer.cli.parser import POSITIVE, Parser, number

from .running import SECONDS, Limits

_LEAST = 0.09  # GiB: Python and numpy by themselves take nearly as much
_GIB = number(float, lambda v: _LEAST < v < math.inf, f"a finite number above {_LEAST}")


def add_limits(parser: Parser, memory: float) -> None:
    """Add the options; `memory` is how many GiB a program may take by default."""
    parser.add_argument(
        "--time-limit",
        type=POSITIVE,
        metavar="S",
        help=f"seconds for each scene (default {SECONDS:g})",
    )
    parser.add_argument(
        "--memory-limit",
        type=_GIB,
        metavar="GIB",
        help=f"memory it may take, where the system can limit it (default {memory:g})",
    )


def limits_of(given: Namespace, memory: float) -> Limits:
    """Return the limits that were given, or those by default."""
    gib = given.memory_limit or memory
    return Limits(given.time_limit or SECONDS, int(gib * 2**30))
