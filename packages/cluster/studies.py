"""Has workers find the rows of the trade, or of the extremes: each row, or scene, by one of them.

The columns that are timed, as the record of each says, are the worker's own. With a share to
verify, that share is found twice, and must be the same in all other columns.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, replace
from math import ceil
from random import SystemRandom
from typing import Any, get_origin, get_type_hints

from reference_tracer.arrays import Floats
from reference_tracer.errors import words
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.trade import TIMED, TradeRow
from reference_tracer.tracer.progress import Work, scaled

from . import tasks
from .claims import packed, unpacked
from .cluster import Cluster, ClusterError, NobodyError
from .pictures import camera_json, scene_name

_NUMBERS = {float: int | float, float | None: int | float | None}  # JSON writes 1.0 as it likes
Own = Callable[[int], Work[list]]  # finds here what the task of this number finds


def trade(cluster: Cluster, share: float | None) -> tradeoff.Every:
    """Return what has the rows of a trade measured on a cluster."""

    def every(choices: list[tradeoff.Choice], truth: Floats) -> Work[list[TradeRow]]:
        color = cluster.keep(packed(truth))

        def asked(choice: tradeoff.Choice) -> tuple:
            chosen = json.dumps(vars(choice.settings))
            return scene_name(cluster, choice.scene), camera_json(choice.scene), chosen, color

        def own(k: int) -> Work[list[TradeRow]]:
            proven = tradeoff.Choice(tasks.PROVEN, choices[k].scene)
            row = (yield from tradeoff.rows_of([proven, replace(choices[k])], truth))[-1]
            return [row]

        told = [(tasks.trade_row, *asked(choice)) for choice in choices]
        rows = yield from _every(cluster, share, told, own, TradeRow)
        return [row for [row] in rows]

    return every


def extremes_of(cluster: Cluster, share: float | None) -> extremes.Every:
    """Return what has the rows of the extremes found on a cluster."""

    def every(scenes: extremes.Scenes, *options: Any) -> Work[list[ExtremesRow]]:
        told = [(tasks.extremes_rows, s.name, scale, *options) for s, scale in scenes]
        own: Own = lambda k: extremes.rows_of(*scenes[k], *options)  # noqa: E731
        rows = yield from _every(cluster, share, told, own, ExtremesRow)
        return [row for some in rows for row in some]

    return every


def _every(
    cluster: Cluster, share: float | None, told: list[tuple], own: Own, kind: type
) -> Work[list[list]]:
    """Have tasks done, a share of them twice; return the rows of each."""

    def ask(k: int, *without: str) -> Any:
        task, *given = told[k]
        return cluster.ask(task, tasks.about(), *given, without=frozenset(without))

    def rows(asked: Any) -> Work[tuple[list, str]]:
        data, worker = yield from cluster.answer(asked)
        try:
            return [_row(kind, row) for row in json.loads(str(*unpacked(data, (str, ()))))], worker
        except Exception as error:  # whatever it is made to be
            said = f"worker {worker} has answered what is no row: {words(error)}"
            raise ClusterError(said) from None

    first, found, second = [ask(k) for k in range(len(told))], [], {}
    twice = SystemRandom().sample(range(len(told)), ceil((share or 0) * len(told)))
    for k, one in enumerate(first):
        found.append((yield from scaled(rows(one), k / len(told), 0.0)))
        if k in twice:
            second[k] = ask(k, found[k][1])
    for k, other in second.items():
        said = [found[k]]
        with suppress(NobodyError):
            said.append((yield from scaled(rows(other), 1.0, 0.0)))
            if _facts(said[0][0]) == _facts(said[1][0]):
                continue
        truth = _facts((yield from scaled(own(k), 1.0, 0.0)))
        if wrong := [worker for some, worker in said if _facts(some) != truth]:
            names = " and ".join(f"worker {worker}" for worker in wrong)
            raise ClusterError(f"{names} gave a wrong answer, row {k + 1}: look at that machine")
    return [some for some, _ in found]


def _row(kind: type, told: dict[str, Any]) -> Any:
    """Return a row of JSON, if each of its values is of the kind that it should be."""
    row = kind(**{k: tuple(map(float, v)) if isinstance(v, list) else v for k, v in told.items()})
    for name, hint in get_type_hints(kind).items():
        value = getattr(row, name)
        wanted = tuple if get_origin(hint) is tuple else _NUMBERS.get(hint, hint)
        if not isinstance(value, wanted):
            raise ValueError(f"{name} is {value!r}")
    return row


def _facts(rows: list) -> str:
    """Return what is the same wherever rows are found: all but what was timed."""
    return repr([{k: v for k, v in asdict(row).items() if k not in TIMED} for row in rows])
