"""What a comparison takes: a scene, the other side's picture of it, and what is known of both."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..manifest import Manifest
from ..scene import Scene
from ..tracer.settings import Settings
from .cause import Hidden
from .certificate import CameraCertificate
from .picture import Curve, Picture


@dataclass(frozen=True, eq=False)
class Alternative:
    """The scene as the other side may have it: it differs in one object, or is of another frame."""

    object: str
    reason: str
    scene: Scene


@dataclass(frozen=True, eq=False)
class Case:
    """All that a comparison is made of; the checks, the self-check and the faults take it whole.

    Parameters
    ----------
    scene : Scene
    manifest : Manifest
    settings : Settings
        How the scene is traced.
    picture : Picture
        What it is compared with.
    certificate : CameraCertificate, optional
    alternatives : tuple of Alternative
        The scene as the other side may have it.
    curves : tuple of Curve, optional
        What may have been done to the colours, besides what is always tried; None where nothing
        may have been.
    self_check : bool
        Whether known faults are to be made, and found.
    next_frame : Scene, optional
        The scene a frame later, for the self-check.
    """

    scene: Scene
    manifest: Manifest
    settings: Settings
    picture: Picture
    certificate: CameraCertificate | None = None
    alternatives: tuple[Alternative, ...] = ()
    curves: tuple[Curve, ...] | None = None
    self_check: bool = False
    next_frame: Scene | None = None

    def absent(self) -> Iterator[tuple[int, Hidden]]:
        """Yield the number and the reason of each object that may be shown, and is not traced."""
        why = {e.name: e.reason for e in self.manifest.objects if e.hidden}
        for number, name in enumerate(self.picture.names):
            if name in why:
                yield number, Hidden(name, why[name])

    def before(self, background: NDArray[np.float32]) -> Case:
        """Return the same with every scene, and the picture, before a background, linear RGBA."""

        def behind(scene: Scene) -> Scene:
            return replace(scene, background=background)

        return replace(
            self,
            scene=behind(self.scene),
            picture=replace(self.picture, background=background),
            alternatives=tuple(replace(a, scene=behind(a.scene)) for a in self.alternatives),
            next_frame=self.next_frame and behind(self.next_frame),
        )
