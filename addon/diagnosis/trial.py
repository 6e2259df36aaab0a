"""Tries a guess on the whole picture: traced with it, compared again with all the causes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools
from ..causes.case import Case
from ..causes.checks.unmodelled import as_known
from ..causes.explain import explain
from ..pictures.storage import differing
from ..rendering import frame_of
from ..scene import Scene, SceneError
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.progress import Work
from .evidence import Evidence, shows_colors
from .faults.fault import AnyFault, Guess
from .regions import labels
from .seen import identical

HOPE = 2.0  # pixels that a guess settles, at least, for each one that it breaks
LOOKED_AT = 1 << 14  # differing pixels that are checked, at most


@dataclass(frozen=True, eq=False)
class Trial:
    """How a guess does in the whole picture."""

    fault: AnyFault
    guess: Guess
    evidence: Evidence  # with the fault put right
    settled: int  # pixels that were unexplained, and are not now
    broken: int  # pixels that agreed or had a cause, and are unexplained now
    stubborn: int  # unexplained pixels that it changes, and that stay unexplained
    touched: int  # unexplained pixels of the regions in which it settles any
    own: float = 1.0  # the share it settles of those in which its object is seen, before or after

    @property
    def cost(self) -> int:
        """How many numbers were fitted."""
        return len(self.guess.low)

    @property
    def gain(self) -> int:
        """How many more pixels are explained."""
        return self.settled - self.broken

    @property
    def unseen(self) -> bool:
        """Whether its object is not seen any more: then all that is known is that it is missing."""
        names, name = self.evidence.case.scene.objects, self.guess.object
        if name not in names or self.fault.removes:
            return False
        return not (self.evidence.frame.object_index == names.index(name)).any()

    @property
    def perfect(self) -> bool:
        """Whether it settles all that is unexplained, and breaks nothing."""
        return not self.broken and not self.evidence.unexplained.any()

    @property
    def recall(self) -> float:
        """The share of the unexplained pixels that it settles, in the regions that it touches."""
        return self.settled / max(self.touched, 1)

    @property
    def precision(self) -> float:
        """The share of the pixels that it changes for which it is right."""
        return self.settled / max(self.settled + self.broken + self.stubborn, 1)


def trial_of(
    evidence: Evidence,
    fault: AnyFault,
    guess: Guess,
    of: Evidence | None = None,
    promising: bool = False,
) -> Work[Trial | None]:
    """Try a guess on the whole picture.

    `of` is the evidence before other faults were put right, if there are any: what the trial counts
    is of that. None if the guess cannot be tried, or is not promising.
    """
    before = of or evidence
    case, frame = evidence.case, evidence.frame
    try:
        other = fault.assume(case, guess)
        if other is None:
            return None
        traced = yield from traced_anew(other, case, frame)
        if fault.after is not None:
            color = fault.after(traced.color, guess, evidence)
            traced = replace(frame, color=color.astype(np.float32))
            other = replace(other, scene=case.scene, alternatives=case.alternatives)
        if traced.shape != frame.shape or not (promising or _hopeful(before, other, traced)):
            return None
    except (SceneError, MemoryError):  # no such camera or scene can be, or be traced here
        return None
    explained = yield from explain(other, traced, LOOKED_AT)
    if fault.removes and explained.background:
        own = frame.object_index == case.scene.objects.index(guess.object)
        behind = np.array([explained.background.picture])
        if shows_colors(replace(evidence.picture, color=behind), frame.color[own]).any():
            return None  # what has its colour may be the object itself
    after = replace(
        evidence, case=explained.case, frame=explained.frame, causes=explained.causes, known={}
    )
    own = _of_object(guess.object, before, after)
    return Trial(fault, guess, after, *counted(before, after), own)


def in_full(trial: Trial) -> Work[Trial]:
    """Return a trial with no pixel passed over: what is told of it is of the whole picture."""
    after = trial.evidence
    if not len(after.causes.passed_over):
        return trial
    explained = yield from explain(after.case, after.frame)
    return replace(trial, evidence=replace(after, causes=explained.causes, known={}))


def traced_anew(other: Case, case: Case, frame: Frame) -> Work[Frame]:
    """Trace another case; if it has the same scene, return the frame there is.

    Where only colours are others, what was traced is painted anew.
    """
    if other.scene is case.scene:
        return frame
    if case.settings.samples == 1 and not frame.cancelled and same_shapes(other.scene, case.scene):
        color = shading.colors(other.scene, frame.hits()).reshape(frame.color.shape)
        return replace(frame, scene=other.scene, color=color)
    return (yield from frame_of(other.scene, case.settings))  # here: to wait for others is no work


def same_shapes(one: Scene, other: Scene) -> bool:
    """Return whether two scenes, one made of the other, differ in nothing but colours."""
    records = ((s.camera, *s.meshes, *s.planes) for s in (one, other))
    return (
        identical(*records)
        and np.array_equal(one.instance_meshes, other.instance_meshes)
        and np.array_equal(one.instance_matrices, other.instance_matrices)
    )


def _hopeful(before: Evidence, case: Case, frame: Frame) -> bool:
    """Return whether a guess settles enough pixels by colour alone to be compared further.

    The others are left to the checks, which take long where whole pictures differ.
    """
    mixes = case.picture.sampling.filter_radius
    if mixes > before.case.picture.sampling.filter_radius:
        return True
    picture = as_known(case)
    right = picture.shows(frame)
    right &= ~picture.other_object(frame.instance_index)
    settled = int((right & before.unexplained).sum())
    broken = int((~right & before.breakable).sum())
    # Where colours are mixed, it may be that only the checks can say so.
    return settled > HOPE * broken or bool(mixes and settled == broken == 0)


def counted(before: Evidence, after: Evidence) -> tuple[int, int, int, int]:
    """Count the pixels that are settled, broken, stubborn and touched: see :class:`Trial`."""
    settled = before.unexplained & ~after.unexplained & ~after.causes.unjudged
    stubborn = before.unexplained & after.unexplained & _changed(before, after)
    broken = after.unexplained & before.judged
    label = labels(before.unexplained)
    touched = before.unexplained & np.isin(label, label[settled])
    return int(settled.sum()), int(broken.sum()), int(stubborn.sum()), int(touched.sum())


def _of_object(name: str, before: Evidence, after: Evidence) -> float:
    """Return the settled share of an object's unexplained pixels; 1 without an object."""
    own = np.zeros(before.unexplained.shape, bool)
    for one in (before, after):
        numbers = [n for n, o in enumerate(one.case.scene.objects) if o == name]
        own |= np.isin(one.frame.object_index, numbers)
    own &= before.unexplained
    return float((~after.unexplained)[own].mean()) if own.any() else 1.0


def _changed(before: Evidence, after: Evidence) -> Bools:
    """Return which pixels (h, w) are traced in other colours; all, if the picture changed."""
    one, other = before.case.picture, after.case.picture
    if not one.holds_as(other):
        return np.ones(before.unexplained.shape, bool)
    if not one.has_colors:
        return one.sees_apart(before.frame, after.frame)
    return differing(before.frame.color, after.frame.color)
