"""All faults of the test bed: camera, scene, picture."""

from __future__ import annotations

from collections.abc import Iterator

from .camera_faults import CAMERA_FAULTS
from .data_faults import DATA_FAULTS
from .description import Description
from .making import Fault, together
from .picture_faults import PICTURE_FAULTS
from .scene_faults import SCENE_FAULTS
from .scenes import scenes

SINGLE = (*CAMERA_FAULTS, *SCENE_FAULTS, *PICTURE_FAULTS, *DATA_FAULTS)


def of(key: str, label: str = "") -> Fault:
    """Return the first fault of a key, and of a label that begins so."""
    return next(f for f in SINGLE if f.key == key and f.label.startswith(label))


PAIRS = (
    together(of("pixel_offset"), of("srgb_for_linear", "the curve left")),
    together(of("object_moved", "first by 0.4"), of("gamma")),
    together(of("focal_length", "angle"), of("rows")),
    together(of("channels"), of("rows")),
    together(of("focal_length"), of("channels")),
    together(of("focal_length"), of("filter_radius", "gauss")),
)
FAULTS: tuple[Fault, ...] = (*SINGLE, *PAIRS)


def cells(key: str | None = None, number: int | None = None) -> Iterator[tuple[Fault, Description]]:
    """Yield each fault with each scene in which it makes sense; of one key, or one scene."""
    for fault in FAULTS:
        for scene in scenes():
            wanted = key in (None, fault.key) and number in (None, scene.number)
            if wanted and scene.number in fault.only:
                yield fault, scene
