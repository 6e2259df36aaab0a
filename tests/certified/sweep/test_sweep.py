"""The sweep sees what the ladder with every ray with every triangle does, however it is divided."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import ladder, measures
from reference_tracer.certified.sweep import (
    boxes,
    chunks,
    depth_bins,
    depth_buffer,
    rasterise,
    resolve,
    sweep,
)
from reference_tracer.scene import Mesh, Region
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.progress import result_of

from ...sampled import daily
from ...tracer.hostile_scenes import brute_force, hostile_scene, offsets, scaled

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error")]
SEEDS = 125  # in a part
PARTS = [0, *(pytest.param(part, marks=pytest.mark.torture) for part in range(1, 32))]
DIVIDED = range(20_005, 20_020, 2), range(20_000, 20_020)  # seeds, of every day and of the long run
ARRAYS = ("t", "instance", "triangle", "s", "certainty")


def swept(scene, region=None, beside=(0.0, 0.0), memory=1 << 30) -> Hits:
    return result_of(sweep.sweep(scene, region or scene.camera.region, memory, *beside))


def assert_same(found: Hits, expected: Hits, what) -> None:
    for name in ARRAYS:
        assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), (what, name)
    assert found.ties == expected.ties, what


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("end", [np.inf, 1e300, 1000.0])
def test_the_clip_range_begins_where_it_does_not_end(make, orthographic, end):
    ramp = Mesh([(-8, -8, -1), (8, -8, -1), (8, 8, -9), (-8, 8, -9)], [[0, 1, 2], [0, 2, 3]])
    half = 8 if orthographic else 1.5
    options = dict(orthographic=orthographic, half=half, clip_start=5.0, clip_end=end)
    found = swept(make.scene(make.camera(**options), ramp))
    seen = found.t[np.isfinite(found.t)]
    assert len(seen) and seen.min() >= 5
    assert_same(found, swept(make.scene(make.camera(**(options | dict(clip_end=500))), ramp)), end)


@pytest.mark.parametrize("part", PARTS)
def test_as_the_ladder_with_every_ray_and_every_triangle(make, part):
    """Ids, t and ties; and it is never more in doubt."""
    count = Counter()
    for seed in range(part * SEEDS, (part + 1) * SEEDS):
        rng = np.random.default_rng(seed)
        scale_too = seed % 8 < 2
        scene, beside = hostile_scene(make, rng, finite=scale_too), offsets(rng)
        if scale_too:
            scene = scaled(scene, 2.0 ** rng.choice([-330, -300, -150, 150, 300, 330]))
        camera, region = scene.camera, scene.camera.region
        found, expected = swept(scene, beside=beside), brute_force(scene, region, *beside)
        for name in ("t", "instance", "triangle"):
            assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), (seed, name)
        assert found.ties == expected.ties, seed
        ambiguous = found.certainty == Certainty.AMBIGUOUS
        assert np.array_equal(ambiguous, expected.certainty == Certainty.AMBIGUOUS), seed
        assert sorted(found.ties) == np.flatnonzero(ambiguous).tolist(), seed
        assert (found.certainty <= expected.certainty).all(), seed
        on_mesh = found.triangle != NOTHING
        assert not found.s[:, ~on_mesh].any(), seed
        count["pixels"] += len(found.t)
        count["on meshes"] += on_mesh.sum()
        count["on planes"] += ((found.instance != NOTHING) & ~on_mesh).sum()
        count["nothing"] += (found.instance == NOTHING).sum()
        for certainty in Certainty:
            count[certainty.name] += (found.certainty == certainty).sum()
        count["orthographic"] += camera.projection.shares_direction
        count["borders"] += (region.width, region.height) != (camera.width, camera.height)
        count["beside"] += beside != (0, 0)
        count["mirrored"] += (np.linalg.slogdet(scene.instance_matrices[:3, :3].T)[0] < 0).any()
    assert count.pop("NOT_CERTIFIED") == 0
    assert min(count[k] for k in ("orthographic", "borders", "beside", "mirrored")) > 25, count
    assert min(count.values()) > 25 and count["BOUND"] > 0.4 * count["pixels"], count


def sizes(fine, coarse):
    return [(depth_buffer, "FINE", fine), (depth_buffer, "COARSE", coarse),
            (rasterise, "FINE", fine), (rasterise, "COARSE", coarse)]  # fmt: skip


DIVISIONS = {
    "triangles by ones": [(sweep, "_TRIANGLES", 1)],
    "boxes by twos": [(boxes, "_TOGETHER", 2)],
    "triangles by threes": [(sweep, "_TRIANGLES", 3)],
    "one depth bin": [(depth_bins, "BINS", 2)],
    "few depth bins": [(depth_bins, "BINS", 5)],
    "pairs by ones": [(resolve, "_PAIRS", 1), (rasterise, "_VALUES", 1)],
    "pairs by sevens": [(resolve, "_PAIRS", 7), (rasterise, "_VALUES", 7)],
    "cells by ones": [(rasterise, "_CELLS", 1)],
    "cells of 4 and 16": sizes(4, 16),
    "cells of 2 and 64": sizes(2, 64),
    "cells of 1 and 1": sizes(1, 1),
    "vertices by twos": [(chunks, "_CHUNK", 2)],
    "hits by ones": [(measures, "TOGETHER", 1)],
    "integers by ones": [(ladder, "BY_INTEGERS", 1)],
    "orders by ones": [(ladder, "BY_ORDER", 1)],
    "pixels by ones": [(m, "PIXELS", 1) for m in (resolve, measures)],
    "rays by ones": [(resolve, "_RAYS", 1)],
    "fragments by threes": [(resolve, "_FRAGMENTS", 3), (sweep, "_PAIRS", 3)],
    "chunks of a triangle": [(sweep, "_BYTES_PER_TRIANGLE", 1 << 40)],
    "chunks of four triangles": [(sweep, "_BYTES_PER_TRIANGLE", 1 << 28)],
    "all small": [
        (sweep, "_TRIANGLES", 2), (depth_bins, "BINS", 3), (resolve, "_PAIRS", 5),
        (rasterise, "_CELLS", 2),
        (rasterise, "_VALUES", 2), (chunks, "_CHUNK", 3), (sweep, "_BYTES_PER_TRIANGLE", 1 << 29),
        *sizes(2, 4),
    ],
}  # fmt: skip


@pytest.fixture(
    scope="module",
    params=[DIVIDED[0], pytest.param(DIVIDED[1], marks=pytest.mark.torture)],
    ids=["some", "all"],
)
def undivided(make, request):
    """Return scenes, where their rays pass the pixels' centres, and what they see."""
    out = []
    for seed in request.param:
        rng = np.random.default_rng(seed)
        scene, beside = hostile_scene(make, rng), offsets(rng)
        out.append((seed, scene, beside, swept(scene, beside=beside)))
    assert sum(len(hits.ties) for *_, hits in out) > 80
    assert sum((hits.certainty == Certainty.EXACT).sum() for *_, hits in out) > 50
    return out


@pytest.mark.parametrize("division", daily(DIVISIONS))
def test_the_division_does_not_matter(undivided, division, monkeypatch):
    for module, name, value in DIVISIONS[division]:
        assert hasattr(module, name)
        monkeypatch.setattr(module, name, value)
    for seed, scene, beside, expected in undivided:
        assert_same(swept(scene, beside=beside), expected, seed)


@pytest.mark.parametrize("memory", [1, 700, 3000])
def test_the_memory_does_not_matter(undivided, memory):
    for seed, scene, beside, expected in undivided:
        assert_same(swept(scene, beside=beside, memory=memory), expected, seed)


@pytest.mark.parametrize("rows", [1, 3])
def test_bands_do_not_matter(undivided, rows):
    for seed, scene, beside, expected in undivided:
        r = scene.camera.region
        bands = [Region(r.x0, y, r.x1, min(y + rows, r.y1)) for y in range(r.y0, r.y1, rows)]
        parts = [swept(scene, band, beside) for band in bands]
        assert_same(Hits.joined(parts), expected, seed)
