"""Arithmetic that others switch between two steps makes no wrong certified pixel: the picture goes.

The scenes are those at the ends of float64, where flushing to zero would show.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import any_rays, arithmetic
from reference_tracer.certified.arithmetic import AssumptionError
from reference_tracer.certified.sweep.sweep import Sweep
from reference_tracer.projections import EQUIRECTANGULAR
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Scene
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.settings import Settings

from .modes import MODES, ON_X86, switch, switched_back
from .test_ends_of_float64 import scene_at

pytestmark = ON_X86
TOLD = 94, 167, 209, 346  # seeds where a pixel would be wrong if no step looked
LENGTHS = (-500, -512, -520, -340, 0)


def disturbed(scene: Scene, settings: Settings, at: int, mode: int, back: int) -> Frame:
    """Return a frame that is traced so: a mode is switched on before step `at`, off before another.

    It is empty where tracing was refused.
    """
    frame = Frame.empty(scene)
    with switched_back():
        try:
            if at == 0:
                switch(mode)
            for number, _ in enumerate(steps(scene, settings, frame), 1):
                if number == at:
                    switch(mode)
                if number == back:
                    switch(0)
        except AssumptionError as error:
            assert "lacks rounding to" in str(error) or "lacks subnormal" in str(error)
            nothing_is_left(frame)
    return frame


def nothing_is_left(frame: Frame) -> None:
    assert not frame.rows_done.any() and not frame.color.any() and not frame.ties
    assert (frame.certainty == Certainty.NOT_CERTIFIED).all()
    assert (frame.instance_index == -1).all() and np.isinf(frame.t).all()


def certified(frame: Frame) -> list[bytes]:
    """Return what is certified of a frame, in bytes."""
    names = "instance_index", "triangle_index", "certainty", "t"
    return [getattr(frame, name).tobytes() for name in names]


def hold(make, seeds) -> tuple[int, int]:
    """Trace a scene for each seed with something switched; returns how many stay, and go."""
    stay = go = 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        scene = scene_at(make, rng, int(rng.choice(LENGTHS)), 0, bool(rng.integers(2)))
        method, samples = rng.choice(("certified", "auto")), int(rng.choice((1, 1, 2, 3)))
        settings = Settings(str(method), samples=samples)
        alone = Frame.empty(scene)
        count = sum(1 for _ in steps(scene, settings, alone))
        at = int(rng.integers(count))
        back = at + int(rng.integers(3))  # 0: before anything is computed
        frame = disturbed(scene, settings, at, int(rng.choice(list(MODES.values()))), back)
        if back in (0, at) and at:
            assert certified(frame) == certified(alone)
        is_certified = (frame.certainty != Certainty.NOT_CERTIFIED).any()
        if is_certified:
            assert certified(frame) == certified(alone)
            stay += 1
        else:
            assert method == "certified" or at == 0 or frame.statistics.notes
            go += 1
    return stay, go


def test_no_certified_pixel_is_wrong(make):
    stay, go = hold(make, [*range(60), *TOLD])
    assert stay > 15 and go > 25


@pytest.mark.torture
def test_no_certified_pixel_is_wrong_in_10000_scenes(make):
    stay, go = hold(make, range(10_000))
    assert stay > 2000 and go > 4000


@pytest.mark.parametrize("mode", MODES)
def test_every_step_is_looked_at(make, mode):
    """A mode is noticed that is on before any step; not one that is off again by then."""
    scene = make.room()
    alone = render(scene, Settings("certified"))
    count = sum(1 for _ in steps(scene, Settings("certified"), Frame.empty(scene)))
    wanted = certified(alone)
    # What is decided is decided before colours are made of it, in the last steps.
    for at in range(1, count, 1 + count // 12):
        frame = disturbed(scene, Settings("certified"), at, MODES[mode], count + 1)
        assert not frame.rows_done.any() or certified(frame) == wanted
        frame = disturbed(scene, Settings("certified"), at, MODES[mode], at)
        assert certified(frame) == wanted


def test_without_looking_pixels_would_be_wrong(make, monkeypatch):
    """The counter-example: the test above would find wrong pixels, if there were any."""
    monkeypatch.setattr(arithmetic, "_check_modes", lambda: None)
    with pytest.raises(AssertionError):
        hold(make, TOLD)


def test_t_is_refused_as_long_as_it_is_switched(make):
    scene = make.room()
    wanted = render(scene, Settings("certified")).t
    frame = render(scene, Settings("certified"))
    with switched_back():
        switch(MODES["up"])
        with pytest.raises(AssumptionError, match="rounding to nearest"):
            _ = frame.t
    assert np.array_equal(frame.t, wanted)


def test_what_a_step_itself_switches_is_found_at_its_end(make, monkeypatch):
    """As a library does that is called meanwhile, or a thread's destructor."""
    scene = make.room()
    frame = Frame.empty(scene)
    find = Sweep.of_pairs

    def switching(*args):
        switch(MODES["both"])
        return find(*args)

    monkeypatch.setattr(Sweep, "of_pairs", switching)
    with switched_back(), pytest.raises(AssumptionError, match="subnormal"):
        for _ in steps(scene, Settings("certified"), frame):
            pass
    nothing_is_left(frame)


def test_auto_begins_again_without_a_proof(make):
    scene = make.room()
    frame = disturbed(scene, Settings("auto"), 5, MODES["both"], 10**6)
    plain = render(scene, Settings("watertight"))
    assert frame.statistics.method == "watertight" and frame.rows_done.all()
    assert (frame.certainty == Certainty.NOT_CERTIFIED).all() and not frame.ties
    assert np.array_equal(frame.instance_index, plain.instance_index)
    assert np.array_equal(frame.t, plain.t) and np.array_equal(frame.color, plain.color)
    [note] = frame.statistics.notes
    assert note.startswith("traced by watertight in float64") and "subnormal" in note


def test_a_panorama_and_any_rays_are_looked_at_too(make):
    camera = make.camera(40, 20, projection=EQUIRECTANGULAR)
    scene = make.scene(camera, make.quad(-9, 9, -9, 9.3, -2))
    assert not disturbed(scene, Settings("certified"), 2, MODES["up"], 10**6).rows_done.any()
    rays = Rays(np.zeros((3, 5)), np.ones((3, 5)))
    work = any_rays.trace_rays(scene, rays, Settings("certified"), Frame.empty(scene).statistics)
    next(work)
    with switched_back(), pytest.raises(AssumptionError):
        switch(MODES["flush"])
        next(work)
    corners = np.eye(3)[..., None].repeat(5, axis=2)
    assert any_rays.decide(rays, corners).crossed.all()
    with switched_back(), pytest.raises(AssumptionError):
        switch(MODES["down"])
        any_rays.decide(rays, corners)
