"""What is found of all faces, in one frame or several, as arrays, JSON and lines."""

from __future__ import annotations

from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np
from reference_tracer.arrays import Array, Floats
from reference_tracer.files import npz
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.visible import SEEN, Visible

SCHEMA = "reference_tracer.visible/1"
_KINDS = "hidden", "seen_from_front", "undecided", "seen_from_behind"  # by Visible.seen; and
_BEHIND = 3  # beside HIDDEN, SEEN and UNDECIDED: seen, and from behind


class Total:
    """What is seen of the faces of a scene, in one frame or in any of several.

    `arrays` are those of the file. A face has what :class:`Visible` has of it in the frame that
    shows most of it, the first such; and `witness_frame`, that frame, or -1 if it is not seen.
    """

    def __init__(self, scene: Scene, found: Visible, frame: int) -> None:
        seen = found.seen == SEEN
        self.arrays: dict[str, Array] = {
            **vars(found),
            "frames": seen.astype(np.int32),
            "witness_frame": np.where(seen, np.int32(frame), np.int32(-1)),
            "object": scene.instance_objects[: len(scene.instances)],
            "objects": np.array(scene.objects, dtype=str),
        }
        self.cameras = {frame: scene.camera.to_dict()}
        self.faces = [
            (scene.objects[i.object], hash(scene.meshes[i.mesh].triangles.tobytes()))
            for i in scene.instances
        ]

    def add(self, other: Total) -> Total:
        """Take in what is found in a later frame, and return this.

        Raises
        ------
        SceneError
            If its faces are other ones.
        """
        frame = max(other.cameras)
        for before, now in zip_longest(self.faces, other.faces):
            if before != now:
                name, _ = before or now
                raise SceneError(
                    f"frame {frame} has other objects or faces than the frames before, from "
                    f"'{name}' on: choose frames in which they stay"
                )
        more = other._shown() > self._shown()
        for name in ("seen", "witness", "area", "behind", "witness_frame"):
            self.arrays[name][more] = other.arrays[name][more]
        self.arrays["frames"] += other.arrays["frames"]
        self.cameras |= other.cameras
        return self

    def _shown(self) -> Floats:
        """Return how much may be seen of each face, (m,): below 0 if it is hidden."""
        return np.choose(self.arrays["seen"], (-1.0, np.inf, self.arrays["area"]))

    def rows(self) -> list[dict[str, Any]]:
        """Return how many faces of each object are found to be what, and of all at the end."""
        found = self.arrays
        names = [*found["objects"].tolist(), "all"]
        of = np.repeat(found["object"], np.diff(found["start"]))
        counts = np.zeros((len(names), len(_KINDS)), int)
        np.add.at(counts, (of, np.where(found["behind"], _BEHIND, found["seen"])), 1)
        counts[-1] = counts.sum(axis=0)
        return [
            {"object": name, **dict(zip(_KINDS, row, strict=True))}
            for name, row in zip(names, counts.tolist(), strict=True)
        ]

    def lines(self) -> list[str]:
        """Return a line for each object, one for all, and how little is undecided."""
        line = (
            "{object}: {seen_from_front:,} seen from the front, {seen_from_behind:,} from "
            "behind, {hidden:,} hidden, {undecided:,} undecided"
        )
        lines = [line.format(**row) for row in self.rows()]
        if area := np.max(self.arrays["area"], initial=0.0):
            lines.append(f"at most {area:.2g} px² may be seen of each that is undecided")
        return lines

    def save(self, arrays: Path, counts: Path, limit: float) -> None:
        """Write the arrays into an .npz, and what they come to into a .json beside it."""
        *objects, whole = self.rows()
        content = {
            "schema": SCHEMA,
            "limit": limit,
            "frames": [*self.cameras],
            "cameras": [*self.cameras.values()],
            "objects": objects,
            "all": whole,
        }
        with folders.replacing(arrays.parent, (arrays.name, counts.name)) as new:
            npz.save(new / arrays.name, self.arrays)
            folders.write_json(new / counts.name, content)
