"""Fits cameras in the same place: an offset on the film, another focal length, a roll.

First the traced picture itself is looked up where such a camera would have seen it, which needs no
ray and finds the numbers to within about a pixel. Then rays are traced, in what is left of the
sample, until the numbers with the most pixels that agree are enclosed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Array, Floats
from ...scene import Camera, ViewWindow
from ...tracer.camera import pixel_size
from ...tracer.progress import Work
from ..checks.probe import Probe
from ..evidence import NEAR, Evidence, film_beside_camera
from .fault import Find, Guess, Refine
from .search import Search, Values

REACH = 2.0  # pixels that rays may pass beside where they start; beyond, they start anew
VALID = 0.3  # the least share of the sample that a camera must see in the traced picture
KEPT = 3  # starts that are fitted: none of the numbers, and those that look best
STEP = 4.0  # pixels that the picture's corners move from one start to the next
LOOKED_UP = 512  # pixels in which the traced picture is looked up
FINER = 1 / 8  # pixels: the first step where a fit is made finer
BETTER = 0.03  # by how much larger the share of right pixels must be for a start


@dataclass(frozen=True)
class Family:
    """Cameras that differ in a few numbers."""

    camera: Callable[..., Camera | None]
    units: Callable[[Camera], Values]  # changes of the numbers that move the film by about a pixel
    starts: Callable[[Evidence], Iterator[Values]]
    words: Callable[[Guess], str] = lambda guess: ""


def _moved(camera: Camera, dx: float, dy: float) -> Camera:
    """Return the camera whose rays pass the pixels' centres at (dx, dy), in pixels."""
    (width, height), w = pixel_size(camera), camera.window
    x, y = dx * width, dy * height
    return replace(camera, window=ViewWindow(w.left + x, w.right + x, w.bottom + y, w.top + y))


def _zoomed(camera: Camera, percent: float) -> Camera | None:
    """Return the camera with another focal length, or orthographic scale; panoramas have none."""
    factor = 1 + percent / 100
    if not camera.projection.is_linear or factor <= 0:
        return None
    w = camera.window
    sides = (w.left / factor, w.right / factor, w.bottom / factor, w.top / factor)
    return replace(camera, window=ViewWindow(*sides))


def _rolled(camera: Camera, degrees: float) -> Camera:
    """Return the camera turned about its axis; its content turns the other way."""
    angle = np.radians(degrees)
    right, up = camera.right.copy(), camera.up.copy()
    matrix = camera.world_from_camera.copy()
    matrix[:3, 0] = np.cos(angle) * right + np.sin(angle) * up
    matrix[:3, 1] = np.cos(angle) * up - np.sin(angle) * right
    return replace(camera, world_from_camera=matrix)


def _radius(camera: Camera) -> float:
    """Return how far the picture's corners are from its middle, in pixels."""
    return float(np.hypot(camera.region.width, camera.region.height)) / 2


def _zooms(evidence: Evidence) -> Iterator[Values]:
    step = STEP / _radius(evidence.case.scene.camera)
    for factor in np.exp(np.arange(-np.log(4), np.log(4), step)):
        yield (100 * float(factor) - 100,)


def _rolls(evidence: Evidence) -> Iterator[Values]:
    step = np.degrees(STEP / _radius(evidence.case.scene.camera))
    for degrees in np.arange(-180, 180, step):
        yield (float(degrees),)


def _offsets(evidence: Evidence) -> Iterator[Values]:
    """Yield offsets for which the traced picture and the shown one correlate best, and (0, 0)."""
    yield (0.0, 0.0)
    traced, shown = (_gray(c) for c in (evidence.frame.color, evidence.picture.color))
    size = [2 * n for n in traced.shape]
    product = np.fft.rfft2(traced, size) * np.conj(np.fft.rfft2(shown, size))
    for whitened in (True, False):
        spectrum = product / (np.abs(product) + 1e-12) if whitened else product
        likeness = np.fft.irfft2(spectrum, size)
        for index in np.argsort(likeness, axis=None)[: -KEPT - 1 : -1]:
            y, x = np.unravel_index(index, likeness.shape)
            height, width = traced.shape
            dx, dy = (
                (int(x) + width) % (2 * width) - width,
                (int(y) + height) % (2 * height) - height,
            )
            yield (float(dx), float(dy))


def _gray(colors: Array) -> Floats:
    """Return one number for each colour (h, w, 4), which tells most colours apart; mean 0."""
    gray = np.nan_to_num(colors.astype(np.float64), posinf=0, neginf=0) @ (0.31, 0.53, 0.97, 0.41)
    return np.clip(gray - gray.mean(), -4, 4)


