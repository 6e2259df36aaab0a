"""Has Blender import a file of meshes, and writes what it shows of it as a scene.

It is run as a process of its own, in whose empty scene nothing of the user's is changed:
`python -m reference_tracer.blender.importing MESHES SCENE.npz`.
"""

from __future__ import annotations

import math
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy

from ..files.scenes import save_scene
from ..manifest import Effect, Unmodelled
from ..scene import SceneError
from ..wording import count_of
from . import registration
from .reading.export import export
from .temporary import everything

# Objects that Blender's importer makes of a USD file, by the name of the prim's type.
_IMPORTED = frozenset(
    "BasisCurves Capsule Cone Cube Cylinder Mesh NurbsCurves Points Sphere Volume".split()
)


def main(path: str, out: str) -> None:
    """Import a file, and write its scene."""
    registration.register()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    missing: list[str] = []
    notes: list[str] = []
    if path.endswith((".gltf", ".glb")):
        _run(bpy.ops.import_scene.gltf, path, _GLTF)
    else:
        first = _look_into(path, missing, notes)
        scene.frame_set(math.floor(first), subframe=first % 1)
        _run(bpy.ops.wm.usd_import, path, _USD)
        _take_names_of_places()
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    with everything(scene):
        traced, manifest = export(bpy.context.evaluated_depsgraph_get())
    lacks = [Unmodelled("the file", said, effect=Effect.UNPLACED) for said in missing]
    account = (*manifest.unmodelled, *lacks)
    save_scene(out, traced, replace(manifest, unmodelled=account, notes=tuple(notes)))


_GLTF = {
    "merge_vertices": False,
    "import_pack_images": False,
    "disable_bone_shape": True,
    "guess_original_bind_pose": False,
}
_USD = {
    "set_frame_range": False,
    "import_cameras": False,
    "import_lights": False,
    "import_materials": False,
    "create_world_material": False,
    "merge_parent_xform": False,
    "import_guide": False,
    "import_proxy": False,
    "import_textures_mode": "IMPORT_NONE",
    "property_import_mode": "NONE",
}


def _run(operator: Any, path: str, options: dict[str, Any]) -> None:
    """Import a file, with those of the options that this Blender has."""
    known = operator.get_rna_type().properties
    own = {name: value for name, value in options.items() if name in known}
    if operator(filepath=path, **own) != {"FINISHED"}:
        raise SceneError("Blender cannot import it: export it again")


def _take_names_of_places() -> None:
    """Give each object the name of the transform above it, where it is alone there.

    Exporters write an object as a transform, and its mesh, which others may share, below it.
    """
    for place in [obj for obj in bpy.data.objects if obj.type == "EMPTY"]:
        below = [child for child in place.children if child.type != "EMPTY"]
        if len(below) == 1:
            name, place.name = place.name, f"above {place.name}"
            below[0].name = name


def bundled() -> str:
    """Return the folder of the modules that Blender brings along, USD's among them."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    return str(Path(bpy.utils.resource_path("LOCAL"), "python", "lib", version, "site-packages"))


def _look_into(path: str, missing: list[str], notes: list[str]) -> float:
    """Find out what a USD file has that Blender does not show; return its first time."""
    sys.path.append(bundled())
    from pxr import Sdf, Tf, Usd, UsdGeom

    try:
        layer = Sdf.Layer.FindOrOpen(path)
    except Tf.ErrorException as error:
        raise SceneError("it is cut off or damaged: export it again") from error
    if layer is None:
        raise SceneError("it is no USD file, or a damaged one: export it again")
    if others := sorted(filter(None, map(str, layer.GetCompositionAssetDependencies()))):
        is_package = path.endswith(".usdz")
        what = "is a package of several USD files" if is_package else "refers to other files"
        raise SceneError(f"it {what}, such as '{others[0]}': export it as one file")
    stage = Usd.Stage.Open(layer)
    if not 0 < UsdGeom.GetStageMetersPerUnit(stage) < math.inf:
        raise SceneError("its metersPerUnit must be above 0")
    left: Counter[str] = Counter()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.HasAuthoredMetadata("clips"):  # values in other files, read when asked for
            say = f"the values of '{prim.GetName()}' are in other files"
            raise SceneError(f"{say}: export it as one file")
        left.update(_lacks(prim, UsdGeom))
    missing += [f"{count_of(n, what)}" for what, n in sorted(left.items())]
    if stage.HasAuthoredTimeCodeRange():
        notes.append("what moves, or is hidden, in time is read at the file's first time")
        return float(stage.GetStartTimeCode())
    return 1.0


def _lacks(prim: Any, geom: Any) -> Iterator[str]:
    """Yield what Blender does not show of a prim, in words that can be counted."""
    kind = str(prim.GetTypeName())
    if prim.IsA(geom.Gprim) and kind not in _IMPORTED:
        yield f"prim of the type {kind} that is not read"
    if kind == "Mesh":
        if geom.Mesh(prim).GetSubdivisionSchemeAttr().Get() != geom.Tokens.none:
            yield "subdivision surface (its cage is read)"


if __name__ == "__main__":
    main(*sys.argv[1:])
