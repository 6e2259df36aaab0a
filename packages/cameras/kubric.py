"""Kubric: the `metadata.json` of a rendered sequence, with a pose for each frame.

Source: google-research/kubric, `kubric/core/cameras.py` and `kubric/file_io.py`
(`get_camera_info`): `positions` and `quaternions` (w, x, y, z) take Blender's camera space, +Y up
and -Z forward, to Blender's world. `K` is of that camera space, so that its last row is 0 0 -1, and
of a picture of 1 x 1: its first two rows are in widths and heights (in an older Kubric, in pixels).
The size is the metadata's `resolution`. Kubric samples pixels as Blender does: the first one's
centre is at (0.5, 0.5).
"""

from __future__ import annotations

import numpy as np
from reference_tracer.camera_files import frame
from reference_tracer.camera_files.colmap import rotation
from reference_tracer.camera_files.convention import Convention, Size, Source, View
from reference_tracer.files.checked_json import Content, numbers, part

_AXES = np.diag((1.0, -1.0, -1.0))  # takes K of Blender's camera space to that of OpenCV's
_UNIT = 1.0  # principal points up to here are in widths and heights, beyond in pixels


def _is_of(source: Source) -> bool:
    own = source.object.get("camera")
    return isinstance(own, dict) and own.keys() >= {"K", "positions", "quaternions"}


def _read(source: Source) -> list[View]:
    content = source.object
    own: Content = part(content, "camera", "", dict)
    metadata: Content = part({"metadata": {}, **content}, "metadata", "", dict)
    width, height = _size(metadata, source)
    k = numbers(own, "K", "camera.", (3, 3)) @ _AXES
    if np.abs(k[:2, 2]).max() <= _UNIT:
        k = k * ((width,), (height,), (1,))
    count = len(part(own, "positions", "camera.", list))
    places = numbers(own, "positions", "camera.", (count, 3))
    turns = numbers(own, "quaternions", "camera.", (count, 4))
    found = []
    for number, (place, turn) in enumerate(zip(places, turns, strict=True)):
        pose = frame.inverse(frame.pose(rotation(turn), place))
        name = f"rgba_{number:05d}.png"
        found.append(frame.pinhole(k, pose, (width, height), name, np.eye(4)))
    return found


def _size(metadata: Content, source: Source) -> Size:
    if "resolution" not in metadata:
        return source.whole_size({})
    width, height = numbers(metadata, "resolution", "metadata.", (2,))
    return int(width), int(height)


KUBRIC = Convention(
    "kubric",
    "Kubric",
    "metadata.json, which is read alone",
    (),
    False,
    None,
    _is_of,
    _read,
)
