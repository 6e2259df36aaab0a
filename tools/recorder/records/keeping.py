"""Candidates that are kept or dropped by what is in front: `ladder.py`, `sweep/`."""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified import ladder
from reference_tracer.certified.ladder import Ladder
from reference_tracer.certified.measures import Prepared
from reference_tracer.certified.sweep.boxes import InstanceBoxes
from reference_tracer.certified.sweep.depth_buffer import DepthBuffer, Fragments
from reference_tracer.certified.sweep.rasterise import Covered
from reference_tracer.certified.sweep.sweep import Sweep
from reference_tracer.projections import PERSPECTIVE
from reference_tracer.tracer import camera
from reference_tracer.tracer.camera import Rays

from . import film
from .record import Inputs, Kept, Record, named

_HIT = dict(low=2.0, high=2.5, start=0.5, end=100.0, farthest=3.0, sure=True)
_PAIR = dict(least=0.5, most=0.75, nearness=0.625, inside=True, outside=False, sure=True)
_RAYS = dict(x1=0.5, y1=-1.5, z1=0.25, x2=-0.75, y2=2.5, z2=1.25)


def _candidates(v: Inputs) -> Kept:
    """t's interval is variables: `Fractions.interval` and `in_range` are recorded by themselves."""
    own = Ladder.__new__(Ladder)
    own._clip, own._farthest = (v.scalar("start"), v.scalar("end")), v.one("farthest")
    fractions = SimpleNamespace(interval=lambda: (v.one("low"), v.one("high")))
    own._candidates(v.rows, v.rows, fractions, v.one("sure"))
    return v.chosen(1, is_path=True), v.chosen(2), own._farthest


def _prepare(v: Inputs, shares_origin: bool) -> Kept:
    """Of two rays around all others: `corner_rays` has four."""
    several = v.stacked([v.vector(f"{k}1 {k}2").reshape(-1) for k in "xyz"])
    one = np.zeros((3, 1))
    own = Ladder.__new__(Ladder)
    own._around = Rays(one, several) if shares_origin else Rays(several, one)
    with (
        mock.patch.object(ladder, "FromPoint", lambda _, reach, __: [reach]),
        mock.patch.object(ladder, "Parallel", lambda _, low, high, __: [low, high]),
    ):
        return (value for vector in own._prepare(None) for value in vector)


def _corner_rays(v: Inputs) -> Kept:
    with mock.patch.object(camera, "camera_rays", lambda _, px, py: (px, py)):
        found = camera.corner_rays(film.camera(v, PERSPECTIVE), v.scalar("dx"), v.scalar("dy"))
    return (values[n : n + 1] for values in found for n in range(4))


def _of_pairs(v: Inputs, prefix: str) -> Kept:
    """Whether the nearness is in the clip range is given: `ClipRange` is recorded by itself."""
    nothing = Fragments(*(np.zeros(0) for _ in range(3)))
    own = SimpleNamespace(
        _statistics=SimpleNamespace(pairs_tested=0),
        _clip=SimpleNamespace(
            inside=lambda *_: v.one("inside"), outside=lambda *_: v.one("outside")
        ),
        _depths=SimpleNamespace(nearness=v.one("nearness"), enter=lambda *_: [nothing]),
    )
    pairs = Covered(v.rows, v.rows, v.one("least"), v.one("most"), v.one("sure"))
    with mock.patch.object(Fragments, "joined", lambda parts: parts):
        Sweep.of_pairs(own, pairs, v.rows)
    if v.values["sure"]:
        return {f"{prefix}_enters": v.chosen(0, is_path=True)}
    return {f"{prefix}_stays": v.chosen(2)}


def _taken(v: Inputs) -> Kept:
    """t by `quotient.py`, and the barycentrics, which are NaN where they are not known."""
    own = Prepared.__new__(Prepared)
    own._quotients = SimpleNamespace(meet=lambda *_: (v.one("t"), v.one("sure")))
    own._planes, own._edges = 0, np.zeros((10, v.columns))
    with mock.patch.object(Prepared, "_weights", lambda *_: v.vector("s1 s2 s3")):
        _, sure, _ = own.meet(None, v.rows)
    return [sure]