OFFSET = Family(
    _moved,
    lambda camera: (1.0, 1.0),
    _offsets,
    lambda guess: (
        "the camera's rays pass the pixels' corners, not their centres"
        if all(abs(v) == 0.5 for v in guess.values)
        else "the camera's rays pass beside the pixels' centres"
    ),
)
FOCAL = Family(
    _zoomed,
    lambda camera: (100 / _radius(camera),),
    _zooms,
    lambda guess: f"the picture shows {'less' if guess.values[0] > 0 else 'more'} than it should",
)
ROLL = Family(_rolled, lambda camera: (float(np.degrees(1 / _radius(camera))),), _rolls)


def fitting(family: Family) -> tuple[Find, Refine]:
    """Return what finds the numbers of a family in a picture, and what fits them finely."""

    def refine(evidence: Evidence, guess: Guess) -> Work[Guess | None]:
        units = family.units(evidence.case.scene.camera)
        search = Search(_Traced(evidence, family).right, units, least=evidence.least_right)
        found = yield from search.guess([guess.values], FINER if guess.low else 1.0)
        return found and replace(found, words=family.words(found))

    def find(evidence: Evidence) -> Work[list[Guess]]:
        out = []
        for start in (yield from _likely(evidence, family)):
            guess = yield from refine(evidence, Guess(start))
            if guess:
                out.append(guess)
        return out

    return find, refine


def _likely(evidence: Evidence, family: Family) -> Work[list[Values]]:
    """Return the numbers for which looking up gives the most right pixels, the best first."""
    camera = evidence.case.scene.camera
    if family.camera(camera, *([0.0] * len(family.units(camera)))) is None:
        return []
    none = (0.0,) * len(family.units(camera))
    least = looked_up(evidence, camera) + BETTER
    scores: list[tuple[float, Values]] = [(2.0, none)]  # nearer than a pixel nothing can be seen
    for number, values in enumerate(family.starts(evidence)):
        other = family.camera(camera, *values)
        if other is not None:
            score = looked_up(evidence, other)
            if score > least:
                scores.append((score, values))
        if number % 32 == 0:
            yield 0.0
    best: list[Values] = []
    units = np.array(family.units(camera))
    for _, values in sorted(scores, key=lambda pair: -pair[0]):
        apart = [np.abs(np.subtract(values, b) / units).max() > 2 * REACH for b in best]
        if len(best) < KEPT and all(apart):
            best.append(values)
    return best


def looked_up(evidence: Evidence, camera: Camera) -> float:
    """Return the share of the sample that is right if the traced picture is seen by a camera.

    The camera stands where the case's does; what lies outside the traced picture is not known.
    """
    own, r = evidence.case.scene.camera, evidence.case.scene.camera.region
    few = slice(None, None, -(-evidence.film.shape[1] // LOOKED_UP))
    with np.errstate(invalid="ignore"):
        x, y = film_beside_camera(own, camera, *evidence.film[:, few])
        column, row = np.floor(x - r.x0), np.floor(y - r.y0)
        inside = (column >= 0) & (column < r.width) & (row >= 0) & (row < r.height)
    if inside.mean() < VALID:
        return 0.0
    where = row[inside].astype(int), column[inside].astype(int)
    shown = evidence.shown.at(few).at(inside)
    made = shown.made_of(evidence.frame.color[where])
    right = np.abs(made - shown.color[:, : made.shape[1]]).max(axis=1) <= NEAR
    if shown.owner is not None and shown.owners is not None:
        right &= shown.owners[evidence.frame.instance_index[where]] == shown.owner
    return float(right.mean())


class _Traced:
    """Counts the right pixels of the sample for the cameras of a family.

    Rays are traced beside those of a camera that was prepared, as long as they are near enough.
    """

    def __init__(self, evidence: Evidence, family: Family) -> None:
        self.evidence = evidence
        self.family = family
        self.probe: Probe | None = None

    def right(self, values: Values) -> Work[int]:
        """Return how many pixels agree, -1 if there is no such camera."""
        evidence = self.evidence
        camera = self.family.camera(evidence.case.scene.camera, *values)
        if camera is None:
            return -1
        moved = np.full_like(evidence.film, np.inf)
        if self.probe:
            there = film_beside_camera(self.probe.scene.camera, camera, *evidence.film)
            moved = there - evidence.film
        if not np.abs(moved).max() <= REACH:
            scene = evidence.case.scene.seen_by(camera)
            self.probe = yield from evidence.probe(scene, REACH)
            moved = np.zeros_like(evidence.film)
        assert self.probe
        hits = yield from self.probe.trace(*moved)
        return int(evidence.agrees(self.probe.scene, hits).sum())
