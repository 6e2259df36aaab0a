"""OFF: what each line says, or why it is refused."""

from __future__ import annotations

import pytest
from reference_tracer.scene import SceneError
from reference_tracer_meshes.off import read as read_off

ARROW = [[[0, 0, 0], [2, 1, 0], [1, 1, 0]], [[2, 1, 0], [0, 2, 0], [1, 1, 0]]]


@pytest.fixture
def read(tmp_path):
    """Return the function that reads a text."""

    def of(text):
        (tmp_path / "stem.off").write_text(text)
        return read_off(tmp_path / "stem.off")

    return of


@pytest.mark.parametrize(
    "text",
    [
        "OFF\n4 1 0\n0 0 0\n2 1 0\n0 2 0\n1 1 0\n4 0 1 2 3\n",
        "OFF 4 1\n# corners\n0 0 0\n\n2 1 0 # right\n0 2 0\n1 1 0\n4 0 1 2 3 255 0 0",
        "COFF\n4 1 4\n0 0 0 1 0 0 1\n2 1 0 1 0 0 1\n0 2 0 0 0 1 1\n1 1 0 0 0 1 1\n4 0 1 2 3\n",
        "STCNOFF\n4 1 4\n"
        + "".join(f"{v} 0 0 1 .5 .5 .5 .5 9 9\n" for v in ("0 0 0", "2 1 0", "0 2 0", "1 1 0"))
        + "4 0 1 2 3 0.5 0.5 0.5\n",
        "NOFF\n4 1 4\n0 0 0 0 0 1\n2 1 0 0 0 1\n0 2 0 0 0 1\n1 1 0 0 0 1\n4 0 1 2 3 7\n",
    ],
)
def test_ways_to_write_the_same(text, read):
    found = read(text)
    (placed,) = found.placed
    assert placed.mesh.vertices[placed.mesh.triangles].tolist() == ARROW
    assert placed.object == "stem" and found.notes == found.missing == ()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no OFF file"),
        ("ply\n", "no OFF file"),
        ("4OFF\n1 0 0\n", "4OFF of four dimensions"),
        ("nOFF\n3\n1 0 0\n", "nOFF of four dimensions"),
        ("OFF BINARY\n", "or binary: save it as text"),
        ("OFF\n3 one 0\n", "line 2: "),
        ("OFF\n3\n", "line 2 should say how many"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n", "cut off: its counts say more"),
        ("OFF\n1 1 0\n0 0 0\n", "cut off: its counts say more"),
        ("OFF\n3 1 0\n0 0 0\n0,5 0 0\n0 1 0\n3 0 1 2\n", "line 4: '0,5' is no number: the dec"),
        ("OFF\n3.0 1 0\n0 0 0\n", "line 2: '3.0' is no integer"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "line 6 has fewer corners"),
        ("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "cut off: its counts say more"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "line 6 has fewer corners"),
        ("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4 has no three coordinates"),
        ("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "line 4: 'x' is no number"),
    ],
)
def test_what_cannot_be_meant_is_refused(text, words, read):
    with pytest.raises((SceneError, ValueError), match=words):
        read(text)


def test_what_is_behind_the_last_face_is_named(read):
    found = read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n")
    (note,) = found.notes
    assert note.startswith("what is behind the last face is not understood")


@pytest.mark.parametrize(
    ("header", "vertex", "face", "notes"),
    [
        ("OFF", " 1 0 0", "", ["3 vertices have other numbers than OFF names"]),
        (
            "OFF",
            " 1",
            "",
            ["3 vertices have other numbers than OFF names"],
        ),
        ("COFF", "", "", ["3 vertices have other numbers than COFF names"]),
        ("COFF", " 1 0 0", "", []),
        ("NOFF", " 0 0 1 1 0 0", "", ["3 vertices have other numbers than NOFF names"]),
        ("CNOFF", " 0 0 1 1 0 0 1", "", []),
        ("OFF", "", " 1 0 0", []),
        ("OFF", "", " 1 0", ["1 face has numbers behind the corners that are no colour"]),
        ("OFF", "", " 1 0 0 1 5", ["1 face has numbers"]),
    ],
)
def test_numbers_that_the_header_does_not_name_are_told(header, vertex, face, notes, read):
    corners = "".join(f"{c}{vertex}\n" for c in ("0 0 0", "1 0 0", "0 1 0"))
    found = read(f"{header}\n3 1 0\n{corners}3 0 1 2{face}\n")
    assert len(found.placed[0].mesh.triangles) == 1
    assert len(found.notes) == len(notes)
    assert all(n.startswith(start) for n, start in zip(found.notes, notes, strict=True))
