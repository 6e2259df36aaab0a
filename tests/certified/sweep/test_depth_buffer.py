"""The depth buffer: a maximum of what is entered, and minima of what is in its cells."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.sweep import depth_buffer
from reference_tracer.certified.sweep.depth_buffer import COARSE, FINE, DepthBuffer, Fragments
from reference_tracer.scene import Region

REGIONS = [
    Region(*r)
    for r in ((0, 0, 1, 1), (3, 5, 67, 70), (0, 0, 128, 64), (1, 2, 3, 200), (7, 0, 140, 9))
]
every_region = pytest.mark.parametrize("region", REGIONS, ids=lambda r: f"{r.width}x{r.height}")


def grid(depths: DepthBuffer) -> np.ndarray:
    return depths.nearness.reshape(-1, depths.stride)


def filled(region, rng) -> DepthBuffer:
    depths = DepthBuffer(region)
    inside = grid(depths)[: region.height, : region.width]
    inside[:] = rng.normal(size=inside.shape)
    inside[rng.random(inside.shape) < 0.1] = -np.inf
    return depths


def enter(depths, pixel, nearness) -> None:
    """Enter what has just this nearness; a surface each."""
    depths.enter(pixel, np.arange(len(pixel)), nearness, nearness)


@every_region
def test_pixels_have_a_place_each_and_back(region):
    depths = DepthBuffer(region)
    pixels = np.arange(region.width * region.height)
    places = depths.places(pixels)
    assert np.array_equal(depths.pixels(places), pixels)
    assert np.isneginf(depths.nearness[places]).all()
    assert np.isneginf(depths.nearness).sum() == len(pixels)  # and all else is never in the way
    y, x = np.divmod(places, depths.stride)
    assert np.array_equal(y * region.width + x, pixels)


def increasing(rng, n):
    return np.sort(rng.normal(size=n))


ORDERS = {
    "increasing": increasing,
    "decreasing": lambda rng, n: increasing(rng, n)[::-1],
    "any": lambda rng, n: rng.normal(size=n),
    "equal": lambda rng, n: np.full(n, 0.25),
    "few values": lambda rng, n: rng.integers(-2, 3, n) * 1.0,
    "zigzag": lambda rng, n: np.where(np.arange(n) % 2, 1.0, -1.0) * np.arange(n),
    "extreme": lambda rng, n: rng.choice([-np.inf, np.inf, 0.0, -0.0, 5e-324, -1e308, 1e308], n),
}


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("pixels", [1, 2, 40, 3000])
def test_enter_is_a_maximum(rng, order, pixels):
    """However often a pixel occurs, and in whatever order."""
    region = Region(2, 3, 75, 70)
    depths = filled(region, rng)
    expected = depths.nearness.copy()
    for _ in range(4):
        pixel = depths.places(rng.integers(0, pixels, 3000))
        nearness = ORDERS[order](rng, 3000)
        enter(depths, pixel, nearness)
        np.maximum.at(expected, pixel, nearness)
        assert np.array_equal(depths.nearness, expected)
    enter(depths, pixel[:0], nearness[:0])
    assert np.array_equal(depths.nearness, expected)


@pytest.mark.parametrize("order", [o for o in ORDERS if o != "extreme"])
@pytest.mark.parametrize("pixels", [1, 2, 40, 3000])
@pytest.mark.parametrize("width", [0.0, 1e-3, 1.0])
def test_winners_and_fragments_are_all_that_may_be_the_nearest(rng, order, pixels, width):
    """As by definition: whose most is not less than the greatest least of its pixel."""
    depths, every, fragments = DepthBuffer(Region(2, 3, 75, 70)), [], []
    for first in range(0, 12_000, 3000):
        pixel = depths.places(rng.integers(0, pixels, 3000))
        least = ORDERS[order](rng, 3000)
        most = least + width * rng.choice([0, 0.1, 1], 3000)
        surface = np.arange(first, first + 3000)
        every.append(np.stack((pixel, surface, most, least)))
        fragments += depths.enter(pixel, surface, least, most)
    pixel, surface, most, least = np.concatenate(every, axis=1)
    pixel = pixel.astype(int)
    expected = np.flatnonzero(most >= depths.nearness[pixel])
    whole = Fragments.joined(fragments)
    whole = whole.take(depths.not_hidden(whole))
    winner = depths.winners[depths.pixels(pixel)]
    assert (least[winner] == depths.nearness[pixel]).all()
    assert set(winner.tolist()) | set(whole.surface.tolist()) == set(expected.tolist())
    assert np.array_equal(pixel[whole.surface], whole.pixel)
    assert np.array_equal(most[whole.surface], whole.nearest)
    assert not np.isin(whole.surface, winner).any()  # so a winner without any is alone
    assert len(whole) > 0 or order not in ("equal", "few values")


def test_what_is_not_a_number_is_not_entered(rng):
    depths = filled(Region(0, 0, 9, 9), rng)
    before = depths.nearness.copy()
    enter(depths, np.arange(5), np.full(5, np.nan))
    assert np.array_equal(depths.nearness, before)


@pytest.mark.parametrize("sizes", [(FINE, COARSE), (4, 16), (8, 8), (2, 64), (1, 2)], ids=str)
@every_region
def test_cells_hold_plain_minima(region, sizes, rng, monkeypatch):
    fine, coarse = sizes
    for name, value in zip(("FINE", "COARSE"), sizes, strict=True):
        monkeypatch.setattr(depth_buffer, name, value)
    depths = filled(region, rng)
    for size in sizes:  # nothing is known before it is refreshed
        assert np.isneginf(depths.farthest(np.zeros(1, int), np.zeros(1, int), size)).all()
    depths.refresh()
    inside = grid(depths)[: region.height, : region.width]  # padding is never the least
    for size in {fine, coarse}:
        y, x = np.indices((-(-region.height // size), -(-region.width // size))).reshape(2, -1)
        plain = [
            inside[b * size : (b + 1) * size, a * size : (a + 1) * size].min()
            for a, b in zip(x, y, strict=True)
        ]
        assert np.array_equal(depths.farthest(x, y, size), plain)


@every_region
def test_what_is_entered_is_refreshed_and_no_cell_is_too_near(region, rng):
    """Cells that were not refreshed have an older, farther minimum: that is safe."""
    depths = filled(region, rng)
    depths.refresh()
    y, x = np.indices((-(-region.height // FINE), -(-region.width // FINE))).reshape(2, -1)
    for _ in range(5):
        count = int(rng.integers(1, region.width * region.height + 1))
        pixel = rng.integers(0, region.width * region.height, count)
        enter(depths, depths.places(pixel), rng.normal(size=count) + 2)
        inside = grid(depths)[: region.height, : region.width]
        ends = (slice(v * FINE, v * FINE + FINE) for v in np.stack((y, x), axis=1).ravel().tolist())
        least = [inside[rows, columns].min() for rows, columns in zip(ends, ends, strict=True)]
        assert (depths.farthest(x, y, FINE) <= least).all()
        depths.refresh()
        assert np.array_equal(depths.farthest(x, y, FINE), least)


@every_region
@pytest.mark.parametrize("dtype", [np.int16, np.int32])
def test_farthest_in_boxes(region, dtype, rng):
    """Never nearer than a pixel of the box; as near as the least in the cells that it may touch."""
    depths = filled(region, rng)
    depths.refresh()
    inside = grid(depths)[: region.height, : region.width]
    ends = np.array([[region.width - 1], [region.height - 1]])
    low = np.stack([rng.integers(0, n, 500) for n in (region.width, region.height)])
    high = np.minimum(low + rng.integers(0, 2 * FINE + 2, (2, 500)), ends)
    found = depths.farthest_in(low.astype(dtype), high.astype(dtype))
    for k, ((x0, x1), (y0, y1)) in enumerate(np.stack((low, high), axis=2).swapaxes(0, 1).tolist()):
        size = max(x1 - x0, y1 - y0)
        assert found[k] <= inside[y0 : y1 + 1, x0 : x1 + 1].min()
        if size >= 2 * FINE:
            assert found[k] == -np.inf
        else:
            far = 2 if size < FINE else 3
            rows, columns = (slice(v // FINE * FINE, (v // FINE + far) * FINE) for v in (y0, x0))
            assert found[k] >= inside[rows, columns].min()
