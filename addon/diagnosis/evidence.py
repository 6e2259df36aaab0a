"""The evidence of a diagnosis: unexplained pixels, and the score of a guess on a sample of them.

A guess is tried on a sample first: half of it unexplained pixels, half pixels that agree, most of
these at edges, where a wrong camera shows first. A guess that is right makes the former agree, and
leaves the latter as they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np

from ..arrays import Array, Bools, Floats, Integers, Places
from ..causes.case import Case, Variant
from ..causes.cause import NOT_DECIDABLE, UNEXPLAINED, Causes
from ..causes.checks.probe import SOUND, Probe, blocks
from ..causes.checks.unmodelled import as_known
from ..pictures.metrics import beside_edges, boundary
from ..pictures.picture import Picture
from ..projections import ORTHOGRAPHIC
from ..scene import Camera, Scene
from ..tracer.camera import camera_rays
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING, Hits
from ..tracer.nearest import plan
from ..tracer.progress import Work
from .seen import Trees

T = TypeVar("T")

SAMPLE = 512  # sampled pixels of each kind
FEW = 128  # those of the small sample, which comes first
SEED = 27
LEAST_SETTLED = 10  # pixels, at least, by a guess; and half as many for each of its numbers
WORTH = 0.2  # of the unexplained pixels: a guess that settles fewer is dropped
NOISE = 0.03  # of all sampled pixels: as many may be wrong for another reason
LEAST_SEEN = 4  # unexplained pixels for which an object is suspected
INVOLVED = 0.1  # of the first suspect's pixels: other objects with as many are suspects, too
MOST_SUSPECTS = 4
MOST_COLORS = 512  # of a scene whose objects are recognised by their colours
BEYOND = 1e6  # the depth of the background, in depths of the farthest surface
NEAR = 0.02  # tolerance of a channel, for a colour to be recognised


class Score(NamedTuple):
    """How a guess does in the sampled pixels, scaled to the whole picture."""

    settled: float  # unexplained pixels that agree with it
    broken: float  # pixels that agreed and do not with it

    @property
    def gain(self) -> float:
        """How many more pixels agree."""
        return self.settled - self.broken


@dataclass(frozen=True, eq=False)
class Evidence:
    """A comparison with unexplained pixels."""

    case: Case
    frame: Frame  # what was traced of it
    causes: Causes
    variants: tuple[Variant, ...] = ()
    size: int = SAMPLE
    fine: bool = False  # whether only pixels beside edges are sampled
    of_object: bool = False  # whether a fault of a single object was put right in it
    known: dict[str, Any] = field(default_factory=dict)  # a cache that faults share
    trees: Trees = field(default_factory=Trees)

    def once(self, key: str, make: Callable[[], T]) -> T:
        """Return what several faults need, made once."""
        if key not in self.known:
            self.known[key] = make()
        found: T = self.known[key]
        return found

    def done_once(self, key: str, work: Work[T]) -> Work[T]:
        """Return the result of work that several faults need, done once."""
        if key not in self.known:
            self.known[key] = yield from work
        found: T = self.known[key]
        return found

    @cached_property
    def unexplained(self) -> Bools:
        """The pixels (h, w) that are unexplained, or passed over as there were too many."""
        out = self.causes.cause == UNEXPLAINED
        out.flat[self.causes.passed_over] = True
        return out

    @cached_property
    def judged(self) -> Bools:
        """The pixels (h, w) that agree or have a cause, and can be judged."""
        return ~self.unexplained & ~self.causes.unjudged & (self.causes.cause != NOT_DECIDABLE)

    @cached_property
    def picture(self) -> Picture:
        """The picture, as far as what is not modelled leaves it known."""
        return as_known(self.case)

    @cached_property
    def few(self) -> Evidence:
        """The same evidence with a smaller sample."""
        return replace(self, size=min(FEW, self.size))

    @cached_property
    def sample(self) -> tuple[Places, Places]:
        """Rows and columns of the n sampled pixels, row by row from the lowest."""
        rows, columns = np.nonzero(self._weights)
        return rows, columns

    @cached_property
    def _weights(self) -> Floats:
        """The weight of each sampled pixel, in pixels; 0 for all others, (h, w)."""
        out = np.zeros(self.unexplained.shape)
        edge = self.judged & boundary(self.frame)
        kinds = [
            (self.unexplained, self.size),
            (edge, 3 * self.size // 4),
            (self.judged & ~edge, self.size // 4),
        ]
        if self.fine:
            both = self.unexplained, self.judged
            kinds = [(some & self.beside_edges, self.size) for some in both]
        for some, most in kinds:
            chosen = spread(some, most)
            out.flat[chosen] = int(some.sum()) / max(len(chosen), 1)
        return out

    @cached_property
    def beside_edges(self) -> Bools:
        """The pixels (h, w) beside an edge of the picture, where small changes show."""
        out = beside_edges(np.nan_to_num(self.picture.color), 2 * NEAR)
        return out if (out & self.unexplained).any() else np.ones_like(out)

    def least_right(self, share: float = WORTH) -> float:
        """Return how many sampled pixels must agree for a guess to be worth a closer look.

        It is the count if a share of the unexplained ones agrees, and nearly all others.
        """
        wrong = self.unexplained_sampled
        return float((~wrong).sum() + share * wrong.sum()) * (1 - NOISE)

    @cached_property
    def shown(self) -> Picture:
        """The other side's picture at the n sampled pixels."""
        return self.picture.at(self.sample)

    @cached_property
    def unexplained_sampled(self) -> Bools:
        """The unexplained pixels among the n sampled ones, (n,)."""
        return self.unexplained[self.sample]

    def probe(self, scene: Scene, reach: float = 0.0) -> Work[Probe]:
        """Return a probe that traces the sampled pixels in a scene."""
        wanted = np.zeros(self.unexplained.shape, bool)
        wanted[self.sample] = True
        made = yield from plan(scene, SOUND, reach)
        return (yield from Probe.of(made, scene.camera.region, wanted.ravel()))

    def trace(self, scene: Scene, at: tuple[Places, Places] | None = None) -> Work[Hits]:
        """Trace a scene in n pixels, by row and column, or in the sampled ones."""
        film = film_at(scene.camera, *(self.sample if at is None else at))
        return (yield from self.trees.trace(scene, camera_rays(scene.camera, *film)))

    def score(self, case: Case) -> Work[Score]:
        """Score a case, with another scene or picture, on the sample."""
        r = case.scene.camera.region
        if (r.height, r.width) != self.unexplained.shape:
            return Score(0, 0)
        tracing = self.trace(case.scene)
        if case.scene is self.case.scene:
            tracing = self.done_once(f"hits {self.size} {self.fine}", tracing)
        hits = yield from tracing
        return self.scored(~as_known(case).at(self.sample).differ(case.scene, hits))

    def agrees(self, scene: Scene, hits: Hits) -> Bools:
        """Return which of the n sampled pixels agree with the n hits of a scene, (n,)."""
        return ~self.shown.differ(scene, hits)

    def scored(self, right: Bools) -> Score:
        """Score the sample, given which of its n pixels agree."""
        wrong, weights = self.unexplained_sampled, self._weights[self.sample]
        settled, broken = right & wrong, ~right & self.breakable[self.sample]
        return Score(float(weights[settled].sum()), float(weights[broken].sum()))

    @cached_property
    def breakable(self) -> Bools:
        """The judged pixels (h, w) that are right, and not by a filter, which may mix others."""
        if not self.case.picture.sampling.filter_radius:
            return self.judged
        return self.judged & self.picture.shows(self.frame)

    @cached_property
    def film(self) -> Floats:
        """The film positions of the n sampled pixels' centres, (2, n) pixels of the picture."""
        return film_at(self.case.scene.camera, *self.sample)

    @cached_property
    def points(self) -> Floats:
        """The points traced in the n sampled pixels, (3, n) world space; the background far away.

        Parallel rays that are turned would lose it: of them it is as far as the farthest surface.
        """
        camera = self.case.scene.camera
        beyond = 1.0 if camera.projection is ORTHOGRAPHIC else BEYOND
        rays = camera_rays(camera, *self.film)
        return rays.at(self.depths(beyond)[self.sample])

    def depths(self, beyond: float = BEYOND) -> Floats:
        """Return the depth of each pixel (h, w); of the background, as many farthest surfaces'."""
        _, farthest = self.frame.depths()
        return np.minimum(self.frame.t, beyond * max(farthest, 1.0))

    @cached_property
    def suspects(self) -> tuple[str, ...]:
        """The objects that are seen in unexplained pixels, or shown in them, the most first.

        All that a moved object makes wrong involves it; less of that involves what is around it, or
        as much: a floor is seen in more pixels.
        """
        scene = self.case.scene
        rows, columns = (v[self.unexplained_sampled] for v in self.sample)
        everywhere = self.frame.object_index
        seen = everywhere[rows, columns]
        shown = self._shown_objects()
        both = np.concatenate((seen, shown[shown != seen]))
        count = np.bincount(both[both >= 0], minlength=len(scene.objects))
        area = np.bincount(everywhere[everywhere >= 0], minlength=len(scene.objects))
        order = np.lexsort((area, -count))
        least = max(LEAST_SEEN, INVOLVED * int(np.max(count, initial=0)))
        return tuple(scene.objects[n] for n in order if count[n] >= least)[:MOST_SUSPECTS]

    def _shown_objects(self) -> Integers:
        """Return the object in each unexplained pixel of the sample; NOTHING where unknown."""
        scene, shown = self.case.scene, self.shown.at(np.flatnonzero(self.unexplained_sampled))
        objects, nothing = scene.instance_objects, len(scene.instance_objects) - 1
        none = np.full(len(shown.color), NOTHING, np.int32)
        if not shown.has_colors:
            return none
        if shown.owners:
            of_owner = reversed(list(enumerate(shown.owners.instances[:-1])))
            first = {int(owner): n for n, owner in of_owner}
            return objects[[first.get(int(owner), nothing) for owner in shown.owners.pixels]]
        table, first_rows = np.unique(scene.color_table[:-1], axis=0, return_index=True)
        if not 0 < len(table) <= MOST_COLORS:
            return none
        made = shown.made_of(table)
        apart = np.abs(shown.color[:, None, : made.shape[1]] - made).max(axis=-1)
        known, nearest = apart.min(axis=1) <= NEAR, first_rows[apart.argmin(axis=1)]
        row = np.where(known, nearest, len(scene.color_table) - 1)
        return objects[np.minimum(np.searchsorted(scene.color_rows[1][:-1], row), nothing)]


def film_at(camera: Camera, rows: Places, columns: Places) -> Floats:
    """Return the film positions of n pixels' centres, (2, n) pixels of the whole picture."""
    return np.stack((columns + camera.region.x0 + 0.5, rows + camera.region.y0 + 0.5))


def least_with(numbers: int) -> float:
    """Return how many pixels a guess with so many fitted numbers must settle, at least."""
    return LEAST_SETTLED * (1 + numbers / 2)


def spread(where: Bools, most: int) -> Places:
    """Return at most `most` pixels of a mask, by flat index, chosen at random."""
    found = np.flatnonzero(where)
    if len(found) <= most:
        return found
    rng = np.random.default_rng(SEED)
    return np.sort(rng.choice(found, most, replace=False))


def shows_colors(picture: Picture, colors: Array) -> Bools:
    """Return which pixels (...) of a picture have nearly one of m traced colours, (m, 4)."""
    out = np.zeros(picture.color.shape[:-1], bool)
    for made in picture.made_of(np.unique(colors, axis=0)):  # a thousand trees have one
        for rows in blocks(picture.color.shape):
            own = picture.color[rows][..., : len(made)]
            out[rows] |= (np.abs(own - made) <= NEAR).all(axis=-1)
    return out
