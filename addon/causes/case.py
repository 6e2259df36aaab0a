"""The input of a comparison: a scene, the other side's picture of it, and what is known of both."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import Bools, Colors, Integers
from ..manifest import Effect, Manifest
from ..pictures.certificate import CameraCertificate
from ..pictures.picture import Curve, Picture
from ..scene import Scene, without
from ..tracer.coloring import Color
from ..tracer.hits import NOTHING
from ..tracer.render import Tracer
from ..tracer.settings import Settings

# The least share of the pixels that another scene changes in which it must be what the picture
# shows: of an alternative, as of a fault.
PRECISE = 0.97


@dataclass(frozen=True, eq=False)
class Alternative:
    """The scene as the other side may have it: one object more or less, or another frame."""

    object: str
    reason: str
    scene: Scene


MOST_VARIANTS = 48  # of a scene: each is evaluated, and tried
WHOLE = "whole"  # in place of a fault's name: the scene as it is, with all that no ray meets


@dataclass(frozen=True, eq=False)
class Variant:
    """The scene with a fault that only Blender can make, as it knows what the scene came from."""

    fault: str  # the name of its record in `faults/`, or WHOLE
    scene: Scene
    words: str = ""  # which camera, frame, level...
    object: str = ""  # that has the fault, if it is one object's


@dataclass(frozen=True, eq=False)
class Behind:
    """The case without the objects that are seen through, as glass: what is behind them."""

    case: Case
    left_out: frozenset[str]  # the objects


def without_colors(case: Case) -> Case:
    """Return a case with a picture of data: what changes colours alone changes nothing."""
    of_colors = Effect.COLOR, Effect.LIGHT
    others = tuple(
        replace(u, effect=Effect.NONE) if u.effect in of_colors else u
        for u in case.manifest.unmodelled
    )
    drawn = case.picture.drawn and replace(case.picture.drawn, beneath=None)
    return replace(
        case,
        manifest=replace(case.manifest, unmodelled=others),
        picture=replace(case.picture, drawn=drawn),
        curves=None,
    )


@dataclass(frozen=True, eq=False)
class Case:
    """All that a comparison takes; the checks, the self-check and the faults take it, too."""

    scene: Scene
    manifest: Manifest
    settings: Settings  # how the scene is traced; always in the objects' own colours
    picture: Picture  # what it is compared with
    certificate: CameraCertificate | None = None
    alternatives: tuple[Alternative, ...] = ()  # the scene as the other side may have it
    # Transforms of the colours to try besides the usual ones. None: the colours are as drawn.
    curves: tuple[Curve, ...] | None = None
    self_check: bool = False  # whether known faults are to be made, and found
    next_frame: Scene | None = None  # the scene a frame later, for the self-check
    behind: Behind | None = None  # if the other side was drawn without what is seen through, too
    tracer: Tracer | None = None  # where whole pictures are traced, if not here
    # Makes the scene with faults for which Blender is needed, one after another; called only if
    # pixels are unexplained.
    variants: Callable[[], Iterable[Variant]] = tuple
    background: Colors | None = None  # (4,) the scene's own, where it was put before another one

    def __post_init__(self) -> None:
        if self.settings.color != Color.OBJECT:
            object.__setattr__(self, "settings", replace(self.settings, color=Color.OBJECT))

    def feature_of(self, effect: Effect) -> Integers:
        """Return which feature with an effect each instance has, then each plane, (k + 1,).

        It is an index into the manifest's `unmodelled`; NOTHING for none, and at the end.
        """
        features = enumerate(self.manifest.unmodelled)
        number = {u.object: n for n, u in features if u.effect is effect}
        found = [number.get(name, NOTHING) for name in self.scene.objects]
        return np.array([*found, NOTHING], np.int32)[self.scene.instance_objects]

    @property
    def colorless(self) -> Bools:
        """Whether each instance, then each plane, has colours that the tracer does not know."""
        return self.feature_of(Effect.COLOR) != NOTHING

    def with_scenes(self, change: Callable[[Scene], Scene]) -> Case:
        """Return the case with the same change made to the scene and to the alternatives."""
        others = tuple(replace(a, scene=change(a.scene)) for a in self.alternatives)
        behind = self.behind and replace(self.behind, case=self.behind.case.with_scenes(change))
        return replace(self.in_scene(change(self.scene)), alternatives=others, behind=behind)

    def in_scene(self, scene: Scene) -> Case:
        """Return the case with another scene."""
        behind = self.behind
        if behind:
            rest = without(scene, behind.left_out)
            behind = replace(behind, case=behind.case.in_scene(rest))
        owners = self.picture.owners
        picture = replace(self.picture, owners=owners and owners.in_scene(scene, self.scene))
        return replace(self, scene=scene, picture=picture, behind=behind)

    def before(self, background: Colors) -> Case:
        """Return the case with all scenes, and the picture, on a background, linear RGBA."""
        behind = partial(replace, background=background)
        picture = replace(self.picture, background=background)
        then = self.next_frame and behind(self.next_frame)
        own = self.scene.background if self.background is None else self.background
        changed = self.with_scenes(behind)
        return replace(changed, picture=picture, next_frame=then, background=own)
