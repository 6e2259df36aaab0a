"""What glTF's specification says of shapes is applied: each feature in a small file.

The right area and place are worked out from the rules of the specification, by hand.
"""

from __future__ import annotations

from urllib.parse import quote

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf
from reference_tracer.mesh_files.load import load_meshes

from .gltf_build import (
    INDICES,
    SQUARE,
    Build,
    area,
    box,
    corners,
    glb,
    inverse_binds,
    read,
    skinned,
)

HALF = np.sqrt(0.5)
UNIT = [[0, 0, 0], [1, 1, 0]]


@pytest.fixture(params=["a.glb", "a.gltf"])
def path(request, tmp_path):
    return tmp_path / request.param


def moved(x: float, y: float = 0, z: float = 0) -> list[list[float]]:
    """The box of the unit square, moved."""
    return [[x, y, z], [x + 1, y + 1, z]]


def test_a_square(path):
    triangles, notes = read(Build().shown().write(path))
    assert box(triangles) == UNIT and area(triangles) == 1 and not notes
    assert triangles.tolist() == SQUARE[INDICES].reshape(2, 3, 3).tolist()


def test_y_is_turned_up(path):
    """By the command's reader: (x, y, z) becomes (x, -z, y)."""
    Build().shown(translation=[0, 5, 7]).write(path)
    ((mesh, world, _),) = load_meshes(path).placed
    assert (mesh.vertices[0] @ world[:3, :3].T + world[:3, 3]).tolist() == [0, -7, 5]


class TestNodes:
    def test_a_hierarchy(self, path):
        """Scale first, then rotation (90 degrees about Z), then translation, then the parent's."""
        build = Build()
        child = build.node(
            mesh=build.mesh(), translation=[1, 0, 0], rotation=[0, 0, HALF, HALF], scale=[2, 3, 1]
        )
        build.scene(build.node(children=[child], scale=[10, 1, 1]))
        triangles, _ = read(build.write(path))
        assert np.allclose(box(triangles), [[-20, 0, 0], [10, 2, 0]], atol=1e-14)
        assert area(triangles) == pytest.approx(60)

    def test_a_matrix_is_stored_by_columns(self, path):
        matrix = [0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]
        triangles, _ = read(Build().shown(matrix=matrix).write(path))
        assert box(triangles) == [[4, 6, 7], [5, 8, 7]]

    def test_a_negative_scale(self, path):
        (placed,) = read_gltf(Build().shown(scale=[-1, 1, 1]).write(path)).placed
        assert box(corners(placed)) == [[-1, 0, 0], [0, 1, 0]]
        assert np.linalg.det(placed.world_from_object) == -1

    def test_a_shared_mesh_is_one_mesh(self, path):
        build = Build()
        mesh = build.mesh()
        build.scene(*(build.node(mesh=mesh, translation=[3 * k, 0, 0]) for k in range(3)))
        placed = read_gltf(build.write(path)).placed
        assert len({id(p.mesh) for p in placed}) == 1
        assert [box(corners(p)) for p in placed] == [moved(0), moved(3), moved(6)]

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
        assert len(set(names)) == 6 and names[5] == "??"

    def test_a_name_that_is_made_is_taken_already(self, path):
        build = Build()
        mesh = build.mesh()
        build.scene(*(build.node(mesh=mesh, name=name) for name in ("A (node 2)", "A", "A")))
        names = {p.object for p in read_gltf(build.write(path)).placed}
        assert names == {"A (node 2)", "A", "A (node 2) (node 2)"}

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
        assert "hidden" in note and "'below'" in note and "'parent'" in note

    def test_a_joint_that_is_hidden_still_moves(self, path):
        build = skinned()
        build.json["nodes"][1]["extensions"] = {"KHR_node_visibility": {"visible": False}}
        assert box(read(build.write(path))[0]) == moved(3)


