"""Decides of each face of a scene whether its camera sees it."""

from __future__ import annotations

import numpy as np

from ..certified.arithmetic import sound_steps
from ..methods import Method
from ..rendering import hits as trace_hits
from ..scene import Scene, SceneError
from ..tracer.hits import Statistics
from ..tracer.progress import Progress, Work, result_of, scaled
from ..tracer.settings import Settings
from ..tracer.vector import cross, dot
from .cells import Cells, scale_of
from .faces import Faces
from .found import SEEN, Visible
from .search import Search

LIMIT = 1e-6  # square pixels
WORK = 1 << 24  # pairs of faces that are compared, and of edges and faces


def visible(scene: Scene, limit: float = LIMIT, work: int = WORK) -> Visible:
    """Decide which faces of a scene its camera sees.

    Parameters
    ----------
    limit : float
        Square pixels: if no more than that may be seen of a face, it stays undecided.
    work : int
        About how many pairs, of faces and of edges and faces, may be compared: then the rest is
        undecided.

    Raises
    ------
    SceneError
        If the camera is a panorama.
    """
    return result_of(steps(scene, limit, work))


@sound_steps
def steps(scene: Scene, limit: float = LIMIT, work: int = WORK) -> Work[Visible]:
    """Decide as :func:`visible`, in steps."""
    camera = scene.camera
    if not camera.projection.is_linear:
        raise SceneError(
            f"Camera '{camera.name}' is {camera.projection.name}: which faces are seen is decided "
            "for perspective and orthographic cameras"
        )
    scale = scale_of(scene)
    scene = scene.seen_by(camera.divided(scale))
    yield Progress(None, "tracing the pixels' centres")
    hits = yield from trace_hits(scene, Settings(method=Method.CERTIFIED), Statistics())
    yield Progress(None, "looking behind what is seen")
    faces = yield from Faces.of(scene)
    yield None
    depth = hits.t
    yield None
    cells = Cells(scene, faces, hits, depth)
    yield from cells.join(faces)
    search = Search(scene, faces, limit * scale**2)
    yield from scaled(search.steps(cells, work), 0.0, None, "looking behind what is seen")
    seen = np.flatnonzero(search.seen == SEEN)
    behind = np.zeros(faces.count, bool)
    x, y, z = scene.instance_matrices[:3, :3].swapaxes(0, 1)
    mirrored = np.repeat(dot(cross(x, y), z) < 0, np.diff(faces.start))
    behind[seen] = (faces.turn[seen] > 0) != mirrored[seen]
    return Visible(
        search.seen,
        search.witness.T / scale,
        search.area / scale**2,
        behind,
        faces.start,
    )
