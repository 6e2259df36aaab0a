"""Scenes as the arrays of files that an older version wrote."""

from __future__ import annotations

import json

import numpy as np
from reference_tracer.scene import Scene


def old_arrays(scene: Scene) -> dict[str, np.ndarray]:
    """A scene as version 2 had it: arrays of their own for each mesh, instance and plane."""
    head = {
        "schema": "reference_tracer.scene/2",
        "camera": scene.camera.to_dict(),
        "objects": scene.objects,
        "background": scene.background.tolist(),
        "meshes": [
            {"name": m.name, "corner_colors": m.corner_colors is not None} for m in scene.meshes
        ],
        "instances": [{"mesh": i.mesh, "object": i.object} for i in scene.instances],
        "planes": [{"object": p.object} for p in scene.planes],
    }
    arrays = {"scene": np.array(json.dumps(head))}
    for kind, things in (
        ("mesh", scene.meshes),
        ("instance", scene.instances),
        ("plane", scene.planes),
    ):
        for k, thing in enumerate(things):
            held = {n: v for n, v in vars(thing).items() if isinstance(v, np.ndarray)}
            arrays |= {f"{kind}{k}_{name}": value for name, value in held.items()}
    return arrays