class TestScenes:
    def two(self) -> Build:
        build = Build()
        mesh = build.mesh()
        at = [build.node(mesh=mesh, translation=[3 * k, 0, 0]) for k in range(3)]
        build.scene(at[0], at[1])
        build.scene(at[2])
        return build

    def test_the_default_one(self, path):
        build = self.two()
        build.json["scene"] = 1
        triangles, notes = read(build.write(path))
        assert box(triangles) == moved(6)
        assert len(notes) == 1 and "node 0, node 1" in notes[0]

    def test_the_first_of_two_is_named(self, path):
        build = self.two()
        del build.json["scene"]
        build.json["scenes"][0]["name"] = "Front"
        triangles, notes = read(build.write(path))
        assert area(triangles) == 2 and any("2 scenes" in n and "'Front'" in n for n in notes)

    def test_the_only_one_needs_no_word(self, path):
        build = Build().shown()
        del build.json["scene"]
        assert read(build.write(path))[1] == ()

    def test_without_any_all_nodes_are_shown(self, path):
        build = self.two()
        del build.json["scene"], build.json["scenes"]
        triangles, notes = read(build.write(path))
        assert area(triangles) == 3 and "no scene" in notes[0]


class TestTopology:
    @pytest.mark.parametrize(
        "mode, order", [(4, (0, 1, 2, 0, 2, 3)), (5, (0, 1, 3, 2)), (6, range(4))]
    )
    @pytest.mark.parametrize("dtype", [None, "u1", "u2", "u4"])
    def test_triangles_strips_and_fans(self, mode, order, dtype, path):
        build = Build()
        order = np.array(order)
        indexed = {"corners": SQUARE, "indices": order.astype(dtype)} if dtype else {}
        direct = {"corners": SQUARE[order], "indices": None}
        build.scene(build.node(mesh=build.mesh(**(indexed or direct), mode=mode)))
        triangles, notes = read(build.write(path))
        assert area(triangles) == 1 and box(triangles) == UNIT and not notes
        a, b, c = np.moveaxis(triangles, 1, 0)
        assert (np.cross(b - a, c - a)[:, 2] == 1).all()  # none is turned round

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
        build.json["meshes"][mesh]["name"] = "Dots"
        build.scene(build.node(mesh=mesh))
        assert not read_gltf(build.write(path)).placed
        (note,) = read_gltf(path).notes
        assert "Points and lines" in note and "mesh 0 'Dots'" in note

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


class TestNumbers:
    @pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "u2"])
    @pytest.mark.parametrize("normalized", [True, False])
    def test_quantised_positions(self, dtype, normalized, path):
        """KHR_mesh_quantization: the greatest integer is 1 where it is normalised."""
        build = Build()
        build.extension("KHR_mesh_quantization", required=True)
        most = np.iinfo(dtype).max
        padded = np.zeros((4, 4), dtype)
        padded[:, :3] = SQUARE * most
        mesh = build.mesh()
        position = build.json["accessors"][0]
        position |= {
            "bufferView": build.view(padded.tobytes(), byteStride=4 * padded.itemsize),
            "componentType": {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123}[dtype],
            "normalized": normalized,
        }
        build.scene(build.node(mesh=mesh))
        triangles, notes = read(build.write(path))
        assert box(triangles) == [[0, 0, 0], [1, 1, 0] if normalized else [most, most, 0]]
        assert not notes

    def test_the_least_signed_integer_is_minus_one(self, path):
        build = Build()
        values = np.array([(-128, -127, 0), (127, 0, 0), (0, 127, 64)], np.int8)
        mesh = build.mesh(values, None)
        build.json["accessors"][0]["normalized"] = True
        build.scene(build.node(mesh=mesh))
        triangles, _ = read(build.write(path))
        assert triangles[0].tolist() == [[-1, -1, 0], [1, 0, 0], [0, 1, 64 / 127]]

    def test_interleaved_with_an_offset(self, path):
        build = Build()
        mixed = np.full((4, 7), np.nan, np.float32)
        mixed[:, 2:5] = SQUARE
        view = build.view(bytes(8) + mixed.tobytes(), byteStride=28)
        mesh = build.mesh()
        build.json["accessors"][0] |= {"bufferView": view, "byteOffset": 16}
        build.scene(build.node(mesh=mesh))
        assert box(read(build.write(path))[0]) == UNIT

    def sparse(self, build: Build, at, values, dtype="u2"):
        return {
            "count": len(at),
            "indices": {
                "bufferView": build.view(np.array(at, dtype).tobytes()),
                "componentType": {"u1": 5121, "u2": 5123, "u4": 5125}[dtype],
            },
            "values": {"bufferView": build.view(np.array(values, np.float32).tobytes())},
        }

    @pytest.mark.parametrize("dtype", ["u1", "u2", "u4"])
    def test_sparse(self, dtype, path):
        """The corner at (1, 1) is moved to (5, 5)."""
        build = Build().shown()
        build.json["accessors"][0]["sparse"] = self.sparse(build, [2], [(5, 5, 0)], dtype)
        triangles, _ = read(build.write(path))
        assert area(triangles) == 5 and box(triangles) == [[0, 0, 0], [5, 5, 0]]

    def test_sparse_without_a_view_begins_with_zeros(self, path):
        build = Build().shown()
        del build.json["accessors"][0]["bufferView"]
        build.json["accessors"][0]["sparse"] = self.sparse(build, [1, 2], [(2, 0, 0), (2, 2, 0)])
        triangles, _ = read(build.write(path))
        assert area(triangles) == 2

    def test_an_integer_may_be_written_as_a_decimal(self, path):
        build = Build().shown()
        build.json["accessors"][0]["count"] = 4.0
        assert area(read(build.write(path))[0]) == 1


