"""Fits a camera in a few numbers: an offset on the film, a focal length, where it stands.

First the edges that are traced are found in the picture (`matching.py`): that needs no ray, and
gives the numbers to a fraction of a pixel. Where most are not found, as they moved too far, the
traced picture is looked up (reprojected) as such a camera would see it. Then rays are traced in the
sampled pixels, until the numbers with the most right pixels are enclosed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...arrays import Bools, Floats
from ...causes.checks.probe import Probe
from ...rendering import frame_of
from ...scene import Camera
from ...tracer.camera import camera_rays
from ...tracer.progress import Work
from ..evidence import WORTH, Evidence
from .fault import Numbers, Values, of_camera
from .matching import Fitted, fitted, is_everywhere, matches, seen_by
from .search import Right, Search, values_of

REACH = 4.0  # pixels that a camera's rays may move before its candidates are found anew
FINE_REACH = 1.0  # the same in a refinement: fewer triangles are near
PREPARED = 2  # cameras with candidates that are kept, as a search goes to and fro
VALID = 0.3  # the least share of the sample that a camera must see in the traced picture
KEPT = 3  # starts that are looked up and fitted, at most
FOUND = 0.5  # of the edges: a camera that explains fewer is not where they moved
NEARLY = 0.8  # of the edges that some camera explains: one that explains fewer is the wrong one
CLEAR = 0.95  # of the edges: where colours are mixed there, no ray says more than they do
MORE = 0.05  # of the edges: as many more must a change explain than none
LOOKED_UP = 512  # pixels in which the traced picture is looked up
FINER = 1 / 8  # pixels: the first step of a refinement
ENOUGH = 0.95  # of the sample: with as many right, no other start is fitted
MOVES = 3  # with steps of one length, at most: a right start is off by a pixel or two
BETTER = 0.03  # the least gain of a start in the share of right pixels
ENCLOSED = 3  # numbers, at most, that get ranges
FOLLOWED = 2  # times that edges are traced and found anew, at most
FITTED = 1024  # sampled pixels of each kind for more numbers
WIDER = 2.0  # times the reach of a fit of more numbers, which pulls at several


def looked_up(evidence: Evidence, camera: Camera) -> float:
    """Return the share of the sample that agrees with the traced picture as a camera sees it.

    The camera stands where the case's does; what lies outside the traced picture is not known.
    """
    own = evidence.case.scene.camera
    few = _few(evidence)
    with np.errstate(invalid="ignore"):
        rays = camera_rays(camera, *evidence.film[:, few])
        # A panorama's or perspective's rays pass one point: any point of them will do.
        film = seen_by(own, rays.at(np.ones(rays.count)))
        column, row = np.floor(film - ((own.region.x0,), (own.region.y0,)))
    height, width = evidence.unexplained.shape
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    if inside.mean() < VALID:
        return 0.0
    traced = evidence.frame.hits().take((row * width + column)[inside].astype(int))
    shown = evidence.shown.at(few).at(inside)
    return float((~shown.differ(evidence.case.scene, traced)).mean())


def _few(evidence: Evidence) -> slice:
    return slice(None, None, max(1, -(-evidence.film.shape[1] // LOOKED_UP)))


@dataclass(frozen=True)
class Family:
    """Cameras that differ in a few numbers."""

    camera: Callable[..., Camera | None]
    # Changes of the numbers that move the film by about a pixel, (m, k) columns.
    axes: Callable[[Evidence], Floats]
    words: Callable[..., str] = lambda camera, *numbers: ""
    # Numbers that are looked up where edges moved too far to be found.
    starts: Callable[[Evidence], Iterator[Values]] = lambda evidence: iter(())
    # Of the unexplained pixels: a fit with fewer right is given up at steps of half a pixel.
    worth: float = WORTH
    # Changes of the numbers, (m, j) columns, that change nothing in the picture.
    unseen: Callable[[Evidence], Floats | None] = lambda evidence: None

    def matched(self, evidence: Evidence) -> Fitted | None:
        """Return the numbers, in units, with which the edges are where the picture has them."""
        return evidence.once(f"matched {id(self)}", lambda: self._matched(evidence, evidence))

    def followed(self, evidence: Evidence) -> Work[Fitted | None]:
        """Return the same, found again in what is traced there: far away, much looks otherwise.

        Only where it has many numbers, and explains some edges.
        """
        found, axes, scene = self.matched(evidence), self.axes(evidence), evidence.case.scene
        if found and found.share >= FOUND / 2 and len(axes) > ENCLOSED:
            for _ in range(FOLLOWED):
                camera = self.camera(scene.camera, *axes @ found.units)
                if camera is None:
                    break
                frame = yield from frame_of(scene.seen_by(camera), evidence.case.settings)
                case = evidence.case.in_scene(frame.scene)
                there = replace(evidence, case=case, frame=frame, known={})
                again = self._matched(evidence, there, found.units)
                if again is None or again.share <= found.share:
                    break
                found = again
        return found

    def _matched(
        self, evidence: Evidence, there: Evidence, units: Floats | float = 0.0
    ) -> Fitted | None:
        axes = self.axes(evidence)
        own = evidence.case.scene.camera
        found = matches(there)

        def seen(more: Floats) -> Floats:
            return seen_by(self.camera(own, *axes @ (units + more)), found.points)

        more = fitted(found, seen, axes.shape[1])
        return more and more._replace(units=units + more.units)


def fitting(family: Family, *rivals: Family) -> dict[str, Any]:
    """Return how a fault of the camera is made, found and refined, as fields of it.

    Where a rival, with more numbers, explains many more edges, no ray is traced for it.
    """

    def refine(evidence: Evidence, guess: Numbers) -> Work[Numbers | None]:
        fine = bool(guess.low)
        axes, known = family.axes(evidence), len(guess.values) <= ENCLOSED
        reach = FINE_REACH if fine else REACH
        if not known:
            evidence = replace(evidence, size=min(evidence.size, FITTED))
            found = family.matched(evidence)
            axes = axes @ found.axes if found else axes
            reach *= WIDER
        search = Search(
            traced(evidence, family.camera, reach),
            axes,
            least=evidence.least_right(family.worth),
            unseen=family.unseen(evidence),
            moves=np.inf if fine else MOVES,
        )
        step = FINER if fine else 0.5
        best = yield from search.guess([guess.values], step, enclose=fine and known)
        if best is None:
            return None
        return replace(best, words=family.words(evidence.case.scene.camera, *best.values))

    def find(evidence: Evidence) -> Work[list[Numbers]]:
        out: list[Numbers] = []
        found, own = family.matched(evidence), evidence.case.scene.camera
        for start in (yield from _likely(evidence, family, rivals)):
            few, many = evidence.few if len(start) > 1 else evidence, len(start) > ENCLOSED
            guess = None if many else (yield from refine(few, Numbers(start)))
            if not guess and found and (many or found.share >= CLEAR):
                out.append(Numbers(start, start, start, words=family.words(own, *start)))
            elif guess:
                out.append(guess)
                right = yield from traced(few, family.camera)(guess.values)
                if right is not None and right.mean() >= ENOUGH:
                    break
        return out

    return {"assume": of_camera(family.camera), "find": find, "refine": refine}


def _likely(evidence: Evidence, family: Family, rivals: Sequence[Family]) -> Work[list[Values]]:
    """Return the numbers from which rays are traced: by the edges, else the best by look-up.

    Where as many edges are explained by no change, they moved by less than a pixel, or not at all.
    """
    axes, own = family.axes(evidence), evidence.case.scene.camera
    none = (0.0,) * len(axes)
    if family.camera(own, *none) is None:
        return []
    film = seen_by(own, matches(evidence).points)
    found = yield from family.followed(evidence)
    still = fitted(matches(evidence), lambda units: film, 0)
    others = [other.share for r in rivals if (other := r.matched(evidence))]
    if found and still and (most := max(found.share, still.share, *others)) >= FOUND:
        moves = found.share >= still.share + MORE or is_everywhere(evidence)
        return [values_of(axes @ found.units)] if moves and found.share >= NEARLY * most else []
    least = looked_up(evidence, own) + BETTER
    scores: list[tuple[float, Values]] = []
    for number, values in enumerate(family.starts(evidence)):
        camera = family.camera(own, *values)
        if camera and (score := looked_up(evidence, camera)) > least:
            scores.append((score, values))
        if number % 32 == 0:
            yield None
    return [values for _, values in sorted(scores, key=lambda pair: -pair[0])[:KEPT]]


def traced(evidence: Evidence, change: Callable[..., Camera | None], reach: float = REACH) -> Right:
    """Return a function: which pixels of a sample are right with a camera of some numbers.

    Rays are tested with the triangles near those of a camera that was prepared, as long as what
    they meet is seen near enough by it.

    Parameters
    ----------
    evidence : Evidence
        With the sample, and the scene that is traced.
    change : callable
        The camera with some numbers, from the scene's own one.
    reach : float
        Pixels that rays may pass beside where they start.
    """
    guide = evidence.points[:, _few(evidence)]  # how far it moves says whether triangles stay near
    probes: list[Probe] = []  # the last one first

    def is_near(prepared: Camera, camera: Camera) -> bool:
        with np.errstate(all="ignore"):
            moved = np.abs(seen_by(camera, guide) - seen_by(prepared, guide))
        known = np.isfinite(moved)
        return bool(known.any() and moved[known].max() <= reach)

    def right(values: Values) -> Work[Bools | None]:
        camera = change(evidence.case.scene.camera, *values)
        if camera is None:
            return None
        scene = evidence.case.scene.seen_by(camera)
        probe = next((p for p in probes if is_near(p.scene.camera, camera)), None)
        if probe is None:
            probe = yield from evidence.probe(scene, reach)
            probes[:] = [probe, *probes[: PREPARED - 1]]
        return evidence.agrees(scene, (yield from replace(probe, scene=scene).trace()))

    return right
