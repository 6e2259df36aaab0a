"""How the surface that a ray sees was decided, and why floating point did not decide it alone."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum, IntEnum

_RULE = "the ray meets an edge, a corner or two surfaces at once: a rule decided"


class Certainty(IntEnum):
    """How the surface that a ray sees was decided; a member is a number, with these attributes."""

    color: str  # on a map
    words: str  # after a number of pixels
    sentence: str

    NOT_CERTIFIED = 0, "#787878", "not proven", "floating point alone decided, without a proof"
    BOUND = 1, "#2e4d59", "by a bound", "floating point decided: its error bound leaves no doubt"
    EXACT = 2, "#56b4e9", "by integers", "integers decided, where the error bound left a doubt"
    AMBIGUOUS = 3, "#f0e442", "by a rule", _RULE

    def __new__(
        cls, number: int, color: str = "", words: str = "", sentence: str = ""
    ) -> Certainty:
        """Make a member of its record; a number alone is looked up."""
        self = int.__new__(cls, number)
        self._value_, self.color, self.words, self.sentence = number, color, words, sentence
        return self


class Reason(Enum):
    """Why a ray and a surface needed exact arithmetic: the end of "rays that ..."."""

    EDGE = "meet an edge or a corner exactly"
    NEAR_EDGE = "pass an edge within rounding error"
    FAR = "meet triangles that are tiny for their distance from the camera"
    THIN = "meet slivers: triangles that are tiny in height for their length"
    EDGE_ON = "meet surfaces that are seen edge-on"
    COPLANAR = "meet surfaces that lie exactly in one plane"
    CLOSE = "meet surfaces closer behind one another than float64 can tell"
    CLIP = "meet a surface within rounding error of the clip range's ends"
    EXTREME = "have numbers near the limits of float64"


def sentences(pairs: int, counts: Mapping[Reason, int]) -> list[str]:
    """Return what the scene required, in lines: the total, then each reason with its count."""
    exact = sum(counts.values())
    if not pairs:
        return ["no ray comes near a surface: there was nothing to decide"]
    if not exact:
        were = f"all of {pairs:,} pairs of a ray and a surface were"
        if pairs == 1:
            were = "the one pair of a ray and a surface was"
        return [f"{were} decided by the error bound"]
    named = sorted((r for r in Reason if counts.get(r)), key=lambda r: -counts[r])
    return [
        f"{exact:,} of {pairs:,} pairs of a ray and a surface (one in {pairs / exact:,.0f}) "
        "needed exact arithmetic: rays that",
        *(f"  {reason.value}: {counts[reason]:,}" for reason in named),
    ]
