"""What is known beside the two pictures; all of it may be missing."""

from __future__ import annotations

from dataclasses import dataclass

from ..scene import Scene
from .alternatives import Alternative
from .certificate import CameraCertificate
from .transforms import Named


@dataclass(frozen=True, eq=False)
class Known:
    """What helps to say why a pixel differs, and whether the comparison can be trusted.

    Parameters
    ----------
    names : tuple of str
        The objects by the numbers that `Shown.owner` has.
    certificate : CameraCertificate, optional
    alternatives : tuple of Alternative
        The scene as the other side may have it.
    curves : tuple of Named, optional
        What may have been done to the colours; None where nothing may have been.
    self_check : bool
        Whether known faults are to be made, and found.
    next_frame : Scene, optional
        The scene a frame later, for the self-check.
    """

    names: tuple[str, ...] = ()
    certificate: CameraCertificate | None = None
    alternatives: tuple[Alternative, ...] = ()
    curves: tuple[Named, ...] | None = None
    self_check: bool = False
    next_frame: Scene | None = None
