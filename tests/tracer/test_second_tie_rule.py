"""Two tie rules, written apart, find the same pixels ambiguous, and notice where they do not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import ladder, ties
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer.settings import Settings

from .hostile_scenes import hostile_scene
from .pictures import mess
from .second_tie_rule import compared

EXERCISE = sorted((Path(__file__).parents[2] / "packages" / "grading" / "scenes").glob("*.npz"))
CAMERAS = pytest.mark.parametrize("orthographic", [False, True], ids=["persp", "ortho"])


def ambiguous(scene: Scene) -> int:
    """Assert that both rules say the same; return how many pixels are ambiguous."""
    frame = render(scene, Settings("certified"))
    assert not compared(scene, frame)
    return int((frame.certainty == Certainty.AMBIGUOUS).sum())


def fan(make, rng, orthographic: bool) -> Scene:
    """A fan around a corner that a ray meets, closed or open, its spokes through other pixels."""
    count, depth = int(rng.integers(3, 14)), -4.0
    angles = np.sort(rng.uniform(0, 2 * np.pi, count))
    rim = np.round(64 * np.stack((np.cos(angles), np.sin(angles)), axis=1)) / 32
    vertices = np.array([(0, 0), *rim, *rng.integers(-2, 3, (4, 2))])
    vertices = np.c_[vertices, np.full(len(vertices), depth)]
    spokes = [(0, 1 + k, 1 + (k + 1) % count) for k in range(count - int(rng.integers(2)))]
    loose = rng.integers(0, len(vertices), (3, 3))
    camera = make.camera(9, 7, half=3.5 if orthographic else 0.875, orthographic=orthographic)
    return make.scene(camera, Mesh(vertices, [*spokes, *loose]))


def cubes(make, rng, orthographic: bool) -> Scene:
    """Cubes with whole corners, faces against one another and through one another."""
    corners = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, 8).T * 1.0
    faces = [(k, k ^ a, k ^ a ^ b) for a, b in ((1, 2), (2, 4), (4, 1)) for k in range(8)]
    cube = Mesh(corners, faces)  # each face from each of its corners: they overlap
    instances = []
    for _ in range(6):
        matrix = np.diag((*rng.integers(1, 3, 3) * 1.0, 1.0))
        matrix[:3, 3] = *rng.integers(-2, 2, 2), rng.integers(-6, -3)
        instances.append(Instance(0, 0, matrix))
    half = 2.0 if orthographic else 0.5
    camera = make.camera(
        8, 8, half=half, orthographic=orthographic, eye=rng.choice([0, 0.25, 0.5], 3),
        clip_start=float(rng.choice([1, 2, 3])), clip_end=float(rng.choice([4, 5, 100])),
    )  # fmt: skip
    return Scene(camera, [cube], instances, objects=("Cubes",))


def crossing(make, rng, orthographic: bool) -> Scene:
    """Quads through one line in pixels' centres, so that their depths tie there."""
    quad = make.quad(-3, 3, -3, 3, 0)
    instances = []
    for slope in rng.choice([-2.0, -0.5, 0.0, 0.25, 1.0], 4):
        matrix = np.eye(4)
        matrix[2, :2], matrix[:3, 3] = (slope, slope * rng.integers(2)), (0, 0, -4)
        instances.append(Instance(0, 0, matrix))
    camera = make.camera(7, 7, half=1.75 if orthographic else 0.4375, orthographic=orthographic)
    return Scene(camera, [quad], instances, objects=("Quads",))


def planes(make, rng, orthographic: bool) -> Scene:
    """Coincident quads and tilted ones, some twice."""
    quad = make.quad(-9, 9, -9, 9, -5)
    tilted = [np.eye(4) + 0.02 * np.eye(4, k=k) for k in (0, 0, 0, 2, 2, -2)]
    instances = [Instance(0, 0, tilted[k]) for k in rng.permutation(6)]
    scene = make.scene(make.camera(8, 6, orthographic=orthographic, half=1.5), quad)
    return replace(scene, instances=instances)


def messes(make, rng, orthographic: bool) -> Scene:
    """Whole corners, infinite planes, and clip ends at surfaces."""
    return mess(make, rng, orthographic, whole=True)


@CAMERAS
@pytest.mark.parametrize("build", [fan, cubes, crossing, planes, messes])
def test_built_to_tie(make, build, orthographic):
    counts = [ambiguous(build(make, np.random.default_rng(s), orthographic)) for s in range(4)]
    assert sum(counts) > 15, counts


def test_hostile_scenes(make):
    found = [ambiguous(hostile_scene(make, np.random.default_rng(seed))) for seed in range(24)]
    assert sum(n > 0 for n in found) > 4


@pytest.mark.slow
@pytest.mark.parametrize("path", EXERCISE, ids=lambda p: p.stem)
def test_the_exercise(path):
    scene = load_scene(path)
    small = replace(scene.camera, width=20, height=15, region=None)
    ambiguous(scene.seen_by(small))


@CAMERAS
def test_a_missing_or_extra_pixel_is_noticed(make, rng, orthographic):
    scene = cubes(make, rng, orthographic)
    frame = render(scene, Settings("certified"))
    is_tie = frame.certainty == Certainty.AMBIGUOUS
    for some, other in ((is_tie, Certainty.EXACT), (~is_tie, Certainty.AMBIGUOUS)):
        pixel = int(rng.choice(np.flatnonzero(some)))
        kept = frame.certainty.flat[pixel]
        frame.certainty.flat[pixel] = other
        assert [k for k, _ in compared(scene, frame)] == [pixel]
        frame.certainty.flat[pixel] = kept
    assert not compared(scene, frame)


@CAMERAS
def test_another_rule_is_noticed(make, monkeypatch, orthographic):
    """Silhouettes that are taken for sure; rays that are moved one way alone."""
    rule, ways = ties.seen_and_ties, ties._ways

    def sure_at_silhouettes(hits):
        seen, found = rule(hits)
        return seen, found if len(hits) > 1 else frozenset()

    builds = [(build, seed) for build in (fan, cubes) for seed in range(3)]
    scenes = [build(make, np.random.default_rng(seed), orthographic) for build, seed in builds]
    for module, name, wrong in (
        (ladder, "seen_and_ties", sure_at_silhouettes),
        (ties, "_ways", lambda hits: ways(hits)[:1]),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(module, name, wrong)
            assert any(compared(s, render(s, Settings("certified"))) for s in scenes), name