class TestMorphTargets:
    def build(self, *weights, own=None, **node) -> Build:
        build = Build()
        targets = [
            {"POSITION": build.accessor(np.broadcast_to(np.float32(move), (4, 3)).copy())}
            for move in ((2, 0, 0), (0, 8, 0))
        ]
        mesh = build.mesh(targets=targets)
        if own is not None:
            build.json["meshes"][mesh]["weights"] = own
        build.scene(*(build.node(mesh=mesh, **({"weights": w} if w else {})) for w in weights))
        return build

    def test_default_weights_are_the_mesh_s(self, path):
        assert box(read(self.build(None, own=[1, 0.25]).write(path))[0]) == moved(2, 2)

    def test_the_node_s_come_first(self, path):
        build = self.build([0.5, 0], own=[1, 0.25])
        assert box(read(build.write(path))[0]) == moved(1)

    def test_without_weights_nothing_moves(self, path):
        assert box(read(self.build(None).write(path))[0]) == UNIT

    def test_each_pose_is_made_once(self, path):
        build = self.build([1, 0], [1, 0], [0, 1], [0, 0], None)
        placed = read_gltf(build.write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(2), moved(2), moved(0, 8), UNIT, UNIT]
        assert len({id(p.mesh) for p in placed}) == 3

    def test_a_target_that_moves_no_position(self, path):
        build = self.build([3, 0.5])
        build.json["meshes"][0]["primitives"][0]["targets"][0] = {}
        assert box(read(build.write(path))[0]) == moved(0, 4)

    def test_a_sparse_and_a_quantised_target(self, path):
        build = Build().shown(weights=[1, 10])
        sparse = TestNumbers().sparse(build, [2], [(4, 4, 0)])
        zeros = {"componentType": 5126, "type": "VEC3", "count": 4}
        down = np.array([(0, 0, -127)] * 4, np.int8)
        build.json["meshes"][0]["primitives"][0]["targets"] = [
            {"POSITION": build.add("accessors", **zeros, sparse=sparse)},
            {"POSITION": build.accessor(down, normalized=True)},
        ]
        assert box(read(build.write(path))[0]) == [[0, 0, -10], [5, 5, -10]]


