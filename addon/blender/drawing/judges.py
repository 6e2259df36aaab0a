"""Lists Blender's engines that the traced picture can be compared with.

To add one, write its record in a file beside this one, with the function that sets a scene up for
it if it needs one, and list it in `JUDGES`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .cycles import CYCLES
from .eevee import EEVEE
from .judge import Judge
from .viewport import VIEWPORT
from .workbench import WORKBENCH

if TYPE_CHECKING:
    from ...pictures.source import Source

# Choices in place of a judge: an engine by its name, or a picture that is there.
ENGINE = "ENGINE"
RENDER_RESULT = "RENDER_RESULT"
IMAGE = "IMAGE"
STILLS = (RENDER_RESULT, IMAGE)
OF_ONE_FRAME = "A Render Result or an image is of one frame: compare the frames with an engine"
GIVEN = (ENGINE, *STILLS)
AUTO = "AUTO"  # the viewport in a window, Workbench in background; Cycles of a panorama

JUDGES = {judge.name: judge for judge in (VIEWPORT, WORKBENCH, CYCLES, EEVEE)}


def label_of(source: Source) -> str:
    """Return a short name of who made a picture, for the interface."""
    return source.file or JUDGES[source.name].label


def choices() -> dict[str, Judge]:
    """Return the judges that a user can choose, by name."""
    return {name: judge for name, judge in JUDGES.items() if judge.number is not None}


def judge_or_none(name: str, background: bool, is_panorama: bool = False) -> Judge | None:
    """Return the judge of a name as :func:`judge_named` does; None for a picture that is there."""
    return None if name in STILLS else judge_named(name, background, is_panorama)


def judge_named(name: str, background: bool, is_panorama: bool = False) -> Judge:
    """Return the judge of a name; for AUTO, the one that draws with or without a window.

    It may be an engine's name that an add-on registers, in any case.

    Raises
    ------
    SceneError
        If there is none of that name, or it rasterises, which makes no panorama.
    """
    from ...scene import SceneError

    if name == AUTO:
        rasteriser = WORKBENCH if background else VIEWPORT
        return CYCLES if is_panorama else rasteriser
    if name == ENGINE:
        raise SceneError("No engine is named: type its name below Compare With, as MY_ENGINE.")
    known = JUDGES
    if name.lower() not in known:
        from .engines import others

        known = JUDGES | others()
    judge = known.get(name.lower())
    if judge is None:
        raise SceneError(f"There is no judge '{name}': choose one of auto, {', '.join(known)}.")
    if is_panorama and not judge.traces_rays:
        raise SceneError(f"{judge.label} draws no panoramas: compare with Cycles.")
    return judge
