"""What was exported, what was not, and what the tracer does not model: nothing is lost in silence.

In come entries from an exporter; out go lines for people and a dict for JSON.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

OUTSIDE = "outside the view"


@dataclass(frozen=True)
class ObjectEntry:
    """One object of the scene: exported, or skipped with the reason."""

    name: str
    type: str
    exported: bool
    reason: str = ""
    triangles: int = 0  # of its meshes
    vertices: int = 0
    instances: int = 0
    outside: int = 0  # instances wholly outside the view, which are not exported
    traced_triangles: int = 0  # over all instances
    left_out: int = 0  # triangles with a non-finite vertex, or of a non-finite matrix
    empty_slots: int = 0
    hidden: bool = False  # Blender does not draw it either, for the reason that is given
    diagnosis: dict[str, Any] | None = None  # see scene_files.diagnose and merged


@dataclass(frozen=True, eq=False)
class Unmodelled:
    """A feature of the scene that the tracer does not model."""

    object: str
    feature: str
    detail: str = ""
    # The world-space box, (2, 3) metres, inside which the feature can change Blender's picture;
    # None where it changes nothing that is compared, or cannot be placed.
    bounds: NDArray[np.float64] | None = None
    everywhere: bool = False  # it can change the picture anywhere
    recolours: bool = False  # it changes shades alone: whose surface a pixel shows stays as it is

    def __post_init__(self) -> None:
        if self.bounds is not None and not np.isfinite(self.bounds).all():
            object.__setattr__(self, "bounds", None)  # a box without an end explains nothing

    def to_dict(self) -> dict[str, Any]:
        """Return the feature as JSON can hold it."""
        out = {k: v for k, v in vars(self).items() if k != "bounds"}
        return out | {"bounds": None if self.bounds is None else np.asarray(self.bounds).tolist()}


@dataclass(frozen=True)
class Manifest:
    """The whole of one export.

    `owners` has the name of the object whose colour Blender gives to each instance of the scene,
    then to each plane: of a collection's instance that is the empty. It is not part of the JSON.
    """

    file: str
    scene: str
    view_layer: str
    frame: int
    evaluation: str  # 'VIEWPORT', 'RENDER', or 'FILE' for a scene that never saw Blender
    camera: str
    objects: tuple[ObjectEntry, ...] = ()
    unmodelled: tuple[Unmodelled, ...] = ()
    notes: tuple[str, ...] = ()
    owners: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the manifest as JSON can hold it."""
        out = {k: v for k, v in vars(self).items() if k not in ("objects", "unmodelled", "owners")}
        out["notes"] = list(self.notes)
        out["objects"] = [asdict(entry) for entry in self.objects]
        out["unmodelled"] = [u.to_dict() for u in self.unmodelled]
        return out

    def lines(self) -> list[str]:
        """Return the manifest as a person reads it, a fact a line."""
        return [text for text, _ in self.facts()]

    def facts(self) -> Iterator[tuple[str, bool]]:
        """Yield each line, and whether it warns: the picture lacks what the line names."""
        exported = [e for e in self.objects if e.exported]
        total = sum(e.traced_triangles for e in exported)
        yield (
            f"{len(exported)} of {len(self.objects)} objects exported, {total:,} triangles, "
            f"{self.evaluation.lower()} evaluation, camera '{self.camera}'",
            False,
        )
        if not exported:
            yield "  note: nothing is exported, so the picture is empty", False
        for e in exported:
            if e.left_out:
                yield f"  {e.name}: {e.left_out} triangles left out (not finite)", True
            if e.empty_slots:
                yield f"  {e.name}: {e.empty_slots} empty material slots, shown in grey", False
        for e in self.objects:
            if not (e.exported or e.outside):
                yield f"  skipped {e.name} ({e.type}): {e.reason}", False
        if unseen := [e for e in self.objects if e.outside]:
            yield (
                f"  outside the view, and not needed: {sum(e.outside for e in unseen):,} "
                f"instances of {len(unseen):,} objects, "
                f"{sum(not e.exported for e in unseen):,} of them whole",
                False,
            )
        for u in self.unmodelled:
            detail = f" ({u.detail})" if u.detail else ""
            yield f"  not modelled: {u.object}: {u.feature}{detail}", True
        for note in self.notes:
            yield f"  note: {note}", False
