"""Lists what was exported, what was not, and what the tracer does not model.

An exporter fills it, so that nothing is lost in silence. People get it as lines, programs as JSON.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any

import numpy as np

from .arrays import Floats
from .wording import count_of

OUTSIDE = "outside the view"
NOT_FINITE = "triangles that are not finite"


@dataclass(frozen=True)
class ObjectEntry:
    """One object of the scene: exported, or skipped for a reason."""

    name: str
    type: str
    exported: bool
    reason: str = ""
    triangles: int = 0  # of its meshes, each counted once
    vertices: int = 0
    instances: int = 0
    outside: int = 0  # instances that are not exported, as they are wholly outside the view
    traced_triangles: int = 0  # over all instances
    left_out: int = 0  # triangles with a non-finite vertex, or of a non-finite matrix
    empty_slots: int = 0
    hidden: bool = False  # Blender does not draw it either, for the same reason
    diagnosis: dict[str, int] | None = None  # see mesh_diagnosis.py


class Effect(Enum):
    """The effect on the other side's picture of a feature that the tracer does not model."""

    NONE = "it changes nothing that is compared"
    UNPLACED = "it may change the picture, and nobody knows where"
    MISSING = "the file lacks it: what it would show, nobody knows"
    COLOR = "the object's surfaces have colours that the tracer does not know"
    DRAWN = "it draws itself, over what is traced"
    IN_FRONT = "the object is drawn over what is before it"
    UNSEEN = "the object is not drawn, and what is behind it is"
    HOLDOUT = "the object cuts a hole into the picture"
    LIGHT = "every colour may differ; which surface a pixel shows stays as it is"
    PICTURE = "every pixel may differ"

    @property
    def key(self) -> str:
        """Its name in JSON."""
        return self.name.lower()

    @property
    def everywhere(self) -> bool:
        """Whether it can change the picture anywhere."""
        return self in (Effect.LIGHT, Effect.PICTURE)


@dataclass(frozen=True, eq=False)
class Unmodelled:
    """A feature of the scene that the tracer does not model, or that the file lacks.

    A box of bounds that are not finite is dropped, as it would explain anything.
    """

    object: str
    feature: str
    detail: str = ""
    bounds: Floats | None = None  # (2, 3) metres, a box in world space; None: anywhere
    effect: Effect = Effect.DRAWN
    by: tuple[str, ...] = ()  # objects with geometry nodes that draw the object, too

    def __post_init__(self) -> None:
        if self.bounds is not None and not np.isfinite(self.bounds).all():
            object.__setattr__(self, "bounds", None)

    def __str__(self) -> str:
        owner = self.object if self.object.startswith("scene '") else f"'{self.object}'"
        return f"{self.feature} of {owner}"

    def line(self) -> str:
        """Return the feature as a person reads it."""
        detail = f" ({self.detail})" if self.detail else ""
        if self.effect is Effect.MISSING:
            return f"{self.feature}: {self.object}{detail}"
        none = self.effect is Effect.NONE
        said = "not modelled, but it changes nothing here" if none else "not modelled"
        return f"{said}: {self.object}: {self.feature}{detail}"

    def to_dict(self) -> dict[str, Any]:
        """Return the feature as JSON can hold it."""
        return vars(self) | {
            "bounds": None if self.bounds is None else np.asarray(self.bounds).tolist(),
            "by": list(self.by),
            "effect": self.effect.key,
            "everywhere": self.effect.everywhere,
        }


@dataclass(frozen=True)
class Manifest:
    """The account of an export: what it holds, and what it lacks."""

    file: str
    scene: str
    view_layer: str
    frame: int
    evaluation: str  # 'VIEWPORT', 'RENDER', or 'FILE' for a scene that never saw Blender
    camera: str
    objects: tuple[ObjectEntry, ...] = ()
    unmodelled: tuple[Unmodelled, ...] = ()
    notes: tuple[str, ...] = ()
    # Of each instance of the scene, then of each plane, the object that gives it its colour in
    # Blender: of a collection's instance that is the empty. It is not in the JSON.
    owners: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, object]:
        """Return the manifest as JSON can hold it."""
        out = {k: v for k, v in vars(self).items() if k not in ("objects", "unmodelled", "owners")}
        out["notes"] = list(self.notes)
        out["objects"] = [asdict(entry) for entry in self.objects]
        out["unmodelled"] = [u.to_dict() for u in self.unmodelled]
        return out

    @property
    def lacks(self) -> tuple[Unmodelled, ...]:
        """Everything of the file that the scene lacks, the triangles that are left out included."""
        return self.unmodelled + tuple(
            Unmodelled(e.name, NOT_FINITE, f"{e.left_out:,}", None, Effect.MISSING)
            for e in self.objects
            if e.left_out
        )

    def lines(self) -> list[str]:
        """Return the manifest as a person reads it, a fact a line."""
        return [text for text, _ in self.facts()]

    def facts(self) -> Iterator[tuple[str, bool]]:
        """Yield each line, and whether it warns: the picture lacks what the line names."""
        exported = [e for e in self.objects if e.exported]
        total = sum(e.traced_triangles for e in exported)
        yield (
            f"{len(exported)} of {count_of(len(self.objects), 'object')} exported, "
            f"{count_of(total, 'triangle')}, "
            f"{self.evaluation.lower()} evaluation, camera '{self.camera}'",
            False,
        )
        if not exported:
            yield "  nothing is exported, so the picture is empty", True
        for e in exported:
            if e.left_out:
                yield f"  {e.name}: {count_of(e.left_out, 'triangle')} left out (not finite)", True
            if e.empty_slots:
                slots = count_of(e.empty_slots, "empty material slot")
                yield f"  {e.name}: {slots}, shown in grey", False
        for e in self.objects:
            if not (e.exported or e.outside):
                yield f"  skipped {e.name} ({e.type}): {e.reason}", False
        if unseen := [e for e in self.objects if e.outside]:
            told = f"{count_of(sum(e.outside for e in unseen), 'instance')} of "
            told += count_of(len(unseen), "object")
            if whole := sum(not e.exported for e in unseen):
                told += f", with nothing of {count_of(whole, 'object')} in view"
            yield f"  outside the view, and not needed: {told}", False
        yield from self._remarks()

    def remarks(self) -> list[str]:
        """Return the last of these lines: what the file holds that is shown otherwise, or not."""
        return [text for text, _ in self._remarks()]

    def _remarks(self) -> Iterator[tuple[str, bool]]:
        for u in self.unmodelled:
            yield f"  {u.line()}", u.effect is not Effect.NONE
        for note in self.notes:
            yield f"  note: {note}", False
