"""Whether the causes' colours are told apart, by colour-blind readers, too; and which are free."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray
from reference_tracer.causes.cause import Color
from skimage.color import rgb2lab

# Machado, Oliveira and Fernandes, "A physiologically-based model for simulation of color vision
# deficiency", 2009: severity 1, of linear sRGB.
DEFICIENT = {
    "none": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
               [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
               [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
               [0.004733, 0.691367, 0.303900]],
}  # fmt: skip
LEAST = 10.0  # of CIE 1976's distance in L*a*b*: what one sees at a glance


def seen(colors: NDArray[np.float64], kind: str) -> NDArray[np.float64]:
    """Return linear RGB colours (n, 3) as L*a*b*, as one with a deficiency sees them."""
    linear = np.clip(colors @ np.array(DEFICIENT[kind]).T, 0, 1)
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return rgb2lab(srgb)


def clash(colors: Mapping[str, Color]) -> str:
    """Return which two colours are hardly told apart, by whom, and one that is free; "" if none."""
    for kind in DEFICIENT:
        lab = dict(zip(colors, seen(np.array([*colors.values()]), kind), strict=True))
        for first, second in combinations(colors, 2):
            distance = np.linalg.norm(lab[first] - lab[second])
            if distance <= LEAST:
                return (
                    f"{first} and {second} are {distance:.1f} apart (vision: {kind}), and should "
                    f"be more than {LEAST:g}; free is {free(colors)}"
                )
    return ""


def free(colors: Mapping[str, Color]) -> Color:
    """Return the colour that is farthest from all others, whatever colours one sees."""
    steps = [(n / 10) ** 2 for n in range(11)]  # roughly even to the eye
    bright = [c for c in product(steps, repeat=3) if max(c) > 0.4]  # the map's greys are dimmed
    candidates = np.array(bright)
    taken = np.array([*colors.values()])
    least = np.min(
        [
            np.linalg.norm(seen(candidates, k)[:, None] - seen(taken, k), axis=2).min(axis=1)
            for k in DEFICIENT
        ],
        axis=0,
    )
    red, green, blue = (float(round(v, 2)) for v in candidates[least.argmax()])
    return red, green, blue
