"""`sweep/`: what is asked at a pixel, and in a box of pixels, of triangles and planes.

Numbers of pixels are integers, without rounding. Which of them a box has is no matter of floats.
"""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified.sweep import rasterise, sweep
from reference_tracer.certified.sweep.depth_buffer import ClipRange, DepthBuffer
from reference_tracer.certified.sweep.rasterise import Boxes
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE, Projection
from reference_tracer.scene import Region

from . import edges
from .bounds import FIRST
from .record import Inputs, Kept, Record, locals_of, named

_PIXELS = tuple(map(float, range(-64, 65)))


class _Extent:
    """The upper end of a box of one pixel: one pixel's, wherever the lower is."""

    def __sub__(self, _):
        return np.zeros((2, 1), np.int32)


def _block(v: Inputs) -> Kept:
    depths = SimpleNamespace(corner=v.vector("region_x region_y"), stride=64)
    boxes = Boxes(FIRST, v.vector("x y"), _Extent())
    found = edges.variables(v)
    with locals_of(rasterise._block) as local:
        out = rasterise._block(found, boxes, depths)
    return local["least"].reshape(-1), v.chosen(0), out.least, out.most, out.sure


def _may_be_seen(v: Inputs) -> Kept:
    depths = SimpleNamespace(corner=v.vector("region_x region_y"))
    boxes = Boxes(FIRST, v.vector("x y"), v.vector("x_end y_end"))
    rasterise._may_be_seen(edges.variables(v), boxes, v.one("farthest"), depths)
    return [v.chosen(0)]


def _clip(v: Inputs, projection: Projection) -> Kept:
    ends = dict(clip_start=v.scalar("start"), clip_end=v.scalar("end"))
    clip = ClipRange(SimpleNamespace(projection=projection, **ends))
    between = v.one("least"), v.one("most")
    return clip.inside(*between), clip.outside(*between)


def _plane(v: Inputs, projection: Projection) -> Kept:
    """The plane's interval of t is variables: `bounds.plane_fractions` is recorded by itself."""
    region, kept = Region(0, 0, 1, 1), []
    infinite = SimpleNamespace(point=np.zeros(3), normal=np.ones(3))
    this = SimpleNamespace(
        _scene=SimpleNamespace(planes=[infinite], instances=[]),
        _film=SimpleNamespace(camera=SimpleNamespace(projection=projection), dx=0.0, dy=0.0),
        _depths=SimpleNamespace(region=region, places=lambda pixel: pixel),
        _numbers=SimpleNamespace(enter=lambda _: 0),
        _keep=lambda _: None,
        of_pairs=lambda pairs, of: kept.append(pairs),
    )
    interval = SimpleNamespace(interval=lambda: (v.one("low"), v.one("high")))
    with (
        mock.patch.object(sweep, "camera_rays", lambda *_: None),
        mock.patch.object(sweep, "plane_fractions", lambda *_: interval),
    ):
        for _ in sweep.Sweep.enter_planes(this):
            pass
    [pairs] = kept
    return pairs.least, pairs.most, pairs.sure


def _enter(v: Inputs) -> Kept:
    """The depth buffer has a winner there, whose nearness is variables."""
    depths = DepthBuffer.__new__(DepthBuffer)
    depths.nearness, depths._most = v.one("winner_least"), v.one("winner_most")
    depths._surface, depths._stale = np.zeros(1, np.int64), np.zeros((1, 1), bool)
    depths.enter(FIRST, np.ones(1, np.int64), v.one("least"), v.one("most"))
    return v.chosen(0, is_path=True), v.chosen(1, is_path=True), depths.nearness


def _theorems(prefix: str, names: str) -> dict[str, str]:
    return named(prefix, names, f"SweepPixels.{prefix}_right")


_PAIRS = "edge inside least most sure"
_PROJECTIONS = (("perspective", PERSPECTIVE), ("parallel", ORTHOGRAPHIC))

RECORDS = (
    Record(
        "block",
        "rasterise._block",
        edges.VALUES | dict(x=5.0, y=6.0, region_x=7.0, region_y=8.0),
        _block,
        _theorems("block", _PAIRS),
        domain=dict.fromkeys(("x", "y", "region_x", "region_y", "origin_x", "origin_y"), _PIXELS),
    ),
    Record(
        "may_be_seen",
        "rasterise._may_be_seen",
        edges.VALUES
        | dict(x=5.0, y=6.0, x_end=9.0, y_end=9.0, region_x=7.0, region_y=8.0, farthest=-1.0),
        _may_be_seen,
        {"may_be_seen": "SweepPixels.may_be_seen_right"},
    ),
    *(
        Record(
            f"clip_{name}",
            "depth_buffer.ClipRange",
            dict(start=0.5, end=100.0, least=0.25, most=0.5),
            lambda v, of=of: _clip(v, of),
            _theorems(f"clip_{name}", "inside outside"),
            of.name,
        )
        for name, of in _PROJECTIONS
    ),
    *(
        Record(
            f"plane_pixel_{name}",
            "sweep.Sweep.enter_planes",
            dict(low=2.0, high=2.5),
            lambda v, of=of: _plane(v, of),
            _theorems(f"plane_pixel_{name}", "least most sure"),
            of.name,
        )
        for name, of in _PROJECTIONS
    ),
    Record(
        "enter",
        "depth_buffer.DepthBuffer.enter",
        dict(winner_least=0.25, winner_most=0.5, least=0.375, most=0.75),
        _enter,
        _theorems("enter", "nearer winner_may_be_nearer nearness"),
        "where it wins, and the winner before is a rival",
    ),
)
