"""What triangles cover: as every pixel of every box by itself, but for what is hidden."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.sweep import rasterise
from reference_tracer.certified.sweep.depth_buffer import FINE, DepthBuffer
from reference_tracer.certified.sweep.edge_functions import EdgeFunctions
from reference_tracer.certified.sweep.rasterise import Boxes, rasterised, split
from reference_tracer.scene import Region

from .test_depth_buffer import enter

CASES = 40
COUNT = 25  # triangles of each
SIZES = (1, 3, 8, 9, 40, 200)  # pixels of boxes, at most


def random_edge_functions(rng, region, low, reach) -> EdgeFunctions:
    """Return functions that are inside in some part of their boxes, of any size."""
    count = low.shape[1]
    coefficients = rng.normal(size=(3, 4, count)) * 2.0 ** rng.integers(-30, 30, (1, 4, count))
    coefficients[1:] *= rng.choice([0, 1, 1, 1], (2, 4, count))
    coefficients[0, :3] = np.abs(coefficients[0, :3]) + rng.uniform(
        -1, 1, (3, count)
    ) * reach * np.abs(coefficients[1:, :3]).sum(axis=0)
    size = np.abs(coefficients).max(axis=(0, 1))
    error = size * rng.choice([0, 1e-16, 1e-3, np.inf], count, p=[0.2, 0.5, 0.2, 0.1])
    coefficients[:, :, np.isinf(error)] = 0
    nearness_error = np.abs(coefficients[0, 3]) * rng.choice([1e-15, 0.1, 1e200], count)
    return EdgeFunctions(
        np.arange(count),
        np.add(low, [[region.x0], [region.y0]]) - rng.integers(0, 3, (2, count)),
        coefficients,
        error,
        nearness_error,
        rng.choice([0, 1e3, np.inf], count),
        rng.random(count) < 0.9,
    )


def cases():
    """Yield edge functions, boxes of theirs in a region, and a depth buffer that is not empty."""
    for seed in range(CASES):
        rng = np.random.default_rng(seed)
        x0, y0 = (int(v) for v in rng.integers(0, 50, 2))
        width, height = (int(v) for v in rng.choice([1, 7, 64, 70, 150], 2))
        region = Region(x0, y0, x0 + width, y0 + height)
        low = np.stack([rng.integers(0, n, COUNT) for n in (width, height)])
        extent = rng.integers(0, rng.choice(SIZES, COUNT), (2, COUNT))
        high = np.minimum(low + extent, [[width - 1], [height - 1]])
        dtype = rng.choice([np.int16, np.int32])
        found = random_edge_functions(rng, region, low, extent.max(axis=0) + 1)
        boxes = Boxes(np.arange(COUNT), low.astype(dtype), high.astype(dtype))
        depths = DepthBuffer(region)
        if seed % 2:
            some = rng.random((height, width)) < rng.choice([0.9, 1, 1])
            level = rng.normal(size=some.shape) + 10.0 ** rng.integers(0, 8)
            inside = depths.nearness.reshape(-1, depths.stride)[:height, :width]
            inside[:] = np.where(some, level, inside)
            depths.refresh()
        yield seed, found, boxes, depths


def pairs_of(parts, depths) -> dict:
    """Return what is said by pixel, in the region's own numbers, and owner; once each."""
    out = {}
    for part in parts:
        for pixel, owner, *values in zip(
            depths.pixels(part.pixel).tolist(),
            part.owner.tolist(),
            part.least.tolist(),
            part.most.tolist(),
            part.sure.tolist(),
            strict=True,
        ):
            assert (pixel, owner) not in out
            out[pixel, owner] = values
    return out


