"""One surface, or two in one place, fill the picture: every step is short, so that Esc is heard."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import ladder
from reference_tracer.certified.decisions import Decisions
from reference_tracer.certified.measures import Prepared
from reference_tracer.certified.sweep.depth_buffer import DepthBuffer
from reference_tracer.rendering import steps
from reference_tracer.scene import Mesh, ViewWindow
from reference_tracer.study.scenarios.parts import lattice
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.settings import Settings

WIDTH, HEIGHT = 960, 540
TOGETHER = 1 << 17  # what numpy does with so many numbers takes some ten milliseconds
BY_PYTHON = 1 << 11  # what Python decides, one by one, likewise


@pytest.mark.slow
@pytest.mark.parametrize("surfaces", [1, 2])
@pytest.mark.parametrize("orthographic", [False, True])
def test_no_step_is_long_where_surfaces_coincide(make, monkeypatch, orthographic, surfaces):
    """Counted is what a step decides: candidates, and rows of arrays."""
    by_numpy, total = 0, 0

    def counting(kind: type, name: str, count) -> None:
        function = getattr(kind, name)

        def counted(*given):
            nonlocal by_numpy
            by_numpy += count(*given)
            return function(*given)

        monkeypatch.setattr(kind, name, counted)

    counting(DepthBuffer, "enter", lambda buffer, pixel, *_: len(pixel))
    counting(Decisions, "by_order", lambda decisions, found: len(found.ray))
    counting(Prepared, "meet", lambda prepared, rays, surface: len(surface))
    camera = make.camera(WIDTH, HEIGHT, half=2.0, orthographic=orthographic)
    quad = make.quad(-9, 9, -9, 9, -2)
    frame = Frame.empty(make.scene(camera, *[quad] * surfaces))
    for _ in steps(frame.scene, Settings("certified"), frame):
        assert by_numpy <= TOGETHER
        total, by_numpy = total + by_numpy, 0
    # Each surface of a pixel is tested; of several they are compared, and who wins is entered.
    assert total > (0.99, 4.99)[surfaces - 1] * WIDTH * HEIGHT
    for _ in frame.measures.steps(slice(None)):
        assert by_numpy <= TOGETHER + WIDTH
        total, by_numpy = total + by_numpy, 0
    assert total > (1.99, 4.99)[surfaces - 1] * WIDTH * HEIGHT
    ambiguous = frame.certainty == Certainty.AMBIGUOUS
    assert len(frame.ties) == ambiguous.sum() and ambiguous.all() == (surfaces == 2)
    assert (frame.instance_index == 0).all()


@pytest.mark.slow
def test_no_step_is_long_where_integers_decide(make, monkeypatch):
    """Every ray meets a corner of six triangles, which Python's integers decide one by one."""
    columns, rows = 60, 40
    window = ViewWindow(0.5, columns + 0.5, 0.5, rows + 0.5)  # pixel centres at integers
    camera = make.camera(columns, rows, window=window, orthographic=True)
    x, y = np.meshgrid(np.arange(columns + 2.0), np.arange(rows + 2.0))
    corners = np.stack((x.ravel(), y.ravel(), np.full(x.size, -2.0)), axis=-1)
    scene = make.scene(camera, Mesh(corners, lattice(columns + 1, rows + 1)))
    of_step = 0

    def counted(self, found, function=Decisions.by_integers):
        nonlocal of_step
        of_step += len(found.ray)
        return function(self, found)

    def longest() -> int:
        nonlocal of_step
        frame, found = Frame.empty(scene), [0]
        for _ in steps(scene, Settings("certified"), frame):
            found.append(of_step)
            of_step = 0
        assert (frame.certainty == Certainty.AMBIGUOUS).all()
        assert sum(found) == 6 * columns * rows
        return max(found)

    monkeypatch.setattr(Decisions, "by_integers", counted)
    assert longest() < BY_PYTHON + 6  # no ray is divided
    monkeypatch.setattr(ladder, "BY_INTEGERS", columns * rows * 6)
    assert longest() > BY_PYTHON  # what was counted is what the division keeps short
