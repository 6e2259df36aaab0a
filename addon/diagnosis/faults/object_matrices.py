"""Faults of objects' matrices: what of them is left out, or taken for something else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Floats
from ...scene import Instance
from ...tracer.progress import at_once
from ..evidence import Evidence
from .changes import nearest_rotation
from .fault import (
    AnyFault,
    Fault,
    Guess,
    Make,
    Option,
    of_object,
)
from .suspects import suspects


def _with_axes(change: Callable[[Floats, Floats], Floats]) -> Make[Guess]:
    """Return a function that changes the axes of an object's instances, by a function of them.

    It takes unit axes, (3, 3) columns, and their lengths, (3,).
    """

    def changed(instance: Instance) -> Instance:
        matrix = instance.world_from_object.copy()
        lengths = np.linalg.norm(matrix[:3, :3], axis=0)
        matrix[:3, :3] = change(matrix[:3, :3] / np.where(lengths > 0, lengths, 1), lengths)
        return replace(instance, world_from_object=matrix)

    return of_object(changed)


def _at_origin(instance: Instance) -> Instance:
    matrix = instance.world_from_object.copy()
    matrix[:3, 3] = 0
    return replace(instance, world_from_object=matrix)


def _rotation(axes: Floats) -> Floats:
    """Return the rotation of the first axis and the plane of the first two, (3, 3)."""
    q, r = np.linalg.qr(axes)
    return q * np.where(np.diag(r) < 0, -1, 1)


@at_once
def _each_way(evidence: Evidence) -> list[Option]:
    """Guess both options for each suspect."""
    return [Option(way, object=name) for name in evidence.suspects for way in (0, 1)]


@at_once
def _transposed(evidence: Evidence) -> list[Guess]:
    """Guess all objects, and each suspect."""
    each = (Guess(object=name, words=f"'{name}'") for name in evidence.suspects)
    return [Guess(words="all objects"), *each]


_UNSHEARED = (  # the scale is the length of the axes
    _with_axes(lambda axes, lengths: _rotation(axes) * lengths),
    _with_axes(lambda axes, lengths: nearest_rotation(axes) * lengths),
)

OBJECT_MATRIX_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "transform_left_out",
        "the transform of '{object}' is left out",
        "Vertices are stored in the object's own coordinates. STL and PLY have no "
        "transforms to go with them.",
        "multiply its vertices by its world matrix",
        of_object(lambda instance: replace(instance, world_from_object=np.eye(4))),
        suspects,
        witness="OpenNaja/cobra-blender#19",
    ),
    Fault(
        "rotation_left_out",
        "the rotation of '{object}' is left out",
        "`rotation_euler` is not used where the object's rotation mode is Quaternion or Axis "
        "Angle, and stays as it was.",
        "multiply its vertices by its whole world matrix",
        _with_axes(lambda axes, lengths: np.diag(np.where(lengths > 0, lengths, 1))),
        suspects,
        witness="taniwha/io_object_mu#8",
    ),
    Fault(
        "rotation_transposed",
        "the rotation of {words} is transposed",
        "numpy and Blender's Python store a matrix row by row, OpenGL, glTF and FBX "
        "column by column.",
        "the object's axes are the columns of its world matrix",
        _with_axes(lambda axes, lengths: axes.T * lengths),
        _transposed,
        words="an object, or of all",
        witness="cedricpinson/osgexport#8",
    ),
    Fault(
        "scale_left_out",
        "the scale of '{object}' is left out",
        "A pose made of a rotation and a translation, as for robots and rigid bodies, has no "
        "scale.",
        "multiply its vertices by its whole world matrix",
        _with_axes(lambda axes, lengths: axes),
        suspects,
        witness="X-Plane/XPlane2Blender#257",
    ),
    Fault(
        "place_left_out",
        "'{object}' is at the world's origin",
        "Only the (3, 3) part of the matrix was used, or each asset was exported at the origin.",
        "multiply its vertices by its whole world matrix",
        of_object(_at_origin),
        suspects,
        witness="X-Plane/XPlane2Blender#214",
    ),
    Fault(
        "shear_left_out",
        "the shear of '{object}' is left out: it has the location, rotation and scale alone",
        "Translation, rotation and scale, as in glTF's nodes or from `Matrix.decompose()`, "
        "cannot hold a shear.",
        "a child that is turned in a parent with a scale is sheared: store its whole world matrix",
        lambda case, guess: _UNSHEARED[guess.number](case, guess),
        _each_way,
        witness="donmccurdy/glTF-Transform#1680",
    ),
)
