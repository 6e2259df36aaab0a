"""Has workers find the rows of the trade, or of the extremes: each row, or scene, by one of them.

Times and memory are the worker's own.
"""

from __future__ import annotations

from typing import Any

from distributed import Future
from reference_tracer.arrays import Floats
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.trade import TradeRow
from reference_tracer.tracer.progress import Progress, Work

from . import tasks
from .cluster import Cluster


def trade(cluster: Cluster, choices: list[tradeoff.Choice], truth: Floats) -> Work[list[TradeRow]]:
    """Have the rows of a trade measured on a cluster."""
    color = cluster.keep(truth)
    scenes = {scene: cluster.keep(scene) for scene in dict.fromkeys(c.scene for c in choices)}
    asked = [cluster.ask(tasks.trade_rows, scenes[c.scene], c.settings, color) for c in choices]
    return _rows(cluster, asked)


def extremes_of(
    cluster: Cluster, scenes: extremes.Scenes, *options: Any
) -> Work[list[ExtremesRow]]:
    """Have the rows of the extremes found on a cluster."""
    return _rows(
        cluster, [cluster.ask(tasks.extremes_rows, s.name, scale, *options) for s, scale in scenes]
    )


def _rows(cluster: Cluster, asked: list[Future]) -> Work[list]:
    """Return the rows of all tasks."""
    rows = []
    for k, one in enumerate(asked):
        yield Progress(k / len(asked))
        rows += yield from cluster.answer(one)
    return rows
