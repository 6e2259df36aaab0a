"""SHA-256 of certified pictures, in any Python with numpy: no test, no Blender.

    python digest.py SCENE...    # prints what it runs on, and the digest of each scene

With `NPY_DISABLE_CPU_FEATURES=all` numpy is told to do without whatever it could use of this CPU.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from pathlib import Path

import numpy as np
from reference_tracer.files.scenes import load_scene
from reference_tracer.rendering import render
from reference_tracer.scene import Scene
from reference_tracer.tracer.settings import Settings

OFF = "NPY_DISABLE_CPU_FEATURES"


def sha256(*arrays: np.ndarray) -> str:
    """Return the digest of arrays' types, shapes and bits."""
    out = hashlib.sha256()
    for array in map(np.ascontiguousarray, arrays):
        out.update(f"{array.dtype.str} {array.shape} ".encode())
        out.update(array.tobytes())
    return out.hexdigest()


def of_scene(scene: Scene) -> str:
    """Return the digest of all that decides who is seen: what the tracer is told."""
    camera = scene.camera
    clip, size = (camera.clip_start, camera.clip_end), (camera.width, camera.height)
    numbers = *vars(camera.window).values(), *clip, *size, camera.projection.shares_direction
    arrays = [np.array(numbers, np.float64), camera.world_from_camera, scene.instance_matrices]
    arrays += [scene.instance_meshes, *(v for p in scene.planes for v in (p.point, p.normal))]
    return sha256(*arrays, *(v for m in scene.meshes for v in (m.vertices, m.triangles)))


def of_picture(scene: Scene) -> str:
    """Return the digest of a certified picture: owners, certainty, t and barycentrics."""
    frame = render(scene, Settings("certified"))
    names = "instance_index", "triangle_index", "certainty", "t", "barycentrics"
    return sha256(*(getattr(frame, name) for name in names))


def features() -> list[str]:
    """Return what numpy may choose of this CPU at run time, and does."""
    try:
        from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__
    except ImportError:  # numpy 1
        from numpy.core._multiarray_umath import __cpu_dispatch__, __cpu_features__
    return [name for name in __cpu_dispatch__ if __cpu_features__[name]]


def main(scenes: list[Path]) -> None:
    """Print what this runs on, and the digests."""
    if os.environ.get(OFF) == "all":  # numpy wants their names, and reads them when it is imported
        os.environ[OFF] = " ".join(features())
        os.execv(sys.executable, [sys.executable, "-s", *sys.argv])
    found = {
        "python": "{}.{}".format(*sys.version_info),
        "numpy": np.__version__,
        "features": features(),
        "pictures": {p.stem: of_picture(load_scene(p)) for p in scenes},
    }
    print(json.dumps(found, indent=1))


if __name__ == "__main__":
    main([Path(p) for p in sys.argv[1:]])
