"""What Blender applies of a file of meshes, in a process of its own: each feature in a small file.

The right area and place are worked out from the rules of the specification, by hand.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer import load_scene
from reference_tracer.blender.importing import bundled
from reference_tracer.cli.opening import SOURCES
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.scene import SceneError
from reference_tracer.tracer.vector import transform_points
from reference_tracer_meshes import FORMATS, by_blender
from reference_tracer_meshes.load import load_meshes

from ..meshes.gltf_build import SQUARE, UNIT, Build, box, moved, read, rich, skinned, sparse

sys.path.append(bundled())
from pxr import Usd, UsdGeom, UsdUtils  # Blender's own

NEAR = 1e-6  # of float32, in which Blender counts


def is_box(path, wanted):
    triangles, notes = read(path)
    assert np.allclose(box(triangles), wanted, atol=NEAR)
    return notes


def morphed() -> Build:
    """Two targets, one sparse, with weights beyond their sliders; the node's own come first."""
    build = Build().shown(weights=[3, -1])
    build.json["meshes"][0]["weights"] = [7, 7]
    corner = sparse(build, [0, 1, 2, 3], [(0, 1, 0)] * 4)
    zeros = {"componentType": 5126, "type": "VEC3", "count": 4}
    build.json["meshes"][0]["primitives"][0]["targets"] = [
        {"POSITION": build.accessor(np.array([(2, 0, 0)] * 4, np.float32))},
        {"POSITION": build.add("accessors", **zeros, sparse=corner)},
    ]
    return build


def quantised() -> Build:
    build = Build()
    build.extension("KHR_mesh_quantization", required=True)
    mesh = build.mesh(np.int16(SQUARE * 16384))
    build.json["accessors"][0]["normalized"] = True
    build.scene(build.node(mesh=mesh, scale=[2, 2, 2]))
    return build


def fan() -> Build:
    build = Build()
    build.scene(build.node(mesh=build.mesh(SQUARE, None, mode=6)))
    return build


def moving() -> Build:
    """Animated, and traced at rest."""
    build = skinned()
    times, places = np.float32([0, 1]), np.float32([(90, 0, 0), (99, 0, 0)])
    sampler = {"input": build.accessor(times), "output": build.accessor(places)}
    channel = {"sampler": 0, "target": {"node": 1, "path": "translation"}}
    build.add("animations", channels=[channel], samplers=[sampler])
    return build


FEATURES = {
    "a skin": (skinned(), moved(3)),
    "two joints": (skinned((0.75, 0.25, 0, 0)), moved(2.25, 2.5)),
    "a skin that moves": (moving(), moved(3)),
    "targets": (morphed(), moved(6, -1)),
    "integers": (quantised(), [[0, 0, 0], [2 * 16384 / 32767, 2 * 16384 / 32767, 0]]),
    "a fan": (fan(), UNIT),
}


@pytest.mark.parametrize(("build", "wanted"), FEATURES.values(), ids=FEATURES)
def test_what_blender_applies(build, wanted, tmp_path):
    notes = is_box(build.write(tmp_path / "a.glb"), wanted)
    assert all("Animations" in note for note in notes)


def test_instances_have_the_name_of_their_node(tmp_path):
    build = Build()
    build.extension("EXT_mesh_gpu_instancing", required=True)
    places = np.array([(0, 0, 0), (3, 0, 0), (6, 0, 0)], np.float32)
    held = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": build.accessor(places)}}}
    path = build.shown(name="a\x1b]0;b\x07", translation=[0, 9, 0], extensions=held).write(
        tmp_path / "a.glb"
    )
    placed = load_meshes(path, up="z").placed
    assert [p.object for p in placed] == ["a\x1b]0;b\x07"] * 3
    at = [transform_points(p.world_from_object, p.mesh.vertices.T).T.min(axis=0) for p in placed]
    assert sorted(map(list, at)) == [[0, 9, 0], [3, 9, 0], [6, 9, 0]]


def test_a_file_of_all_features_is_read(tmp_path):
    found = load_meshes(rich().write(tmp_path / "a.gltf"))
    assert len(found.placed) == 6 and found.missing == ()


@pytest.mark.parametrize(
    "change",
    [
        lambda b: b.json["skins"][0].update(joints=[0, 99]),
        lambda b: b.json["skins"][0].update(inverseBindMatrices=0),
        lambda b: b.json["accessors"][0].update(count=10**12),
        lambda b: b.extension("ACME_inflate", required=True),
    ],
)
def test_what_blender_cannot_import_is_refused_in_a_line(change, tmp_path):
    build = skinned()
    change(build)
    with pytest.raises(SceneError, match=r"a\.glb' cannot be read as a mesh: [^\n]{9,400}$"):
        load_meshes(build.write(tmp_path / "a.glb"))


def test_without_blender_it_is_said_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(by_blender, "find_spec", lambda name: None)
    path = skinned().write(tmp_path / "a.glb")
    with pytest.raises(MissingLibraryError, match=r"a\.glb'.*skins.*reference_tracer\[blender\]"):
        load_meshes(path)


