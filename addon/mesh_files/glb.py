"""Reads GLB by trimesh."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..scene import Mesh, SceneError, drop_non_finite
from .contents import Contents, Placed


def read_glb(path: Path) -> Contents:
    """Read the meshes of a GLB file; each of its meshes becomes an object."""
    import trimesh

    with path.open("rb") as file:
        if file.read(4) != b"glTF":
            raise SceneError("it is no GLB file: it does not begin with glTF")
    loaded: Any = trimesh.load(
        path, file_type="glb", force="scene", process=False, skip_materials=True
    )
    left_out: list[int] = []
    placed = tuple(p for node in loaded.graph.nodes_geometry for p in _of(loaded, node, left_out))
    count = sum(left_out)
    missing = f"{count:,} triangles with a corner that is no finite number are left out"
    return Contents(placed, missing=(missing,) if count else ())


def _of(loaded: Any, node: str, left_out: list[int]) -> Iterator[Placed]:
    """Yield the mesh of a node of a trimesh.Scene, if it has triangles."""
    matrix, name = loaded.graph[node]
    geometry = loaded.geometry[name]
    faces = getattr(geometry, "faces", None)  # a point cloud has none
    if faces is not None and len(faces):
        vertices, keep = drop_non_finite(np.asarray(geometry.vertices), faces)
        left_out.append(int((~keep).sum()))
        yield Placed(Mesh(vertices, faces[keep], name=str(name)), np.array(matrix), str(name))
