"""Has workers find the rows of the trade, or of the extremes: each row, or scene, by one of them.

Times and memory are the worker's own.
"""

from __future__ import annotations

from typing import Any

from reference_tracer.arrays import Floats
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.trade import TradeRow
from reference_tracer.tracer.progress import Progress, Work

from . import tasks
from .cluster import Cluster
from .pictures import sent_scene


def trade(cluster: Cluster) -> tradeoff.Every:
    """Return what has the rows of a trade measured on a cluster."""

    def every(choices: list[tradeoff.Choice], truth: Floats) -> Work[list[TradeRow]]:
        kept = cluster.keep(truth)
        told = [(tasks.trade_rows, sent_scene(cluster, c.scene), c.settings, kept) for c in choices]
        rows: list[TradeRow] = yield from _every(cluster, told)
        return rows

    return every


def extremes_of(cluster: Cluster) -> extremes.Every:
    """Return what has the rows of the extremes found on a cluster."""

    def every(scenes: extremes.Scenes, *options: Any) -> Work[list[ExtremesRow]]:
        told = [(tasks.extremes_rows, s.name, scale, *options) for s, scale in scenes]
        rows: list[ExtremesRow] = yield from _every(cluster, told)
        return rows

    return every


def _every(cluster: Cluster, told: list[tuple]) -> Work[list]:
    """Have tasks done; return the rows of all."""
    asked = [cluster.ask(task, *given) for task, *given in told]
    rows = []
    for k, one in enumerate(asked):
        yield Progress(k / len(asked))
        rows += yield from cluster.answer(one)
    return rows
