"""No step of the checks is long: its work, counted in pairs and in numbers, is bounded."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
import trimesh
from reference_tracer.causes import hull
from reference_tracer.causes.checks import color as coloring
from reference_tracer.causes.checks import coverage, parts, probe
from reference_tracer.causes.explain import explain
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.rendering import render
from reference_tracer.tracer import candidates, nearest
from reference_tracer.tracer import render as rendering
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ...cases import case_of

BOUNDS = {"pairs": 256, "numbers": 1 << 16, "pixels": 256}


@pytest.fixture
def work(monkeypatch):
    """Count what is done between two yields, with bounds so low that a small scene meets them."""
    done = Counter()
    test_pairs, pair, other_color = nearest.test_pairs, hull._pair, Picture.other_color

    def counted_pairs(scene, settings, rays, some, *hits):
        done["pairs"] += len(some.pixel)
        return test_pairs(scene, settings, rays, some, *hits)

    def counted_numbers(points, *others):
        done["numbers"] += points.size
        return pair(points, *others)

    def counted_pixels(self, colors, *others):
        done["pixels"] += colors[..., 0].size
        return other_color(self, colors, *others)

    for module in (probe, coverage):
        monkeypatch.setattr(module, "test_pairs", counted_pairs)
    monkeypatch.setattr(hull, "_pair", counted_numbers)
    monkeypatch.setattr(Picture, "other_color", counted_pixels)
    for module in (candidates, probe):
        monkeypatch.setattr(module, "PAIRS", BOUNDS["pairs"])
    monkeypatch.setattr(hull, "STEP", BOUNDS["numbers"] // 4)
    monkeypatch.setattr(probe, "BLOCK", BOUNDS["pixels"])
    monkeypatch.setattr(coloring, "ENOUGH", BOUNDS["pixels"])
    monkeypatch.setattr(rendering, "ROWS", 8)
    monkeypatch.setattr(parts, "FEW", 64)
    return done


@pytest.mark.slow
@pytest.mark.parametrize("radius", [1.5, 0.0], ids=["a filter", "one sample"])
def test_a_step_is_bounded_whatever_differs(make, work, radius):
    """A fine mesh of which every pixel differs: nothing is drawn in one long step."""
    ball = trimesh.creation.icosphere(3, radius=1.0)
    camera = make.camera(20, 15, half=0.5, eye=(0.1, 0.2, 3), clip_end=100)
    scene = make.scene(camera, make.mesh(ball), make.quad(-9, 9, -9, 9, -4))
    settings = Settings("moller_trumbore")
    color = render(scene, replace(settings, samples=2)).color.copy()
    color[::3] = (0.3, 0.9, 0.1, 1)
    color[1::3] = color[1, 0]  # of what is behind the ball
    picture = Picture(color, sampling=Sampling(filter_radius=radius))
    frame, longest, total = render(scene, settings), Counter(), Counter()

    def between(_):
        for kind, amount in work.items():
            longest[kind] = max(longest[kind], amount)
        total.update(work)
        work.clear()

    case = case_of(scene, picture, settings=settings, curves=())
    found = result_of(explain(case, frame), between).causes
    assert (found.cause != 0).sum() > 100
    kinds = ("pairs", "numbers", "pixels") if radius else ("pairs", "pixels")
    for kind in kinds:
        assert longest[kind] <= BOUNDS[kind] < total[kind] / 4, (kind, longest, total)
