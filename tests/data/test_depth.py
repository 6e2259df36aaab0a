"""Depths: which are right, by which allowance, and what is named of wrong ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer import compare
from reference_tracer.causes.case import without_colors
from reference_tracer.comparison.comparing import compared
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.manifest import Effect, Unmodelled
from reference_tracer.pictures.given import Making
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.rendering import render
from reference_tracer.scene import SceneError, ViewWindow
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.progress import result_of

from .conftest import CLIP, MOVED, SOME


@pytest.fixture(scope="session")
def lengths(solids, traced):
    rays = camera_rays(solids.camera, *film_positions(solids.camera.region))
    return np.sqrt((rays.directions**2).sum(axis=0)).reshape(traced.shape)


def test_right_depths_agree(judged, traced, lengths):
    for kind, right in (("depth", traced.t), ("distance", traced.t * lengths)):
        for values in (right, right.astype(np.float32), right.astype(np.float16)):
            found = judged(kind, values)
            assert found.verdict == Verdict.AGREE and not found.counts.differ, kind


@pytest.mark.parametrize("nothing", [np.nan, np.inf, 0.0, -1.0, 1e10])
def test_nothing_may_be_written_in_many_ways(judged, traced, nothing):
    values = np.where(np.isfinite(traced.t), traced.t, nothing)
    assert judged("depth", values).verdict == Verdict.AGREE
    hole = values.copy()
    hole[12, 16] = nothing  # but not where something is
    assert judged("depth", hole).counts.unexplained == 1
    beyond = values.copy()
    y, x = np.argwhere(~np.isfinite(traced.t))[0]
    beyond[y, x] = 7.0
    assert judged("depth", beyond).counts.unexplained == 1


def test_each_file_has_its_own_steps(judged, traced):
    right = np.where(np.isfinite(traced.t), traced.t, 0)
    coarse = right.astype(np.float16)
    assert judged("depth", coarse).verdict == Verdict.AGREE
    assert judged("depth", coarse.astype(np.float32)).counts.unexplained > 50
    millimetres = np.rint(1000 * right).astype(np.uint16)
    assert judged("depth", millimetres, scale=0.001).verdict == Verdict.AGREE
    off = millimetres + np.where(right > 0, 1, 0).astype(np.uint16)
    wrong = judged("depth", off, scale=0.001).counts.unexplained
    assert wrong > 0.9 * (right > 0).sum()
    with pytest.raises(SceneError, match="say how many metres 1 is"):
        judged("depth", millimetres)


@pytest.mark.parametrize("unit", [0.001, 1 / 5000, 3.7])
def test_the_steps_of_floats_are_those_before_their_unit(judged, traced, unit):
    for dtype in (np.float16, np.float32):
        stored = (np.nan_to_num(traced.t, posinf=0) / unit).astype(dtype)
        assert judged("depth", stored, scale=unit).verdict == Verdict.AGREE
    coarser = np.nextafter(stored.astype(np.float16), np.float16(np.inf))
    assert judged("depth", coarser, scale=unit).verdict == Verdict.DIFFERENCES


def test_float32_arithmetic_is_allowed_for_and_no_more(judged, solids, traced):
    rays = camera_rays(solids.camera, *film_positions(solids.camera.region), np.float32)
    hits = traced.hits()
    hit = np.flatnonzero(hits.instance >= 0)
    values = np.zeros(traced.shape, np.float32)
    matrices = solids.instance_matrices.astype(np.float32)
    for k in hit:  # Moeller and Trumbore, in float32
        mesh = solids.meshes[solids.instances[hits.instance[k]].mesh]
        m = matrices[:3, :, hits.instance[k]]
        v = mesh.vertices[mesh.triangles[hits.triangle[k]]].astype(np.float32)
        p1, p2, p3 = v @ m[:, :3].T + m[:, 3]
        e1, e2, s = p2 - p1, p3 - p1, rays.origins[:, 0] - p1
        values.flat[k] = e2 @ np.cross(s, e1) / (e1 @ np.cross(rays.directions[:, k], e2))
    own = np.abs(values - traced.t)[values > 0] / np.spacing(values[values > 0])
    assert own.max() > 2  # it is not the nearest float32
    assert judged("depth", values).verdict == Verdict.AGREE
    for off in (1 + 2e-5, 1 - 2e-5):
        assert judged("depth", values * np.float32(off)).counts.unexplained > 150


def _buffer(t, near, far):
    return far / (far - near) * (1 - near / t)


def _stretched(t):
    seen = t[np.isfinite(t)]
    return (t - seen.min()) / np.ptp(seen)


# By fault, what makes a file of depths, of the clip range, and of the lengths of the rays.
WRONG = {
    "distance_for_depth": [lambda t, near, far, length: t * length],
    "data_unit": [lambda t, near, far, length: 1000 * t],
    "data_scale": [lambda t, near, far, length: t / 1.7],
    "depth_buffer": [
        lambda t, near, far, length: _buffer(t, near, far),
        lambda t, near, far, length: 1 - _buffer(t, near, far),
        lambda t, near, far, length: 2 * _buffer(t, near, far) - 1,
    ],
    "depth_normalised": [
        lambda t, near, far, length: (t - near) / (far - near),
        lambda t, near, far, length: 1 - _stretched(t),
        lambda t, near, far, length: (t - 1.3) / 9.7,
        lambda t, near, far, length: (8.2 - t) / 6.9,
    ],
    "inverse_depth": [lambda t, near, far, length: 1 / t],
    "data_sign": [lambda t, near, far, length: -t],
}


EVERY = [("depth", name, of) for name in WRONG for of in WRONG[name]]
EVERY += [("distance", name, WRONG[name][0]) for name in list(WRONG)[1:]]


@pytest.mark.parametrize("kind, fault, of", EVERY, ids=lambda v: v if type(v) is str else "")
def test_a_fault_has_its_name_alone(told, solids, traced, lengths, kind, fault, of):
    right = traced.t if kind == "depth" or fault == "depth_buffer" else traced.t * lengths
    made = of(right, solids.camera.clip_start, solids.camera.clip_end, lengths)
    made = np.where(np.isfinite(traced.t), made, np.nan).astype(np.float32)
    assert told(kind, made, faults=SOME) == [fault]


@pytest.mark.parametrize("levels", [255, 65535])
def test_a_range_is_found_from_integers(judged, traced, levels):
    """Two numbers, to a small part of a step."""
    for zero, one in ((1.3, 11.0), (9.5, 0.25)):
        share = np.where(np.isfinite(traced.t), (traced.t - zero) / (one - zero), 0)
        stored = np.rint(share * levels).astype(np.uint8 if levels == 255 else np.uint16)
        found = judged("depth", stored, scale=1 / levels)
        said = result_of(diagnose(found.case, found.frame, found.causes))
        assert [told.fault.name for told in said.told] == ["depth_normalised"]
        assert np.abs(np.array(said.told[0].guess.values) - (zero, one)).max() < 9 / levels


def test_the_far_planes_value_stands_for_nothing(told, traced, lengths):
    """But not where a wall hides a part of the background, or where some of it is empty."""
    hit = np.isfinite(traced.t)
    assert told("depth", np.where(hit, traced.t, 50.0), faults=SOME) == ["background_value"]
    far = np.where(hit, traced.t * lengths, 50.0)
    assert told("distance", far, faults=SOME) == ["background_value"]
    both = np.where(hit, 1000 * traced.t, 50.0)
    assert sorted(told("depth", both, faults=SOME)) == ["background_value", "data_unit"]
    wall = np.where(~hit & (np.arange(hit.shape[1]) > 6), 50.0, np.where(hit, traced.t, np.nan))
    assert (wall == 50).sum() > 20 and told("depth", wall, faults=SOME) == []
    ramp = np.where(hit, traced.t, 40 + np.arange(hit.shape[1]))
    assert told("depth", ramp, faults=SOME) == []


def test_depths_for_distances(told, traced):
    assert told("distance", traced.t, faults=SOME) == ["depth_for_distance"]


def test_no_name_for_what_is_none_of_these(told, traced, rng):
    values = np.where(np.isfinite(traced.t), traced.t, np.nan)
    assert told("depth", values + rng.uniform(0.01, 0.1, values.shape), faults=SOME) == []
    assert told("depth", values**1.3, faults=SOME) == []
    assert told("depth", values + 0.01, faults=SOME) == []
    assert told("depth", values / 10 + 0.02 * np.sin(9 * values), faults=SOME) == []
    millimetres = np.rint(1000 * np.nan_to_num(values) - 500 * (values > 0)).astype(np.uint16)
    assert told("depth", millimetres, scale=0.001, faults=SOME) == []  # an offset is no range


@pytest.mark.parametrize("kind", ["depth", "distance"])
def test_half_floats_and_cut_off_integers(told, traced, lengths, kind):
    values = np.where(np.isfinite(traced.t), traced.t, 0)
    values = values * (lengths if kind == "distance" else 1)
    half = values.astype(np.float16).astype(np.float32)
    assert told(kind, half, faults=SOME) == ["data_rounded"]
    away = np.where(half > values, np.nextafter(values.astype(np.float16), np.float16(0)), half)
    assert told(kind, away.astype(np.float32), faults=SOME) == ["data_rounded"]
    cut = (1000 * values).astype(np.uint16)
    assert told(kind, cut, scale=0.001, faults=SOME) == ["data_cut_off"]


def test_a_depth_buffers_steps_are_those_of_the_scenes_own_clip_range(told, solids, traced):
    """A guess that nothing is clipped makes the steps of a buffer so large that all depths fit."""
    half = np.where(np.isfinite(traced.t), traced.t, 0).astype(np.float16).astype(np.float32)
    assert told("depth", half, faults=CLIP, making=Making("raster")) == []


def test_a_moved_object_is_named_by_its_depths(told, solids, traced):
    at = np.eye(4)
    at[:3, 3] = 0.05, 0, 0.1
    other = replace(solids.instances[1], world_from_object=at)
    wrong = replace(solids, instances=(solids.instances[0], other, solids.instances[2]))
    assert told("depth", render(wrong).t, faults=MOVED) == ["object_moved"]


def test_an_edge_excuses_what_lies_beside_it_and_nothing_far_from_it(judged, solids, traced):
    """A surface that is seen a pixel away, or lies behind, is not what a pixel shows."""
    t, beside = traced.t, np.roll(traced.t, 1, axis=1)
    away = np.isfinite(t) & np.isfinite(beside)
    away[away] = np.abs(beside[away] - t[away]) > 0.3
    assert away.sum() > 5
    assert judged("depth", np.where(away, beside, t)).counts.unexplained > 5
    behind = render(replace(solids, instances=solids.instances[1:])).t
    found = judged("depth", behind)
    assert found.counts.unexplained == (behind != t).sum()


def test_samples_may_lie_as_far_from_the_centres_as_is_said(judged, solids, make):
    window, camera = solids.camera.window, solids.camera
    shift = 0.2 * (window.right - window.left) / camera.width
    moved = replace(camera, window=window.moved(shift, -shift))
    values = render(solids.seen_by(moved)).t
    right = judged("depth", values, making=Making(filter_radius=0.2))
    assert right.counts.unexplained == 0 and right.counts.by_cause["edge"] > 0
    assert judged("depth", values, making=Making(filter_radius=0.1)).counts.unexplained > 20
    assert judged("depth", values + 0.05, making=Making(filter_radius=0.2)).counts.unexplained > 20


def test_a_buffers_depths_may_be_off_by_its_steps(judged, solids, traced):
    """Of 24 bits, at z: z^2 (f - n) / (f n) 2^-24."""
    near, far = solids.camera.clip_start, solids.camera.clip_end
    level = np.rint((far / (far - near) * (1 - near / traced.t)) * 2**24) / 2**24
    values = near * far / (far - level * (far - near))
    values = np.where(np.isfinite(traced.t), values, 0)
    assert judged("depth", values, making=Making("raster")).verdict == Verdict.AGREE
    off = values + 300 * values**2 / near * 2.0**-24
    assert judged("depth", off, making=Making("raster")).counts.unexplained > 20


def test_colors_that_are_not_modelled_excuse_no_depth(judged, traced, solids):
    case = judged("depth", traced.t + 0.1).case
    light = Unmodelled("Sun", "light", effect=Effect.LIGHT)
    glass = Unmodelled("Ball", "glass", effect=Effect.COLOR)
    hair = Unmodelled("Ball", "hair", bounds=np.array([[-9, -9, -9], [9, 9, 9.0]]))
    for some, blind in (((light, glass), 0), ((hair,), 1)):
        manifest = replace(case.manifest, unmodelled=some)
        found = result_of(compared(without_colors(replace(case, manifest=manifest))))
        assert (found.counts.unexplained == 0) == bool(blind)
        assert bool(found.counts.not_judged.pixels) == bool(blind)


@pytest.mark.parametrize("parallel", [False, True], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("renderer", ["rays", "raster"])
def test_a_camera_without_a_clip_end_allows_no_more(solids, renderer, parallel):
    camera = replace(solids.camera, clip_end=np.inf)
    if parallel:
        window = ViewWindow(-2, 2, -1.5, 1.5)
        camera = replace(camera, projection=ORTHOGRAPHIC, window=window)
    endless = replace(solids, camera=camera)
    right = render(endless).t
    shown = right.astype(np.float32)
    assert compare(endless, shown, kind="depth", renderer=renderer).verdict == Verdict.AGREE
    before_nothing = np.where(np.isfinite(right), shown, 2.5)
    for wrong in (before_nothing, shown + np.float32(0.5)):
        found = compare(endless, wrong, kind="depth", renderer=renderer, diagnose=False)
        assert found.counts.unexplained > 50


def test_depths_of_a_scene_with_nothing_are_compared(solids):
    nothing = replace(solids, instances=())
    shape = solids.camera.height, solids.camera.width
    found = compare(nothing, np.full(shape, 3.0, np.float32), kind="depth")
    assert found.counts.unexplained == found.counts.total
