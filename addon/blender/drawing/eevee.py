"""EEVEE as a judge: it shows constant colours, with one sample in each pixel's centre.

EEVEE spreads its samples over its filter, which is a disk where it is narrow: of width 0, it is the
pixel's centre. Measured as `rasteriser.py` does, in rows and in columns, in 5.2: edges are where
Workbench has them, rounded to 1/256 pixel. In 4.3 it takes no override of materials: what is drawn
first says so.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any

from .judge import Judge

if TYPE_CHECKING:
    from bpy.types import Mesh, Object

    from ...scene import Scene


def _check_colors(scene: Scene, color_type: str, objects: Collection[Any]) -> None:
    """Refuse meshes that EEVEE shows in other colours than the solid viewport."""
    if color_type == "VERTEX":
        _check_attributes(scene, objects)
    elif color_type == "MATERIAL":
        _check_edited(scene)


def _check_edited(scene: Scene) -> None:
    """Refuse a mesh that is drawn as it is edited: EEVEE gives all its faces one material."""
    import bpy

    from ...scene import SceneError

    for name in scene.objects:
        obj: Object = bpy.data.objects.get(name)
        if obj is None or obj.mode != "EDIT" or len(obj.material_slots) < 2:
            continue
        if not any(m.show_viewport and m.show_in_editmode for m in obj.modifiers):
            raise SceneError(
                f"EEVEE shows '{name}', which is in Edit Mode, in one material: leave Edit Mode, "
                "set Colors to Object, or compare with Workbench or Cycles."
            )


def _check_attributes(scene: Scene, objects: Collection[Any]) -> None:
    """Refuse meshes that lack a colour attribute that the colours use: EEVEE shows them black.

    So it does what stands for infinite planes.
    """
    import bpy

    from ...scene import SceneError
    from .constant_material import attribute_names

    asked = attribute_names(objects)
    data: Any = {o.name_full: o.data for o in bpy.data.objects}
    found: list[set[str]] = [set() for _ in scene.planes]
    for instance in scene.instances:
        mesh: Mesh = data.get(scene.objects[instance.object])
        has_one = scene.meshes[instance.mesh].corner_colors is not None
        attributes = getattr(mesh, "color_attributes", None) if has_one else None
        found.append({attributes.active_color_name} if attributes else set())
    for own in found:
        if asked - own:
            raise SceneError(
                "EEVEE shows a mesh black that lacks the colour attribute of another: set Colors "
                "to Object, or compare with Workbench or Cycles."
            )


EEVEE = Judge(
    name="eevee",
    label="EEVEE",
    description="An EEVEE render of the same constant colours, one sample in each pixel's centre",
    number=3,
    engine="BLENDER_EEVEE",
    ignores=("display type", "transparency", "texture", "in-front drawing"),
    settings=(("eevee.taa_render_samples", 1), ("render.filter_size", 0.0)),
    check_colors=_check_colors,
    solid=False,
)
