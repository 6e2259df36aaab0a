"""`--scheduler` and `--verify`, for the commands whose work may be done elsewhere."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from reference_tracer.cli.parser import Parser
from reference_tracer.scene import SceneError

_COMMANDS = "trace", "compare", "trade", "extremes"


def add(parser: Parser, name: str) -> None:
    """Add the options to a command's, and what they mean: its `place`."""
    if name not in _COMMANDS:
        return
    group = parser.add_argument_group("more cores, more machines (docs/cluster.md)")
    where = (
        "have the work done by the workers of a Dask scheduler, tcp://HOST:PORT on this machine or "
        "tls://HOST:PORT; or of local:N, N processes that are started for it"
    )
    again = "have this share of it (above 0, to 1) done a second time by another worker, and all "
    again += "that can be checked here checked exactly"
    group.add_argument("--scheduler", metavar="ADDRESS", help=where)
    group.add_argument("--verify", type=float, metavar="SHARE", help=again)
    parser.set_defaults(place=lambda options: place(options, name))


@contextmanager
def place(options: argparse.Namespace, name: str) -> Iterator[dict[str, Any]]:
    """Give the parameters that have a command's work done where the options say.

    Raises
    ------
    SceneError
        If an option is wrong.
    ClusterError, MissingLibraryError
        If there are no such workers, or no Dask.
    """
    share = options.verify
    if options.scheduler is None:
        if share is not None:
            raise SceneError("--verify is about the workers of --scheduler: name one")
        yield {}
        return
    if share is not None and not 0 < share <= 1:
        raise SceneError(f"--verify is {share:g}; it must be above 0 and at most 1")
    from .connection import connected

    with connected(options.scheduler) as cluster:
        from . import pictures, studies

        yield {
            "trace": lambda: {"tracer": pictures.tracer(cluster, share)},
            "compare": lambda: {"tracer": pictures.tracer(cluster, share)},
            "trade": lambda: {"every": studies.trade(cluster, share)},
            "extremes": lambda: {"every": studies.extremes_of(cluster, share)},
        }[name]()
