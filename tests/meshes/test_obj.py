"""OBJ: what each line says, or why it is refused, or in which note it is named."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.scene import SceneError
from reference_tracer_meshes.obj import read as read_obj

POINTS = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.fixture
def read(tmp_path):
    """Return the function that reads a text."""

    def of(text):
        (tmp_path / "stem.obj").write_bytes(text.encode())
        return read_obj(tmp_path / "stem.obj")

    return of


def corners(contents):
    """Return the corners of all triangles, (n, 3, 3)."""
    parts = [mesh.vertices[mesh.triangles] for mesh, *_ in contents.placed]
    return np.concatenate(parts)


def test_negative_indices_count_back_from_their_own_line(read):
    """Also where more vertices follow, and in a face that begins with one from the front."""
    moved = "v 3 0 0\nv 4 0 0\nv 3 1 0\n"
    found = corners(read(f"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n{moved}f -3 -2 -1\nf 4 -2 -1\n"))
    assert found[0, :, 0].tolist() == [0, 1, 0]
    assert found[1, :, 0].tolist() == found[2, :, 0].tolist() == [3, 4, 3]


@pytest.mark.parametrize("face", ["1 2 3", "1/9 2/9 3/9", "1//9 2//9 3//9", "1/9/9 2/9/9 3/9/9"])
def test_a_corner_may_name_more_than_a_vertex(face, read):
    found = read(f"{POINTS}vn 0 0 1\nvt 0 0\ns off\nusemtl red\nmtllib a.mtl\nf {face}\n")
    assert corners(found).tolist() == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]
    assert found.notes == found.missing == ()


@pytest.mark.parametrize(
    "text",
    [
        f"{POINTS}f 1 2 3 4\n",
        f"{POINTS}f 1 2 3 4\n".replace("\n", "\r\n"),
        f"# v 9 9 9\n{POINTS}f 1 2 \\\n  3\\\n  4 # a square\n",
        f"# a path\\\n{POINTS}\n\n   f\t1  2 3 4",
        "v 0 0 0 1.0\nv 1e0 0 0\nv 1.0E+0 +1 -0. 1 0 0\nv 0 .1e1 0\nf 1 2 3 4",
    ],
)
def test_ways_to_write_the_same(text, read):
    found = read(text)
    assert corners(found).tolist() == [
        [[0, 0, 0], [1, 0, 0], [1, 1, 0]],
        [[0, 0, 0], [1, 1, 0], [0, 1, 0]],
    ]
    assert found.notes == found.missing == ()


@pytest.mark.parametrize("name", ["stem", "other"])
def test_an_object_is_one_whatever_the_file_is_called(name, read):
    found = read(f"{POINTS}o {name}\ng a\nf 1 2 3\ng b\nf 1 3 4\n")
    assert [part.object for part in found.placed] == [name]


def test_vertices_are_the_numbers_of_the_file(read, rng):
    numbers = rng.normal(size=(99, 3)) * 10.0 ** rng.integers(-30, 30, (99, 3))
    lines = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in numbers.tolist())
    found = read(lines + "".join(f"f {k} {k + 1} {k + 2}\n" for k in range(1, 98)))
    assert np.array_equal(found.placed[0].mesh.vertices, numbers)


def test_objects_keep_their_names_and_share_no_vertices(read):
    text = f"{POINTS}f 1 2 3\no Cube#2\ng one\nf 2 3 4\no a b\nf 1 2 4\no Cube#2\nf 1 3 4\n"
    found = read(text)
    names = [placed.object for placed in found.placed]
    assert names == ["stem", "Cube#2", "a b"]
    assert [len(p.mesh.triangles) for p in found.placed] == [1, 2, 1]
    assert [len(p.mesh.vertices) for p in found.placed] == [3, 4, 3]
    grouped = read(f"{POINTS}g one\nf 2 3 4\ng two three\nf 1 2 4\ng one\nf 1 3 4\n")
    assert [placed.object for placed in grouped.placed] == ["one", "two three"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{POINTS}f 1 2 5\n", "line 5 names vertex 5, but there are 4"),
        (f"{POINTS}f 1 2 0\n", "line 5 names vertex 0"),
        (f"{POINTS}f 1 2 3\nf -5 1 2\n", "line 6 names vertex 0"),
        (f"{POINTS}f 1 2 3\n\nf 1 2 x/1\n", "line 7: 'x' is no integer"),
        (f"{POINTS}f 1 2 -x\n", "line 5: '-x' is no integer"),
        (f"{POINTS}f 1 2 2.5\n", "line 5: '2.5' is no integer"),
        (f"{POINTS}v 1 2 1_0\n", "line 5: '1_0' is no number"),
        (f"{POINTS}f 1 2 3_\n", "line 5: '3_' is no integer"),
        (f"{POINTS}f 1 2 {'9' * 30}\n", "line 5: an integer has too many digits"),
        (f"{POINTS}v 1 2\n", "line 5: a vertex has three coordinates"),
        (f"{POINTS}v 1 2 0,5\n", "line 5: '0,5' is no number: the decimal sign is a point"),
        (f"{POINTS}v 1 2", "line 5: a vertex has three coordinates; if .* it is cut off: copy it"),
        (f"{POINTS}v 1 2 three\n", "line 5: 'three' is no number"),
        ("\0\0\0\0", "holds bytes that no text has"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(text, words, read):
    with pytest.raises(SceneError, match=words):
        read(text)


@pytest.mark.parametrize(
    ("line", "words", "is_missing"),
    [
        ("l 1 2 3\nl 1 2", "2 lines 'l' (lines) are not drawn", False),
        ("p 1", "1 line 'p' (points) is not drawn", False),
        ("cstype bspline\ncurv 0 1 1 2\nend", "(cstype, curv, end)", True),
        ("vp 0 1", "curves and surfaces are not drawn: 1 line (vp)", True),
        ("tesselate 3", "1 line 'tesselate' is not understood, and left out", False),
        ("v 0 0 0 2.5", "1 vertex has a weight other than 1", False),
        ("f 1 2", "1 face with fewer than three corners, the first is face 1", False),
        ("v 0 0 inf\nf 1 2 5", "1 face with a corner that is no finite number", True),
    ],
)
def test_what_is_not_drawn_is_named(line, words, is_missing, read):
    found = read(f"{POINTS}{line}\nf 1 2 3\n")
    told, other = (found.missing, found.notes) if is_missing else (found.notes, found.missing)
    assert len(told) == 1 and words in told[0] and other == ()
    assert corners(found)[-1].tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]


def test_objects_of_one_name_are_taken_as_one_with_a_note(tmp_path):
    triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"
    path = tmp_path / "a.obj"
    path.write_text(f"o Box\n{triangle}o Ball\n{triangle}o Box\n{triangle}")
    found = read_obj(path)
    assert [(p.object, len(p.mesh.triangles)) for p in found.placed] == [("Box", 2), ("Ball", 1)]
    assert found.notes == ("objects that have the same name are taken as one: 'Box'",)
    path.write_text(f"g Box\n{triangle}g Ball\n{triangle}g Box\n{triangle}")  # a group goes on
    assert not read_obj(path).notes


def test_a_mark_of_utf_8_hides_no_vertex(read):
    found = read(f"\ufeff{POINTS}f 1 2 3\n")
    assert corners(found).tolist() == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]
    assert found.notes == ()
