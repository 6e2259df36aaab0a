"""What ties at an edge: a neighbour, what is behind an outline, what is seen through a gap."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.ties import seen_and_ties
from reference_tracer.tracer.camera import Rays

from ..moved import may
from ..oracle import sights

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = (-1, -1)


def sight(corners, direction=(0, 0, -1)):
    """Return what the one ray from the origin sees, its ties, and the oracle's answer."""
    o, d = np.zeros((3, 1)), np.array(direction, float)[:, None]
    c = np.array(corners, float).transpose(1, 2, 0)
    batch = IntegerBatch(Rays(o, d), c)
    found = [((0, k), batch.hit(0, k)) for k in range(c.shape[2])]
    seen, ties = seen_and_ties([(name, m) for name, m in found if m])
    return seen, {k if i == 0 else None for i, k in ties}, sights(o, d, c)[0]


LEFT, RIGHT = [(0, -1, -2), (0, 1, -2), (-3, 0, -2)], [(0, -1, -2), (0, 1, -2), (3, 0, -2)]
WALL = [(-9, -9, -3), (9, -9, -3), (0, 19, -3)]


def test_an_edge_inside_a_surface_and_one_on_its_outline():
    seen, ties, judged = sight([LEFT, RIGHT])
    assert ties == {0, 1} and seen in ties and may(judged) == {(0, 0), (0, 1)}
    for one in (LEFT, RIGHT):
        _, ties, judged = sight([one])
        assert ties == {0, None} and may(judged) == {(0, 0), NOTHING}
        _, ties, judged = sight([one, WALL])
        assert ties == {0, 1} and may(judged) == {(0, 0), (0, 1)}
    assert sight([WALL])[1] == set()
    assert sight([WALL, LEFT, RIGHT])[1] == {1, 2}
    assert sight([WALL, WALL])[:2] == (0, {0, 1})


def test_a_thin_gap_beside_a_corner_is_among_the_ties():
    """A fan around the ray lacks a slice of 15 degrees: what is behind may be seen there, too."""
    angle = np.radians(np.r_[25, 90, 150, 210, 270, 330, 370])
    rim = [(8 * np.cos(a), 8 * np.sin(a), -2) for a in angle]
    fan = [[(0, 0, -2), p, q] for p, q in pairwise(rim)]
    _, ties, judged = sight([*fan, WALL])
    assert may(judged) == {(0, k) for k in range(7)}
    assert ties == set(range(7))
