"""Blender's engines as judges of the traced picture: a record each, in `judges.toml`.

To add one, give it a record there and, if a scene has to be set up for it, a function here. The
command line reads the records where there is no Blender: nothing here imports bpy.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

AUTO = "AUTO"
AUTO_IS = "The viewport in a window, Workbench in background; Cycles of a panorama"


@dataclass(frozen=True)
class Judge:
    """One of Blender's engines."""

    name: str  # in options, folders and JSON; in capitals, in a script; the others: `judges.toml`
    label: str
    description: str = ""
    number: int | None = None
    engine: str | None = None
    ignores: tuple[str, ...] = ()
    # Sets a temporary scene and a view layer up to be drawn in constant colours, for a while.
    set_up: Callable[[Judge, Any, str], AbstractContextManager[None]] = lambda *_: nullcontext()
    sample_radius: float = 0.0
    # Pixels from its centre that its anti-aliasing mixes. Workbench's samples lie within a pixel
    # and a half; what smooths their edges takes in the pixel beside.
    filter_radius: float = 2.0
    solid: bool = True
    random_instances: bool = True
    panoramas: bool = False

    @property
    def needs_window(self) -> bool:
        """Whether it draws only where Blender has a window."""
        return self.engine is None

    def check_random(self, scene: Any, owners: Sequence[str]) -> None:
        """Raise a SceneError if random colours are those of instances, which it cannot draw.

        An instance shows the colour of its own object's name, here that of what instances it.
        """
        from ...scene import SceneError

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


_SET_UP = {"cycles": {"set_up": _cycles}}
_LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
JUDGES = {
    name: Judge(name, **_SET_UP.get(name, {}), **record | {"ignores": tuple(record["ignores"])})
    for name, record in _LISTED.items()
}


def choices() -> dict[str, Judge]:
    """Return the judges that a user can choose, by name."""
    return {name: judge for name, judge in JUDGES.items() if judge.number is not None}


def judge_named(name: str, background: bool, is_panorama: bool = False) -> Judge:
    """Return the judge that a name, or AUTO, means with or without a window.

    Raises
    ------
    SceneError
        If there is none of that name, or it cannot draw the picture's panorama.
    """
    from ...scene import SceneError

    key = name.lower()
    if name == AUTO:
        key = "cycles" if is_panorama else "workbench" if background else "viewport"
    if key not in JUDGES:
        raise SceneError(f"There is no judge '{name}': choose one of auto, {', '.join(JUDGES)}.")
    if is_panorama and not JUDGES[key].panoramas:
        raise SceneError(f"{JUDGES[key].label} draws no panoramas: compare with Cycles.")
    return JUDGES[key]
