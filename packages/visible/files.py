"""What is found of all faces, in one frame or several, as arrays, JSON and lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array, Index
from reference_tracer.files import npz
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.visible import HIDDEN, SEEN, UNDECIDED, Visible
from reference_tracer.wording import count_of

SCHEMA = "reference_tracer.visible/1"


@dataclass(eq=False)
class Total:
    """What is seen of the faces of a scene in any of some frames.

    `found` has each face's witness in the first frame that sees it, `frame` (m,), and the largest
    area that may be seen of it in any frame. `count` (m,) is in how many frames it is seen.
    """

    scene: Scene
    found: Visible
    frame: Index
    count: Index

    @classmethod
    def of(cls, scene: Scene, found: Visible, frame: int = 0) -> Total:
        """Return that of one frame."""
        seen = found.seen == SEEN
        return cls(scene, found, np.where(seen, frame, -1), seen.astype(np.int32))

    def add(self, scene: Scene, found: Visible, frame: int) -> Total:
        """Return that of another frame, too.

        Raises
        ------
        SceneError
            If its faces are other ones.
        """
        if _names(scene) != _names(self.scene) or not np.array_equal(found.start, self.found.start):
            raise SceneError(
                f"frame {frame} has other objects or faces than the frames before: its faces are "
                "not theirs; choose frames in which they stay"
            )
        before, seen = self.found, found.seen == SEEN
        new = seen & (before.seen != SEEN)
        state = np.maximum(before.seen, found.seen)
        state[seen | (before.seen == SEEN)] = SEEN
        both = Visible(
            state,
            np.where(new[:, None], found.witness, before.witness),
            np.where(state == UNDECIDED, np.maximum(before.area, found.area), 0),
            np.where(new, found.behind, before.behind),
            found.start,
        )
        frames = np.where(new, frame, self.frame)
        return Total(scene, both, frames.astype(np.int32), self.count + seen)

    def rows(self) -> list[dict[str, object]]:
        """Return what is found of each object."""
        found = self.found
        of = np.repeat(
            self.scene.instance_objects[: len(self.scene.instances)], np.diff(found.start)
        )
        rows = []
        for number, name in enumerate(self.scene.objects):
            own = of == number
            hidden, seen, undecided = np.bincount(found.seen[own], minlength=3).tolist()
            rows.append(
                {
                    "object": name,
                    "faces": hidden + seen + undecided,
                    "seen": seen,
                    "seen_from_behind": int(found.behind[own].sum()),
                    "hidden": hidden,
                    "undecided": undecided,
                    "largest_area": float(np.max(found.area[own], initial=0.0)),
                }
            )
        return rows

    def lines(self) -> list[str]:
        """Return a line for each object that has faces."""
        line = (
            "{object}: {seen:,} of {faces:,} faces seen, {seen_from_behind:,} of them from behind; "
            "{undecided:,} undecided, at most {largest_area:.2g} px² each"
        )
        return [line.format(**row) for row in self.rows() if row["faces"]]

    def save(self, path: Path, frames: Sequence[int], limit: float) -> None:
        """Write the arrays into `path`, and what they come to into the .json beside it."""
        scene, found = self.scene, self.found
        arrays: dict[str, Array] = {
            **vars(found),
            "object": scene.instance_objects[: len(scene.instances)],
            "objects": np.array(scene.objects, dtype=str),
        }
        if frames:
            arrays |= {"frames": self.count, "witness_frame": self.frame}
        with folders.replacing_file(path) as new:
            npz.save(new, arrays)
        content = {
            "schema": SCHEMA,
            "limit": limit,
            "frames": [*frames],
            "camera": scene.camera.to_dict(),
            "objects": self.rows(),
        }
        folders.write_json(path.with_suffix(".json"), content)

    def summary(self) -> str:
        """Return in one line how many faces are seen, hidden and undecided."""
        states = np.bincount(self.found.seen, minlength=3)
        return (
            f"{count_of(len(self.found.seen), 'face')}: {states[SEEN]:,} seen, "
            f"{states[HIDDEN]:,} hidden, {states[UNDECIDED]:,} undecided"
        )


def _names(scene: Scene) -> list[str]:
    return [scene.objects[i.object] for i in scene.instances]
