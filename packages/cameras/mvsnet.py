"""MVSNet: a file `..._cam.txt` for each picture, in a folder.

Source: YoYo000/MVSNet, README ("cam.txt" under "File Formats"): `extrinsic` and four rows that take
the world to OpenCV's camera space, `intrinsic` and the three rows of K, then the least depth and
the step, or more numbers, of the depths that are searched; these clip nothing. It says neither the
picture's size nor where a pixel's centre is: (0.5, 0.5) is read and written.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Source, View
from reference_tracer.camera_files.features import ASPECT, SHIFT
from reference_tracer.scene import Camera, SceneError

ENDING = "_cam.txt"
_EXTRINSIC, _INTRINSIC = "extrinsic", "intrinsic"  # words before 16 and 9 numbers
_STEPS = 192  # between the least depth and the largest, as in its own examples


def _text(camera: Camera) -> str:
    step = (min(camera.clip_end, frame.FARTHEST) - camera.clip_start) / _STEPS
    rows = [_EXTRINSIC, *_rows(frame.camera_from_world(camera))]
    rows += ["", _INTRINSIC, *_rows(frame.k_of(camera)), "", f"{camera.clip_start!r} {step!r}"]
    return "\n".join(rows) + "\n"


def _rows(matrix: Floats) -> list[str]:
    return [" ".join(repr(float(v)) for v in row) for row in matrix]


def _paths(source: Source) -> list[Path]:
    path = source.path
    return sorted(path.glob(f"*{ENDING}")) if path.is_dir() else [path]


def _is_of(source: Source) -> bool:
    return any(Source(path).text.startswith(_EXTRINSIC) for path in _paths(source)[:1])


def _view(path: Path, source: Source) -> View:
    words = Source(path).text.split()
    try:
        at = words.index(_INTRINSIC)
        pose, k = np.array(words[1:at], float), np.array(words[at + 1 : at + 10], float)
    except ValueError as error:
        raise SceneError(f"{path.name}: {error}") from None
    if len(pose) != 16 or len(k) != 9:
        raise SceneError(f"{path.name}: it must have 16 numbers of a pose and 9 of K")
    size = source.whole_size({})
    name = f"{path.name.removesuffix(ENDING)}.png"
    return frame.pinhole(k.reshape(3, 3), pose.reshape(4, 4), size, name)


MVSNET = Convention(
    "mvsnet",
    "MVSNet",
    f"a file {ENDING} for each picture in a folder",
    (SHIFT, ASPECT),
    False,
    lambda views, _: {f"{Path(v.name).stem}{ENDING}": _text(v.camera) for v in views},
    _is_of,
    lambda source: [_view(path, source) for path in _paths(source)],
)
