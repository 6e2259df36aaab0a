"""What a comparison takes: a scene, the other side's picture of it, and what is known of both."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import Bools, Colors, Integers
from ..manifest import Effect, Manifest
from ..scene import Scene
from ..tracer.coloring import Color
from ..tracer.hits import NOTHING
from ..tracer.render import Tracer
from ..tracer.settings import Settings
from .certificate import CameraCertificate
from .picture import Curve, Picture


@dataclass(frozen=True, eq=False)
class Alternative:
    """The scene as the other side may have it: one object more or less, or another frame."""

    object: str
    reason: str
    scene: Scene


@dataclass(frozen=True, eq=False)
class Case:
    """All that a comparison takes; the checks, the self-check and the faults take it, too."""

    scene: Scene
    manifest: Manifest
    settings: Settings  # how the scene is traced; always in the objects' own colours
    picture: Picture  # what it is compared with
    certificate: CameraCertificate | None = None
    alternatives: tuple[Alternative, ...] = ()  # the scene as the other side may have it
    # What may have been done to the colours, besides what is always tried. None: nothing was.
    curves: tuple[Curve, ...] | None = None
    self_check: bool = False  # whether known faults are to be made, and found
    next_frame: Scene | None = None  # the scene a frame later, for the self-check
    tracer: Tracer | None = None  # where whole pictures are traced, if not here

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
        """Return the same with the scene and the alternatives changed alike."""
        others = tuple(replace(a, scene=change(a.scene)) for a in self.alternatives)
        return replace(self, scene=change(self.scene), alternatives=others)

    def before(self, background: Colors) -> Case:
        """Return the same with all scenes, and the picture, before a background, linear RGBA."""
        behind = partial(replace, background=background)
        picture = replace(self.picture, background=background)
        then = self.next_frame and behind(self.next_frame)
        return replace(self.with_scenes(behind), picture=picture, next_frame=then)
