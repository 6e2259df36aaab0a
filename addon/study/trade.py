"""What was measured of a trade: its rows, which of them no other beats, and the advice.

In come rows; out go the same rows, marked, and one sentence. `tradeoff.py` measures them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from statistics import median

from ..methods import Method
from ..tracer.settings import Precision

NOTHING_SEEN = (
    "Nothing is seen: no ray through a pixel's centre meets a surface, so there is nothing to get "
    "wrong, and these times are those of an empty picture."
)
FORGIVEN = 7  # of so many rounds, one may have been disturbed


@dataclass(frozen=True)
class TradeRow:
    """One choice, what it takes and what it gets wrong."""

    method: str
    precision: str
    samples: int  # colour is the mean of samples x samples rays a pixel
    width: int
    height: int
    seconds: float  # the median of `rounds`
    wrong_pixels: int  # whose surface, seen through the centre, is not one of the certified ones
    largest_t_error: float | None  # metres along the view axis; None: nowhere a surface in common
    peak_bytes: int  # of the working arrays and the picture, beside the scene
    coverage_error: float  # root mean square of RGBA against the converged picture
    rounds: tuple[float, ...] = ()  # seconds of each repeat; a round measured every row once
    best_pixels: bool = False  # no row of this resolution beats it in time and wrong pixels
    best_coverage: bool = False  # no row beats it in time and coverage error

    @property
    def pixels(self) -> int:
        """Of the picture."""
        return self.width * self.height

    @property
    def fastest(self) -> float:
        """Seconds of the shortest repeat."""
        return min(self.rounds, default=self.seconds)

    @property
    def slowest(self) -> float:
        """Seconds of the longest repeat."""
        return max(self.rounds, default=self.seconds)

    @property
    def best(self) -> bool:
        """Whether no other row beats it, in wrong pixels or in coverage."""
        return self.best_pixels or self.best_coverage


@dataclass(frozen=True)
class Trade:
    """What was measured on a scene, and the advice that follows from it."""

    scene: str
    rows: list[TradeRow]
    advice: str
    converged: int  # samples a pixel and direction of the picture that coverage is held against

    @property
    def whole(self) -> list[TradeRow]:
        """The rows of the largest picture with one sample: the methods, side by side."""
        return whole(self.rows)


def whole(rows: list[TradeRow]) -> list[TradeRow]:
    """Return those of the largest picture with one sample."""
    width = max(r.width for r in rows)
    return [r for r in rows if r.width == width and r.samples == 1]


def mark(rows: list[TradeRow]) -> list[TradeRow]:
    """Return the rows with those marked that no other beats.

    One beats another if its error is smaller and the other is not measurably faster; or if the
    error is the same and it is faster. Wrong pixels are compared within a resolution: fewer pixels
    can't have as many wrong. Coverage is compared over all, as every picture is held against the
    same one.
    """
    sizes: dict[tuple[int, int], list[TradeRow]] = {}
    for r in rows:
        sizes.setdefault((r.width, r.height), []).append(r)
    return [
        replace(
            r,
            best_pixels=not any(
                _beats(o, r, "wrong_pixels") for o in sizes[r.width, r.height] if o is not r
            ),
            best_coverage=not any(_beats(o, r, "coverage_error") for o in rows if o is not r),
        )
        for r in rows
    ]


def _beats(one: TradeRow, other: TradeRow, error: str) -> bool:
    mine, others = getattr(one, error), getattr(other, error)
    if mine == others:
        return one.seconds < other.seconds
    return mine < others and gain(other, one) <= 0


def gain(fast: TradeRow, slow: TradeRow) -> float:
    """Return which part of `slow`'s time `fast` saves, 0 where the measurement does not tell.

    It does where the rounds agree on which is faster, all but one of seven: they were measured in
    turn, so that a time in which the machine was slow is shared by both. Negative where `fast` is
    slower.
    """
    pairs = list(zip(fast.rounds, slow.rounds, strict=False))
    enough = len(pairs) - len(pairs) // FORGIVEN
    agree = max(sum(f < s for f, s in pairs), sum(f > s for f, s in pairs))
    return 1 - median(f / s for f, s in pairs) if pairs and agree >= enough else 0.0


def advice(rows: list[TradeRow]) -> str:
    """Return, in one sentence, what float32 buys and costs here, and what the proof does."""
    if all(r.largest_t_error is None for r in whole(rows)):
        return NOTHING_SEEN
    by = {(r.method, r.precision): r for r in whole(rows)}
    float32, float64 = (by[Method.TEXTBOOK.value, p.value] for p in Precision)
    certified = by[Method.CERTIFIED.value, Precision.FLOAT64.value]
    rivals = [
        r
        for r in by.values()
        if r is not certified and r.method != Method.TEXTBOOK_LITERAL.value  # it is to be looked at
    ]
    fastest = _fastest(rivals)
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
        return f"has {-more:,} fewer wrong pixel{'s' * (more < -1)} of {one.pixels:,}"
    further = "more " if other.wrong_pixels else ""
    return f"costs {more:,} {further}wrong pixel{'s' * (more > 1)} of {one.pixels:,}"


def _takes(share: float, rival: TradeRow) -> str:
    count = f"{rival.wrong_pixels:,}" if rival.wrong_pixels else "no"
    wrong = f"{count} wrong pixel{'s' * (rival.wrong_pixels != 1)}"
    name = f"{Method(rival.method).record.words} in {rival.precision} ({wrong})"
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
