"""Many surfaces in one place: the same picture in little memory, at a price like theirs."""

from __future__ import annotations

import tracemalloc
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified import order, ties
from reference_tracer.certified.sweep import sweep
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Scene
from reference_tracer.tracer.hits import Statistics, Ties
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..moved import may, touched
from ..oracle import scene_sights

pytestmark = pytest.mark.filterwarnings("error")
LEAST = 16 << 20  # the least memory that there is a setting for


def coincident(make, count: int, width: int, height: int, **camera) -> Scene:
    """Return so many instances of one quad that fills the picture, its diagonal in sight."""
    quad = make.quad(-9, 9, -9, 9, -5)
    scene = make.scene(make.camera(width, height, **camera), quad)
    return replace(scene, instances=scene.instances * count)


def layers(make, rng, orthographic: bool) -> Scene:
    """Return coincident quads, in any order among others that are tilted, twice some of them."""
    scene = coincident(make, 7, 8, 6, orthographic=orthographic, half=1.5)
    tilted = [np.eye(4) + 0.02 * np.eye(4, k=k) for k in (0, 0, 2, 2, -2)]
    instances = [*scene.instances, *(Instance(0, 0, m) for m in tilted)]
    return replace(scene, instances=[instances[k] for k in rng.permutation(len(instances))])


@pytest.mark.slow
@pytest.mark.parametrize("orthographic", [False, True])
def test_memory_is_bounded(make, orthographic):
    """Beside the picture, which has each set of surfaces once, not for each pixel."""
    scene = coincident(make, 50, 80, 50, orthographic=orthographic)
    tracemalloc.start()
    frame = render(scene, Settings("certified", memory=LEAST))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert (frame.certainty == Certainty.AMBIGUOUS).all() and len(frame.ties) == 80 * 50
    assert all(len(names) >= 50 for names in frame.ties.values())
    assert frame.ties.instance.nbytes < 50 * 80 * 50 / 4
    assert peak < LEAST


@pytest.mark.slow
def test_pieces_are_the_whole(make, rng, monkeypatch):
    """Arrays, ties and statistics, however little is held at once; as the oracle has it."""
    calls, in_one = [], sweep.sweep
    for orthographic in (False, True):
        scene = layers(make, rng, orthographic)
        whole = Statistics()
        expected = result_of(sweep.sweep(scene, scene.camera.region, 1 << 30, statistics=whole))
        truth = scene_sights(scene)
        names = list(zip(expected.instance.tolist(), expected.triangle.tolist(), strict=True))
        assert names == [s.seen for s in truth] and len(expected.ties) > 12
        for k, tied in expected.ties.items():
            assert names[k] in tied and may(truth[k]) <= tied <= touched(truth[k])
        for room in (24, 100):
            with monkeypatch.context() as patch:
                patch.setattr(sweep, "_FRAGMENTS", room)
                patch.setattr(sweep, "sweep", lambda *a, **k: calls.append(a[1]) or in_one(*a, **k))
                own = Statistics()
                found = result_of(sweep.sweep(scene, scene.camera.region, 1, statistics=own))
            for name in ("t", "instance", "triangle", "s", "certainty"):
                assert getattr(found, name).tobytes() == getattr(expected, name).tobytes(), name
            assert found.ties == expected.ties and own.reasons == whole.reasons
            assert own.pairs_exact <= own.pairs_tested <= whole.pairs_tested  # each counts once
            assert own.culling["left"] == whole.culling["left"]
    assert len(calls) > 20 and {(r.width, r.height) for r in calls} >= {(8, 6), (8, 1), (1, 1)}


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_ties_with_a_surface_that_is_beaten_later_is_beaten_with_it(make, orthographic):
    """Quads in one place, and a last one that is nearer by less than the bounds can tell."""
    scene = coincident(make, 4, 9, 7, orthographic=orthographic, half=1.5)
    nearest = make.quad(-19, 18, -17, 19, float(np.nextafter(-5, 0)))
    instances = (*scene.instances, replace(scene.instances[0], mesh=1))
    scene = replace(scene, meshes=(*scene.meshes, nearest), instances=instances)
    frame = render(scene, Settings("certified"))
    assert (frame.instance_index == 4).all() and (frame.certainty == Certainty.EXACT).all()
    assert not frame.ties and frame.statistics.reasons[Reason.CLOSE] > 0


def test_the_price_grows_with_the_surfaces(make, monkeypatch):
    """Counted are the steps of numpy and the integers' comparisons, of four times as many."""
    counted = Counter()

    def counting(module, name):
        function = getattr(module, name)

        def call(*given):
            counted[name] += 1
            return function(*given)

        monkeypatch.setattr(module, name, call)

    counting(order, "order_of")
    for name in ("gap", "intersection", "sign_of_difference"):
        counting(ties, name)
    prices = []
    for surfaces in (20, 80):
        counted.clear()
        render(coincident(make, surfaces, 32, 18), Settings("certified"))
        prices.append(dict(counted))
    for name, few in prices[0].items():
        assert prices[1][name] <= 5 * few, (name, prices)


def test_ties_are_the_rows_they_are_made_of(rng):
    """Shared or not, joined in any order, and asked for all at once."""
    shared = 0
    for _ in range(99):
        counts = rng.integers(1, 4, int(rng.integers(0, 12)))
        ray = np.repeat(np.sort(rng.choice(40, len(counts), replace=False)), counts)
        rows = ray, *rng.integers(-1, 1, (2, len(ray)))
        made = Ties.of(*rows)
        expected: dict[int, set] = {}
        for k, *name in np.array(rows).T.tolist():
            expected.setdefault(k, set()).add(tuple(name))
        assert dict(made) == expected and len(made) == len(expected)
        shared += len(made.instance) < len(ray)
        cut = int(rng.integers(0, 40))
        parts = [Ties.of(*(v[side] for v in rows)) for side in (ray >= cut, ray < cut)]
        assert Ties.joined(parts) == made
        asked = rng.integers(0, 41, 50), *rng.integers(-2, 2, (2, 50))
        may = [tuple(name) in expected.get(k, ()) for k, *name in np.array(asked).T.tolist()]
        assert made.may_see(*asked).tolist() == may
    assert shared > 5
