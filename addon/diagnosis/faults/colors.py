"""Faults of objects' colours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...scene import Instance
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import (
    AnyFault,
    Effort,
    Example,
    Fault,
    Numbers,
    Pick,
    instances_named,
    of_object,
)
from .painted import exchanged, of_one_color, other_source, painted_case, two_colors
from .search import values_of


def _in_color(instance: Instance, *rgb: float) -> Instance:
    """Give an instance one colour, linear RGB."""
    return replace(instance, colors=np.array([[*rgb, 1.0]], np.float32))


def _recolored(change: Callable[[Array], Array]) -> Pick:
    """Return a function that picks the largest object with one colour, and changes that."""

    def pick(case: Case, frame: Frame) -> Numbers | None:
        for number in of_one_color(case, frame):
            instance = case.scene.instances[number]
            other = change(instance.colors[:1])[0, :3]
            if len(instance.colors) == 1 and not np.allclose(other, instance.colors[0, :3]):
                name = case.scene.objects[instance.object]
                return Numbers(values_of(other), object=name)
        return None

    return pick


def _shown_color(evidence: Evidence) -> Work[list[Numbers]]:
    """Guess, for each suspect, the median colour in which it is shown."""
    out = []
    scene, picture = evidence.case.scene, evidence.picture
    for name in evidence.suspects:
        own = np.isin(evidence.frame.instance_index, instances_named(scene, name))
        where = own & evidence.unexplained
        if 2 * where.sum() > own.sum() and picture.transform is None:
            color = np.median(picture.color[where], axis=0)
            if np.isfinite(color).all() and color[3] > 0:
                values = values_of(color[:3])
                out.append(Numbers(values, values, values, object=name))
        yield None
    return out


COLOR_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "swapped_colors",
        "objects have one another's colours: {words}",
        "Objects and colours come in two lists in different orders.",
        "check by which index colours are taken",
        painted_case,
        exchanged,
        examples=(Example("swapped_colors", "two objects with one another's colours", two_colors),),
        words="which has whose",
        witness="WolvenKit/WolvenKit#1036",
    ),
    Fault(
        "color_source",
        "all colours come from another source than the scene's: {words}",
        "Blender has a colour in each material, one for the viewport, one of each "
        "object, and attributes; a mesh has several material slots.",
        "check which colour is read (material, object, attribute), and that a face's material "
        "index counts the object's slots from 0",
        painted_case,
        other_source,
        words="another material slot's, or those that are shown",
        witness="CoDEmanX/blender-cod#3",
    ),
    Fault(
        "recolored",
        "'{object}' is shown in another colour: ({red:.3f}, {green:.3f}, {blue:.3f}), linear",
        "A material has one colour for the viewport and another in its shader. Hexadecimal "
        "colours are sRGB, those in Blender's Python are linear.",
        "check its material, and in which colour space its colour is stored; a mesh is grey unless "
        "--colors names its colours",
        of_object(_in_color),
        _shown_color,
        ("red", "green", "blue"),
        effort=Effort.PIXELS,  # after what is missing: the one behind it is shown
        examples=(
            Example("one_shade", "one object half as bright", _recolored(lambda c: c * 0.5)),
            Example(
                "one_channels",
                "one object's red and blue swapped",
                _recolored(lambda c: c[:, [2, 1, 0, 3]]),
            ),
        ),
        witness="godotengine/collada-exporter#115",
    ),
)
