"""Steps a scene to a frame: what is simulated and not baked needs the frames before it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import bpy
from bpy.types import Scene

_SIMULATED = {"CLOTH", "DYNAMIC_PAINT", "FLUID", "PARTICLE_SYSTEM", "SOFT_BODY"}  # modifiers
_ZONE = "GeometryNodeSimulationOutput"


def visited(scene: Scene, frames: Sequence[int]) -> Sequence[int]:
    """Return the frames to step through, in order, so that some sorted ones are as when played."""
    modifiers = (m.type in _SIMULATED for o in bpy.data.objects for m in o.modifiers)
    nodes = (n.bl_idname == _ZONE for tree in bpy.data.node_groups for n in tree.nodes)
    if frames and (any(modifiers) or any(nodes)):
        return range(min(scene.frame_start, frames[0]), frames[-1] + 1)
    return frames


def stepped(scene: Scene, frames: Sequence[int]) -> Iterator[int]:
    """Yield each of some sorted frames once the scene is there; it goes back in the end."""
    with frame_restored(scene):
        for frame in visited(scene, frames):
            scene.frame_set(frame)
            if frame in frames:
                yield frame


@contextmanager
def frame_restored(scene: Scene) -> Iterator[None]:
    """Put a scene back to its frame in the end."""
    own = scene.frame_current, scene.frame_subframe
    try:
        yield
    finally:
        scene.frame_set(own[0], subframe=own[1])


def bake_bodies(scene: Scene, last: int) -> None:
    """Bake rigid bodies up to a frame: a copy of the scene has them only so.

    Only for a command's own process, which never saves the file.
    """
    if (bodies := scene.rigidbody_world) and bodies.enabled:
        cache = bodies.point_cache
        if not (cache.is_baked or cache.use_disk_cache):  # that would write beside the file
            cache.frame_end = min(cache.frame_end, max(last, cache.frame_start + 1))
            with bpy.context.temp_override(scene=scene, point_cache=cache):
                bpy.ops.ptcache.bake(bake=True)
