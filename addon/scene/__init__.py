"""The contract between Blender (or a file) and the tracer: plain arrays in frozen dataclasses.

A `Scene` checks its input, so that nothing after this file has to ask whether an index is in range
or a vertex is finite.
World space is Blender's: metres, Z up. Camera space: -Z forward, +Y up.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from copy import copy
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import Array as Array
from ..arrays import Bools as Bools
from ..arrays import Colors, Floats, Integers, Places
from ..arrays import Index as Index
from ..projections import PERSPECTIVE as PERSPECTIVE
from ..projections import PROJECTIONS as PROJECTIONS
from ..projections import Projection as Projection
from .camera import Camera as Camera
from .camera import Region as Region
from .camera import ViewWindow as ViewWindow
from .camera import check_size as check_size
from .checks import SceneError as SceneError
from .checks import colors, store
from .checks import finite as finite
from .checks import indices as indices
from .checks import shaped as shaped
from .mesh import GREY as GREY
from .mesh import Instance as Instance
from .mesh import Mesh as Mesh
from .mesh import Plane as Plane
from .mesh import drop_non_finite as drop_non_finite


@dataclass(frozen=True, eq=False)
class Scene:
    """The tracer's input.

    `objects` are names, by the `object` index of instances and planes. Some may have neither: they
    are there, but outside the view.
    """

    camera: Camera
    meshes: tuple[Mesh, ...] = ()
    instances: tuple[Instance, ...] = ()  # of surfaces exactly as near, the lower index is seen
    planes: tuple[Plane, ...] = ()
    # Linear RGBA of a pixel that sees nothing, (4,); alpha 0 for a transparent film.
    background: Colors = field(default_factory=lambda: np.zeros(4, np.float32))
    objects: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("meshes", "instances", "planes", "objects"):
            store(self, name, tuple(getattr(self, name)))
        store(self, "background", colors([self.background], "background")[0])
        for i in self.instances:
            if not 0 <= i.mesh < len(self.meshes):
                raise SceneError(f"An instance names mesh {i.mesh} of {len(self.meshes)}.")
        every: tuple[Instance | Plane, ...] = (*self.instances, *self.planes)
        for shown in every:
            if not 0 <= shown.object < len(self.objects):
                what = "infinite plane" if isinstance(shown, Plane) else "instance"
                raise SceneError(f"An {what} names object {shown.object} of {len(self.objects)}.")

    def with_meshes(self, others: Mapping[int, Mesh]) -> Scene:
        """Return the same with other meshes of some instances, which may share one, by number."""
        new = {id(mesh): mesh for mesh in others.values()}
        number = {key: k for k, key in enumerate(new, len(self.meshes))}
        instances = tuple(
            replace(i, mesh=number[id(others[n])]) if n in others else i
            for n, i in enumerate(self.instances)
        )
        return replace(self, meshes=(*self.meshes, *new.values()), instances=instances)

    def seen_by(self, camera: Camera) -> Scene:
        """Return the same scene with another camera; what is known of it stays known."""
        other = copy(self)
        store(other, "camera", camera)
        return other

    @cached_property
    def instance_meshes(self) -> Places:
        """The mesh of each instance, (k,)."""
        return np.array([i.mesh for i in self.instances], np.intp)

    @cached_property
    def instance_bounds(self) -> Floats:
        """Lowest and highest coordinates of each instance in its object's space, (2, 3, k)."""
        bounds = np.array([mesh.bounds for mesh in self.meshes]).reshape(-1, 2, 3)
        return bounds[self.instance_meshes].transpose(1, 2, 0)

    @cached_property
    def instance_objects(self) -> Integers:
        """The object of each instance and plane, and -1 at the end, for nothing: (k + 1,)."""
        of_instances = [i.object for i in self.instances]
        return np.array([*of_instances, *(p.object for p in self.planes), -1], np.int32)

    @cached_property
    def instance_matrices(self) -> Floats:
        """world_from_object of every instance, (4, 4, k)."""
        matrices = [i.world_from_object for i in self.instances]
        return np.stack(matrices, axis=-1) if matrices else np.zeros((4, 4, 0))

    @cached_property
    def color_table(self) -> Colors:
        """The colours of all instances below one another, of the planes, and the background.

        (r, 4) linear RGBA; those of surfaces are opaque.
        """
        surfaces = [i.colors for i in self.instances] + [p.color[None] for p in self.planes]
        table = np.concatenate([*surfaces, self.background[None]])
        table[:-1, 3] = 1
        return table

    @cached_property
    def color_rows(self) -> Integers:
        """First and last row in `color_table`, (2, k + 1): of instances, planes, and nothing."""
        counts = np.array([*(len(i.colors) for i in self.instances), *(1,) * len(self.planes), 1])
        ends = np.cumsum(counts)
        return np.stack((ends - counts, ends - 1)).astype(np.int32)

    @property
    def triangle_count(self) -> int:
        """Triangles over all instances."""
        return sum(len(self.meshes[i.mesh].triangles) for i in self.instances)


def without(scene: Scene, names: Collection[str]) -> Scene:
    """Return a scene without some objects."""
    numbers = {n for n, name in enumerate(scene.objects) if name in names}
    return replace(
        scene,
        instances=tuple(i for i in scene.instances if i.object not in numbers),
        planes=tuple(p for p in scene.planes if p.object not in numbers),
    )


def alike(first: Any, second: Any) -> bool:
    """Return whether two scenes, or parts of them, hold the same, but for memory."""
    if first is second or type(first) is not type(second):
        return first is second
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(alike, first, second))
    if is_dataclass(first):
        return all(alike(getattr(first, f.name), getattr(second, f.name)) for f in fields(first))
    return np.array_equal(first, second)  # also of two numbers or texts
