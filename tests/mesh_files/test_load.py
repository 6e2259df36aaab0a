"""Meshes in files, the camera that frames them, and what is said of their state."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.cli import opening
from reference_tracer.mesh_diagnosis import diagnose
from reference_tracer.mesh_files.contents import Contents, Placed
from reference_tracer.mesh_files.load import load_meshes, scene_of_meshes
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer.vector import transform_points

from .plys import write_ply


@pytest.mark.parametrize("suffix", ["obj", "ply", "off", "stl", "glb"])
def test_meshes_from_files(suffix, tmp_path):
    shape = trimesh.creation.torus(2.0, 0.5, major_sections=12, minor_sections=7)
    shape.apply_translation((3, 4, 5))
    path = tmp_path / f"mesh.{suffix.upper()}"
    shape.export(path, file_type=suffix)
    ((mesh, matrix, _),) = load_meshes(path).placed
    corners = mesh.vertices[mesh.triangles] @ matrix[:3, :3].T + matrix[:3, 3]
    expected = shape.triangles
    if suffix == "glb":  # whose Y is up
        expected = expected[..., [0, 2, 1]] * (1, -1, 1)
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
    matrices = [placed.world_from_object for placed in loaded.placed]
    assert np.ptp([m[:3, 3] for m in matrices], axis=0).max() == pytest.approx(20)


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


def test_faces_that_are_not_finite_are_left_out_and_named(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 nan 1\nf 1 2 3\nf 1 2 4 3\n")
    found = load_meshes(tmp_path / "a.obj")
    assert len(found.placed[0].mesh.triangles) == 1
    assert found.missing[0].startswith("1 face with a corner that is no finite number")
    assert "the first is face 2" in found.missing[0]


def alone(mesh, matrix=None):
    """Return a mesh as the only one of a file."""
    return Contents((Placed(mesh, np.eye(4) if matrix is None else matrix, mesh.name),))


def world(contents):
    """Return the corners of every mesh's triangles in world space, one after the other."""
    return [
        transform_points(matrix, mesh.vertices.T).T[mesh.triangles]
        for mesh, matrix, _ in contents.placed
    ]


@pytest.mark.parametrize("suffix", ["obj", "ply", "off", "stl", "glb"])
def test_y_up_is_the_file_turned_by_hand(suffix, tmp_path, rng):
    shape = trimesh.creation.icosphere(1)
    shape.vertices = (shape.vertices * rng.normal(size=3)).astype(np.float32)
    shape.export(tmp_path / f"y.{suffix}")
    shape.vertices = shape.vertices[:, [0, 2, 1]] * (1, -1, 1)
    shape.export(tmp_path / f"z.{suffix}")
    (turned,) = world(load_meshes(tmp_path / f"y.{suffix}", up="y"))
    (by_hand,) = world(load_meshes(tmp_path / f"z.{suffix}", up="z"))
    assert np.array_equal(turned, by_hand) and np.ptp(turned, axis=(0, 1)).all()
    camera, other = (
        scene_of_meshes(load_meshes(tmp_path / f"{n}.{suffix}", n), None, 8, 8).camera for n in "yz"
    )
    assert np.array_equal(camera.world_from_camera, other.world_from_camera)


def test_y_up_is_exact_where_a_file_places_its_meshes(tmp_path, rng):
    several = trimesh.Scene()
    for k in range(3):
        matrix = trimesh.transformations.random_rotation_matrix(rng.random(3))
        matrix[:3, 3] = rng.normal(size=3)
        several.add_geometry(trimesh.creation.box(), transform=matrix, geom_name=f"box{k}")
    several.export(tmp_path / "several.glb")
    z, y = (world(load_meshes(tmp_path / "several.glb", up)) for up in "zy")
    for a, b in zip(z, y, strict=True):
        assert np.array_equal(a[..., [0, 2, 1]] * (1, -1, 1), b)


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


@pytest.mark.filterwarnings("error")
def test_what_cannot_be_framed_or_is_no_number_is_refused_without_a_warning(tmp_path):
    huge = Mesh(1.7e308 * np.eye(3) - 1e308, [[0, 1, 2]], name="huge.ply")
    with pytest.raises(SceneError, match=r"^it is too large to be framed: scale it down$"):
        scene_of_meshes(alone(huge), None, 8, 8)
    bits = np.array([0x7F800001, 0, 0x7F7FFFFF] * 3, np.uint32).view(np.float32).reshape(3, 3)
    write_ply(tmp_path / "a.ply", bits, {"face": [(0, 1, 2)]}, "binary_little_endian")
    with pytest.raises(SceneError, match="holds no triangles"):
        load_meshes(tmp_path / "a.ply")