QUAD = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def stage(path, up="Z", unit=1.0, scheme="none"):
    """A USD file with a quad of four metres, if its unit is one."""
    made = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(made, unit)
    UsdGeom.SetStageUpAxis(made, up)
    place = UsdGeom.Xform.Define(made, "/Place")
    UsdGeom.XformCommonAPI(place).SetTranslate((0, 0, 5))
    mesh = UsdGeom.Mesh.Define(made, "/Place/Shape")
    mesh.CreatePointsAttr(QUAD)
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateSubdivisionSchemeAttr(scheme)
    made.SetDefaultPrim(place.GetPrim())
    return made


@pytest.mark.parametrize("suffix", ["usd", "usda", "usdc", "usdz"])
def test_a_usd_file_is_read_whatever_holds_it(suffix, tmp_path):
    """In metres, with Z up: (x, y, z) of Y up is (x, -z, y)."""
    path = tmp_path / f"a.{suffix}"
    own = path if suffix != "usdz" else tmp_path / "in.usdc"
    stage(own, up="Y", unit=0.01).Save()
    if suffix == "usdz":
        UsdUtils.CreateNewUsdzPackage(str(own), str(path))
    found = load_meshes(path)
    (placed,) = found.placed
    points = transform_points(placed.world_from_object, placed.mesh.vertices.T)
    low, high = points.min(axis=1), points.max(axis=1)
    assert placed.object == "Place" and len(placed.mesh.triangles) == 2
    assert np.allclose([low, high], [(-0.01, -0.05, -0.01), (0.01, -0.05, 0.01)], atol=1e-7)


def test_what_a_usd_file_has_and_blender_does_not_show_is_named(tmp_path):
    made = stage(tmp_path / "a.usda", scheme="catmullClark")
    UsdGeom.NurbsPatch.Define(made, "/Patch")
    made.Save()
    said = " ".join(u.line() for u in load_meshes(tmp_path / "a.usda").unmodelled)
    assert "subdivision surface" in said and "NurbsPatch" in said


def test_a_usd_file_that_refers_to_others_is_refused(tmp_path):
    stage(tmp_path / "other.usda").Save()
    made = stage(tmp_path / "a.usda")
    made.OverridePrim("/More").GetReferences().AddReference("./other.usda")
    made.Save()
    with pytest.raises(SceneError, match=r"refers to other files, such as '\./other\.usda'"):
        load_meshes(tmp_path / "a.usda")


def test_a_package_of_several_layers_is_refused_as_one(tmp_path):
    stage(tmp_path / "other.usda").Save()
    made = stage(tmp_path / "in.usda")
    made.OverridePrim("/More").GetReferences().AddReference("./other.usda")
    made.Save()
    UsdUtils.CreateNewUsdzPackage(str(tmp_path / "in.usda"), str(tmp_path / "a.usdz"))
    with pytest.raises(SceneError, match=r"package of several USD files, such as '.*other\.usda'"):
        load_meshes(tmp_path / "a.usdz")


@pytest.mark.parametrize("content", [b"#usda 1.0\nover", b"PXR-USDC" + bytes(99), b"x" * 99])
def test_a_usd_file_that_is_damaged_is_refused(content, tmp_path):
    (tmp_path / "a.usd").write_bytes(content)
    with pytest.raises(SceneError, match=r"a\.usd' cannot be read as a mesh: "):
        load_meshes(tmp_path / "a.usd")


def test_the_process_that_imports_leaves_this_blender_as_it_is(tmp_path):
    """It is the command's own, too: what a user has open is not touched."""
    import bpy

    before = [*bpy.data.objects.keys()]
    stage(tmp_path / "a.usda").Save()
    load_meshes(tmp_path / "a.usda")
    assert [*bpy.data.objects.keys()] == before


def test_the_formats_that_are_named_are_those_that_are_read(tmp_path):
    """In --help, in the documents and to Python: each is read here."""
    square = trimesh.Trimesh(QUAD, [(0, 1, 2), (0, 2, 3)], process=False)
    stage(tmp_path / "in.usdc").Save()
    for suffix in FORMATS:
        path = tmp_path / f"a{suffix}"
        if suffix == ".usdz":
            UsdUtils.CreateNewUsdzPackage(str(tmp_path / "in.usdc"), str(path))
        elif suffix.startswith(".usd"):
            stage(path).Save()
        else:
            square.export(path)
        assert sum(len(p.mesh.triangles) for p in load_meshes(path).placed) == 2, suffix
    root = Path(__file__).parent.parent.parent
    documents = (root / "docs/commands.md").read_text("utf-8")
    line = next(line for line in documents.splitlines() if line.startswith("A scene is a .blend"))
    for text in (line.partition("#meshes")[2], SOURCES.partition("a mesh")[2]):
        assert re.findall(r"\.\w+", text) == [*FORMATS]
    assert re.findall(r"\.\w+", load_scene.__doc__.split("``")[0].partition("That is")[2]) == [
        *FORMATS
    ]
