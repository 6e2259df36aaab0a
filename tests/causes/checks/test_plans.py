"""One plan serves several checks: it holds for a wider clip range, and for nearer rays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reference_tracer.causes.checks.plans import SOUND, shared_plan
from reference_tracer.causes.checks.probe import Probe
from reference_tracer.pictures.renderers import RASTER
from reference_tracer.scene import Region
from reference_tracer.tracer.nearest import plan
from reference_tracer.tracer.progress import result_of


def test_its_rays_meet_what_those_of_a_plan_of_their_own_do(room):
    """The clip start cuts the ball: the widened range must not show what lies before it."""
    scene = room.seen_by(replace(room.camera, clip_start=5.0))
    region = scene.camera.region
    wanted = np.ones(region.width * region.height, bool)
    found = []
    for made in (
        result_of(plan(scene, SOUND, 0.0)),
        replace(result_of(shared_plan(scene, RASTER, 0.3)), scene=scene),
    ):
        probe = result_of(Probe.of(made, Region(0, 0, region.width, region.height), wanted))
        found.append(result_of(probe.trace()))
    first, second = found
    assert 0 < (first.t < np.inf).mean() < 1 and first.t.min() > 5
    for name in ("instance", "triangle", "values"):
        assert np.array_equal(getattr(first, name), getattr(second, name))
