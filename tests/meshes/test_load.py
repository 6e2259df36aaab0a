"""Meshes in files, the camera that frames them, and what is said of their state."""

from __future__ import annotations

import subprocess
import sys
import warnings

import numpy as np
import pytest
import trimesh
from reference_tracer.cli import opening
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.scene import SceneError
from reference_tracer.tracer.vector import transform_points
from reference_tracer_meshes.load import load_meshes, scene_of_meshes


def world(contents):
    """Return the corners of every mesh's triangles in world space, one after the other."""
    return [
        transform_points(matrix, mesh.vertices.T).T[mesh.triangles]
        for mesh, matrix, _ in contents.placed
    ]


@pytest.mark.parametrize(
    "suffix, up", [("obj", "z"), ("ply", "z"), ("off", "z"), ("stl", "z"), ("glb", "y")]
)
def test_which_axis_is_up_where_nobody_says(suffix, up, tmp_path):
    trimesh.creation.box((1, 2, 3)).export(tmp_path / f"a.{suffix}")
    default, named = (world(load_meshes(tmp_path / f"a.{suffix}", u)) for u in (None, up))
    assert np.array_equal(default, named)
    high = np.ptp(default[0][..., 2])
    assert high == {"y": 2, "z": 3}[up]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-310, 1e300, 1e307])
def test_hostile_coordinates_warn_of_nothing(scale, tmp_path):
    path = tmp_path / "a.obj"
    corners = f"v {scale} 0 0\nv 0 {scale} 0\nv 0 0 -{scale}\nv 0 nan 1\n"
    path.write_text(f"{corners}f 1 2 3\nf 1 2 4\n")
    assert scene_of_meshes(load_meshes(path), None, 8, 8).triangle_count == 1


def test_a_mesh_too_large_to_be_framed_is_named(tmp_path):
    (tmp_path / "a.obj").write_text("v -1e308 0 0\nv 1.7e308 0 0\nv 0 1e308 0\nf 1 2 3\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(SceneError, match=r"a\.obj': it is too large"):
            opening.load(tmp_path / "a.obj")


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".off", ".stl", ".glb"])
@pytest.mark.parametrize("content", [bytes(200), bytes(range(256)), b"{}"])
def test_what_is_no_mesh_at_all_gets_one_message(suffix, content, tmp_path):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(SceneError, match=rf"^'{path}' (cannot be read as a mesh: |holds no tri)"):
        load_meshes(path)


def test_scipy_is_not_imported_for_a_mesh_and_is_not_missed(tmp_path):
    """It takes longer than all else at the start of `reftrace trace`."""
    for name in ("a.glb", "b.stl", "c.ply", "d.obj"):
        trimesh.creation.icosphere(1).export(tmp_path / name)
    code = """if True:
        import sys
        from pathlib import Path
        from reference_tracer.cli import opening
        for name in sys.argv[1:]:
            for mesh in opening.load(Path(name))[0].meshes:
                print(mesh.vertices[mesh.triangles].tolist())
        print([n for n in sys.modules if n.split(".")[0] in ("scipy", "networkx")])
        import scipy
    """
    files = sorted(map(str, tmp_path.iterdir()))
    done = subprocess.run(
        [sys.executable, "-c", code, *files], capture_output=True, text=True, check=True
    )
    lines = done.stdout.splitlines()  # with notes between
    *found, imported = [line for line in lines if line.startswith("[")]
    expected = [
        m.vertices[m.triangles].tolist() for path in files for m, *_ in load_meshes(path).placed
    ]
    assert found == list(map(str, expected)) and len(found) == 4 and imported == "[]"


def test_a_property_of_a_ply_may_have_spaces_in_its_name(tmp_path):
    """As a vertex group has that Blender writes."""
    head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    head += "property float Bone 1\nproperty float z\nelement face 1\n"
    head += "property list uchar uint vertex_indices\nend_header\n"
    (tmp_path / "a.ply").write_text(head + "0 0 9 1\n1 0 9 1\n0 1 9 2\n3 0 1 2\n")
    (placed,) = load_meshes(tmp_path / "a.ply").placed
    np.testing.assert_array_equal(placed.mesh.vertices, [(0, 0, 1), (1, 0, 1), (0, 1, 2)])
    (tmp_path / "b.ply").write_text(head.replace("float Bone 1", "float"))
    with pytest.raises(SceneError, match="bad 'property' line"):
        load_meshes(tmp_path / "b.ply")


@pytest.mark.parametrize(
    "name, text",
    [
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\n"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n"),
        ("b.off", "OFF3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n"),  # as ModelNet's files have it
    ],
)
def test_a_byte_order_mark_is_no_part_of_the_first_line(name, text, tmp_path):
    found = []
    for number, mark in enumerate((b"", b"\xef\xbb\xbf")):
        path = tmp_path / f"{number}{name}"
        path.write_bytes(mark + text.encode())
        contents = load_meshes(path)
        assert not contents.notes
        [placed] = contents.placed
        found.append(placed.mesh.vertices[placed.mesh.triangles].tolist())
    assert found[0] == found[1] == [[[0, 0, 0], [1, 0, 0], [0, 0, 1]]]


@pytest.mark.parametrize("up", [None, "y", "z"])
def test_an_obj_of_blenders_has_y_up_where_nobody_says_otherwise(up, tmp_path):
    def read(text):
        (tmp_path / "a.obj").write_text(text)
        contents = load_meshes(tmp_path / "a.obj", up)
        return contents.notes, contents.placed[0].world_from_object[2, 1]  # y becomes z, or not

    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    assert read(text) == ((), up == "y")
    notes, turned = read(f"# Blender 5.0.0\n{text}")
    assert ["up=z" in note for note in notes] == [True] * (up is None)
    assert turned == (up != "z")


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".off"])
def test_points_alone_are_told_to_be_nothing_that_a_ray_meets(suffix, tmp_path):
    texts = {
        ".obj": "v 0 0 0\n",
        ".off": "OFF\n1 0 0\n0 0 0\n",
        ".ply": "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n",
    }
    (tmp_path / f"a{suffix}").write_text(texts[suffix])
    with pytest.raises(SceneError, match="holds no triangles, and a ray meets nothing else"):
        load_meshes(tmp_path / f"a{suffix}")


def test_without_the_optional_libraries_triangles_and_convex_faces_are_read(tmp_path, monkeypatch):
    for name in ("mapbox_earcut", "plyfile"):
        monkeypatch.setitem(sys.modules, name, None)
    text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\n"
    (tmp_path / "a.obj").write_text(f"{text}f 1 2 5\nf 1 2 3 4\n")
    assert len(load_meshes(tmp_path / "a.obj").placed[0].mesh.triangles) == 3
    (tmp_path / "b.obj").write_text(f"{text}f 1 2 3 4 5\n")
    trimesh.creation.box().export(tmp_path / "c.ply")
    for name, library in (("b.obj", "mapbox_earcut"), ("c.ply", "plyfile")):
        with pytest.raises(MissingLibraryError, match=rf"{name}'.*{library}: pip install .*meshes"):
            load_meshes(tmp_path / name)
