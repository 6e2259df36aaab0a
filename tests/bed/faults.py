"""All faults of the test bed: camera, scene, picture."""

from __future__ import annotations

from collections.abc import Iterator

from .camera_faults import CAMERA_FAULTS
from .description import Description
from .making import Fault
from .picture_faults import PICTURE_FAULTS
from .scene_faults import SCENE_FAULTS
from .scenes import scenes

FAULTS: tuple[Fault, ...] = (*CAMERA_FAULTS, *SCENE_FAULTS, *PICTURE_FAULTS)


def cells(key: str | None = None, number: int | None = None) -> Iterator[tuple[Fault, Description]]:
    """Yield each fault with each scene in which it makes sense; of one key, or one scene."""
    for fault in FAULTS:
        for scene in scenes():
            wanted = key in (None, fault.key) and number in (None, scene.number)
            if wanted and scene.number in fault.only:
                yield fault, scene
