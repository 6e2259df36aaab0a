"""`sweep/edge_functions.py`: triangles as functions of the pixel, with their bounds."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from reference_tracer.certified.sweep import edge_functions
from reference_tracer.certified.sweep.edge_functions import EdgeFunctions
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE, Projection

from .record import Inputs, Kept, Record, locals_of

_SIDES, _OF = ("bc", "ca", "ab", "nearness"), ("1", "y", "x")
_VALUES = dict(
    **dict(pa=1.5, pb=20.25, pc=9.0, qa=2.5, qb=3.75, qc=18.0, wa=1.0, wb=1.25, wc=1.5),
    **dict(sa=4.0, sb=5.0, sc=4.5, ta=1.0, tb=1.25, tc=1.5),
    **dict(c0=1e-12, c1=1e-13, weight=1e-14, ray_error=1e-14, d0=1e-14, d1=1e-15),
    **dict(nearest=1.01, x0=1.0, y0=2.0, reach=20.0),
)
_EDGE_ON = dict(pc=8.75, pb=16.0, pa=1.5, qa=2.5, qb=5.0, qc=3.75, wa=1.0, wb=2.0, wc=1.5)
_LOST = dict(pa=-(2.0**520), pb=2.0**521)
_NAMES = [f"{side}_{of}" for side in _SIDES for of in _OF]


def film(v: Inputs, projection: Projection) -> SimpleNamespace:
    """The bounds of a film, as variables."""
    return SimpleNamespace(
        camera=SimpleNamespace(projection=projection),
        place=(v.scalar("c0"), v.scalar("c1")),
        weight=v.scalar("weight"),
        ray_error=v.scalar("ray_error"),
        depth_error=(v.scalar("d0"), v.scalar("d1")),
    )


def _set_up(v: Inputs, prefix: str, projection: Projection) -> Kept:
    of = {
        "p": "pa pb pc",
        "q": "qa qb qc",
        "w": "wa wb wc",
        "size": "sa sb sc",
        "depth": "ta tb tc",
    }
    vertices = SimpleNamespace(**{k: v.vector(names).reshape(-1) for k, names in of.items()})
    with locals_of(edge_functions.set_up) as local:
        out = edge_functions.set_up(
            film(v, projection),
            vertices,
            np.arange(3 * v.columns).reshape(3, -1),
            v.one("nearest"),
            v.vector("x0 y0"),
            v.one("reach"),
        )
    kept = {
        f"{prefix}_{side}_{of}": out.coefficients[i, k]
        for k, side in enumerate(_SIDES)
        for i, of in enumerate(_OF)
    }
    kept |= {f"{prefix}_edge_error": out.edge_error, f"{prefix}_sure": out.sure}
    kept |= {f"{prefix}_nearness_error": out.nearness_error}
    if len(out) == 2 * v.columns:  # once for each sign
        n = v.columns
        other = {name.replace(prefix, f"{prefix}_other"): k[n:] for name, k in kept.items()}
        kept = {name: k[:n] for name, k in kept.items()} | other
    return kept | {f"{prefix}_T": local["volume"], f"{prefix}_T_error": local["error"]}


def variables(v: Inputs) -> EdgeFunctions:
    """The functions of a triangle, as variables."""
    coefficients = [[v.one(f"{side}_{of}") for side in _SIDES] for of in _OF]
    return EdgeFunctions(
        v.rows,
        v.vector("origin_x origin_y"),
        v.stacked([v.stacked(row) for row in coefficients]),
        v.one("edge_error"),
        v.one("nearness_error"),
        v.one("nearest"),
        v.one("sure"),
    )


VALUES = (
    dict.fromkeys(_NAMES, 0.25)
    | dict(origin_x=3.0, origin_y=4.0, edge_error=1e-9, nearness_error=1e-9)
    | dict(nearest=10.0, sure=True)
)


def _theorems(prefix: str) -> dict[str, str]:
    of = {
        "edges": [*(f"{side}_{of}" for side in _SIDES[:3] for of in _OF), "edge_error"],
        "nearness": [*(f"nearness_{of}" for of in _OF), "nearness_error"],
        "sign": ["sure", "T", "T_error"],
    }
    file = "SweepDoubt" if "_edge_on" in prefix or "_lost" in prefix else "SweepCode"
    copies = f"{prefix}_", f"{prefix}_other_"  # the other is of the other sign of T
    same = "SweepDoubt.edge_on_is_perspective" if prefix == "set_up_edge_on_parallel" else ""
    return {
        f"{copy}{name}": same or f"{file}.{prefix}_{theorem}"
        for copy in copies
        for theorem, names in of.items()
        for name in names
    }


def _record(
    name: str, projection: Projection, values: dict[str, float], note: str, only: str = ""
) -> Record:
    """Return a record; of what is as in another one, `only` some results are kept."""

    def call(v: Inputs) -> Kept:
        kept = _set_up(v, name, projection)
        return {f"{name}_{k}": kept[f"{name}_{k}"] for k in only.split()} or kept

    return Record(name, "edge_functions.set_up", values, call, _theorems(name), note)


RECORDS = (
    _record("set_up_perspective", PERSPECTIVE, _VALUES, "perspective"),
    _record("set_up_parallel", ORTHOGRAPHIC, _VALUES, "parallel rays"),
    _record(
        "set_up_edge_on",
        PERSPECTIVE,
        _VALUES | _EDGE_ON,
        "perspective, where the sign of T is not known",
    ),
    _record(
        "set_up_edge_on_parallel",
        ORTHOGRAPHIC,
        _VALUES | _EDGE_ON,
        "parallel rays, where the sign of T is not known",
        "bc_1 other_bc_1 nearness_1 nearness_error sure",
    ),
    *(
        _record(
            f"set_up_lost_{name}",
            projection,
            _VALUES | _LOST,
            f"{projection.name}, where numbers are too large",
            "bc_1 edge_error nearness_1 nearness_error sure",
        )
        for name, projection in (("perspective", PERSPECTIVE), ("parallel", ORTHOGRAPHIC))
    ),
)
