"""Writes a mask of each object that is seen, as PNG and as COCO has them, with its whole extent.

What is seen of an object is proven pixel by pixel, and so is what would be seen of it alone: the
whole extent, which other objects may hide in part. Row 0 is the topmost here.

References
----------
COCO, cocodataset.org/#format-data, run-length encoded: column by column, beginning with zeros.
`bbox_obj`, `px_count_all`, `px_count_visib`, `visib_fract`: as BOP's scene_gt_info.json has them.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Bools
from ..files import png
from ..rendering import trace
from ..scene import without
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.settings import Settings
from . import folders

NAME = "coco.json"
SCHEMA = "reference_tracer.masks/1"
_UNSAFE = re.compile(r"[^A-Za-z0-9.-]")  # in the name of a file


def runs(mask: Bools) -> dict[str, Any]:
    """Return a mask (h, w) as COCO's uncompressed run lengths."""
    flat = np.concatenate(([False], mask.ravel(order="F")))
    ends = np.flatnonzero(np.diff(flat.astype(np.int8)))
    counts = np.diff(np.concatenate(([0], ends, [mask.size])))
    return {"size": list(mask.shape), "counts": counts.tolist()}


def box(mask: Bools) -> list[int]:
    """Return the smallest box around a mask (h, w): x, y, width, height; y from the top."""
    places = np.argwhere(mask)
    if not len(places):
        return [0, 0, 0, 0]
    y, x = places.min(axis=0).tolist()
    height, width = (np.ptp(places, axis=0) + 1).tolist()
    return [x, y, width, height]


def whole(frame: Frame, number: int) -> Bools:
    """Return where an object would be seen without all others, (h, w), row 0 at the bottom."""
    scene = frame.scene
    others = [name for n, name in enumerate(scene.objects) if n != number]
    hits = trace(without(scene, others), Settings())
    return (hits.instance != NOTHING).reshape(frame.shape)


def write(directory: Path, frame: Frame, picture: str) -> list[str]:
    """Write the masks of all objects that are seen into a folder, which is made.

    Parameters
    ----------
    directory : Path
    frame : Frame
    picture : str
        The name of the picture that the masks are of.

    Returns
    -------
    list of str
        The names of the files.
    """
    names = frame.scene.objects
    seen = [int(n) for n in np.unique(frame.object_index) if n != NOTHING]
    files = {n: f"{n:04}_{_UNSAFE.sub('_', names[n])[:80]}.png" for n in seen}
    written = [*files.values(), NAME]
    with folders.replacing(directory, written) as new:
        annotations = []
        for number, file in files.items():
            mask = frame.object_index == number
            (new / file).write_bytes(png.encode_grey(np.where(mask, 255, 0).astype(np.uint8)))
            annotations.append({"file_name": file, **_annotation(frame, number, mask)})
        folders.write_json(new / NAME, _content(frame, picture, annotations))
    return written


def _annotation(frame: Frame, number: int, mask: Bools) -> dict[str, Any]:
    own, all_ = mask[::-1], whole(frame, number)[::-1]
    area, full = int(own.sum()), int(all_.sum())
    return {
        "id": number + 1,
        "image_id": 1,
        "category_id": number + 1,
        "iscrowd": 0,
        "area": area,
        "bbox": box(own),
        "segmentation": runs(own),
        "bbox_obj": box(all_),
        "amodal_segmentation": runs(all_),
        "px_count_all": full,
        "px_count_visib": area,
        "visib_fract": area / full,
    }


def _content(frame: Frame, picture: str, annotations: list[dict[str, Any]]) -> dict[str, Any]:
    height, width = frame.shape
    return {
        "info": {"description": "visible and whole masks of objects", "schema": SCHEMA},
        "images": [{"id": 1, "file_name": picture, "width": width, "height": height}],
        "categories": [{"id": n + 1, "name": name} for n, name in enumerate(frame.scene.objects)],
        "annotations": annotations,
    }
