"""Finds where Blender's two drawings contradict one another: there, the object is not known.

An edge may fall to one side in the drawing of the colours, and to the other in the drawing of the
objects. A pixel with a colour that an object cannot have does not show that object.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Bools, Colors, Places, places
from ...pictures.identity import UNKNOWN
from ...pictures.picture import Picture
from ...scene import Scene
from ...tracer import shading
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from .probe import blocks


def without_contradictions(case: Case, frame: Frame) -> Work[Case]:
    """Return the case without the objects that their pixels' colours contradict.

    Only pixels with the traced colour are tested: others differ, whatever object they show.
    """
    picture, scene = case.picture, case.scene
    owners = picture.owners
    if not owners or picture.lit or picture.sampling.filter_radius > 0:
        return case
    pixels = owners.pixels.copy()
    unclear = case.colorless | shading.interpolated(scene, np.arange(len(owners.instances)))
    for rows in blocks(pixels.shape):
        part, shown = picture.at(rows), pixels[rows]
        odd = part.other_object(frame.instance_index[rows])
        at = places(odd)
        odd[at] = ~part.at(at).other_color(frame.color[rows][at])
        for number in np.unique(shown[odd]):
            own = np.flatnonzero(owners.instances == number)
            if len(own) and not unclear[own].any():
                here = odd & (shown == number)
                may = _may_have(part.at(here), _colors(scene, own))
                shown[here] = np.where(may, number, UNKNOWN)
        yield None
    return replace(case, picture=replace(picture, owners=replace(owners, pixels=pixels)))


def _colors(scene: Scene, instances: Places) -> Colors:
    """Return the colours that some instances, planes and the background may have, (m, 4)."""
    first, last = (rows[instances] for rows in scene.color_rows)
    ends = np.unique(np.stack((first, last)), axis=1).T
    rows = np.concatenate([np.arange(a, b + 1) for a, b in ends])
    return np.unique(scene.color_table[rows], axis=0)


def _may_have(picture: Picture, colors: Colors) -> Bools:
    """Return which of n pixels show one of the colours (m, 4)."""
    shown = np.zeros(len(picture.color), bool)
    for color in colors:
        shown |= ~picture.other_color(np.broadcast_to(color, picture.color.shape))
    return shown
