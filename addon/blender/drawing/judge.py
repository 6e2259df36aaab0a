"""Defines the record of a judge: an engine of Blender's that the traced picture is compared with.

Nothing here imports bpy or numpy: the command line reads the records where there is no Blender.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...scene import Scene


@dataclass(frozen=True)
class Judge:
    """One of Blender's engines, and what a comparison has to know of it.

    Raises
    ------
    ValueError
        If the record contradicts itself.
    """

    name: str  # in options, folders and JSON; in capitals, in a script and in a .blend
    label: str  # in the interface
    description: str = ""  # a tooltip; only one that a user can choose needs it
    # A .blend stores it: never given to another judge. Without a number, only Automatic chooses
    # this judge.
    number: int | None = None
    engine: str | None = None  # Blender's name of it; None: the drawing of the viewport
    # Features that it does not show like for like: they explain none of its pixels.
    ignores: tuple[str, ...] = ()
    # Of a temporary scene, like for like, by their paths.
    settings: tuple[tuple[str, Any], ...] = ()
    # Sets such a scene and its evaluation up to be drawn in constant colours, if more than its
    # settings is to be set: of those with materials, by default, one material for all of it.
    set_up: Callable[[Any, Any], AbstractContextManager[None]] | None = None
    # Pixels: how far its samples may lie from a pixel's centre, like for like.
    sample_radius: float = 0.0
    # Metres: Embree draws, which takes triangles with a coordinate beyond for invalid; else inf.
    farthest: float = math.inf
    traces_rays: bool = False  # a rasteriser rounds the corners of triangles, a ray tracer does not
    solid: bool = True  # drawn by the scene's solid shading; others have materials and light
    known: bool = True  # how it samples and rounds: else its picture is compared as anybody's
    # Refuses meshes whose colours of a type it cannot draw, beside those that no material shows,
    # given the view layer's objects; raises SceneError.
    check_colors: Callable[[Scene, str, Collection[Any]], None] | None = None

    def __post_init__(self) -> None:
        problem = ""
        if not 0 <= self.sample_radius < 0.5:
            problem = "its samples must lie within their pixel: sample_radius from 0 to below 0.5"
        elif self.number is not None and not self.description:
            problem = "one that a user can choose needs a description"
        elif self.needs_window and self.traces_rays:
            problem = "the drawing of the viewport traces no rays"
        if problem:
            raise ValueError(f"judge '{self.name}': {problem}")

    @property
    def needs_window(self) -> bool:
        """Whether it draws only where Blender has a window."""
        return self.engine is None

    def check_random(self, scene: Scene, owners: Sequence[str]) -> None:
        """Refuse random colours of instances, if this judge cannot draw them.

        The viewport gives an instance the colour of its own object's name. A judge with materials
        would give it that of the object that instances it.

        Parameters
        ----------
        scene : Scene
        owners : sequence of str
            For each instance, the object that instances it.

        Raises
        ------
        SceneError
            If an instance would have another colour.
        """
        from ...scene import SceneError

        for instance, owner in zip(scene.instances, owners, strict=False):
            if not self.solid and scene.objects[instance.object] != owner:
                raise SceneError(
                    f"{self.label} cannot draw the viewport's random colours of instances, as of "
                    f"'{owner}': set the colour of the scene's solid shading to material or "
                    "object, or compare with Workbench."
                )
