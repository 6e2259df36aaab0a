"""The definition: as a contest of every ray with every triangle; and the sweep is equal to it."""

from __future__ import annotations

from collections import Counter
from itertools import product

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import plain
from reference_tracer.certified.sweep.sweep import sweep
from reference_tracer.scene import Mesh
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.progress import result_of

from ..sampled import sampled
from ..tracer.hostile_scenes import brute_force, hostile_scene, offsets, scaled
from ..tracer.pictures import mess

pytestmark = pytest.mark.filterwarnings("error")
CORNERS = np.array(list(product((-2, 2), repeat=3)))  # of a cube
TRIANGLES = [
    (0, 1, 3),
    (0, 3, 2),
    (4, 6, 7),
    (4, 7, 5),
    (0, 4, 5),
    (0, 5, 1),
    (2, 3, 7),
    (2, 7, 6),
    (0, 2, 6),
    (0, 6, 4),
    (1, 5, 7),
    (1, 7, 3),
]
SEEDS = 75  # in a part
PARTS = [
    0,
    *(pytest.param(part, marks=pytest.mark.torture) for part in range(1, 8)),
]
MEMORY = 64 << 20


def both(scene, beside=(0.0, 0.0)) -> tuple[Hits, Hits]:
    given = scene, scene.camera.region, MEMORY, *beside
    return result_of(sweep(*given)), result_of(plain.plain(*given))


def assert_equal(swept: Hits, defined: Hits, what) -> None:
    """To the bit; but what the bounds of one prove, those of the other may leave to integers.

    Where either did, the barycentrics are rounded in another order.
    """
    for name in ("t", "instance", "triangle"):
        assert getattr(swept, name).tobytes() == getattr(defined, name).tobytes(), (what, name)
    assert swept.ties == defined.ties, what
    proven = np.stack((swept.certainty, defined.certainty))
    assert np.isin(proven[:, proven[0] != proven[1]], (Certainty.BOUND, Certainty.EXACT)).all(), (
        what
    )
    alike = (proven == Certainty.BOUND).all(axis=0)
    assert swept.s[:, alike].tobytes() == defined.s[:, alike].tobytes(), what
    np.testing.assert_allclose(swept.s, defined.s, rtol=0, atol=1e-6, err_msg=str(what))


@pytest.mark.parametrize("part", PARTS)
def test_the_sweep_is_equal_on_hostile_scenes(make, part):
    count = Counter()
    for seed in range(40_000 + part * SEEDS, 40_000 + (part + 1) * SEEDS):
        rng = np.random.default_rng(seed)
        scene, beside = hostile_scene(make, rng, finite=seed % 8 < 2), offsets(rng)
        if seed % 8 < 2:
            scene = scaled(scene, 2.0 ** rng.choice([-330, -150, 150, 330]))
        swept, defined = both(scene, beside)
        assert_equal(swept, defined, seed)
        count["pixels"] += len(swept.t)
        count["same"] += (swept.certainty == defined.certainty).sum()
        count["hits"] += (swept.instance != NOTHING).sum()
        for certainty in Certainty:
            count[certainty.name] += (defined.certainty == certainty).sum()
    assert count["NOT_CERTIFIED"] == 0 and count["same"] > 0.9 * count["pixels"], count
    assert min(count[c] for c in ("hits", "BOUND", "EXACT", "AMBIGUOUS")) > 50, count


@pytest.mark.parametrize("whole", [False, True], ids=["any", "coincident"])
@pytest.mark.parametrize("orthographic", [False, True])
def test_the_sweep_is_equal_on_a_mess(make, rng, orthographic, whole):
    """Instances through one another and twice, planes twice, the clip range amid them."""
    for _ in range(3):
        scene = mess(make, rng, orthographic, whole)
        for beside in ((0.0, 0.0), (1 / 3, -1 / 3)):
            assert_equal(*both(scene, beside), beside)


def test_the_sweep_is_equal_from_inside_a_closed_surface(make, rng):
    for orthographic in (False, True):
        camera = make.camera(40, 30, orthographic=orthographic, clip_start=1e-3)
        scene = make.scene(camera, Mesh(CORNERS, TRIANGLES))
        swept, defined = both(scene)
        assert_equal(swept, defined, orthographic)
        assert (swept.instance == 0).all()


@pytest.mark.slow
@sampled(2)
@pytest.mark.parametrize("rows", [1, 3])
def test_as_a_contest_of_every_ray_with_every_triangle(make, rows, every, monkeypatch):
    """However it is divided."""
    monkeypatch.setattr(plain, "_ROWS", rows)
    for seed in range(50_000 + 40 * (rows == 3), 50_040 + 40 * (rows == 3), every):
        rng = np.random.default_rng(seed)
        scene, beside = hostile_scene(make, rng), offsets(rng)
        region = scene.camera.region
        found = result_of(plain.plain(scene, region, MEMORY, *beside))
        expected = brute_force(scene, region, *beside)
        for name in ("t", "instance", "triangle"):
            assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), (seed, name)
        assert found.ties == expected.ties and (found.certainty <= expected.certainty).all(), seed
