"""What a frame tells of its certainty, and of what was left out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh
from reference_tracer.tracer.hits import NOWHERE
from reference_tracer.tracer.settings import Precision, Settings

from .pictures import CERTIFIED, mess, names_of

pytestmark = pytest.mark.filterwarnings("error")


@pytest.mark.parametrize("method", [m for m in Method if not m.is_proven])
@pytest.mark.parametrize("precision", Precision)
def test_wrong_against(make, rng, method, precision):
    """Pixels that no ray, moved infinitesimally, would see so."""
    differ = counted = 0
    for whole in (False, True):
        scene = mess(make, rng, True, whole)
        certified, other = render(scene, CERTIFIED), render(scene, Settings(method, precision))
        wrong = other.wrong_against(certified)
        assert wrong.shape == certified.t.shape
        for k, (name, right) in enumerate(zip(names_of(other), names_of(certified), strict=True)):
            assert wrong.flat[k] == (name not in certified.ties.get(k, {right}))
            differ += name != right
        counted += wrong.sum()
        assert not certified.wrong_against(certified).any()
    assert counted < differ
    assert counted > 3 or method != Method.TEXTBOOK_LITERAL


def overflowing(make):
    """Return a scene, and it with triangles whose world vertices are beyond float64."""
    matrix = np.diag((1e300, 1, 1, 1.0))
    broken = Mesh([(1e300, 0, -2), (0, 1, -2), (0, 0, -2), (0, -1, -2.0)], [[0, 1, 2], [2, 1, 3]])
    scene = make.scene(make.camera(8, 6), make.quad(-9, 9, -9, 9.5, -3))
    copies = [replace(scene.instances[0], mesh=1, world_from_object=matrix)] * 2
    meshes, instances = (*scene.meshes, broken), (*scene.instances, *copies)
    return scene, replace(scene, meshes=meshes, instances=instances)


def test_vertices_that_are_not_finite_in_world_space_are_refused(make):
    """Left out, counted, and said without a warning; everything else is there."""
    scene, broken = overflowing(make)
    for settings in (CERTIFIED, Settings("watertight"), Settings("textbook")):
        frame = render(broken, settings)
        assert names_of(frame) == names_of(render(scene, settings))
        assert frame.statistics.refused == 2
        assert any("2 triangles were left out" in line for line in frame.statistics.required())
    assert not render(scene, CERTIFIED).statistics.refused
    alone = replace(broken, instances=broken.instances[1:])
    assert set(names_of(render(alone, CERTIFIED))) == {NOWHERE}
