"""Many surfaces in one place: the same picture in little memory, at a price like theirs."""

from __future__ import annotations

import tracemalloc
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified import order, ties
from reference_tracer.rendering import render
from reference_tracer.scene import Scene
from reference_tracer.tracer.settings import Settings

pytestmark = pytest.mark.filterwarnings("error")
LEAST = 16 << 20  # the least memory that there is a setting for


def coincident(make, count: int, width: int, height: int, **camera) -> Scene:
    """Return so many instances of one quad that fills the picture, its diagonal in sight."""
    quad = make.quad(-9, 9, -9, 9, -5)
    scene = make.scene(make.camera(width, height, **camera), quad)
    return replace(scene, instances=scene.instances * count)


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
