"""Where Blender's two drawings contradict one another: there, whose surface it is is not known.

An edge may fall to this side in the drawing of the colours, and to that side in the drawing of
whose surfaces they are. An object that cannot have the colour that is shown is not shown there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Colors, Mask, Places
from ...scene import Scene
from ...tracer import shading
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..identity import UNKNOWN
from ..picture import Picture
from .probe import blocks


def without_contradictions(case: Case, frame: Frame) -> Work[Case]:
    """Return the case with the owners forgotten that their pixels' colours contradict.

    Only where the colour is the one that was traced: else the pixel differs, whoever owns it.
    """
    picture, scene = case.picture, case.scene
    if picture.owner is None or picture.lit or picture.filter_radius > 0:
        return case
    owner = picture.owner.copy()
    unclear = case.colorless | shading.interpolated(scene, np.arange(len(picture.owners)))
    for rows in blocks(owner.shape):
        part = picture.at(rows)
        odd = part.other_object(frame.instance_index[rows])
        odd &= ~part.other_color(frame.color[rows])
        for number in np.unique(part.owner[odd]):
            own = np.flatnonzero(picture.owners == number)
            if len(own) and not unclear[own].any():
                here = odd & (part.owner == number)
                may = _may_have(part.at(here), _colors(scene, own))
                owner[rows][here] = np.where(may, number, UNKNOWN)
        yield 1.0
    return replace(case, picture=replace(picture, owner=owner))


def _colors(scene: Scene, instances: Places) -> Colors:
    """Return the colours that some instances, planes and the background may have, (m, 4)."""
    first, last = (rows[instances] for rows in scene.color_rows)
    ends = np.unique(np.stack((first, last)), axis=1).T
    rows = np.concatenate([np.arange(a, b + 1) for a, b in ends])
    return np.unique(scene.color_table[rows], axis=0)


def _may_have(picture: Picture, colors: Colors) -> Mask:
    """Return which of n pixels show one of the colours (m, 4)."""
    shown = np.zeros(len(picture.color), bool)
    for color in colors:
        shown |= ~picture.other_color(np.broadcast_to(color, picture.color.shape))
    return shown