def plain(found, boxes, depths) -> dict:
    """Evaluate every pixel of every box: the ends of its nearness, and whether it is sure."""
    out, region = {}, depths.region
    for owner, (x0, y0), (x1, y1) in zip(boxes.owner, boxes.low.T, boxes.high.T, strict=True):
        of_1, of_y, of_x = found.coefficients[:, :, owner]
        y, x = np.indices((y1 - y0 + 1, x1 - x0 + 1)).reshape(2, -1)
        y, x = y + y0, x + x0
        up, right = (
            (y + region.y0 - found.origin[1, owner]),
            (x + region.x0 - found.origin[0, owner]),
        )
        values = (of_1[:, None] + of_y[:, None] * up) + of_x[:, None] * right
        least = values[:3].min(axis=0)
        for k in np.flatnonzero(least >= -found.edge_error[owner]):
            pixel = int(y[k]) * region.width + int(x[k])
            near, error = float(values[3, k]), float(found.nearness_error[owner])
            most = min(near + error, float(found.nearest[owner]))
            sure = bool(least[k] > found.edge_error[owner] and found.sure[owner])
            out[pixel, int(owner)] = [near - error, most, sure]
    return out


def all_pairs(found, boxes, depths) -> list:
    """Return what a sweep asks for."""
    parts = list(split(found, boxes, depths))
    assert all((part.size < FINE).all() for part in parts)
    return [pairs for part in parts for pairs in rasterised(found, part, depths)]


@pytest.mark.parametrize(
    "name, value",
    [
        ("_BOXES", 1 << 8),
        ("_BOXES", 1),
        ("_BOXES", 7),
        ("_CELLS", 1),
        ("_CELLS", 1 << 30),
    ],
)
def test_every_pixel_of_every_box_bit_for_bit(name, value, monkeypatch):
    """But for what the depth buffer hides: no cell is dropped with a pixel that would be kept."""
    monkeypatch.setattr(rasterise, name, value)
    empty, hidden, seen = 0, 0, 0
    for seed, found, boxes, depths in cases():
        expected = plain(found, boxes, depths)
        got = pairs_of(all_pairs(found, boxes, depths), depths)
        for key in got:
            assert got[key] == expected[key], seed
        missing = expected.keys() - got.keys()
        if missing:
            assert seed % 2
            pixel, owner = np.array(sorted(missing)).T
            nearest = np.array([expected[key][1] for key in sorted(missing)])
            assert (nearest < depths.nearness[depths.places(pixel)]).all(), seed
            assert (boxes.take(owner).size >= FINE).all()
        seen, hidden = seen + len(got), hidden + len(missing)
        empty += sum(owner not in {k for _, k in expected} for owner in range(COUNT))
    assert seen > 20_000 and hidden > 2_000 and empty > 50


def test_cells_that_no_edge_lets_in_or_that_are_hidden_are_dropped():
    """Otherwise the above would hold for a plain loop."""
    region = Region(0, 0, 128, 128)
    depths = DepthBuffer(region)
    coefficients = np.zeros((3, 4, 1))
    coefficients[:, 0, 0] = (-20, 0, 1)  # inside where x >= 20
    found = EdgeFunctions(
        np.zeros(1, int), np.zeros((2, 1), int), coefficients, np.zeros(1), np.zeros(1),
        np.zeros(1), np.ones(1, bool),
    )  # fmt: skip
    box = Boxes(np.zeros(1, int), np.zeros((2, 1), np.int16), np.full((2, 1), 127, np.int16))

    def lows():
        cells = [some.low for some in split(found, box, depths)]
        return {tuple(c.tolist()) for part in cells for c in part.T}

    open_cells = {(x, y) for x in range(16, 128, FINE) for y in range(0, 128, FINE)}
    assert lows() == open_cells
    hidden = np.arange(64)[:, None] * depths.stride + np.arange(64, 128)
    hidden = hidden[hidden != (hole := 33 * depths.stride + 70)]
    enter(depths, hidden, np.full(len(hidden), 1.0))  # nearer than the triangle
    enter(depths, np.array([hole]), np.array([-1.0]))
    depths.refresh()
    assert lows() == {(x, y) for x, y in open_cells if x < 64 or y >= 64} | {(64, 32)}
    enter(depths, np.array([hole]), np.array([1.0]))
    depths.refresh()
    assert lows() == {(x, y) for x, y in open_cells if x < 64 or y >= 64}
