"""Meshes in files, the camera that frames them, and what is said of their state."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.scene_files import (
    diagnose,
    framing_camera,
    load_meshes,
    load_scene,
    scene_of_meshes,
)
from reference_tracer.tracer.camera import film_of


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "glb"])
def test_meshes_from_files(suffix, tmp_path):
    shape = trimesh.creation.torus(2.0, 0.5, major_sections=12, minor_sections=7)
    shape.apply_translation((3, 4, 5))
    path = tmp_path / f"mesh.{suffix.upper()}"
    shape.export(path, file_type=suffix)
    ((mesh, matrix),) = load_meshes(path)
    corners = mesh.vertices[mesh.triangles] @ matrix[:3, :3].T + matrix[:3, 3]
    expected = shape.triangles
    if suffix == "glb":  # its readers may turn the up axis; the size stays
        corners, expected = (np.sort(np.ptp(c.reshape(-1, 3), axis=0)) for c in (corners, expected))
    assert np.allclose(corners, expected, atol=1e-5)
    assert len(mesh.triangles) == len(shape.faces)


def test_a_file_of_several_meshes_keeps_them_apart(tmp_path):
    several = trimesh.Scene()
    for k in range(3):
        several.add_geometry(
            trimesh.creation.box(),
            transform=trimesh.transformations.translation_matrix((10 * k, 0, 0)),
            geom_name=f"box{k}",
        )
    several.export(tmp_path / "several.glb")
    loaded = load_meshes(tmp_path / "several.glb")
    whole = scene_of_meshes(loaded, None, 30, 20)
    assert len(whole.instances) == len(whole.objects) == 3
    assert len({tuple(i.colors[0]) for i in whole.instances}) == 3
    assert np.ptp([matrix[:3, 3] for _, matrix in loaded], axis=0).max() == pytest.approx(20)


@pytest.mark.parametrize(
    "name, content",
    [
        ("a.obj", ""),
        ("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"),
        ("a.ply", ""),
        ("a.ply", "ply\nformat"),
        ("a.stl", ""),
        ("a.stl", "solid"),
        ("a.glb", ""),
        ("a.glb", "glTF"),
        ("a.obj", "words"),
        ("b.ply", None),
    ],
)
def test_bad_mesh_files_are_named(name, content, tmp_path):
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(SceneError, match=name):
        load_meshes(tmp_path / name)


def test_triangles_that_are_not_finite_are_left_out(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 nan 1\nf 1 2 3\nf 1 2 4\n")
    ((mesh, _),) = load_meshes(tmp_path / "a.obj")
    assert len(mesh.triangles) == 1


@pytest.mark.parametrize("width, height", [(30, 20), (20, 30), (1, 1), (400, 10), (10, 400)])
@pytest.mark.parametrize(
    "stretch", [(1, 1, 1), (1e4, 1, 1), (1, 1, 0), (1e-5, 1e-5, 1e-5), (1e6, 1e6, 1e6)]
)
def test_framing_camera_sees_every_vertex(width, height, stretch, make, rng):
    matrix = trimesh.transformations.random_rotation_matrix(rng.random(3)) * (1, 1, 1, 0)
    matrix[:3, :3] *= stretch
    matrix[:3, 3] = 100 * np.max(stretch) * rng.normal(size=3)
    mesh = make.mesh(trimesh.creation.icosphere(1))
    camera = framing_camera([(mesh, matrix)], width, height)
    x, y, depth = film_of(camera, (mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3]).T)
    assert (depth > camera.clip_start).all() and (depth < camera.clip_end).all()
    assert (x > 0).all() and (x < width).all() and (y > 0).all() and (y < height).all()
    assert max(np.ptp(x) / width, np.ptp(y) / height) > 0.1 or width / height in (40, 1 / 40)


class TestDiagnose:
    def of(self, shape, **changes):
        whole = {"vertices": np.array(shape.vertices), "triangles": np.array(shape.faces)} | changes
        return diagnose(Mesh(**whole))

    def test_closed(self):
        expected = {
            "closed": True,
            "consistent_winding": True,
            "degenerate_faces": 0,
            "duplicate_faces": 0,
        }
        assert self.of(trimesh.creation.box()) == expected

    def test_split_corners_are_still_closed(self):
        shape = trimesh.creation.box()
        split = self.of(
            shape, vertices=shape.triangles.reshape(-1, 3), triangles=np.arange(36).reshape(-1, 3)
        )
        assert split["closed"] and split["consistent_winding"]

    def test_open(self):
        shape = trimesh.creation.box()
        assert not self.of(shape, triangles=shape.faces[1:])["closed"]

    def test_flipped_winding(self):
        faces = np.array(trimesh.creation.box().faces)
        faces[0] = faces[0][::-1]
        found = self.of(trimesh.creation.box(), triangles=faces)
        assert found["closed"] and not found["consistent_winding"]

    def test_degenerate_and_duplicate(self):
        shape = trimesh.creation.box()
        faces = np.concatenate(
            (shape.faces, [[0, 1, 1]], shape.faces[:2, [1, 2, 0]], shape.faces[:1, ::-1])
        )
        found = self.of(shape, triangles=faces)
        assert (found["degenerate_faces"], found["duplicate_faces"]) == (1, 3)

    def test_nothing(self):
        assert diagnose(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))["duplicate_faces"] == 0


@pytest.mark.parametrize("load", [load_meshes, load_scene])
@pytest.mark.parametrize("kind", [str, Path])
def test_there_is_no_such_file(load, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match=r"^there is no file 'none\.ply'$"):
        load(kind("none.ply"))


def test_no_meshes():
    with pytest.raises(SceneError, match="no meshes"):
        scene_of_meshes([], None, 30, 20)


@pytest.mark.parametrize("size, word", [((6.5, 4), "width .* is 6.5"), ((6, 4.0), "height .* 4.0")])
def test_a_part_of_a_pixel(size, word):
    box = Mesh(np.eye(3), [[0, 1, 2]])
    with pytest.raises(SceneError, match=rf"{word}; it must be an integer"):
        scene_of_meshes([(box, np.eye(4))], None, *size)
    assert scene_of_meshes([(box, np.eye(4))], None, np.int64(6), 4).camera.width == 6