class TestSkins:
    def test_the_mesh_node_s_own_place_is_not_used(self, path):
        (placed,) = read_gltf(skinned().write(path)).placed
        assert box(corners(placed)) == moved(3) and (placed.world_from_object == np.eye(4)).all()

    def test_two_joints_are_mixed(self, path):
        assert box(read(skinned((0.75, 0.25, 0, 0)).write(path))[0]) == moved(2.25, 2.5)

    def test_inverse_bind_matrices_come_first(self, path):
        build = skinned()
        build.json["nodes"][1]["scale"] = [2, 2, 2]
        build.json["skins"][0]["inverseBindMatrices"] = inverse_binds(build, (-1, 0, 0), (0, 0, 0))
        triangles, _ = read(build.write(path))
        assert box(triangles) == [[1, 0, 0], [3, 2, 0]] and area(triangles) == 4

    def test_joints_hang_from_one_another_and_outside_of_the_scene(self, path):
        build = skinned((0, 1, 0, 0))
        root = build.node(children=[1], scale=[1, 1, 5], translation=[0, 0, 7])
        build.json["nodes"][1]["children"] = [2]
        build.json["scenes"] = [{"nodes": [0]}]
        assert root == 3 and box(read(build.write(path))[0]) == moved(3, 10, 7)

    @pytest.mark.parametrize("dtype", ["u1", "u2"])
    def test_normalised_weights_and_wide_joints(self, dtype, path):
        build = skinned()
        most = np.iinfo(dtype).max
        attributes = build.json["meshes"][0]["primitives"][0]["attributes"]
        weights = np.array([(most // 5, most - most // 5, 0, 0)] * 4, dtype)
        attributes["WEIGHTS_0"] = build.accessor(weights, normalized=True)
        attributes["JOINTS_0"] = build.accessor(np.array([(0, 1, 0, 0)] * 4, dtype))
        triangles, notes = read(build.write(path))
        assert np.allclose(box(triangles), moved(0.6, 8), atol=1e-14) and not notes

    def test_a_second_set_of_joints(self, path):
        build = skinned((0.5, 0, 0, 0))
        build.json["meshes"][0]["primitives"][0]["attributes"] |= {
            "JOINTS_1": build.accessor(np.array([(0, 0, 0, 1)] * 4, np.uint8)),
            "WEIGHTS_1": build.accessor(np.array([(0, 0, 0, 0.5)] * 4, np.float32)),
        }
        triangles, notes = read(build.write(path))
        assert box(triangles) == moved(1.5, 5) and not notes

    def test_weights_that_do_not_sum_to_one_are_used_and_named(self, path):
        """Half a weight is half of the joint's matrix: the square shrinks to a quarter."""
        triangles, notes = read(skinned((0.5, 0, 0, 0)).write(path))
        assert box(triangles) == [[1.5, 0, 0], [2, 0.5, 0]]
        (note,) = notes
        assert "do not sum to 1" in note
        assert "primitive 0 of mesh 0 (sums from 0.5 to 0.5)" in note

    def test_morph_targets_move_before_the_skin(self, path):
        build = skinned()
        build.json["nodes"][1]["scale"] = [2, 1, 1]
        target = build.accessor(np.array([(5, 0, 0)] * 4, np.float32))
        build.json["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": target}]
        build.json["meshes"][0]["weights"] = [1]
        assert box(read(build.write(path))[0]) == [[13, 0, 0], [15, 1, 0]]

    def test_a_mesh_that_is_shown_without_its_skin_too(self, path):
        build = skinned()
        build.scene(0, build.node(mesh=0, translation=[0, 0, 9]), build.node(mesh=0, skin=0))
        build.json["scene"] = 1
        placed = read_gltf(build.write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(3), moved(0, 0, 9), moved(3)]
        assert placed[0].mesh is placed[2].mesh is not placed[1].mesh

    def test_a_joint_without_weight_may_be_anything(self, path):
        build = skinned()
        joints = np.array([(0, 77, 78, 79)] * 4, np.uint8)
        build.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = build.accessor(joints)
        assert box(read(build.write(path))[0]) == moved(3)


class TestInstances:
    def build(self, **attributes) -> Build:
        build = Build()
        build.extension("EXT_mesh_gpu_instancing", required=True)
        held = {key: build.accessor(values, **more) for key, (values, more) in attributes.items()}
        extension = {"EXT_mesh_gpu_instancing": {"attributes": held}}
        return build.shown(translation=[0, 100, 0], extensions=extension)

    def test_places(self, path):
        places = np.array([(0, 0, 0), (3, 0, 0), (6, 0, 0)], np.float32)
        placed = read_gltf(self.build(TRANSLATION=(places, {})).write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(x, 100) for x in (0, 3, 6)]
        assert len({id(p.mesh) for p in placed}) == 1

    @pytest.mark.parametrize("dtype", ["f4", "i1", "i2"])
    def test_rotation_and_scale(self, dtype, path):
        """A quarter turn about Z; an integer's rounding makes no rotation longer or shorter."""
        whole = 1 if dtype == "f4" else np.iinfo(dtype).max
        turn = np.array([(0, 0, HALF * whole, HALF * whole)])
        turn = (turn if dtype == "f4" else np.round(turn)).astype(dtype)
        build = self.build(
            ROTATION=(turn, {} if dtype == "f4" else {"normalized": True}),
            SCALE=(np.array([(2, 3, 4)], np.float32), {}),
        )
        triangles, notes = read(build.write(path))
        assert np.allclose(box(triangles), [[-3, 100, 0], [0, 102, 0]], atol=1e-6) and not notes
        assert area(triangles) == pytest.approx(6, rel=1e-15)

    def test_instances_of_no_mesh_are_named(self, path):
        build = Build().shown()
        build.json["scenes"][0]["nodes"].append(
            build.node(name="Empty", extensions={"EXT_mesh_gpu_instancing": {"attributes": {}}})
        )
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1 and "without a mesh" in note and "node 1 'Empty'" in note


class TestBuffers:
    @pytest.mark.parametrize("kind", ["application/octet-stream", "application/gltf-buffer", ""])
    def test_a_data_uri(self, kind, tmp_path):
        text = Build().shown().with_data_uri().replace("data:;", f"data:{kind};")
        (tmp_path / "a.gltf").write_text(text)
        assert area(read(tmp_path / "a.gltf")[0]) == 1

    def test_a_data_uri_without_base64(self, tmp_path):
        build = Build().shown()
        uri = "data:," + quote(bytes(build.data))
        build.json["buffers"] = [{"byteLength": len(build.data), "uri": uri}]
        (tmp_path / "a.glb").write_bytes(glb(build.json, b""))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    @pytest.mark.parametrize("name", ["b.bin", "sub folder/größe%.bin", "./b.bin", "sub/../b.bin"])
    @pytest.mark.parametrize("encode", [True, False])
    def test_a_file_beside_it(self, name, encode, tmp_path):
        build = Build().shown()
        for folder in ("sub folder", "sub"):
            (tmp_path / folder).mkdir()
        (tmp_path / name).write_bytes(build.data + b"more than is needed")
        uri = quote(name) if encode else name.replace("%", "%25")
        build.json["buffers"] = [{"byteLength": len(build.data), "uri": uri}]
        (tmp_path / "a.glb").write_bytes(glb(build.json, b""))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    def test_a_chunk_and_a_file(self, tmp_path):
        build = Build().shown()
        (tmp_path / "b.bin").write_bytes(build.data)
        build.json["buffers"] = [
            {"byteLength": len(build.data)},
            {"byteLength": len(build.data), "uri": "b.bin"},
        ]
        build.json["bufferViews"][1]["buffer"] = 1
        (tmp_path / "a.glb").write_bytes(glb(build.json, bytes(build.data) + b"long"))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    def test_further_chunks_are_named(self, tmp_path):
        build = Build().shown()
        build.json["buffers"] = [{"byteLength": len(build.data)}]
        content = glb(build.json, bytes(build.data), (b"BIN\0", bytes(8)), (b"ABCD", bytes(4)))
        (tmp_path / "a.glb").write_bytes(content + b"tail")
        triangles, notes = read(tmp_path / "a.glb")
        assert area(triangles) == 1
        assert any("BIN, ABCD" in n for n in notes) and any("4 bytes follow" in n for n in notes)

    def test_the_content_says_which_of_the_two_it_is(self, tmp_path):
        Build().shown().write(tmp_path / "a.glb").rename(tmp_path / "b.gltf")
        Build().shown().write(tmp_path / "a.gltf").rename(tmp_path / "b.glb")
        assert area(read(tmp_path / "b.gltf")[0]) == area(read(tmp_path / "b.glb")[0]) == 1


class TestNotes:
    def test_animations_cameras_and_lights(self, path):
        build = Build().shown()
        for name in ("Walk", "Run", "Jump", "Sit"):
            build.add("animations", name=name, channels=[], samplers=[])
        build.add("cameras", type="perspective")
        build.extension("KHR_lights_punctual", required=True)
        build.json["extensions"] = {"KHR_lights_punctual": {"lights": [{}, {}]}}
        triangles, notes = read(build.write(path))
        assert area(triangles) == 1 and len(notes) == 3
        assert "Walk, Run, Jump and 1 more" in notes[0]
        assert "has 1" in notes[1] and "has 2" in notes[2]

    @pytest.mark.parametrize("listed", [True, False])
    def test_an_extension_that_nobody_knows(self, listed, path):
        build = Build().shown(extensions={"ACME_inflate": {"by": 3}})
        if listed:
            build.extension("ACME_inflate")
        (lacking,) = read_gltf(build.write(path)).missing
        assert "ACME_inflate" in lacking and "not known" in lacking

    @pytest.mark.parametrize(
        "name", ["KHR_texture_transform", "KHR_materials_unlit", "KHR_lights_punctual"]
    )
    def test_an_extension_that_leaves_the_shape_alone(self, name, path):
        build = Build().shown()
        build.extension(name, required=True)
        triangles, notes = read(build.write(path))
        assert area(triangles) == 1 and not notes

    def test_the_plain_data_beside_draco_s(self, path):
        build = Build().shown()
        build.extension("KHR_draco_mesh_compression")
        extension = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
        build.json["meshes"][0]["primitives"][0]["extensions"] = extension
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1
        assert "plain data" in note and "KHR_draco_mesh_compression" in note

    @pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
    def test_the_plain_data_beside_meshopt_s(self, name, path):
        build = Build().shown()
        build.extension(name)
        build.json["bufferViews"][0]["extensions"] = {name: {"buffer": 0, "byteLength": 4}}
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1 and "plain data" in note and name in note

    def test_a_version_that_2_0_is_enough_for(self, path):
        build = Build().shown()
        build.json["asset"] = {"version": "2.1", "minVersion": "2.0"}
        assert area(read(build.write(path))[0]) == 1

    def test_a_name_is_said_once(self, path):
        build = skinned((0.5, 0, 0, 0))
        mesh = build.json["meshes"][0]
        mesh["primitives"] += [{"mode": 0, "attributes": {"POSITION": 0}}] * 2
        notes = read(build.write(path))[1]
        assert len(notes) == 2 and all(note.count("mesh 0") == 1 for note in notes)

    def test_a_rotation_that_is_too_long(self, path):
        triangles, (note,) = read(Build().shown(rotation=[0, 0, 2, 0], name="N").write(path))
        assert box(triangles) == [[-1, -1, 0], [0, 0, 0]]
        assert "length 1" in note and "node 0 'N'" in note


def test_what_a_node_has_beside_its_matrix_is_named(tmp_path):
    matrix = np.eye(4).ravel().tolist()
    path = Build().shown(matrix=matrix, translation=[5, 0, 0]).write(tmp_path / "a.gltf")
    triangles, notes = read(path)
    assert box(triangles) == UNIT
    assert notes == (
        "Nodes have a matrix, and parts of one beside it, which are not used: node 0.",
    )
