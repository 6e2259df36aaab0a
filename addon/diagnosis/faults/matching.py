"""Finds where the picture shows the edges that are traced, and the camera that sees them there.

Small windows around pixels at edges are looked for in the picture: first coarsely and far around,
then finely. Along a straight edge nobody can say how far it moved: only what is sure counts. A
camera of a few numbers is then fitted to all at once, by least squares that pass over what moved
otherwise (iteratively reweighted, Holland and Welsch 1977). It needs no ray.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Bools, Floats, Integers, Places
from ...pictures.bounds import largest_within
from ...pictures.metrics import beside_edges
from ...scene import Camera
from ...tracer.camera import camera_rays, film_of
from ..evidence import NEAR, Evidence, film_at, spread

POINTS = 384  # pixels at edges that are searched
WINDOW = 4  # pixels on each side of one that are compared
FAR = 8  # windows' pixels that one may have moved, at the coarsest
CLOSE = 2  # the same, at finer scales
ALIKE = 0.025  # of a window: places with as many more wrong pixels are as good
STRAIGHT = 0.9  # px²: a variance of the places that are as good, along a straight edge
SNAPPED = 0.1  # px²: that of a place in whole pixels
LEAST = 12  # points: fewer say nothing
ROUNDS = 16  # of least squares
STEP = 0.25  # of a unit, for differences
FIXED = 1e-3  # keeps what no point says near 0
INFORMED = 1 / SNAPPED  # 1/px²: what a point tells of one direction, about
LONGEST = 16.0  # units: an axis along which next to nothing moves is no longer
HIT = 1.0  # px: points that are fitted as near are explained
SURE = 6  # digits of a unit
TILES = 6  # across, and up
MOST = 0.5  # of the tiles with edges
MANY = 60  # unexplained pixels: with fewer nobody knows


class Matches(NamedTuple):
    """Points at edges, and where the picture shows them."""

    points: Floats  # (3, n) in the world
    shown: Floats  # (2, n) film positions where they are shown
    sure: Floats  # (n, 2, 2) the inverse of the covariance of that; 0 where nothing is known


class Fitted(NamedTuple):
    """A camera that was fitted to the points."""

    units: Floats  # (k,) of the numbers
    share: float  # of the points, those that it explains
    axes: Floats  # (k, k) changes of the units, columns that move the points apart from each other


def matches(
    evidence: Evidence,
    name: str = "",
    where: Bools | None = None,
    about: tuple[float, float] | None = None,
) -> Matches:
    """Return the points at edges, and where they are shown (cached).

    Those of an object are in a mask (h, w), and moved by about so many pixels; all others by about
    as many as most of the picture.
    """
    some = np.ones(evidence.unexplained.shape, bool) if where is None else where
    key = f"matches {name} {about}"
    return evidence.once(key, lambda: _matched(evidence, some, about))


def seen_by(camera: Camera | None, points: Floats) -> Floats:
    """Return where a camera has points (3, n), (2, n) pixels; NaN without one."""
    return points[:2] * np.nan if camera is None else np.stack(film_of(camera, points)[:2])


def fitted(found: Matches, seen: Callable[[Floats], Floats], count: int) -> Fitted | None:
    """Fit some units, (k,), with which points are seen where they are shown.

    None if too few are known. The function returns their film positions, (2, n), with some units.
    """
    units, axes = np.zeros(count), np.eye(count)
    if len(found.points[0]) < LEAST:
        return None

    def off(values: Floats) -> Floats:
        with np.errstate(all="ignore"):
            return found.shown - seen(values)

    now = off(units)
    for number in range(ROUNDS if count else 0):
        beside = [off(units + STEP * axis) for axis in np.eye(count)]
        slope = (now - np.array(beside)) / STEP  # (k, 2, n)
        known = np.isfinite(now).all(axis=0) & np.isfinite(slope).all(axis=(0, 1))
        if not known.any():  # all are behind the camera, or there is none
            return None
        apart = _apart(now, found.sure)[known]
        scale = max(HIT, float(np.median(apart)) * 2 / (1 + number / 4))
        weighted = found.sure[known] / (1 + (apart / scale) ** 2)[:, None, None]
        j, r = slope[..., known], now[:, known]
        normal = np.einsum("ain,nij,bjn->ab", j, weighted, j) + FIXED * np.eye(count)
        sizes, own = np.linalg.eigh(normal / int(known.sum()) / INFORMED)
        axes = own / np.maximum(np.sqrt(np.maximum(sizes, 0)), 1 / LONGEST)
        step = np.linalg.solve(normal, np.einsum("ain,nij,jn->a", j, weighted, r))
        units = units + step
        now = off(units)
        if np.abs(step).max() < FIXED:
            break
    apart = _apart(now, found.sure)
    share = float((apart[np.isfinite(apart)] < HIT).sum() / len(apart))
    # LAPACK's last digits are another machine's, and where a search begins is what it tells.
    return Fitted(np.round(units, SURE), share, np.round(axes, SURE))


def _apart(off: Floats, sure: Floats) -> Floats:
    """Return how far points are off, (n,) pixels, as far as that is sure."""
    return np.sqrt(np.maximum(SNAPPED * np.einsum("in,nij,jn->n", off, sure, off), 0))


def _matched(evidence: Evidence, where: Bools, about: tuple[float, float] | None) -> Matches:
    traced = evidence.picture.made_of(evidence.frame.color)
    shown = evidence.picture.color[..., : traced.shape[-1]]
    edges = beside_edges(np.nan_to_num(traced), 2 * NEAR) & where
    rows, columns = np.unravel_index(spread(edges, POINTS), edges.shape)
    pair = _gray(traced), _gray(shown)
    starts = _starts(*pair) if about is None else [np.rint(about)]
    found = [_followed(pair, (rows, columns), start, _coarsest(where)) for start in starts]
    moved, wrong, steps = found[0]
    for other, wrong_there, _ in found[1:]:
        better = wrong_there.min(axis=1) < wrong.min(axis=1) - ALIKE
        moved = np.where(better, other, moved)
        wrong = np.where(better[:, None], wrong_there, wrong)
    good = wrong <= wrong.min(axis=1, keepdims=True) + ALIKE
    good &= wrong.min(axis=1, keepdims=True) < 0.5
    share = good / np.maximum(good.sum(axis=1), 1)[:, None]
    beside = steps - steps[:, wrong.argmin(axis=1)].T[..., None]  # (n, 2, m)
    mean = np.einsum("nm,nim->in", share, beside)
    apart = beside - mean.T[..., None]
    spreads, axes = np.linalg.eigh(np.einsum("nm,nim,njm->nij", share, apart, apart))
    sure = np.where(spreads < STRAIGHT, 1 / (spreads + SNAPPED), 0.0) * good.any(axis=1)[:, None]
    known = np.flatnonzero(sure.any(axis=1))
    each = np.einsum("nij,nj,nkj->nik", axes, sure, axes)
    rows, columns = rows[known], columns[known]
    camera = evidence.case.scene.camera
    film = film_at(camera, rows, columns)
    nearest = -largest_within(-evidence.depths(), 1)  # at an edge, what is in front
    points = camera_rays(camera, *film).at(nearest[rows, columns])
    return Matches(points, film + (moved + mean)[:, known], each[known])


def _gray(colors: Array) -> Floats:
    """Project colours (h, w, c) on an axis that separates most of them."""
    weights = np.array((0.31, 0.53, 0.97, 0.41))[: colors.shape[-1]]
    known = np.nan_to_num(colors.astype(np.float64), posinf=0, neginf=0)
    return np.clip(known, -4, 4) @ weights


def _followed(
    pair: tuple[Floats, Floats], at: tuple[Places, ...], start: Floats, scale: int
) -> tuple[Floats, Floats, Floats]:
    """Return by how much n windows are moved, (2, n), and what is wrong at places beside that."""
    moved, reach = np.repeat(start[:, None], len(at[0]), axis=1), FAR
    while scale >= 1:
        wrong, steps = _compared(pair, at, moved.astype(int), scale, reach)
        moved += steps[:, wrong.argmin(axis=1)]
        scale, reach = scale // 2, CLOSE
    return moved, wrong, steps


def _starts(traced: Floats, shown: Floats) -> Floats:
    """Return by how many pixels, right and up, a picture (h, w) may be moved, (k, 2).

    Beside none, it is where the phases of both correlate (Kuglin and Hines 1975).
    """
    both = np.conj(np.fft.rfft2(traced)) * np.fft.rfft2(shown)
    alike = np.fft.irfft2(both / np.maximum(np.abs(both), np.finfo(float).tiny), traced.shape)
    size = np.array(traced.shape)
    place = np.array(np.unravel_index(np.argmax(alike), alike.shape))
    up, right = (place + size // 2) % size - size // 2
    return np.array([*dict.fromkeys([(0, 0), (int(right), int(up))])], np.float64)


def _coarsest(where: Bools) -> int:
    """Return how many pixels wide those of a window are at first: it spans half of a mask."""
    size = min(int(where.any(axis=axis).sum()) for axis in (0, 1))
    wide = max(1, size // (2 * (2 * WINDOW + 1)))
    return 1 << (wide.bit_length() - 1)


def _compared(
    pair: tuple[Floats, Floats],
    at: tuple[Places, ...],
    moved: Places,
    scale: int,
    reach: int,
) -> tuple[Floats, Floats]:
    """Return the share of wrong pixels of n windows at m places, (n, m), and the places, (2, m)."""
    traced, shown = pair
    side = scale * np.arange(-WINDOW, WINDOW + 1)
    y, x = (v.ravel() for v in np.meshgrid(side, side, indexing="ij"))
    rows, columns = at[0][:, None] + y, at[1][:, None] + x
    own = _seen_at(traced, rows, columns)
    places = scale * np.arange(-reach, reach + 1)
    steps = np.array(np.meshgrid(places, places)).reshape(2, -1)
    steps = steps[:, np.argsort(np.abs(steps).sum(axis=0), kind="stable")]
    wrong = np.empty((len(rows), steps.shape[1]))
    for number, (dx, dy) in enumerate(steps.T):
        there = rows + moved[1][:, None] + dy, columns + moved[0][:, None] + dx
        apart = np.abs(own - _seen_at(shown, *there))
        count, differ = np.isfinite(apart).sum(axis=1), (apart > NEAR).sum(axis=1)
        wrong[:, number] = np.where(2 * count >= len(y), differ / np.maximum(count, 1), 1.0)
    return wrong, steps.astype(np.float64)


def _seen_at(picture: Floats, rows: Places, columns: Places) -> Floats:
    """Return some pixels of a picture (h, w); NaN outside of it."""
    height, width = picture.shape
    inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    seen = picture[rows.clip(0, height - 1), columns.clip(0, width - 1)]
    return np.where(inside, seen, np.nan)


def is_everywhere(evidence: Evidence) -> bool:
    """Return whether edges in most parts of the picture are unexplained, as with another camera.

    A few pixels may lie anywhere: they are taken to do so.
    """
    return bool(evidence.unexplained.sum() < MANY) or touched_parts(evidence) >= MOST


def touched_parts(evidence: Evidence) -> float:
    """Return the share of the picture's parts with edges in which some are unexplained (cached)."""
    return evidence.once("parts", lambda: _touched(evidence))


def _touched(evidence: Evidence) -> float:
    edges = beside_edges(np.nan_to_num(evidence.picture.made_of(evidence.frame.color)), 2 * NEAR)
    tiles, touched = (_in_tiles(v) for v in (edges, edges & evidence.unexplained))
    return float(touched[tiles > 0].astype(bool).mean()) if tiles.any() else 1.0


def _in_tiles(mask: Bools) -> Integers:
    """Count a mask's pixels (h, w) in each tile of the picture."""
    rows, columns = (np.linspace(0, n, TILES, endpoint=False, dtype=int) for n in mask.shape)
    counts: Integers = np.add.reduceat(np.add.reduceat(mask, rows, dtype=int), columns, axis=1)
    return counts
