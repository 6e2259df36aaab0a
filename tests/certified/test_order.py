"""Order by what two surfaces are, once: as by every ray's own integers."""

from __future__ import annotations

import pytest
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified.decisions import Decisions
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings


def test_coplanar_surfaces_do_not_cost_a_ray_each(make, monkeypatch):
    """Where only the order is asked for, no ray is turned into integers."""
    monkeypatch.setattr(Decisions, "by_integers", lambda *a: pytest.fail("a ray by itself"))
    quads = make.quad(-9, 9.3, -8, 9.17, -2), make.quad(-8, 9.1, -9, 8.7, -2)
    scene = make.scene(make.camera(), *quads)
    frame = render(scene, Settings("certified"))
    assert (frame.object_index == 0).all()
    assert (frame.certainty == Certainty.AMBIGUOUS).all()
    assert set(frame.statistics.reasons) == {Reason.COPLANAR}
    assert len(frame.ties) == frame.t.size
