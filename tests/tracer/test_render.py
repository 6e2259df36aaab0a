"""Whole pictures: sampled, cancelled, empty."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
import trimesh
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Region
from reference_tracer.tracer import candidates
from reference_tracer.tracer import render as rendering
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.render import sample_offsets, tiles
from reference_tracer.tracer.settings import Settings


@pytest.mark.parametrize("samples", [1, 2, 3, 5])
def test_samples_are_spread_evenly(samples):
    offsets = np.array(sample_offsets(samples))
    assert offsets.shape == (samples**2, 2)
    assert np.allclose(offsets.mean(axis=0), 0) and np.abs(offsets).max() < 0.5
    assert np.allclose(np.diff(np.unique(offsets[:, 0].round(12))), 1 / samples)


@pytest.mark.parametrize("samples", [1, 2, 4, 8])
@pytest.mark.parametrize("covered", [0.25, 0.5, 0.75])
def test_an_edge_becomes_the_mean(make, samples, covered):
    """A half-plane that covers a share of a column: that share of the samples, and of alpha."""
    camera = make.camera(10, 10, half=5, orthographic=True)
    scene = make.scene(camera, make.quad(-9, covered, -9, 9, -2), background=(0, 0, 0, 0))
    frame = render(scene, Settings(samples=samples))
    exact = covered * samples % 1 == 0
    share = frame.color[:, 5, 3]
    assert np.allclose(share, covered, rtol=0, atol=1e-6 if exact else 0.5 / samples)
    assert np.allclose(frame.color[:, 5], share[:, None] * frame.color[0, 0])
    assert (frame.color[:, :5] == frame.color[0, 0]).all() and (frame.color[:, 6:] == 0).all()


@pytest.mark.parametrize("background", [(0, 0, 0, 0), (0.1, 0.2, 0.3, 1), (0.1, 0.1, 0.1, 0.5)])
@pytest.mark.parametrize("samples", [1, 2])
def test_an_empty_scene_is_its_background(make, background, samples):
    frame = render(make.scene(make.camera(), background=background), Settings(samples=samples))
    assert np.allclose(frame.color, background)
    assert np.isinf(frame.t).all() and frame.rows_done.all() and not frame.cancelled
    for name in ("object_index", "instance_index", "triangle_index"):
        assert (getattr(frame, name) == NOTHING).all()
    assert not (frame.normal.any() or frame.position.any() or frame.barycentrics.any())


@pytest.fixture
def busy(make, monkeypatch):
    """Return a scene whose picture takes many small steps."""
    monkeypatch.setattr(candidates, "PAIRS", 100)
    monkeypatch.setattr(rendering, "BYTES_PER_PIXEL", Settings().memory // (4 * 40))  # 4 rows
    camera = make.camera(40, 30, half=0.3, eye=(2.3, -2.6, 1.9), target=(0, 0, 0))
    torus, box = trimesh.creation.torus(1.0, 0.4), trimesh.creation.box()
    return make.scene(camera, make.mesh(torus), make.mesh(box))


@pytest.mark.parametrize("samples", [1, 2])
def test_progress_rises_to_1_at_the_end(busy, samples):
    shares = []
    render(busy, Settings(samples=samples), progress=shares.append)
    assert len(shares) > 30 * samples
    assert (np.diff(shares) >= 0).all() and shares[0] >= 0
    assert shares[-1] == 1 and max(shares[:-1]) < 1


def test_steps_are_small(busy):
    frame = Frame.empty(busy)
    tested = [0]
    for _ in steps(busy, Settings("moller_trumbore"), frame):
        tested.append(frame.statistics.pairs_tested)
    assert max(np.diff(tested)) <= candidates.PAIRS + busy.camera.region.width
    assert tested[-1] > 20 * candidates.PAIRS
    assert frame.statistics.triangles == busy.triangle_count


@pytest.mark.parametrize("share", [0.0, 0.3, 0.8])
def test_a_cancelled_picture_keeps_its_rows(busy, share):
    whole = render(busy)
    reached = []
    frame = render(busy, progress=reached.append, cancelled=lambda: reached[-1] >= share)
    assert frame.cancelled and max(reached) < 1
    rows = int(frame.rows_done.sum())
    assert frame.rows_done[:rows].all() and rows % 4 == 0
    assert abs(rows / 30 - share) < 0.2
    for name, values in frame.passes().items():
        if name == "rows_done":
            continue
        assert np.array_equal(values[:rows], getattr(whole, name)[:rows])
        assert np.array_equal(values[rows:], getattr(Frame.empty(busy), name)[rows:])


@pytest.mark.parametrize("color", [Color.OBJECT, Color.DEPTH])
def test_a_cancelled_picture_has_no_half_a_band(make, color):
    """A certified one is coloured in steps, once it is known what all of it sees."""
    large, small = (make.quad(-r, r, -r, r, -3) for r in (9, 0.5))  # where both are is a tie
    scene = make.scene(make.camera(120, 90, half=0.5), large, small)
    empty, settings, cancelled = Frame.empty(scene), Settings(color=color), 0
    for most in range(1, 200):
        steps = iter([False] * most + [True] * 999)
        frame = render(scene, settings, cancelled=partial(next, steps))
        if not frame.cancelled:
            break
        undone, cancelled = ~frame.rows_done, cancelled + 1
        assert not any(pixel >= 120 * frame.rows_done.sum() for pixel in frame.ties)
        for name in ("color", "instance_index", "triangle_index", "certainty", "t"):
            values = getattr(frame, name)[undone], getattr(empty, name)[undone]
            assert np.array_equal(*values), (most, name)
    assert cancelled > 5 and len(frame.ties) > 500


def test_tiles_cover_the_region_once(make, monkeypatch):
    monkeypatch.setattr(rendering, "ROWS", 5)
    covered = np.zeros((18, 24), int)
    for tile in tiles(make.camera(24, 18, region=Region(3, 1, 20, 15))):
        covered[tile.y0 : tile.y1, tile.x0 : tile.x1] += 1
    assert (covered[1:15, 3:20] == 1).all() and covered.sum() == 14 * 17
