"""What glTF's specification says of shapes is applied: each feature in a small file.

The right area and place are worked out from the rules of the specification, by hand.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer_meshes.gltf import read as read_gltf
from reference_tracer_meshes.load import load_meshes

from .gltf_build import INDICES, SQUARE, Build, area, box, corners, moved, read


def test_y_is_turned_up(path):
    """By the command's reader: (x, y, z) becomes (x, -z, y)."""
    Build().shown(translation=[0, 5, 7]).write(path)
    ((mesh, world, _),) = load_meshes(path).placed
    assert (mesh.vertices[0] @ world[:3, :3].T + world[:3, 3]).tolist() == [0, -7, 5]


class TestNodes:
    def test_names(self, path):
        build = Build()
        named, nameless = build.mesh(), build.mesh()
        build.json["meshes"][named]["name"] = "Mesh"
        nodes = [
            *(build.node(mesh=named, name="A") for _ in range(2)),
            build.node(mesh=named),
            build.node(mesh=nameless),
            build.node(mesh=nameless, name="A (node 1)"),
            build.node(mesh=nameless, name="\ud800\n"),
        ]
        build.scene(*nodes)
        names = [p.object for p in read_gltf(build.write(path)).placed]
        assert names[:4] == ["A", "A (node 1)", "Mesh", "node 3"]
        assert len(set(names)) == 6 and names[5] == "\ud800\n"

    def test_a_node_that_is_hidden_and_those_below_it(self, path):
        build = Build()
        build.extension("KHR_node_visibility", required=True)
        mesh = build.mesh()
        visible = {"KHR_node_visibility": {"visible": True}}
        below = build.node(mesh=mesh, name="below", extensions=visible)
        hidden = {"KHR_node_visibility": {"visible": False}}
        parent = build.node(mesh=mesh, name="parent", children=[below], extensions=hidden)
        build.scene(parent, build.node(mesh=mesh, translation=[9, 0, 0], extensions=visible))
        triangles, notes = read(build.write(path))
        assert box(triangles) == moved(9)
        (note,) = notes
        assert "hidden" in note and "2 nodes" in note


SCENES = {
    "the default one": ({"scene": 1}, moved(6), ["2 nodes"]),
    "the first of two": ({"scene": None}, [[0, 0, 0], [4, 1, 0]], ["2 scenes", "1 node"]),
    "all nodes": ({"scene": None, "scenes": None}, [[0, 0, 0], [7, 1, 0]], ["no scene"]),
}


@pytest.mark.parametrize("name", SCENES)
def test_which_scene_is_shown(name, path):
    changes, expected, words = SCENES[name]
    build = Build()
    mesh = build.mesh()
    at = [build.node(mesh=mesh, translation=[3 * k, 0, 0]) for k in range(3)]
    build.scene(at[0], at[1])
    build.scene(at[2])
    build.json = {k: v for k, v in (build.json | changes).items() if v is not None}
    triangles, notes = read(build.write(path))
    assert box(triangles) == expected
    assert all(word in note for word, note in zip(words, notes, strict=True))


class TestTopology:
    def test_every_second_triangle_of_a_strip_is_turned_round(self, path):
        corners = np.array([(k // 2, k % 2, 0) for k in range(7)], np.float32)
        build = Build()
        build.scene(build.node(mesh=build.mesh(corners, None, mode=5)))
        a, b, c = np.moveaxis(read(build.write(path))[0], 1, 0)
        assert (np.cross(b - a, c - a)[:, 2] == -1).all() and len(a) == 5

    @pytest.mark.parametrize("mode", range(4))
    def test_points_and_lines_are_named(self, mode, path):
        build = Build()
        mesh = build.mesh(indices=None, mode=mode)
        build.scene(build.node(mesh=mesh))
        assert not read_gltf(build.write(path)).placed
        (note,) = read_gltf(path).notes
        assert "Points and lines" in note

    def test_primitives_that_share_corners(self, path):
        build = Build()
        mesh = build.mesh()
        primitive = build.json["meshes"][mesh]["primitives"][0]
        halves = [dict(primitive, indices=build.accessor(INDICES[k : k + 3])) for k in (0, 3)]
        other = build.json["meshes"][build.mesh(SQUARE + np.float32([5, 0, 0]))]["primitives"][0]
        build.json["meshes"][mesh]["primitives"] = [*halves, other]
        build.scene(build.node(mesh=mesh))
        (placed,) = read_gltf(build.write(path)).placed
        assert area(corners(placed)) == 2 and len(placed.mesh.vertices) == 8
        assert box(corners(placed)) == [[0, 0, 0], [6, 1, 0]]

    def test_without_positions_nothing_is_shown(self, path):
        build = Build().shown()
        build.json["meshes"][0]["primitives"][0]["attributes"] = {"_OTHER": 0}
        assert "without positions" in read_gltf(build.write(path)).missing[0]
