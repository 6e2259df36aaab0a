"""The scene that is made of a file's meshes, and the camera that frames them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Mesh, SceneError
from reference_tracer_meshes.contents import Contents, Placed
from reference_tracer_meshes.load import load_meshes, scene_of_meshes

from .plys import write_ply


def alone(mesh, matrix=None):
    """Return a mesh as the only one of a file."""
    return Contents((Placed(mesh, np.eye(4) if matrix is None else matrix, mesh.name),))


@pytest.mark.filterwarnings("error")
def test_what_is_no_number_is_refused_without_a_warning(tmp_path):
    bits = np.array([0x7F800001, 0, 0x7F7FFFFF] * 3, np.uint32).view(np.float32).reshape(3, 3)
    write_ply(tmp_path / "a.ply", bits, {"face": [(0, 1, 2)]}, "binary_little_endian")
    with pytest.raises(SceneError, match="holds no triangles"):
        load_meshes(tmp_path / "a.ply")


def test_a_mesh_that_is_placed_often_is_one_mesh_and_a_name_is_one_object():
    same, other = (Mesh(np.eye(3) + k, [[0, 1, 2]], name="Mesh") for k in range(2))
    far = trimesh.transformations.translation_matrix((5, 0, 0))
    placed = (
        Placed(same, np.eye(4), "first"),
        Placed(other, np.eye(4), "first"),
        Placed(same, far, "second"),
    )
    whole = scene_of_meshes(Contents(placed), None, 8, 8)
    assert whole.meshes == (same, other) and whole.objects == ("first", "second")
    assert [(i.mesh, i.object) for i in whole.instances] == [(0, 0), (1, 0), (0, 1)]
    assert np.array_equal(whole.instances[2].world_from_object, far)
    greys = [tuple(i.colors[0]) for i in whole.instances]
    assert greys[0] == greys[1] != greys[2]


def test_no_meshes():
    with pytest.raises(SceneError, match="no meshes"):
        scene_of_meshes(Contents(()), None, 30, 20)


@pytest.mark.parametrize("size, word", [((6.5, 4), "width .* is 6.5"), ((6, 4.0), "height .* 4.0")])
def test_a_part_of_a_pixel(size, word):
    box = Mesh(np.eye(3), [[0, 1, 2]])
    with pytest.raises(SceneError, match=rf"{word}; it must be an integer"):
        scene_of_meshes(alone(box), None, *size)
    assert scene_of_meshes(alone(box), None, np.int64(6), 4).camera.width == 6


@pytest.mark.filterwarnings("error")
def test_what_cannot_be_framed_is_refused_without_a_warning():
    huge = Mesh(1.7e308 * np.eye(3) - 1e308, [[0, 1, 2]], name="huge.ply")
    with pytest.raises(SceneError, match=r"^it is too large to be framed: scale it down$"):
        scene_of_meshes(alone(huge), None, 8, 8)
