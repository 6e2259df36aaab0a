"""Blender's engines as judges of the traced picture: one record each.

To add one, give it a record here and, if a scene has to be set up for it, a function in a module of
its own. The command line reads the records where there is no Blender: nothing here imports bpy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

from ..scene import Scene, SceneError

AUTO = "AUTO"  # the viewport in a window, Workbench in background


@dataclass(frozen=True)
class Judge:
    """One of Blender's engines."""

    name: str  # in options, folders and JSON; in capitals, in a script
    label: str  # in the interface, as the description
    description: str
    # Which a .blend stores: one that was given away is never given to another. None where only AUTO
    # chooses it.
    number: int | None
    engine: str | None  # Blender's name of it; None for the drawing of the viewport
    ignores: frozenset[str]  # features not drawn like for like: they explain none of its pixels
    # Sets a temporary scene and a view layer up to be drawn in constant colours, for a while.
    set_up: Callable[[Judge, Any, str], AbstractContextManager[None]] = lambda *_: nullcontext()
    sample_radius: float = 0.0  # pixels: like for like, samples are no farther from a centre
    # Pixels from its centre that its anti-aliasing mixes. Workbench's samples lie within a pixel
    # and a half; what smooths their edges takes in the pixel beside.
    filter_radius: float = 2.0
    solid: bool = True  # drawn by the scene's solid shading; others have materials and light
    random_instances: bool = True  # where colours are random, each instance has one of its own

    @property
    def needs_window(self) -> bool:
        """Whether it draws only where Blender has a window."""
        return self.engine is None

    def check_random(self, scene: Scene, owners: Sequence[str]) -> None:
        """Raise a SceneError if random colours are those of instances, which it cannot draw.

        An instance shows the colour of its own object's name, here that of what instances it.
        """
        for instance, owner in zip(scene.instances, owners, strict=False):
            if not self.random_instances and scene.objects[instance.object] != owner:
                raise SceneError(
                    f"{self.label} cannot draw the viewport's random colours of instances, as of "
                    f"'{owner}': set the colour of the scene's solid shading to material or "
                    "object, or compare with Workbench."
                )


def _cycles(judge: Judge, scene: Any, layer: str) -> AbstractContextManager[None]:
    from .cycles import constant_colors

    return constant_colors(scene, layer, judge.sample_radius)


_RASTERISER_IGNORES = frozenset(
    {"display type", "holdout", "not visible to the camera", "indirect only"}
)
JUDGES = {
    judge.name: judge
    for judge in (
        Judge(
            "viewport",
            "Viewport",
            "The viewport's own drawing: visibility and modifier levels of the viewport",
            None,
            None,
            _RASTERISER_IGNORES,
        ),
        Judge(
            "workbench",
            "Workbench",
            "A Workbench render: render visibility and modifier levels",
            1,
            "BLENDER_WORKBENCH",
            _RASTERISER_IGNORES,
        ),
        Judge(
            "cycles",
            "Cycles",
            "A Cycles render of the same constant colours, one sample in each pixel's centre",
            2,
            "CYCLES",
            # It shows constant colours without transparency: see `cycles.py`.
            frozenset({"display type", "transparency", "texture", "in-front drawing"}),
            _cycles,
            sample_radius=0.005,
            solid=False,
            random_instances=False,
        ),
    )
}


def choices() -> dict[str, Judge]:
    """Return the judges that a user can choose, by name."""
    return {name: judge for name, judge in JUDGES.items() if judge.number is not None}


def judge_named(name: str, background: bool) -> Judge:
    """Return the judge that a name, or AUTO, means with or without a window.

    Raises
    ------
    SceneError
        If there is none of that name.
    """
    key = name.lower()
    if name == AUTO:
        key = "workbench" if background else "viewport"
    if key not in JUDGES:
        raise SceneError(f"There is no judge '{name}': choose one of auto, {', '.join(JUDGES)}.")
    return JUDGES[key]
