"""Faults of the camera: where it stands, how it is turned, and where its rays pass."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np

from ...causes.case import Case
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Effort, Example, Fault, Numbers, with_values
from .film import CROPPED, FOCAL, FOCALS, OFFSET
from .fitting import Family, fitting
from .stand import MOVED, PLACED, ROLL, TURNED


def _a_pixel_aside(case: Case, frame: Frame) -> Numbers | None:
    """Pick a sideways move of one pixel at the median depth."""
    t = frame.t[np.isfinite(frame.t)]
    if not len(t):
        return None
    camera = case.scene.camera
    width = pixel_size(camera)[0] * camera.projection.scale(float(np.median(t)))
    return Numbers((float(width), 0.0, 0.0))


def _fitted(family: Family) -> dict[str, Any]:
    """Return how a family's numbers are fitted: not where more of them explain many more edges."""
    return fitting(family, FOCALS, CROPPED, PLACED)


_OFFSET = _fitted(OFFSET)


def _find_offset(evidence: Evidence) -> Work[list[Numbers]]:
    """Guess an offset: half a pixel, the commonest, exactly; and what is found in the picture."""
    camera = evidence.case.scene.camera
    halves = product((0.5, -0.5), repeat=2)
    exact = [Numbers(v, words=OFFSET.words(camera, *v)) for v in halves]
    found = yield from _OFFSET["find"](evidence)
    return [*exact, *found]


CAMERA_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "pixel_offset",
        "{words}: ({dx:+.3f}, {dy:+.3f}) px",
        "OpenCV puts the first pixel's centre at (0, 0), Blender and COLMAP at (1/2, "
        "1/2). Rays through (i, j) / size pass the pixels' corners.",
        "move the film position of every ray by that: pixel (i, j) has its centre at "
        "(i + 1/2, j + 1/2), and the principal point is at half of the width and the height, plus "
        "the shift",
        **_OFFSET | {"find": _find_offset},
        numbers=("dx", "dy"),
        effort=Effort.FILM,
        examples=(
            Example("half_pixel", "rays through the pixels' corners", with_values(0.5, 0.5)),
            Example("one_pixel", "the camera off by a pixel to the right", with_values(1.0, 0.0)),
        ),
        words="the camera's rays pass beside the pixels' centres",
        witness="NVIDIA/VisRTX#327",
    ),
    Fault(
        "focal_length",
        "{words}",
        "An angle is halved or doubled, a vertical one (glTF's yfov) taken for a "
        "horizontal one, or a lens in millimetres goes with another sensor.",
        "check the lens' unit, the sensor's width, and whether an angle is the whole one or half, "
        "of the width or of the height",
        **_fitted(FOCAL),
        numbers=("percent",),
        effort=Effort.FILM,
        words="the focal length, or an orthographic camera's scale, is some per cent off",
        witness="mrdoob/three.js#9328",
    ),
    Fault(
        "focal_lengths",
        "the focal length is {across:+.4g} % off across, and {up:+.4g} % up",
        "Each is computed from its own side of the sensor, which has another shape than "
        "the picture; or only one of them heeds the pixel aspect.",
        "take one focal length for both, in pixels; a pixel is pixel aspect Y / X as high as it is "
        "wide; remove the scale of the camera and its parents",
        **_fitted(FOCALS),
        numbers=("across", "up"),
        effort=Effort.CAMERA,
        witness="ohayoyogi/blender-exporter-colmap#6",
    ),
    Fault(
        "cropped",
        "the focal length is {percent:+.4g} % off, and the rays pass ({dx:+.3f}, {dy:+.3f}) px "
        "beside: the picture was cropped or enlarged about another point than the camera's axis",
        "A picture that is cropped and scaled has its principal point elsewhere.",
        "compare the whole picture, and scale the principal point with the focal length",
        **_fitted(CROPPED),
        numbers=("percent", "dx", "dy"),
        effort=Effort.CAMERA,
        witness="google-research-datasets/Objectron#36",
    ),
    Fault(
        "camera_moved",
        "the camera is moved by {right:+.4g} m to its right, {up:+.4g} m upwards and "
        "{forward:+.4g} m forward: by {words} in the world",
        "In Blender a camera's `location` is without its parents, constraints and delta "
        "transform. Or the picture is that of one eye of a stereo pair.",
        "compare its world matrix with the one that the scene has",
        **_fitted(MOVED),
        numbers=("right", "up", "forward"),
        effort=Effort.CAMERA,
        examples=(
            Example("camera_moved", "the camera moved by a pixel to its right", _a_pixel_aside),
        ),
        words="a vector",
        witness="GPUOpen-LibrariesAndSDKs/RadeonProRenderBlenderAddon#539",
    ),
    Fault(
        "camera_turned",
        "the camera is turned by {words}",
        "Angles are read in another order than the camera's rotation mode, or without "
        "its parents and constraints.",
        "compare its world matrix with the one that the scene has, and the order of its angles",
        **_fitted(TURNED),
        numbers=("right", "up", "roll"),
        effort=Effort.CAMERA,
        examples=(
            Example(
                "camera_turned", "the camera turned by half a degree", with_values(0.4, 0.3, 0)
            ),
        ),
        words="angles to the right, upwards and about its axis",
        witness="BabylonJS/Babylon.js#147",
    ),
    Fault(
        "camera_placed",
        "the camera stands elsewhere and looks elsewhere: {words}",
        "A pose of another frame or another camera, or a camera that was placed by hand.",
        "compare its world matrix with the one that the scene has",
        **_fitted(PLACED),
        numbers=("right", "up", "forward", "rightwards", "upwards", "anticlockwise"),
        effort=Effort.CAMERA,
        words="a vector, and angles",
        witness="gameplay3d/gameplay#1733",
    ),
    Fault(
        "roll",
        "the camera is rolled by {degrees:+.3f} degrees about its axis",
        "A camera that is made of an eye, a target and an up vector rolls with the up vector.",
        "turn it back; a positive angle turns the picture's content clockwise",
        **_fitted(ROLL),
        numbers=("degrees",),
        effort=Effort.FILM,
        witness="Unity-Technologies/com.unity.formats.alembic#317",
    ),
)
