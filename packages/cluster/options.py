"""`--scheduler`, for the commands whose work may be done elsewhere."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from functools import partial
from typing import Any

from reference_tracer.cli.arguments import Place
from reference_tracer.cli.parser import Parser

_COMMANDS = "trace", "compare", "trade", "extremes"


def add(parser: Parser, name: str) -> None:
    """Add the option to a command's parser, and what it means: its `place`."""
    if name not in _COMMANDS:
        return
    group = parser.add_argument_group("more cores, more machines (docs/cluster.md)")
    group.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="Dask's, whose workers do the work: tcp://HOST:PORT, tls:// (other machines), or "
        "local:N (N processes)",
    )
    parser.set_defaults(place=lambda given: place(given, name))


def place(given: Namespace, name: str) -> Place:
    """Return the parameters that have a command's work done where the option says.

    Raises
    ------
    SceneError
        If the address is none.
    ClusterError, MissingLibraryError
        If there are no such workers, or no Dask; once it is entered.
    """
    return nullcontext({}) if given.scheduler is None else _of_workers(given.scheduler, name)


@contextmanager
def _of_workers(address: str, name: str) -> Iterator[dict[str, Any]]:
    from .connection import connected

    with connected(address) as cluster:
        from . import pictures, studies

        if name == "trade":
            yield {"every": partial(studies.trade, cluster)}
        elif name == "extremes":
            yield {"every": partial(studies.extremes_of, cluster)}
        else:
            yield {"tracer": pictures.tracer(cluster)}
