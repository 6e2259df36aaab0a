"""One surface, or two in one place, fill the picture: every step is short, so that Esc is heard."""

from __future__ import annotations

import pytest
from reference_tracer.tracer.certified.certainty import Certainty
from reference_tracer.tracer.certified.settle import BY_INTEGERS, Decisions
from reference_tracer.tracer.certified.surfaces import Prepared
from reference_tracer.tracer.certified.sweep.depth_buffer import DepthBuffer
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.render import steps
from reference_tracer.tracer.settings import Settings

WIDTH, HEIGHT = 960, 540
TOGETHER = 1 << 17  # what numpy does with so many numbers takes some ten milliseconds
BY_PYTHON = BY_INTEGERS  # what Python decides, one by one, likewise


@pytest.mark.parametrize("surfaces", [1, 2])
@pytest.mark.parametrize("orthographic", [False, True])
def test_no_step_is_long_where_surfaces_coincide(make, monkeypatch, orthographic, surfaces):
    """Counted is what a step decides: candidates, and rows of arrays."""
    by_numpy, by_python, total = 0, 0, 0

    def counting(kind: type, name: str, count) -> None:
        function = getattr(kind, name)

        def counted(*given):
            nonlocal by_numpy
            by_numpy += count(*given)
            return function(*given)

        monkeypatch.setattr(kind, name, counted)

    def integers(self, found, function=Decisions.by_integers):
        nonlocal by_python
        by_python += len(found.ray)
        return function(self, found)

    counting(DepthBuffer, "enter", lambda buffer, pixel, *_: len(pixel))
    counting(Decisions, "by_order", lambda decisions, found: len(found.ray))
    counting(Prepared, "enter", lambda prepared, hits, at, *_: len(at))
    counting(Hits, "clear", lambda hits, part, *_: len(hits.t[part]))
    monkeypatch.setattr(Decisions, "by_integers", integers)
    camera = make.camera(WIDTH, HEIGHT, half=2.0, orthographic=orthographic)
    quad = make.quad(-9, 9, -9, 9, -2)
    frame = Frame.empty(make.scene(camera, *[quad] * surfaces))
    for _ in steps(frame.scene, Settings("certified"), frame):
        assert by_numpy <= TOGETHER and by_python <= BY_PYTHON
        total, by_numpy, by_python = total + by_numpy, 0, 0
    # Its hit is made room for; each surface of a pixel is tested, and compared or entered.
    assert total > (1 + 2 * surfaces) * WIDTH * HEIGHT
    ambiguous = frame.certainty == Certainty.AMBIGUOUS
    assert len(frame.ties) == ambiguous.sum() and ambiguous.all() == (surfaces == 2)
    assert (frame.instance_index == 0).all()
