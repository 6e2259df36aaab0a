"""From one frame of a scene to another: what is simulated and not baked needs those between."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import bpy

_SIMULATED = {"CLOTH", "DYNAMIC_PAINT", "FLUID", "PARTICLE_SYSTEM", "SOFT_BODY"}  # modifiers
_ZONE = "GeometryNodeSimulationOutput"


def visited(scene: Any, frames: list[int]) -> Iterable[int]:
    """Return the frames to step through, in order, for some that are sorted to be as played."""
    modifiers = (m.type in _SIMULATED for o in bpy.data.objects for m in o.modifiers)
    nodes = (n.bl_idname == _ZONE for tree in bpy.data.node_groups for n in tree.nodes)
    if frames and (any(modifiers) or any(nodes)):
        return range(min(scene.frame_start, frames[0]), frames[-1] + 1)
    return frames