@pytest.mark.parametrize("size", [(90, 50), (40, 70)])
@pytest.mark.parametrize(
    "shape",
    [
        trimesh.creation.icosphere(2),
        trimesh.creation.box((1, 2, 30)),
        trimesh.creation.torus(1, 0.1),
        trimesh.creation.box((1e-4, 3e-4, 2e-5)),
    ],
    ids=["ball", "tower", "ring", "tiny"],
)
def test_the_picture_of_a_mesh_is_nine_tenths_full(shape, size, make):
    far = shape.bounding_box.extents.max() * np.array((9, -7, 2.0))
    matrix = trimesh.transformations.translation_matrix(far)
    frame = render(scene_of_meshes(alone(make.mesh(shape), matrix), None, *size))
    seen = frame.instance_index == 0
    y, x = (np.flatnonzero(seen.any(axis=axis)) for axis in (1, 0))
    spans = np.array([np.ptp(x) + 1, np.ptp(y) + 1])
    assert (np.abs(spans - 0.9 * np.array(size)) <= 1).any() and (
        spans <= 0.9 * np.array(size) + 1
    ).all()
    assert 0 < x[0] and x[-1] < size[0] - 1 and 0 < y[0] and y[-1] < size[1] - 1


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

    @pytest.mark.parametrize("scale", [1e-9, 1.0, 1e160])
    def test_as_trimesh_has_it(self, rng, scale):
        for count in range(60):
            points = scale * rng.integers(-1, 2, (6, 3)).astype(float)
            points[0] += 1e-8 * rng.normal(size=3)
            faces = rng.integers(0, 6, (count % 12, 3))
            if count % 2:  # all edges in pairs, one of them wound the wrong way at times
                faces = np.concatenate((faces, np.roll(faces[:, ::-1], count, axis=1)))
                faces[:1] = faces[:1, :: 1 if count % 4 == 1 else -1]
            found = self.of(trimesh.Trimesh(points, faces, process=False), triangles=faces)
            positions, index = np.unique(points, axis=0, return_inverse=True)
            merged = trimesh.Trimesh(positions, index.reshape(-1)[faces], process=False)
            with np.errstate(all="ignore"):
                assert found["degenerate_faces"] == (~merged.nondegenerate_faces()).sum()
            assert found["closed"] == merged.is_watertight
            assert found["consistent_winding"] == merged.is_winding_consistent

    def test_nothing(self):
        found = diagnose(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))
        assert not found["closed"] and not found["degenerate_faces"]

    @pytest.mark.filterwarnings("error")
    @pytest.mark.parametrize("scale", [1e-310, 1e150, 1e307])
    def test_what_is_tiny_or_huge_is_closed_too(self, scale):
        found = self.of(trimesh.creation.box(), vertices=trimesh.creation.box().vertices * scale)
        assert found["closed"] and found["consistent_winding"]


def test_a_mesh_of_points_in_a_plane_is_named(tmp_path):
    trimesh.creation.box().export(tmp_path / "a.glb")
    content = (tmp_path / "a.glb").read_bytes()
    assert content.count(b'"type":"VEC3"') == 1
    (tmp_path / "a.glb").write_bytes(content.replace(b'"type":"VEC3"', b'"type":"VEC2"'))
    with pytest.raises(SceneError, match=r"a\.glb' .*: accessor 1 is of type 'VEC2', not VEC3"):
        load_meshes(tmp_path / "a.glb")


def test_a_mesh_too_large_to_be_framed_is_named(tmp_path):
    (tmp_path / "a.obj").write_text("v -1e308 0 0\nv 1.7e308 0 0\nv 0 1e308 0\nf 1 2 3\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(SceneError, match=r"a\.obj': it is too large"):
            opening.load(tmp_path / "a.obj")


@pytest.mark.parametrize("load", [load_meshes, load_scene])
@pytest.mark.parametrize("kind", [str, Path])
def test_there_is_no_such_file(load, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match=r"^there is no file 'none\.ply'$"):
        load(kind("none.ply"))


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


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".off", ".stl", ".glb"])
@pytest.mark.parametrize("content", [b"", bytes(200), bytes(range(256)), b"{}"])
def test_what_is_no_mesh_at_all_gets_one_message(suffix, content, tmp_path):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(SceneError, match=rf"^'{path}' (cannot be read as a mesh: |holds no tri)"):
        load_meshes(path)


def test_no_meshes():
    with pytest.raises(SceneError, match="no meshes"):
        scene_of_meshes(Contents(()), None, 30, 20)


@pytest.mark.parametrize("size, word", [((6.5, 4), "width .* is 6.5"), ((6, 4.0), "height .* 4.0")])
def test_a_part_of_a_pixel(size, word):
    box = Mesh(np.eye(3), [[0, 1, 2]])
    with pytest.raises(SceneError, match=rf"{word}; it must be an integer"):
        scene_of_meshes(alone(box), None, *size)
    assert scene_of_meshes(alone(box), None, np.int64(6), 4).camera.width == 6


def test_scipy_is_not_imported_for_a_mesh_and_is_not_missed(tmp_path):
    """It takes longer than all else at the start of `reftrace trace`."""
    several = trimesh.Scene()
    for k in range(2):
        at = trimesh.transformations.translation_matrix((3 * k, 0, 1))
        several.add_geometry(trimesh.creation.box(), transform=at)
    several.export(tmp_path / "a.glb")
    trimesh.creation.icosphere(1).export(tmp_path / "b.stl")
    points = np.round(np.column_stack((*np.c_[[np.cos(v := np.arange(6)), np.sin(v)]], v)), 3)
    write_ply(
        tmp_path / "c.ply", points, {"face": [(0, 1, 2, 3), (2, 3, 4, 5)]}, "binary_little_endian"
    )
    text = "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "f 1 2 3 4 5 6\nf 1 2 3 4\n"
    (tmp_path / "d.obj").write_text(text)
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
    assert found == list(map(str, expected)) and len(found) == 5 and imported == "[]"


def test_a_property_of_a_ply_may_have_spaces_in_its_name(tmp_path):
    """As a vertex group has that Blender writes."""
    head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    head += "property float Bone 1\nproperty float z\nelement face 1\n"
    head += "property list uchar uint vertex_indices\nend_header\n"
    (tmp_path / "a.ply").write_text(head + "0 0 9 1\n1 0 9 1\n0 1 9 2\n3 0 1 2\n")
    (placed,) = load_meshes(tmp_path / "a.ply").placed
    np.testing.assert_array_equal(placed.mesh.vertices, [(0, 0, 1), (1, 0, 1), (0, 1, 2)])
    (tmp_path / "b.ply").write_text(head.replace("float Bone 1", "float"))
    with pytest.raises(SceneError, match="its head is not understood: 'property float'"):
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
