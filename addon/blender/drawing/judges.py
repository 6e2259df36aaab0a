"""Lists Blender's engines that the traced picture can be compared with.

To add one, write its record in a file beside this one, with the function that sets a scene up for
it if it needs one, and list it in `JUDGES`.
"""

from __future__ import annotations

from .cycles import CYCLES
from .eevee import EEVEE
from .judge import Judge
from .viewport import VIEWPORT
from .workbench import WORKBENCH

AUTO = "AUTO"  # the viewport in a window, Workbench in background; Cycles of a panorama

JUDGES = {judge.name: judge for judge in (VIEWPORT, WORKBENCH, CYCLES, EEVEE)}


def choices() -> dict[str, Judge]:
    """Return the judges that a user can choose, by name."""
    return {name: judge for name, judge in JUDGES.items() if judge.number is not None}


def judge_named(name: str, background: bool, is_panorama: bool = False) -> Judge:
    """Return the judge of a name; for AUTO, the one that draws with or without a window.

    Raises
    ------
    SceneError
        If there is none of that name, or it rasterises, which makes no panorama.
    """
    from ...scene import SceneError

    if name == AUTO:
        rasteriser = WORKBENCH if background else VIEWPORT
        return CYCLES if is_panorama else rasteriser
    if name.lower() not in JUDGES:
        raise SceneError(f"There is no judge '{name}': choose one of auto, {', '.join(JUDGES)}.")
    judge = JUDGES[name.lower()]
    if is_panorama and not judge.traces_rays:
        raise SceneError(f"{judge.label} draws no panoramas: compare with Cycles.")
    return judge
