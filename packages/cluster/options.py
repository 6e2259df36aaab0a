"""`--scheduler` and `--verify`, for the commands whose work may be done elsewhere."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from typing import Any

from reference_tracer.cli.arguments import Place
from reference_tracer.cli.parser import FINITE, Parser
from reference_tracer.scene import SceneError

_COMMANDS = "trace", "compare", "trade", "extremes"


def add(parser: Parser, name: str) -> None:
    """Add the options to a command's parser, and what they mean: its `place`."""
    if name not in _COMMANDS:
        return
    group = parser.add_argument_group("more cores, more machines (docs/cluster.md)")
    group.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="Dask's, whose workers do the work: tcp://HOST:PORT, tls:// (other machines), or "
        "local:N (N processes)",
    )
    group.add_argument(
        "--verify",
        type=FINITE,
        metavar="SHARE",
        help="of the work (above 0, to 1) that two workers do, and must find the same",
    )
    parser.set_defaults(place=lambda given: place(given, name))


def place(given: Namespace, name: str) -> Place:
    """Return the parameters that have a command's work done where the options say.

    Raises
    ------
    SceneError
        If an option is wrong.
    ClusterError, MissingLibraryError
        If there are no such workers, or no Dask; once it is entered.
    """
    share = given.verify
    if given.scheduler is None:
        if share is not None:
            raise SceneError("--verify is about the workers of --scheduler: name one")
        return nullcontext({})
    if share is not None and not 0 < share <= 1:
        raise SceneError(f"--verify is {share:g}; it must be above 0 and at most 1")
    return _of_workers(given.scheduler, share, name)


@contextmanager
def _of_workers(address: str, share: float | None, name: str) -> Iterator[dict[str, Any]]:
    from .connection import connected

    with connected(address) as cluster:
        from . import pictures, studies

        if name == "trade":
            yield {"every": studies.trade(cluster, share)}
        elif name == "extremes":
            yield {"every": studies.extremes_of(cluster, share)}
        else:
            yield {"tracer": pictures.tracer(cluster, share)}
