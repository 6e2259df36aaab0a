"""What is found of the faces of a scene."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import Bools, Bytes, Floats, Index

HIDDEN, SEEN, UNDECIDED = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Visible:
    """What a camera sees of the m faces of a scene.

    Parameters
    ----------
    seen : (m,) uint8
        HIDDEN, SEEN or UNDECIDED.
    witness : (m, 2) float64
        A film position of each face that is seen, in pixels: its ray sees the face. Else NaN.
    area : (m,) float64
        Of a face that is undecided, the most that may be seen of it, in square pixels. Else 0.
    behind : (m,) bool
        Whether a face that is seen shows its back, where its corners turn to the right; which a
        mirrored instance does not turn over.
    start : (k + 1,) int
        The first face of each of the scene's instances.
    """

    seen: Bytes
    witness: Floats
    area: Floats
    behind: Bools
    start: Index
