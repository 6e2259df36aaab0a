"""EEVEE as a judge: it shows constant colours, with one sample in each pixel's centre.

EEVEE spreads its samples over its filter, which is a disk where it is narrow: of width 0, it is the
pixel's centre. Measured as `rasteriser.py` does, in rows and in columns, in 5.2: edges are where
Workbench has them, rounded to 1/256 pixel. In 4.3 it takes no override of materials: what is drawn
first says so.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .judge import Judge


@contextmanager
def _one_sample_a_pixel(scene: Any, layer: str) -> Iterator[None]:
    from .constant_material import constant_colors

    scene.eevee.taa_render_samples = 1
    scene.render.filter_size = 0.0
    with constant_colors(scene, layer):
        yield


EEVEE = Judge(
    name="eevee",
    label="EEVEE",
    description="An EEVEE render of the same constant colours, one sample in each pixel's centre",
    number=3,
    engine="BLENDER_EEVEE",
    ignores=("display type", "transparency", "texture", "in-front drawing", "hidden faces"),
    set_up=_one_sample_a_pixel,
    solid=False,
    random_instances=False,
)
