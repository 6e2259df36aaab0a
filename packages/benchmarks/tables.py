"""A `Bench` as text: ours and embreex, the other peers, stages, scaling."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from reference_tracer.report.tables import columns

from .rows import Bench, Row
from .scaling import Scaling, scalings

_PEERS = {
    "rtree": "trimesh rtree",
    "bvhtree": "BVHTree",
    "cycles": "Cycles 1 spp",
    "workbench": "Workbench",
}


def table(bench: Bench) -> str:
    """Return all of it as lines of at most 100 characters."""
    if not bench.rows and not bench.commands:
        return "\n".join(["nothing was measured", *_notes(bench)])
    parts = [
        list(_ours(bench)) if bench.rows else [],
        list(_asked(bench)),
        list(_peers(bench)),
        list(_stages(bench)),
        list(_scaling(bench)),
        list(_commands(bench)),
        list(_notes(bench)),
    ]
    return "\n\n".join("\n".join(part) for part in parts if part)


def _certified(bench: Bench) -> list[Row]:
    return [r for r in bench.rows if r.method == "certified"]


def _ours(bench: Bench) -> Iterator[str]:
    head = "certified", "triangles", "seconds", "x MT (least - most)", "x embreex (the same) "
    rows: list[Sequence[str] | str] = [(*head, "build", "frame", "MiB")]

    for (_, camera), group in groupby(sorted(_certified(bench), key=_size), key=_size):
        some = list(group)
        rows += ["", f"{some[0].width} x {some[0].height} pixels, {camera}", *map(_cells, some)]
    yield from columns(rows, gap=" ")
    yield ""
    yield "MT: Möller–Trumbore in float64. embreex, in float32, traces alone; build: of its tree."
    yield "frame: render() with all passes. MiB: the peak of tracing. ~ is from a sample of rays."
    if bench.machine.get("one_core"):
        yield "Everything ran on one core."


def _asked(bench: Bench) -> Iterator[str]:
    """Yield what a frame takes by what is asked of it, beside what embreex is asked for."""
    some = [r for r in _certified(bench) if r.picture_s and r.outputs_s]
    if not some:
        return
    head = "owners", "x ids (least - most)", "x b+i", "outputs", "x trace (the same)", "x b+t"
    rows: list[Sequence[str] | str] = [("", *head)]
    for (_, camera), group in groupby(sorted(some, key=_size), key=_size):
        of = list(group)
        rows += ["", f"{of[0].width} x {of[0].height} pixels, {camera}", *map(_asked_cells, of)]
    yield "what a frame is asked for, certified, beside embreex"
    yield from columns(rows, gap=" ")
    yield ""
    yield "owners: colour and certified owners, beside embreex's ids; outputs: t and barycentrics,"
    yield "too, beside embreex's trace. x b+i, x b+t: with embreex's build of its tree."


def _asked_cells(r: Row) -> Sequence[str]:
    out = [r.scene]
    for seconds, ratio, peer in (
        (r.picture_s, "picture_ratio", r.embreex_ids_s),
        (r.outputs_s, "outputs_ratio", r.embreex_trace_s),
    ):
        whole = peer and r.embreex_build_s is not None and seconds / (peer + r.embreex_build_s)
        out += [_seconds(seconds), _ratio(r, ratio), f"{whole:.2f}" if whole else "-"]
    return out


def _size(row: Row) -> tuple[int, str]:
    return row.pixels, row.camera


def _cells(r: Row) -> Sequence[str]:
    sampled = "~" if r.embreex_rays is not None and r.embreex_rays < r.pixels else " "
    return (
        r.scene,
        f"{r.triangles:,}",
        _seconds(r.trace_s),
        _ratio(r, "ratio_to_mt"),
        _ratio(r, "ratio_to_embreex") + sampled,
        _seconds(r.embreex_build_s),
        _seconds(r.render_s),
        _mib(r.peak_bytes),
    )


def _peers(bench: Bench) -> Iterator[str]:
    rows = [r for r in _certified(bench) if any(getattr(r, f"{p}_s") for p in _PEERS)]
    if not rows:
        return
    yield "the others: seconds (x certified's)"
    cells = [
        (r.scene, f"{r.width} x {r.height}", r.camera[:5], *(_peer(r, p) for p in _PEERS))
        for r in rows
    ]
    yield from columns([("", "", "", *_PEERS.values()), *cells], left=(0, 2))
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
    yield from columns(
        [
            ("", "", *(name[:9] for name in names), "other"),
            *((r.scene, r.camera, *_shares(r, names)) for r in rows),
        ],
        left=(0, 1),
        gap=" ",
    )


def _shares(r: Row, names: Sequence[str]) -> Iterator[str]:
    parts = [r.stages.get(name, 0.0) / r.render_s for name in names]
    return (f"{share:.0%}" for share in (*parts, max(0.0, 1 - sum(parts))))


def _scaling(bench: Bench) -> Iterator[str]:
    found = [s for s in scalings(bench.rows) if s.method == "certified"]
    if not found:
        return
    yield "time grows with (number) ** exponent"

    def what(s: Scaling) -> tuple[str, str, str]:
        return s.over, s.what, s.camera

    rows = [("", "", "", "trace", "frame", "embreex")]
    for named, group in groupby(found, key=what):
        by = {s.of: f"{s.exponent:.2f}" for s in group}
        rows.append((*named, *(by.get(of, "-") for of in ("trace", "render", "embreex"))))
    yield from columns(rows, left=(0, 1, 2))


def _commands(bench: Bench) -> Iterator[str]:
    if not bench.commands:
        return
    rows = [("", "CPU s", "x import bpy (least - most)", "waited")]
    for c in bench.commands:
        times = f"{c.ratio:.2f} ({c.ratio_least:.2f} - {c.ratio_most:.2f})"
        waited = "-" if c.waited_s is None else f"{c.waited_s:.2f} s"
        rows.append((c.name, f"{c.cpu_s:.2f}", times, waited))
    yield "commands, in processes of their own; x import bpy: in the same round"
    yield from columns(rows)


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
