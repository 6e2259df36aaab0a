"""Finds which rows of a trade no other beats, and says in words what follows from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from statistics import median

from ..methods import Method
from ..tracer.settings import Precision
from ..wording import count_of
from .trade import TradeRow, whole

NOTHING_SEEN = (
    "Nothing is seen: no ray through a pixel's centre meets a surface, so there is nothing to get "
    "wrong, and these times are those of an empty picture."
)
FORGIVEN = 7  # rounds: of as many, one may have been disturbed


def mark(rows: Sequence[TradeRow]) -> list[TradeRow]:
    """Return the rows, with those marked that no other beats.

    One beats another if its error is smaller and the other is not measurably faster; or if the
    error is the same and it is faster. Wrong pixels are compared within a resolution, because fewer
    pixels cannot have as many wrong. Coverage is compared over all, as every picture is held
    against the same one.
    """
    return [
        replace(
            r,
            best_pixels=_unbeaten(r, [o for o in rows if o.width == r.width], "wrong_pixels"),
            best_coverage=_unbeaten(r, rows, "coverage_error"),
        )
        for r in rows
    ]


def _unbeaten(row: TradeRow, others: Sequence[TradeRow], error: str) -> bool:
    return not any(_beats(o, row, error) for o in others if o is not row)


def _beats(one: TradeRow, other: TradeRow, error: str) -> bool:
    mine, theirs = getattr(one, error), getattr(other, error)
    if mine == theirs:
        return one.seconds < other.seconds
    return bool(mine < theirs) and gain(other, one) <= 0


def gain(fast: TradeRow, slow: TradeRow) -> float:
    """Return which part of `slow`'s time `fast` saves, 0 where the measurement cannot tell.

    It can tell where the rounds agree on which is faster, all but one of seven. The rows were
    measured in turn, so that a time in which the machine was slow is shared by both. The result is
    negative where `fast` is slower.
    """
    pairs = list(zip(fast.rounds, slow.rounds, strict=False))
    enough = len(pairs) - len(pairs) // FORGIVEN
    agree = max(sum(f < s for f, s in pairs), sum(f > s for f, s in pairs))
    return 1 - median(f / s for f, s in pairs) if pairs and agree >= enough else 0.0


def advice(rows: Sequence[TradeRow]) -> str:
    """Return, in one sentence, what float32 buys and costs here, and what the proof does."""
    if all(r.largest_t_error is None for r in whole(rows)):
        return NOTHING_SEEN
    by = {(r.method, r.precision): r for r in whole(rows)}
    float32, float64 = (by[Method.TEXTBOOK.value, p.value] for p in Precision)
    certified = by[Method.CERTIFIED.value, Precision.FLOAT64.value]
    # Nobody would choose the literal textbook: it is there to be seen.
    unfit = Method.CERTIFIED.value, Method.TEXTBOOK_LITERAL.value
    fastest = _fastest([r for r in by.values() if r.method not in unfit])
    return (
        f"With the textbook's formulas, float32 {_buys(gain(float32, float64))} here and "
        f"{_costs(float32, float64)}; certified, proven to have none, "
        f"{_takes(gain(fastest, certified), fastest)}."
    )


def _fastest(rows: list[TradeRow]) -> TradeRow:
    """Return the one with the fewest wrong pixels of those that none is measurably faster than."""
    first = min(rows, key=lambda r: r.seconds)
    equals = [r for r in rows if gain(first, r) <= 0]
    return min(equals, key=lambda r: (r.wrong_pixels, r.seconds))


def _buys(share: float) -> str:
    if share == 0:
        return "buys nothing that could be measured"
    return f"buys {_percent(share)}" if share > 0 else f"takes {_times(1 - share)} float64"


def _costs(one: TradeRow, other: TradeRow) -> str:
    more = one.wrong_pixels - other.wrong_pixels
    if more == 0:
        return f"costs no {'further ' if other.wrong_pixels else ''}pixel of {one.pixels:,}"
    if more < 0:
        return f"has {count_of(-more, 'fewer wrong pixel')} of {one.pixels:,}"
    further = "more " if other.wrong_pixels else ""
    return f"costs {count_of(more, f'{further}wrong pixel')} of {one.pixels:,}"


def _takes(share: float, fastest: TradeRow) -> str:
    count = fastest.wrong_pixels
    wrong = count_of(count, "wrong pixel") if count else "no wrong pixels"
    name = f"{Method(fastest.method).record.words} in {fastest.precision} ({wrong})"
    if share < 0:
        return f"is faster than {name}, the next that loses no hits on purpose"
    first = "the fastest that loses no hits on purpose"  # without the literal textbook
    if share == 0:
        return f"takes no longer than {name}, {first}, as far as could be measured"
    return f"takes {_times(1 / (1 - share))} {name}, {first}"


def _times(ratio: float) -> str:
    return f"{ratio:.1f} times as long as" if ratio >= 1.5 else f"{_percent(ratio - 1)} longer than"


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.01 else "less than 1 %"
