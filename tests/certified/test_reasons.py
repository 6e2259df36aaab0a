"""Why integers had to decide: each reason in a scene that was built for it."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from reference_tracer.certainty import Reason, sentences
from reference_tracer.certified.reasons import of_doubts
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.settings import Settings

pytestmark = pytest.mark.filterwarnings("error")
ULP = 2.0**-52


def turned(rng, points, triangles):
    """Return a mesh, and axes in which its numbers are round ones, but for rounding."""
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = np.array(points, float)
    x, y, z = (
        points[:, :1] * axes[:, 0] + points[:, 1:2] * axes[:, 1] + points[:, 2:] * axes[:, 2]
    ).T
    return Mesh(np.stack((x, y, z), axis=1), triangles), axes


def reasons_of(make, rng, points, triangles, turn=True, **options):
    """Return why a 4 x 4 picture of triangles needed integers.

    The rays of the orthographic camera pass x, y = -1.5, -0.5, 0.5, 1.5.
    """
    mesh, axes = turned(rng, points, triangles)
    if not turn:
        mesh, axes = Mesh(np.array(points, float), triangles), np.eye(3)
    options = {"half": 2, "orthographic": True} | options
    if "distance" in options:
        options["eye"] = axes @ (0, 0, options.pop("distance"))
    camera = make.camera(4, 4, axes=axes, **options)
    return render(make.scene(camera, mesh), Settings("certified")).statistics.reasons


DIAGONAL = [(-9, -9, -2), (9, -9, -2), (9, 9, -2), (-9, 9, -2)], [[0, 1, 2], [0, 2, 3]]
SLANTED = [(-9, -8.3, -2), (9.1, -9, -2), (8.7, 9, -2)], [[0, 1, 2]]


def test_nothing_unusual(make, rng):
    assert not reasons_of(make, rng, *SLANTED)


def test_edge(make, rng):
    assert set(reasons_of(make, rng, *DIAGONAL, turn=False)) == {Reason.EDGE}


def test_near_edge(make, rng):
    found = reasons_of(make, rng, *DIAGONAL)
    assert found[Reason.NEAR_EDGE] and set(found) <= {Reason.NEAR_EDGE, Reason.EDGE}


def test_far(make, rng):
    """From a million kilometres: within rounding error is a good part of a metre's edge."""
    window = {"half": 2e-9, "orthographic": False, "clip_end": 1e10}
    found = reasons_of(make, rng, *DIAGONAL, distance=1e9, **window)
    assert found[Reason.FAR] and set(found) <= {Reason.FAR, Reason.EDGE}


def test_thin(make, rng):
    points = [(-9, 0.5, -2), (9, 0.5, -2), (0, 0.5 + 1e-7, -2), (0, 0.5 - 1e-7, -2)]
    found = reasons_of(make, rng, points, [[0, 1, 2], [1, 0, 3]])
    assert found[Reason.THIN] and set(found) <= {Reason.THIN, Reason.EDGE}


@pytest.mark.parametrize("turn", [False, True])
def test_edge_on(make, rng, turn):
    """A triangle along the rays, and through some of them."""
    found = reasons_of(make, rng, [(0.5, -9, -2), (0.5, 9, -2), (0.5, 0, -9)], [[0, 1, 2]], turn)
    assert set(found) == {Reason.EDGE_ON}


def test_edge_on_plane(make, rng):
    """An infinite plane in which some of the rays run, but for rounding."""
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    camera = make.camera(4, 4, half=2, orthographic=True, axes=axes)
    scene = make.scene(camera, planes=[(axes[:, 0] * 0.5, axes[:, 0])])
    reasons = render(scene, Settings("certified")).statistics.reasons
    assert set(reasons) == {Reason.EDGE_ON}


@pytest.mark.parametrize("turn", [False, True])
def test_coplanar(make, rng, turn):
    points, _ = SLANTED
    found = reasons_of(make, rng, points, [[0, 1, 2], [1, 2, 0]], turn)
    assert set(found) == {Reason.COPLANAR}


def test_close(make, rng):
    """A second surface behind the first, nearer than a rounding error of t."""
    points, _ = SLANTED
    behind = [(x, y, z * (1 + 2 * ULP)) for x, y, z in points]
    found = reasons_of(make, rng, points + behind, [[0, 1, 2], [3, 4, 5]], turn=False)
    assert set(found) == {Reason.CLOSE}


@pytest.mark.parametrize("clip", [(2, 9), (1, 2)])
def test_clip(make, rng, clip):
    found = reasons_of(make, rng, *SLANTED, turn=False, clip_start=clip[0], clip_end=clip[1])
    assert set(found) == {Reason.CLIP}


def test_extreme_lengths():
    """Lengths that float64 cannot subtract."""
    corners = 1.7e308 * np.array([[1.0, -1, -1], [-1, 1, -1], [0, 1, -1]])[:, :, None]
    rays = Rays(np.array([[-1.0], [1], [1]]) * 1.7e308, np.array([[1.0], [0], [0]]))
    assert list(Reason)[of_doubts(rays, corners).item()] is Reason.EXTREME


def test_extreme_scale(make, rng):
    points, triangles = SLANTED
    scale = 2.0**-400
    found = reasons_of(
        make,
        rng,
        np.array(points) * scale,
        triangles,
        orthographic=False,
        clip_start=scale,
        clip_end=9 * scale,
    )
    assert set(found) == {Reason.EXTREME}


def test_sentences_are_readable():
    counts = Counter({reason: 1000 * (k + 1) for k, reason in enumerate(Reason)})
    first, *lines = sentences(10_000_000, counts)
    assert first.startswith("45,000 of 10,000,000 pairs of a ray and a surface")
    assert first.endswith("rays that") and len(lines) == len(Reason)
    numbers = [int(line.rsplit(": ", 1)[1].replace(",", "")) for line in lines]
    assert numbers == sorted(numbers, reverse=True) and sum(numbers) == 45_000
    assert all(any(reason.value in line for line in lines) for reason in Reason)
    assert len({reason.value for reason in Reason}) == len(Reason)
    for reason in Reason:  # each ends "rays that ..."
        assert reason.value.split()[0] in ("meet", "pass", "have")


@pytest.mark.parametrize("counts", [Counter(), Counter({Reason.EDGE: 0})])
def test_nothing_needed_is_a_sentence_of_its_own(counts):
    [line] = sentences(1234, counts)
    assert "1,234" in line and "decided by the error bound" in line


def test_no_more_pairs_are_exact_than_there_are(make):
    scene = make.scene(make.camera(4, 4), planes=[((0, 0, -2), (0, 0, 1)), ((0, 0, -2), (0, 0, 2))])
    statistics = render(scene, Settings("certified")).statistics
    assert 0 < statistics.pairs_exact <= statistics.pairs_tested
