"""USD: what Pixar's own library writes is read, and what is not read is named.

`tests/blender/exporters.py` has Blender write twenty scenes, too.
"""

from __future__ import annotations

import sys

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom
from reference_tracer.mesh_files.load import load_meshes
from reference_tracer.scene import SceneError

SQUARE = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]


@pytest.fixture
def stage(tmp_path):
    made = Usd.Stage.CreateNew(str(tmp_path / "a.usda"))
    UsdGeom.SetStageUpAxis(made, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(made, 1.0)
    return made


def mesh(stage, path, points=SQUARE, counts=(4,), indices=(0, 1, 2, 3)):
    out = UsdGeom.Mesh.Define(stage, path)
    out.CreatePointsAttr(list(points))
    out.CreateFaceVertexCountsAttr(list(counts))
    out.CreateFaceVertexIndicesAttr(list(indices))
    out.CreateSubdivisionSchemeAttr("none")
    return out


@pytest.fixture
def read(stage, tmp_path):
    def run(suffix="usda", up=None):
        path = tmp_path / f"b.{suffix}"
        stage.GetRootLayer().Export(str(path))
        return load_meshes(path, up)

    return run


def corners(placed):
    """Return the triangles in the world, (n, 3, 3)."""
    m = placed.world_from_object
    return placed.mesh.vertices[placed.mesh.triangles] @ m[:3, :3].T + m[:3, 3]


@pytest.mark.parametrize("suffix", ["usd", "usda", "usdc"])
def test_meshes_in_their_places(stage, read, suffix):
    above = UsdGeom.Xform.Define(stage, "/World/Table")
    above.AddTranslateOp().Set(Gf.Vec3d(1, 2, 3))
    above.AddScaleOp().Set(Gf.Vec3f(2, 1, 1))
    mesh(stage, "/World/Table/Mesh_001")
    found = read(suffix)
    [placed] = found.placed
    assert placed.object == "Table" and not found.notes and not found.missing
    wanted = np.array(SQUARE)[[[0, 1, 2], [0, 2, 3]]] * (2, 1, 1) + (1, 2, 3)
    assert np.array_equal(corners(placed), wanted)


def test_the_file_says_which_axis_is_up_and_its_unit(stage, read):
    mesh(stage, "/A", [(1, 2, 3), (4, 2, 3), (1, 5, 3)], (3,), (0, 1, 2))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    found = read()
    assert np.allclose(corners(found.placed[0])[0, 0], (0.01, -0.03, 0.02), atol=1e-12)
    assert found.notes == ("its unit is 0.01 m, and it is scaled to metres",)
    assert np.allclose(corners(read(up="z").placed[0])[0, 0], (0.01, 0.02, 0.03), atol=1e-12)


def test_the_side_of_left_handed_meshes(stage, read):
    mesh(stage, "/A").CreateOrientationAttr("leftHanded")
    [placed] = read().placed
    a, b, c = corners(placed)[0]
    assert np.cross(b - a, c - a)[2] < 0


def test_holes_invisible_meshes_and_guides_are_no_surfaces(stage, read):
    two = (*SQUARE, (5, 0, 0), (6, 0, 0), (5, 1, 0))
    mesh(stage, "/A", two, (4, 3), (0, 1, 2, 3, 4, 5, 6)).CreateHoleIndicesAttr([1])
    UsdGeom.Imageable(mesh(stage, "/B")).MakeInvisible()
    mesh(stage, "/C").CreatePurposeAttr("guide")
    mesh(stage, "/D").CreatePurposeAttr("proxy")
    mesh(stage, "/E").CreatePurposeAttr("render")
    found = read()
    assert [(p.object, len(p.mesh.triangles)) for p in found.placed] == [("A", 2), ("E", 2)]
    assert not found.missing


def test_instances_share_their_mesh(stage, read):
    stage.CreateClassPrim("/Prototype")  # a class is no surface itself
    mesh(stage, "/Prototype/Mesh")
    for number in range(2):
        one = UsdGeom.Xform.Define(stage, f"/Copy{number}")
        one.AddTranslateOp().Set(Gf.Vec3d(number, 0, 5))
        one.GetPrim().GetReferences().AddInternalReference("/Prototype")
        one.GetPrim().SetInstanceable(True)
    found = read().placed
    assert [p.object for p in found] == ["Copy0", "Copy1"] and found[0].mesh is found[1].mesh
    assert [float(corners(p)[0, 0, 0]) for p in found] == [0, 1]


def test_what_is_not_read_is_named(stage, read):
    mesh(stage, "/A").CreateSubdivisionSchemeAttr("catmullClark")
    mesh(stage, "/B").GetPrim().ApplyAPI("SkelBindingAPI")
    moving = mesh(stage, "/C").GetPointsAttr()
    moving.Set(SQUARE, 1)
    moving.Set([(0, 0, 9), *SQUARE[1:]], 2)
    UsdGeom.Sphere.Define(stage, "/D")
    found = read()
    assert found.missing == (
        "1 prim of the type Sphere, not read",
        "1 skinned surface read at rest",
        "1 subdivision surface of which the cage is read",
    )
    assert found.notes == ("1 surface moved or hidden in time, read at the first time",)
    assert corners(found.placed[2])[0, 0, 2] == 0


def test_no_other_file_is_followed(stage, read, tmp_path):
    mesh(stage, "/A")
    for kind in (Sdf.Reference, Sdf.Payload):
        prim = stage.DefinePrim("/B")
        arcs = prim.GetReferences() if kind is Sdf.Reference else prim.GetPayloads()
        own = kind("./secret.usda")
        (arcs.AddReference if kind is Sdf.Reference else arcs.AddPayload)(own)
        with pytest.raises(SceneError, match=r"refers to other files, such as '\./secret\.usda'"):
            read()
        stage.RemovePrim("/B")
    assert read().placed
    clips = {"default": {"assetPaths": [Sdf.AssetPath("./secret.usda")], "primPath": "/A"}}
    stage.GetPrimAtPath("/A").SetMetadata("clips", clips)
    with pytest.raises(SceneError, match="the values of 'A' are in other files"):
        read()


@pytest.mark.parametrize(
    "content", [b"", b"#usda 1.0\ndef Mesh {", b"PXR-USDC" + bytes(80), b"none"]
)
@pytest.mark.parametrize("suffix", ["usda", "usdc", "usdz"])
def test_damaged_files_are_refused_in_one_line(content, suffix, tmp_path):
    (tmp_path / f"a.{suffix}").write_bytes(content)
    with pytest.raises(SceneError) as refused:
        load_meshes(tmp_path / f"a.{suffix}")
    assert "\n" not in str(refused.value).strip()


def test_faces_that_contradict_their_corners_are_refused(stage, read):
    mesh(stage, "/A", SQUARE, (4, 3))
    with pytest.raises(SceneError, match="'A' has 4 corners, and faces of 7"):
        read()


def test_without_the_library_it_is_said_what_to_install(stage, read, monkeypatch):
    mesh(stage, "/A")
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(SceneError, match=r'pip install "reference_tracer\[usd\]"'):
        read()


def test_what_a_point_instancer_repeats_is_not_shown_in_its_own_place(stage, read):
    mesh(stage, "/Floor")
    trees = UsdGeom.PointInstancer.Define(stage, "/Trees")
    mesh(stage, "/Trees/Prototypes/Tree")
    trees.CreatePrototypesRel().SetTargets(["/Trees/Prototypes/Tree"])
    found = read()
    assert [placed.object for placed in found.placed] == ["Floor"]
    assert found.missing == ("1 prim of the type PointInstancer, not read",)


@pytest.mark.parametrize("unit", [0.0, -1.0, np.nan, np.inf])
def test_a_unit_must_be_a_length(stage, read, unit):
    mesh(stage, "/A")
    stage.SetMetadata("metersPerUnit", unit)
    with pytest.raises(SceneError, match="metersPerUnit"):
        read()


def test_what_moves_or_is_hidden_in_time_is_named(stage, read):
    above = UsdGeom.Xform.Define(stage, "/Moved")
    moved = above.AddTranslateOp()
    for time in (1, 9):
        moved.Set(Gf.Vec3d(time, 0, 0), time)
    mesh(stage, "/Moved/Mesh")
    hidden = mesh(stage, "/Hidden").CreateVisibilityAttr()
    hidden.Set("invisible", 1)
    hidden.Set("inherited", 9)
    mesh(stage, "/Still")
    found = read()
    assert [placed.object for placed in found.placed] == ["Moved", "Still"]
    assert found.notes == ("2 surfaces moved or hidden in time, read at the first time",)
