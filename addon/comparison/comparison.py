"""Compares a traced scene with a picture: the counts, the causes, the metrics, the verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Colors
from ..causes.case import Case
from ..causes.cause import Causes
from ..causes.checks.background import Background
from ..causes.checks.color import COLOR
from ..causes.checks.hidden import HIDDEN
from ..causes.checks.unmodelled import NOT_MODELLED
from ..causes.counts import PixelCounts
from ..causes.excused import COMPARABLE, Excused
from ..causes.explain import BY_NUMBER, CAUSES
from ..certainty import Certainty
from ..certified.rounding import rounding
from ..diagnosis.fault_rows import FaultRow
from ..manifest import Effect, Manifest
from ..pictures.curves import ADVICE
from ..pictures.identity import Identity
from ..pictures.metrics import Metrics
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..wording import count_of
from .methods import MethodRow
from .verdict import Verdict

if TYPE_CHECKING:
    from ..diagnosis.diagnosis import Diagnosis

SCHEMA = "reference_tracer.comparison/1"


@dataclass(frozen=True, eq=False)
class Comparison:
    """A comparison: what was compared, the causes, and the verdict."""

    case: Case  # with the scene before the picture's own background, if it has one
    frame: Frame
    causes: Causes
    counts: PixelCounts
    metrics: Metrics
    excused: Excused  # what rests on rounding
    methods: tuple[MethodRow, ...] = ()
    # (h, w, 4) by the textbook as printed, NaN where it sees nothing; None: not traced yet.
    literal: Colors | None = None
    identity: Identity | None = None  # which object each side shows
    self_check: tuple[FaultRow, ...] = ()  # faults made on purpose, and whether they were found
    background: Background | None = None  # where the picture's is not the scene's
    diagnosis: Diagnosis | None = None  # None: not made

    @property
    def scene(self) -> Scene:
        """The scene that was traced."""
        return self.case.scene

    @property
    def manifest(self) -> Manifest:
        """The manifest of the scene, with notes on the picture."""
        own = self.case.manifest
        return replace(own, notes=(*own.notes, *self.case.picture.source.remarks))

    @property
    def picture(self) -> Colors:
        """The other side's picture, (h, w, 4) linear RGBA."""
        return self.case.picture.color

    @property
    def verdict(self) -> Verdict:
        """How it ended: differences are those that no cause explains."""
        if self.frame.cancelled:
            return Verdict.CANCELLED
        certificate = self.case.certificate
        if self.counts.unexplained or (certificate and not certificate.passed):
            return Verdict.DIFFERENCES
        if max(self.counts.not_judged.share, self.excused.share) > COMPARABLE:
            return Verdict.NOT_COMPARABLE
        return Verdict.WARNINGS if any(self.doubts()) else Verdict.AGREE

    def doubts(self) -> Iterator[str]:
        """Yield why the verdict cannot be better than a warning, in a few words each."""
        for feature in self.manifest.unmodelled:
            if feature.effect in (Effect.UNPLACED, Effect.MISSING):
                yield str(feature)
        for entry in self.manifest.objects:
            if entry.left_out:
                yield f"triangles of '{entry.name}' are left out"
        for cause in CAUSES:
            if cause.warns and self.counts.by_cause[cause.key]:
                yield (cause == COLOR and self.causes.transform) or cause.label
        if self.counts.not_judged.pixels:
            yield "a part cannot be judged"
        if unjudged := self.excused.objects:
            others = count_of(len(unjudged) - 1, "other object")
            rest = f" and {others} rest" if len(unjudged) > 1 else " rests"
            yield f"'{unjudged[0].object}'{rest} on rounding alone"
        elif self.excused.too_much:
            yield "much rests on rounding alone"
        if self.empty:
            yield "the picture is empty"
        if any(row.missed for row in self.self_check):
            yield "the self-check missed a fault"
        if self.background and not self.background.transparent:
            yield self.background.unjudged()

    def why(self, x: int, y: int) -> str:
        """Return why a pixel has its cause, in a sentence with its numbers and names."""
        cause = BY_NUMBER[self.causes.cause[y, x]]
        figure = self.causes.figure[y, x]
        name: object = ""
        if cause == NOT_MODELLED:
            name = self.manifest.unmodelled[int(figure)]
        elif cause == HIDDEN:
            name = self.causes.hidden[int(figure)]
        return cause.in_words(figure, self.causes.allowed[y, x], name)

    @property
    def empty(self) -> bool:
        """Whether no ray hits anything: then nothing in the picture could have been wrong."""
        return bool((self.frame.instance_index == NOTHING).all())

    @property
    def required(self) -> list[str]:
        """Sentences on how the picture was certified, and on what was left out."""
        return list(dict.fromkeys(line for row in self.methods for line in row.required))

    def to_dict(self) -> dict[str, object]:
        """Return the comparison as JSON can hold it."""
        certificate = self.case.certificate
        measured = self.case.picture.measured(self.metrics)
        return {
            "schema": SCHEMA,
            "scene": self.manifest.to_dict(),
            "blender": self.case.picture.to_dict(),
            "tracer": self._tracer(),
            "methods": [row.to_dict() for row in self.methods],
            "pixels": self.counts.to_dict(),
            "excused": self.excused.to_dict(),
            "causes": {c.key: c.to_dict() for c in CAUSES},
            "transform": self.causes.transform,
            "advice": self.advice,
            "shades": [shade._asdict() for shade in self.causes.shades],
            "background": self.background and self.background.to_dict(),
            "hidden": [h._asdict() for h in self.causes.hidden],
            "identity": self.identity and self.identity.to_dict(),
            "diagnosis": self.diagnosis and self.diagnosis.to_dict(),
            "certificate": certificate and certificate.to_dict(),
            "self_check": [row.to_dict() for row in self.self_check],
            "metrics": self.metrics.to_dict() if measured else None,
            "verdict": self.verdict,
        }

    @property
    def advice(self) -> str:
        """What to do about a transform of all colours; empty if there is none."""
        return ADVICE if self.causes.made_by else ""

    def _tracer(self) -> dict[str, object]:
        """Return how the scene was traced, as JSON can hold it."""
        s, settings = self.frame.statistics, self.case.settings
        certainty = self.frame.certainty
        off = rounding(self.scene)._asdict()
        return {
            "method": s.method,
            "precision": str(settings.precision),
            "samples": settings.samples,
            "seconds": round(s.seconds, 6),
            "triangles": s.triangles,
            "refused_triangles": s.refused,
            "pairs_tested": s.pairs_tested,
            "pairs_exact": s.pairs_exact,
            "rounding": {k: v if v < np.inf else None for k, v in off.items()},
            "exact_reasons": {reason.name.lower(): n for reason, n in s.reasons.items()},
            "certainty": {c.name.lower(): int((certainty == c).sum()) for c in Certainty},
            "cancelled": self.frame.cancelled,
        }

    def not_judged(self) -> Iterator[str]:
        """Say what share of the picture cannot be judged, why, and what would help."""
        told, total = self.counts.not_judged, self.counts.total
        if lights := [str(u) for u in self.manifest.unmodelled if u.effect is Effect.LIGHT]:
            known = "whose surfaces it shows can" if self.identity else "nor whose surfaces"
            yield f"no colour of this picture can be judged, {known}: {', '.join(lights)}"
        if told.pixels:
            features = ", ".join(told.by_feature)
            yield f"{_share(told.pixels, total)} of this picture cannot be judged: {features}"
        if behind := self.counts.behind:
            yield (
                f"what is behind transparent surfaces was judged in {behind.pixels:,} px, by a "
                f"picture without them: {behind.unexplained:,} px are unexplained"
            )
        if undecided := self.counts.not_decidable:
            yield (
                f"{_share(undecided, total)} of this picture is not decidable: so far from the "
                "origin, or at such a scale, float32 moves Blender's surfaces by more than half a "
                "pixel; move the scene to the origin, or apply the objects' scale"
            )
        yield from self.excused.lines()


def _share(pixels: int, total: int) -> str:
    """Return a share in per cent: never 100 % or 0 % of a part."""
    share = 100 * pixels / total
    if 1 <= share <= 99 or pixels == total:
        return f"{share:.0f} %"
    return f"{min(max(share, 0.1), 99.9):.1f} %"
