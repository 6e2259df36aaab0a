"""Writes certificates: a certified picture with its scene, for a checker that knows no tracer.

docs/certificate.md has the format, and packages/verify the checker.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .scene_files import arrays_of, save_arrays
from .tracer.frame import Frame

SCHEMA = "reference_tracer.certificate/1"


def save_certificate(path: str | Path, frame: Frame) -> None:
    """Write what every pixel of a frame sees, with its scene, to a compressed .npz.

    It is a scene's file that holds the answers, too. Whoever checks it believes nothing: a frame
    that is not certified makes a certificate that is refused.
    """
    ties = frame.ties
    rows = [(ray, *name) for ray in ties for name in sorted(ties[ray])]
    pixel, instance, triangle = np.array(rows, np.int64).reshape(-1, 3).T
    answers = {
        "certificate": np.array(SCHEMA),
        "instance": frame.instance_index,
        "triangle": frame.triangle_index,
        "t": frame.t,
        "tie_pixel": pixel,
        "tie_instance": instance.astype(np.int32),
        "tie_triangle": triangle.astype(np.int32),
    }
    save_arrays(path, arrays_of(frame.scene) | answers)