def _hidden(v: Inputs) -> Kept:
    own = InstanceBoxes(
        None, None, np.zeros((2, v.columns)), np.zeros((2, v.columns)), v.one("nearest")
    )
    region = SimpleNamespace(x0=0, x1=1, y0=0, y1=1)
    depths = SimpleNamespace(region=region, farthest_around=lambda *_: v.scalar("farthest"))
    return [own.hidden(v.rows, depths)]


def _not_hidden(v: Inputs) -> Kept:
    own = SimpleNamespace(_depths=SimpleNamespace(farthest_in=lambda *_: v.one("farthest")))
    Sweep.not_hidden(own, None, None, v.one("nearest"))
    return [v.chosen(0)]


def _fragment(v: Inputs) -> Kept:
    depths = DepthBuffer.__new__(DepthBuffer)
    depths.nearness = v.one("nearness")
    depths.not_hidden(Fragments(v.rows, v.rows, v.one("nearest")))
    return [v.chosen(0)]


_HIDDEN = dict(nearest=0.5, farthest=0.25)
RECORDS = (
    *(
        Record(
            name,
            "ladder.Ladder._candidates",
            _HIT | dict(sure=sure),
            _candidates,
            named(name, "certain kept farthest", "CodeRange.candidates_is"),
            note,
        )
        for name, sure, note in (
            ("candidate_sure", True, "what is sure"),
            ("candidate_open", False, "what is in doubt"),
        )
    ),
    Record(
        "around_directions",
        "ladder.Ladder._prepare",
        _RAYS,
        lambda v: _prepare(v, True),
        named("around", "reach_x reach_y reach_z", "AroundRays.reach_is"),
        "rays from one point, two of them",
    ),
    Record(
        "around_origins",
        "ladder.Ladder._prepare",
        _RAYS,
        lambda v: _prepare(v, False),
        named("around", "low_x low_y low_z high_x high_y high_z", "AroundRays.box_is"),
        "parallel rays, two of them",
    ),
    Record(
        "corner_ray",
        "camera.corner_rays",
        dict(width=640.0, height=480.0, dx=0.125, dy=-0.25),
        _corner_rays,
        named("corner_ray", "px0 px1 px2 px3 py0 py1 py2 py3", "AroundRays.between_corners"),
        "film positions",
        film.DOMAIN,
    ),
    *(
        Record(
            name,
            "sweep.Sweep.of_pairs",
            _PAIR | dict(sure=sure),
            lambda v, name=name: _of_pairs(v, name),
            named(name, "enters stays", "Cells.all_kept"),
            note,
        )
        for name, sure, note in (
            ("pair", True, "what is sure"),
            ("pair_open", False, "what is in doubt"),
        )
    ),
    Record(
        "taken_as_it_is",
        "measures.Prepared.meet",
        dict(t=2.5, sure=True, s1=0.5, s2=0.25, s3=0.25),
        _taken,
        {"taken_as_it_is": "CodeRange.taken_is_finite"},
    ),
    Record(
        "hidden_instance",
        "boxes.InstanceBoxes.hidden",
        _HIDDEN,
        _hidden,
        {"hidden_instance": "Cells.least_is_bound"},
    ),
    Record(
        "not_hidden_box",
        "sweep.Sweep.not_hidden",
        _HIDDEN,
        _not_hidden,
        {"not_hidden_box": "Cells.around_large"},
    ),
    Record(
        "not_hidden_fragment",
        "depth_buffer.DepthBuffer.not_hidden",
        dict(nearest=0.5, nearness=0.25),
        _fragment,
        {"not_hidden_fragment": "Sweep.sweep_sees_what_plain_does"},
    ),
)
