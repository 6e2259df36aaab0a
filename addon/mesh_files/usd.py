"""Reads the meshes of a USD file, by Pixar's own library: the extra `usd`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ..arrays import Array
from ..exr import MissingLibraryError
from ..scene import Mesh, SceneError
from ..wording import count_of
from .contents import Contents, Placed
from .meshes import contents

_SHOWN = ("default", "render")  # purposes: what is a guide or a proxy is not rendered


def read_usd(path: Path) -> Contents:
    """Read the meshes of a .usd, .usda, .usdc or .usdz, each in its place at the file's first time.

    An object's name is that of the transform above its only mesh, as exporters write it, else the
    mesh' own. What is invisible, a guide or a proxy is left out; nothing of another file is read.

    Raises
    ------
    MissingLibraryError
        If usd-core is not installed.
    SceneError, ValueError
        If it cannot be read, refers to other files, or a mesh contradicts itself.
    """
    usd = _library()
    try:
        layer = usd.Sdf.Layer.FindOrOpen(str(path))
    except usd.Tf.ErrorException as error:
        raise SceneError("it is cut off or damaged: export it again") from error
    if layer is None:
        raise SceneError("it is no USD file, or a damaged one: export it again")
    if others := sorted(filter(None, map(str, layer.GetCompositionAssetDependencies()))):
        raise SceneError(f"it refers to other files, such as '{others[0]}': export it as one file")
    return _Reading(usd, usd.Usd.Stage.Open(layer)).read()


def _library() -> Any:
    try:
        import pxr
        from pxr import Sdf, Tf, Usd, UsdGeom  # noqa: F401
    except ImportError:
        raise MissingLibraryError(
            'USD files take the library usd-core: pip install "reference_tracer[usd]"'
        ) from None
    module: ModuleType = pxr
    return module


class _Reading:
    """What a stage has shown so far."""

    def __init__(self, usd: Any, stage: Any) -> None:
        self.usd = usd
        self.stage = stage
        self.time = usd.Usd.TimeCode.EarliestTime()
        self.places = usd.UsdGeom.XformCache(self.time)
        self.scale = float(usd.UsdGeom.GetStageMetersPerUnit(stage))
        if not 0 < self.scale < np.inf:
            raise SceneError(f"its metersPerUnit is {self.scale:g}, which must be above 0")
        self.meshes: dict[Any, Contents] = {}  # by the prim, or by that of its prototype
        self.left: Counter[tuple[str, str]] = Counter()
        self.animated = 0

    def read(self) -> Contents:
        """Return the meshes that are shown, in the file's own axes."""
        placed = tuple(self._placed())
        cut = list(self.meshes.values())
        notes = [note for one in cut for note in one.notes]
        if self.scale != 1:
            notes.append(f"its unit is {self.scale:.6g} m, and it is scaled to metres")
        if self.animated:
            notes.append(
                f"{count_of(self.animated, 'surface')} moved or hidden in time, read at the first "
                "time"
            )
        missing = [said for one in cut for said in one.missing]
        missing += [f"{count_of(n, what)} {how}" for (what, how), n in sorted(self.left.items())]
        up = str(self.usd.UsdGeom.GetStageUpAxis(self.stage)).lower()
        return Contents(placed, tuple(notes), tuple(missing), up)

    def _placed(self) -> Iterator[Placed]:
        geom, every = self.usd.UsdGeom, self.usd.Usd.TraverseInstanceProxies()
        prims = iter(self.usd.Usd.PrimRange(self.stage.GetPseudoRoot(), every))
        for prim in prims:
            if prim.HasAuthoredMetadata("clips"):  # values in other files, read when asked for
                say = f"the values of '{prim.GetName()}' are in other files"
                raise SceneError(f"{say}: export it as one file")
            if prim.IsA(geom.PointInstancer):  # what it repeats is not shown in its own place
                prims.PruneChildren()
            if not prim.IsA(geom.Boundable):
                continue
            self.animated += prim.IsA(geom.Mesh) and self._is_animated(prim)
            if not self._is_shown(geom.Imageable(prim)):
                continue
            if prim.IsA(geom.Mesh):
                matrix = np.array(self.places.GetLocalToWorldTransform(prim), np.float64).T
                matrix[:3] *= self.scale
                name = self._name(prim)
                yield from (Placed(p.mesh, matrix, name) for p in self._mesh(prim, name).placed)
            elif prim.IsA(geom.Gprim) or prim.IsA(geom.PointInstancer):
                self.left["prim", f"of the type {prim.GetTypeName()}, not read"] += 1

    def _is_shown(self, prim: Any) -> bool:
        visible = prim.ComputeVisibility(self.time) != self.usd.UsdGeom.Tokens.invisible
        return visible and prim.ComputePurpose() in _SHOWN

    def _is_animated(self, prim: Any) -> bool:
        """Return whether a mesh, or what it is below, may move or be hidden at another time."""
        geom = self.usd.UsdGeom
        moving = bool(geom.Mesh(prim).GetPointsAttr().ValueMightBeTimeVarying())
        while prim and not moving:
            place, seen = geom.Xformable(prim), geom.Imageable(prim)
            moving = bool(place) and place.TransformMightBeTimeVarying()
            moving |= bool(seen) and seen.GetVisibilityAttr().ValueMightBeTimeVarying()
            prim = prim.GetParent()
        return moving

    def _name(self, prim: Any) -> str:
        above = prim.GetParent()
        every = above.GetFilteredChildren(self.usd.Usd.TraverseInstanceProxies())
        own = [child for child in every if child.IsA(self.usd.UsdGeom.Mesh)]
        alone = not above.IsPseudoRoot() and above.IsA(self.usd.UsdGeom.Xform) and len(own) == 1
        return str((above if alone else prim).GetName())

    def _mesh(self, prim: Any, name: str) -> Contents:
        """Return a prim's mesh, the same for all instances of a prototype."""
        own = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
        if own.GetPath() not in self.meshes:
            self.meshes[own.GetPath()] = self._cut(self.usd.UsdGeom.Mesh(own), name)
        return self.meshes[own.GetPath()]

    def _cut(self, mesh: Any, name: str) -> Contents:
        def array(attribute: Any, dtype: type) -> Array:
            held = attribute.Get(self.time)
            return np.array([] if held is None else held, dtype)

        points = array(mesh.GetPointsAttr(), np.float32).reshape(-1, 3)
        sizes = array(mesh.GetFaceVertexCountsAttr(), np.intp)
        corners = array(mesh.GetFaceVertexIndicesAttr(), np.intp)
        if sizes.sum() != len(corners) or (sizes < 0).any():
            raise SceneError(f"'{name}' has {len(corners)} corners, and faces of {sizes.sum()}")
        solid = ~np.isin(np.arange(len(sizes)), array(mesh.GetHoleIndicesAttr(), np.intp))
        corners = corners[np.repeat(solid, sizes)]
        if "SkelBindingAPI" in mesh.GetPrim().GetAppliedSchemas():
            self.left["skinned surface", "read at rest"] += 1
        if mesh.GetSubdivisionSchemeAttr().Get() != self.usd.UsdGeom.Tokens.none:
            self.left["subdivision surface", "of which the cage is read"] += 1
        found = contents(points, corners, sizes[solid], [name])
        if mesh.GetOrientationAttr().Get() == self.usd.UsdGeom.Tokens.leftHanded:
            turned = (p._replace(mesh=_turned_over(p.mesh)) for p in found.placed)
            found = Contents(tuple(turned), found.notes, found.missing)
        return found


def _turned_over(mesh: Mesh) -> Mesh:
    return Mesh(mesh.vertices, mesh.triangles[:, ::-1], name=mesh.name)
