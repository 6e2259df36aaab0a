"""Regions of pixels: each pixel in exactly one, near ones together, named by their objects."""

from collections import deque

import numpy as np
import pytest
from reference_tracer.diagnosis.regions import MOST, Region, regions


def flooded(mask, reach):
    """Another way to the same: fill from pixel to pixel, each step within so many rows, columns."""
    left = set(zip(*(a.tolist() for a in np.nonzero(mask)), strict=True))
    found = []
    while left:
        todo, part = deque([left.pop()]), []
        while todo:
            y, x = todo.popleft()
            part.append((y, x))
            near = {
                (j, i)
                for j in range(y - reach, y + reach + 1)
                for i in range(x - reach, x + reach + 1)
            }
            todo += near & left
            left -= near
        rows, columns = [y for y, _ in part], [x for _, x in part]
        size = max(columns) - min(columns) + 1, max(rows) - min(rows) + 1
        found.append(Region(min(columns), min(rows), *size, len(part)))
    return found


def in_order(found):
    return sorted(found, key=lambda r: (r.left, r.bottom, r.width, r.height, r.pixels))


@pytest.mark.parametrize("near", [0, 1, 3])
@pytest.mark.parametrize("share", [0.01, 0.1, 0.3, 0.45, 0.7])
def test_they_are_what_flooding_finds(near, share):
    rng = np.random.default_rng(int(100 * share) + near)
    for shape in ((1, 1), (1, 40), (40, 1), (23, 31), (40, 60)):
        mask = rng.random(shape) < share
        found = regions(mask, near=near, most=mask.size)
        assert in_order(found) == in_order(flooded(mask, 2 * near + 1))
        assert [r.pixels for r in found] == sorted((r.pixels for r in found), reverse=True)


def test_a_spiral_is_one_and_two_spirals_are_two():
    mask = np.zeros((61, 61), bool)
    y = x = 30
    for arm in range(1, 29):
        dy, dx = [(0, 1), (1, 0), (0, -1), (-1, 0)][arm % 4]
        for _ in range(2 * ((arm + 1) // 2)):
            mask[y, x] = True
            y, x = y + dy, x + dx
    assert len(regions(mask, near=0)) == 1
    mask[0, 60] = True
    assert [r.pixels for r in regions(mask, near=0)] == [mask.sum() - 1, 1]


def test_nothing_is_no_region():
    assert regions(np.zeros((5, 7), bool)) == []


def test_two_blocks_are_two_regions_with_their_places():
    mask = np.zeros((100, 200), bool)
    mask[10:14, 20:26] = mask[80:82, 150:153] = True
    one, other = regions(mask)
    assert one == Region(20, 10, 6, 4, 24)
    assert one.top == 13
    assert other.to_dict() == {
        "left": 150, "top": 81, "width": 3, "height": 2, "pixels": 6, "objects": [],
    }  # fmt: skip


def test_scattered_pixels_are_in_no_more_regions_than_can_be_framed_and_none_is_lost():
    mask = np.zeros((540, 960), bool)
    mask[::20, ::20] = True
    assert len(regions(mask, most=mask.size)) == mask.sum() > MOST
    found = regions(mask)
    assert len(found) <= MOST
    assert sum(r.pixels for r in found) == mask.sum()


def test_each_is_named_by_the_objects_that_either_side_shows_there():
    mask = np.zeros((40, 80), bool)
    mask[5:10, 5:10] = mask[30:33, 60:66] = True
    traced, shown = np.full((40, 80), -1), np.full((40, 80), -2)
    traced[5:10, 5:10] = 1
    traced[30:33, 60:66] = 0
    shown[5:10, 5:7] = 0
    shown[30:33, 60:66] = 2
    sides = [(("Floor", "Cube"), traced), (("Floor", "Cube", "Lamp"), shown)]
    assert [r.objects for r in regions(mask, sides)] == [("Cube", "Floor"), ("Floor", "Lamp")]
