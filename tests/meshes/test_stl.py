"""STL, binary and text."""

from __future__ import annotations

import pytest
import trimesh
from reference_tracer.scene import SceneError
from reference_tracer_meshes.stl import read as read_stl

SOLID = (
    "solid {}\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
    "   vertex {} 1 0\n  endloop\n endfacet\nendsolid {}\n"
)


def test_a_binary_file_may_begin_with_solid(tmp_path):
    trimesh.creation.box().export(tmp_path / "a.stl")
    content = (tmp_path / "a.stl").read_bytes()
    (tmp_path / "a.stl").write_bytes(b"solid facet" + content[11:])
    assert len(read_stl(tmp_path / "a.stl").placed[0].mesh.triangles) == 12


def test_solids_are_objects(tmp_path):
    (tmp_path / "a.stl").write_text(SOLID.format("one", 0, "one") + SOLID.format("", 2, ""))
    found = read_stl(tmp_path / "a.stl").placed
    assert [placed.object for placed in found] == ["one", "a"]
    assert found[1].mesh.vertices[:, 0].tolist() == [0, 1, 2]


def test_a_facet_of_four_corners_is_cut(tmp_path):
    """Some programs write them."""
    four = SOLID.format("a", 1, "a").replace("  endloop", "   vertex 0 1 0\n  endloop")
    (tmp_path / "a.stl").write_text(four)
    assert len(read_stl(tmp_path / "a.stl").placed[0].mesh.triangles) == 2


@pytest.mark.parametrize("kind", ["stl", "stl_ascii"])
def test_a_file_that_is_cut_off_is_refused_wherever_that_is(kind, tmp_path):
    trimesh.creation.box().export(tmp_path / "a.stl", file_type=kind)
    content = (tmp_path / "a.stl").read_bytes()
    for end in range(1, len(content) - 12, 37):
        (tmp_path / "a.stl").write_bytes(content[:end])
        with pytest.raises(SceneError, match="cut off"):
            read_stl(tmp_path / "a.stl")


def test_what_is_behind_the_last_triangle_is_named(tmp_path):
    trimesh.creation.box().export(tmp_path / "a.stl")
    with (tmp_path / "a.stl").open("ab") as file:
        file.write(bytes(7))
    (note,) = read_stl(tmp_path / "a.stl").notes
    assert "behind the last triangle" in note and "7 byte" in note


def test_a_line_that_is_not_understood_is_refused(tmp_path):
    (tmp_path / "a.stl").write_text(SOLID.format("a", 0, "a").replace("vertex 1 0 0", "vertex 1 0"))
    with pytest.raises(SceneError, match="a line of it is not understood"):
        read_stl(tmp_path / "a.stl")
