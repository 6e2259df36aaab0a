"""A `Bench` as text: ours and embreex, the other peers, stages, scaling, and a baseline."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from statistics import median

from .rows import Bench, Row
from .scaling import Scaling, scalings

_PEERS = ("rtree", "bvhtree", "cycles", "workbench")
_NAMES = {"rtree": "trimesh rtree", "bvhtree": "BVHTree", "cycles": "Cycles 1 spp"}
_NAMES |= {"workbench": "Workbench"}


def table(bench: Bench, baseline: Bench | None = None) -> str:
    """Return all of it as lines of at most 100 characters."""
    if not bench.rows:
        return "\n".join(["nothing was measured", *_notes(bench)])
    parts = [
        list(_ours(bench)),
        list(_peers(bench)),
        list(_stages(bench)),
        list(_scaling(bench)),
        list(_compared(bench, baseline)) if baseline else [],
        list(_notes(bench)),
    ]
    return "\n\n".join("\n".join(part) for part in parts if part)


def _certified(bench: Bench) -> list[Row]:
    return [r for r in bench.rows if r.method == "certified"]


def _ours(bench: Bench) -> Iterator[str]:
    yield (
        f"{'certified: seconds':<28}{'x MT (least - most)':>21}{'x embreex (least - most)':>25}"
        f"{'build':>7}{'frame':>8}{'MiB':>6}"
    )

    def size(row: Row) -> tuple[int, str]:
        return row.pixels, row.camera

    for (_, camera), rows in groupby(sorted(_certified(bench), key=size), key=size):
        some = list(rows)
        yield from ("", f"{some[0].width} x {some[0].height} pixels, {camera}")
        yield from map(_line, some)
    yield ""
    yield "MT: Möller–Trumbore in float64. embreex, in float32, traces alone; build: of its tree."
    yield "frame: render() with all passes. MiB: the peak of tracing. ~ is from a sample of rays."
    if bench.machine.get("one_core"):
        yield "Everything ran on one core."


def _line(r: Row) -> str:
    sampled = "~" if r.embreex_rays is not None and r.embreex_rays < r.pixels else " "
    return (
        f"{r.scene:<15}{r.triangles:>9,} {_seconds(r.trace_s):>7}"
        f"{_ratio(r, 'ratio_to_mt'):>20}{_ratio(r, 'ratio_to_embreex'):>24}{sampled}"
        f"{_seconds(r.embreex_build_s):>7}{_seconds(r.render_s):>8}{_mib(r.peak_bytes):>6}"
    ).rstrip()


def _peers(bench: Bench) -> Iterator[str]:
    rows = [r for r in _certified(bench) if any(getattr(r, f"{p}_s") for p in _PEERS)]
    if not rows:
        return
    yield "the others: seconds (x certified's)"
    yield f"{'':<33}" + "".join(f"{_NAMES[p]:>16}" for p in _PEERS)
    for r in rows:
        cells = (_peer(r, p) for p in _PEERS)
        yield (
            f"{r.scene:<15}{f'{r.width} x {r.height}':>12} {r.camera[:5]:<5}"
            + "".join(f"{cell:>16}" for cell in cells)
        ).rstrip()
    yield "Cycles and Workbench are the whole render, against certified's whole frame."


def _peer(r: Row, peer: str) -> str:
    seconds = getattr(r, f"{peer}_s")
    ours = r.render_s if peer in ("cycles", "workbench") else r.trace_s
    if not seconds or not ours:
        return "-"
    rays = getattr(r, f"{peer}_rays", None)
    sampled = "~" if rays is not None and rays < r.pixels else ""
    return f"{sampled}{_seconds(seconds)} ({seconds / ours:,.{0 if seconds > 10 * ours else 1}f})"


def _stages(bench: Bench) -> Iterator[str]:
    """Where the time of a whole frame goes, at the largest size."""
    rows = [r for r in _certified(bench) if r.stages and r.render_s]
    largest = max((r.pixels for r in rows), default=0)
    rows = [r for r in rows if r.pixels == largest]
    if not rows:
        return
    names = list(dict.fromkeys(name for r in rows for name in r.stages))
    yield f"where a frame's time goes, certified, {rows[0].width} x {rows[0].height} pixels"
    yield f"{'':<30}" + "".join(f"{name[:9]:>10}" for name in names) + f"{'other':>10}"
    for r in rows:
        parts = [r.stages.get(name, 0.0) / r.render_s for name in names]
        parts.append(max(0.0, 1 - sum(parts)))
        yield f"{r.scene:<16}{r.camera:<14}" + "".join(f"{share:>10.0%}" for share in parts)


def _scaling(bench: Bench) -> Iterator[str]:
    found = [s for s in scalings(bench.rows) if s.method == "certified"]
    if not found:
        return
    yield "time grows with (number) ** exponent"
    yield f"{'':<46}{'trace':>8}{'frame':>8}{'embreex':>9}"

    def what(s: Scaling) -> tuple[str, str, str]:
        return s.over, s.what, s.camera

    for (over, name, camera), group in groupby(found, key=what):
        by = {s.of: f"{s.exponent:.2f}" for s in group}
        yield (
            f"{over:<10} {name:<20} {camera:<15}"
            + "".join(f"{by.get(of, '-'):>{w}}" for of, w in (("trace", 8), ("render", 8)))
            + f"{by.get('embreex', '-'):>9}"
        )


def ratios(new: Bench, old: Bench, name: str) -> dict[tuple, float]:
    """Return new against old of one attribute, by the key of the row, where both have it."""
    before = {r.key: getattr(r, name) for r in old.rows}
    found = ((r.key, getattr(r, name), before.get(r.key)) for r in new.rows)
    return {key: now / then for key, now, then in found if now and then}


def _compared(bench: Bench, baseline: Bench) -> Iterator[str]:
    of = {n: ratios(bench, baseline, n) for n in ("trace_s", "render_s", "peak_bytes")}
    control = ratios(bench, baseline, "embreex_trace_s")
    keys = [r.key for r in bench.rows if any(r.key in found for found in of.values())]
    if not keys:
        yield "the baseline has none of these rows"
        return
    yield "against the baseline: new / old, below 1 is better"
    yield f"{'':<59}{'trace':>8}{'frame':>8}{'memory':>8}{'embreex':>9}"
    for key in keys:
        scene, width, height, camera, method, _ = key
        cells = (f"{found[key]:>8.2f}" if key in found else f"{'-':>8}" for found in of.values())
        yield (
            f"{scene:<15}{f'{width} x {height}':>12} {camera:<13} {method:<16} {''.join(cells)}"
            + (f"{control[key]:>9.2f}" if key in control else f"{'-':>9}")
        )
    middle = [f"{median(found.values()):>8.2f}" if found else f"{'-':>8}" for found in of.values()]
    yield f"{'median':<59}{''.join(middle)}" + (
        f"{median(control.values()):>9.2f}" if control else f"{'-':>9}"
    )
    yield "embreex does not change with us: what it shows is the machine."
    changed = [
        f"{name} {then} then, {now} now"
        for name, then in baseline.machine.items()
        if (now := bench.machine.get(name)) != then
    ]
    if changed:
        yield f"The machine differs: {'; '.join(changed)}."


def _notes(bench: Bench) -> Iterator[str]:
    yield from bench.notes
    if bench.interrupted:
        yield "Interrupted: these are the rows that were done."


def _seconds(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.4f}" if value < 1 else f"{value:.2f}" if value < 1000 else f"{value:,.0f}"


def _ratio(r: Row, name: str) -> str:
    value, least, most = (getattr(r, f"{name}{end}") for end in ("", "_least", "_most"))
    return "-" if value is None else f"{value:.2f} ({least:.2f} - {most:.2f})"


def _mib(value: int | None) -> str:
    return "-" if value is None else f"{value / 2**20:.0f}"
