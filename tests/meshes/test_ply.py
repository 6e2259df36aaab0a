"""PLY in all its forms, judged by plyfile, which writes them."""

from __future__ import annotations

import numpy as np
import plyfile
import pytest
from reference_tracer.scene import SceneError
from reference_tracer_meshes.ply import read as read_ply

from .plys import write_ply

FORMS = ["ascii", "binary_little_endian", "binary_big_endian"]
STRIP = [0, 1, 2, 3, -1, 2, 3, 4, 5, 5, 6, 6, 5, 7, -1, 8, 0, -1, 9, 8, 7, -1]
TRIANGLES = [(0, 1, 2), (2, 1, 3), (2, 3, 4), (4, 3, 5), (5, 6, 7)[::-1], (9, 8, 7)]


def corners(contents):
    """Return the corners of all triangles, (n, 3, 3)."""
    (placed,) = contents.placed
    return placed.mesh.vertices[placed.mesh.triangles]


def turned(triangle):
    """Return the same triangle, the same way round, from its lowest corner on."""
    return np.roll(triangle, -np.argmin(triangle)).tolist()


def written(path, elements, form):
    """Write elements by plyfile."""
    order = {"ascii": "=", FORMS[1]: "<", FORMS[2]: ">"}[form]
    plyfile.PlyData(elements, text=form == "ascii", byte_order=order).write(str(path))


def lists(name, rows, kind, length="u1", **more):
    """Return an element of lists, with other properties before and after them."""
    fields = [("before", "f8"), ("vertex_indices", "O"), ("flags", "u2")]
    data = np.array([(0.5, np.array(row, kind), 7) for row in rows], fields)
    return plyfile.PlyElement.describe(
        data, name, len_types={"vertex_indices": length}, val_types={"vertex_indices": kind}, **more
    )


@pytest.mark.parametrize("form", FORMS)
def test_what_is_not_the_shape_is_named_and_skipped_to_the_byte(form, tmp_path):
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(axis, "f4") for axis in "xyz"])
    edges = np.array([(0, 1), (1, 2)], [("vertex1", "i4"), ("vertex2", "i4")])
    elements = [
        lists("hair", [(1, 2, 3, 4), (), (9,)], "i2"),
        plyfile.PlyElement.describe(vertices, "vertex", comments=["of a test"]),
        plyfile.PlyElement.describe(edges, "edge"),
        lists("face", [(0, 1, 2)], "i4"),
    ]
    written(tmp_path / "a.ply", elements, form)
    found = read_ply(tmp_path / "a.ply")
    assert corners(found).tolist() == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert found.notes == (
        "3 rows of 'hair' are not understood, and left out",
        "2 edges are not drawn: what has no surface meets no ray",
    )


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("faces", [[], TRIANGLES])
def test_strips_are_read_also_beside_faces(form, faces, tmp_path):
    points, path = np.arange(30, dtype=np.float32).reshape(10, 3) ** 2, tmp_path / "a.ply"
    write_ply(path, points, {"face": faces, "tristrips": [STRIP, [0, 1, 2]]}, form)
    found = np.sqrt(corners(read_ply(path))[..., 0]) / 3
    assert [turned(t) for t in found] == [turned(t) for t in [*faces, *TRIANGLES, (0, 1, 2)]]


HEAD = "ply\nformat ascii 1.0\nelement vertex 3\n"
XYZ = "property float x\nproperty float y\nproperty float z\n"
FACE = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
TWO_LISTS = FACE.replace("end_", "property list uchar int vertex_index\nend_")
BODY = "0 0 0\n1 0 0\n0 1 0\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("solid", "no PLY file"),
        ("ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "expected integer count"),
        ("ply\nformat utf8 1.0\nend_header\n", "format"),
        (f"{HEAD}property half x\nend_header\n", "half"),
        (
            f"{HEAD}property float x\nproperty float y\n{FACE}0 0\n1 0\n0 1\n3 0 1 2",
            "no x, y and z",
        ),
        (f"{HEAD}{XYZ}{FACE}{BODY}3 0 1 two", "malformed input"),
        (f"{HEAD}{XYZ}{FACE}{BODY}3 0 1 0,5", "malformed input"),
        (f"{HEAD}{XYZ}{FACE}{BODY}3 0 1 1.5", "malformed input"),
        (f"{HEAD}{XYZ}{FACE}{BODY}-3 0 1 2", "out of bounds|malformed"),
        (f"{HEAD}{XYZ}{FACE.replace('int', 'float', 1)}{BODY}3 0 1 1.5", "with fractions"),
        (f"{HEAD}{XYZ}{FACE.replace('vertex_indices', 'corners')}{BODY}3 0 1 2", "not one list"),
        (f"{HEAD}{XYZ}property float x\n{FACE}", "two properties with same name"),
        (f"{HEAD}{XYZ}{TWO_LISTS}{BODY}3 0 1 2 3 2 1 0", "not one list"),
    ],
)
def test_what_cannot_be_meant_is_refused(text, words, tmp_path):
    (tmp_path / "a.ply").write_text(text)
    with pytest.raises(Exception, match=words):
        read_ply(tmp_path / "a.ply")


def test_more_rows_than_the_file_has_bytes_are_refused_before_any_is_made(tmp_path):
    (tmp_path / "a.ply").write_text(f"{HEAD.replace('3', '9' * 13)}{XYZ}{FACE}{BODY}3 0 1 2\n")
    with pytest.raises(SceneError, match="fewer bytes than its head has rows"):
        read_ply(tmp_path / "a.ply")


def test_an_index_out_of_range_is_refused_with_its_face(tmp_path):
    (tmp_path / "a.ply").write_text(f"{HEAD}{XYZ}{FACE}{BODY}3 0 1 3")
    with pytest.raises(ValueError, match="face 1 names vertex 3 of 3, counted from 0"):
        read_ply(tmp_path / "a.ply")


@pytest.mark.parametrize("form", FORMS)
def test_bytes_behind_the_last_row_are_named(form, tmp_path):
    """In a file of triangles, and in one of mixed sizes, which is read in another way."""
    points = np.zeros(5, [(axis, "f4") for axis in "xyz"])
    points["x"], points["y"] = [0, 1, 1, 0, 2], [0, 0, 1, 1, 2]
    for rows in ([(0, 1, 2)], [(0, 1, 2, 3), (0, 1, 2)]):
        path = tmp_path / "a.ply"
        elements = [plyfile.PlyElement.describe(points, "vertex"), lists("face", rows, "i4")]
        written(path, elements, form)
        assert not read_ply(path).notes
        path.write_bytes(path.read_bytes() + b"extra")
        assert read_ply(path).notes == (
            "5 bytes behind the last row are not understood, and left out",
        )
