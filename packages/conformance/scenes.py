"""The kit's forty scenes: each is plain but for one thing that renderers and exporters get wrong.

World space is Blender's: metres, Z up. Each object has a flat colour of its own, which is far from
all others; nothing is lit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from typing import Any

import numpy as np
from reference_tracer.arrays import Colors, Floats
from reference_tracer.framing import Choice
from reference_tracer.pictures.palette import clear_palette
from reference_tracer.scene import Camera, Instance, Scene
from trimesh import transformations

from .shapes import Shape, ball, box, bracket, in_two, needles, prism, sheet, triangle
from .shapes import with_zero_areas as zero_areas

SIZE = 64, 48
_CLEAR = clear_palette([str(k) for k in range(14)]).colors.values()
# (3,) linear RGB each. Those of 0 and 1 alone would look the same without sRGB's curve.
PALETTE: list[Colors] = [color for color in _CLEAR if not np.isin(color, (0, 1)).all()]


@dataclass(frozen=True, eq=False)
class Move:
    """A transform as glTF has it: scaled, then rotated by a quaternion x, y, z, w, then moved."""

    at: Sequence[float] = (0.0, 0.0, 0.0)
    turn: Sequence[float] = (0.0, 0.0, 0.0, 1.0)
    scale: Sequence[float] = (1.0, 1.0, 1.0)

    @property
    def matrix(self) -> Floats:
        """As (4, 4) float64."""
        x, y, z, w = self.turn
        out = transformations.quaternion_matrix((w, x, y, z))
        out[:3, :3] *= np.array(self.scale)
        out[:3, 3] = self.at
        return out


@dataclass(frozen=True, eq=False)
class Sheared:
    """A transform that is no rotation of a scaling: its matrix."""

    rows: Any

    @property
    def matrix(self) -> Floats:
        """As (4, 4) float64."""
        return np.array(self.rows, np.float64)


def turned(axis: Sequence[float], degrees: float) -> tuple[float, ...]:
    """Return the quaternion x, y, z, w of a turn about an axis through the origin."""
    w, x, y, z = transformations.quaternion_about_axis(np.radians(degrees), axis).tolist()
    return x, y, z, w


@dataclass(frozen=True, eq=False)
class Item:
    """An object: a shape at a place, which its parents' transforms and its own lead to."""

    name: str
    shape: Shape
    moves: tuple[Move | Sheared, ...] = ()  # the outermost parent's first
    colors: tuple[int, ...] = (0,)  # of its materials, in PALETTE

    @property
    def world_from_object(self) -> Floats:
        """Return the product of its transforms, (4, 4) float64."""
        return reduce(np.matmul, [m.matrix for m in self.moves], np.eye(4))


@dataclass(frozen=True, eq=False)
class KitScene:
    """One scene of the kit."""

    name: str  # of its folder: what it is about, then which
    sentence: str  # what is special, and what often goes wrong with it
    items: tuple[Item, ...]
    camera: Camera = field(default_factory=lambda: view())

    @cached_property
    def scene(self) -> Scene:
        """The traced scene; items of one shape share a mesh."""
        shapes = list(dict.fromkeys(item.shape for item in self.items))
        rgba = np.array([(*color, 1) for color in PALETTE], np.float32)
        instances = tuple(
            Instance(shapes.index(i.shape), k, i.world_from_object, rgba[list(i.colors)])
            for k, i in enumerate(self.items)
        )
        names = tuple(item.name for item in self.items)
        return Scene(self.camera, tuple(s.mesh for s in shapes), instances, objects=names)


def view(
    eye: Sequence[float] = (4.4, -4.9, 3.6),
    target: Sequence[float] = (0.9, 0.6, 0.3),
    angle: float = 20.0,
    *,
    size: tuple[int, int] = SIZE,
    shift: tuple[float, float] = (0.0, 0.0),
    tall: float = 1.0,
    roll: float = 0.0,
    height: float | None = None,
) -> Camera:
    """Return a camera.

    Parameters
    ----------
    eye, target : (3,) float
        World space, metres.
    angle : float
        Vertical angle of view, degrees.
    size : (int, int)
        Width and height, pixels.
    shift : (float, float)
        How far the window is moved to the right and up, in its own widths and heights.
    tall : float
        Height of a pixel, in widths.
    roll : float
        Turn about the view axis, degrees counter-clockwise as the camera sees it.
    height : float, optional
        Of the picture, metres: then the camera is orthographic.
    """
    choice = Choice(eye=eye, target=target, angle=angle, ortho_scale=height)
    camera = choice.placed(*size, tall)
    c, s = np.cos(np.radians(roll)), np.sin(np.radians(roll))
    matrix = camera.world_from_camera.copy()
    matrix[:3, :3] = matrix[:3, :3] @ np.array([(c, -s, 0), (s, c, 0), (0, 0, 1)])
    right, up = np.multiply(camera.window.size, shift).tolist()
    return replace(
        camera,
        world_from_camera=matrix,
        window=camera.window.moved(right, up),
        clip_start=0.05,
        clip_end=1e5,
        name="Camera",
    )


_TILT = turned((0.3, 1.0, 0.5), 40)
_BRACKET = Item("Bracket", bracket())
_POST = Item("Post", box(0.15, 0.15, 0.7), (Move((1.6, 1.3, 0.7)),), (1,))
_BALL = Item("Ball", ball(), (Move((0.25, 1.1, 0.85), scale=(0.3, 0.3, 0.3)),), (2,))
_THREE = (_BRACKET, _POST, _BALL)


def _cameras() -> list[KitScene]:
    def seen(name: str, sentence: str, camera: Camera) -> KitScene:
        return KitScene(f"camera-{name}", sentence, _THREE, camera)

    far = 1000.0
    return [
        seen("plain", "A perspective camera with nothing special.", view()),
        seen("wide", "110 degrees high.", view((1.9, -0.9, 1.4), angle=110.0)),
        seen("narrow", "1.2 degrees high, from 130 m.", view((75, -90, 58), angle=1.2)),
        seen(
            "portrait",
            "Higher than wide: the angle of view is that of the height.",
            view(size=(40, 64), angle=30.0),
        ),
        seen("shift-x", "Shifted to the right by 0.25 of the width.", view(shift=(0.25, 0))),
        seen("shift-y", "Shifted up by 0.2 of the height.", view(shift=(0, 0.2))),
        seen(
            "shift-portrait",
            "Shifted both ways, higher than wide.",
            view(size=(40, 64), angle=40.0, shift=(-0.2, 0.1)),
        ),
        seen("tall-pixels", "Pixels twice as high as wide: fx is 2 fy.", view(tall=2.0)),
        seen("orthographic", "Parallel rays, 3 m high.", view(height=2.4)),
        seen(
            "orthographic-shift",
            "Parallel rays, shifted both ways.",
            view(height=3.0, shift=(0.1, -0.15)),
        ),
        seen("rolled", "Turned about the view axis by 75 degrees.", view(roll=75)),
        seen(
            "down",
            "Straight down, with Y up in the picture.",
            view((0.87, 0.63, 7), (0.87, 0.63, 0)),
        ),
        KitScene(
            "camera-far",
            "Camera and objects are 1 km from the origin: float32 keeps 0.06 mm of that.",
            tuple(
                Item(i.name, i.shape, (Move((far, -far, 0)), *i.moves), i.colors) for i in _THREE
            ),
            view((far + 4.4, -far - 4.9, 3.6), (far + 0.9, -far + 0.6, 0.3)),
        ),
    ]


def _transforms() -> list[KitScene]:
    tenth = Move(scale=(0.01,) * 3)
    shear = Sheared([(1, 0.5, 0, 0), (0, 1, 0.25, 0), (0, 0, 1, 0.1), (0, 0, 0, 1)])
    far_parent = Move((0.4, 0.2, 0.1), turned((0, 0, 1), 35), (1, 0.5, 1))
    kinds: dict[str, tuple[str, tuple[Move | Sheared, ...]]] = {
        "moved": ("Moved.", (Move((0.5, 0.25, 0.25)),)),
        "rotated": ("Rotated about a slanted axis.", (Move(turn=_TILT),)),
        "scaled": ("Half as large.", (Move((0.5, 0.25, 0), scale=(0.5,) * 3),)),
        "stretched": ("Another scale along each axis.", (Move(scale=(0.5, 1.25, 2)),)),
        "mirrored": ("Scaled by -1 along X.", (Move((2, 0, 0), scale=(-1, 1, 1)),)),
        "inverted": (
            "Scaled by -1 along all axes: mirrored, and turned inside out.",
            (Move((2, 1.5, 0.9), scale=(-1, -1, -1)),),
        ),
        "sheared": ("A matrix that no scale and rotation make.", (shear,)),
        "parented": (
            "Three parents, each moved, turned and scaled.",
            (
                Move((0.3, 0, 0), turned((0, 0, 1), 20)),
                Move((0.2, 0.1, 0), scale=(0.8, 0.8, 0.8)),
                Move((0, 0, 0.2), turned((1, 0, 0), 15)),
            ),
        ),
        "parent-stretched": (
            "Turned below a parent with another scale along each axis: together a shear.",
            (far_parent, Move(turn=turned((0, 0, 1), 30))),
        ),
        "tiny": (
            "A mesh of millimetres below a parent that scales it up.",
            (Move(scale=(100,) * 3), tenth),
        ),
        "flattened": (
            "Scaled by 0 along Z: a flat surface is left, which is seen.",
            (Move((0, 0, 0.5), scale=(1, 1, 0)),),
        ),
    }
    return [
        KitScene(f"transform-{n}", s, (Item("Bracket", bracket(), moves), _POST))
        for n, (s, moves) in kinds.items()
    ]


def _instances() -> list[KitScene]:
    half = (0.5,) * 3
    grid = tuple(
        Item(f"Cell-{x}-{y}", box(), (Move((0.45 * x, 0.4 * y, 0.1), scale=(0.15,) * 3),))
        for y in range(5)
        for x in range(5)
    )
    pair = [Move((0, 0, 0), scale=half), Move((1, 0.75, 0), scale=half)]
    mirror = Move((2.2, 0.9, 0), scale=(-0.5, 0.5, 0.5))
    groups = [Move(), Move((0.2, 0.1, 0.9), turned((0, 0, 1), 25))]
    return [
        KitScene(
            "instances-two",
            "Two objects of one mesh.",
            tuple(Item(f"Bracket-{k}", bracket(), (m,)) for k, m in enumerate(pair)),
        ),
        KitScene("instances-grid", "25 objects of one mesh.", (*grid, _POST)),
        KitScene(
            "instances-mirrored",
            "Of two objects of one mesh one is mirrored.",
            (Item("Plain", bracket(), (pair[0],)), Item("Mirrored", bracket(), (mirror,))),
        ),
        KitScene(
            "instances-colours",
            "Three objects of one mesh, each in another material.",
            tuple(
                Item(f"Bracket-{k}", bracket(), (m,), (k,))
                for k, m in enumerate([*pair, Move((1.2, -0.4, 0.3), scale=half)])
            ),
        ),
        KitScene(
            "instances-groups",
            "Two groups of two objects each, one group turned.",
            tuple(
                Item(f"Bracket-{g}-{k}", bracket(), (group, m))
                for g, group in enumerate(groups)
                for k, m in enumerate(pair)
            ),
        ),
        KitScene(
            "instances-same-place",
            "Two objects of one mesh and one colour in the same place, as copies often are.",
            (_BRACKET, Item("Copy", bracket()), _POST),
        ),
    ]


def _meshes() -> list[KitScene]:
    low = Move((0.9, 0.6, 0.3))
    big = Move((0.9, 0.6, 0.3), scale=(0.9,) * 3)
    up = Move((0.9, 0.6, 0.3), turned((1, 0, 0), 180), (0.9,) * 3)
    of_mesh = {
        "triangle": ("One triangle.", (Item("Triangle", triangle(), (low,)),)),
        "polygons": (
            "Faces of four and six corners, where the format has such.",
            (Item("Prism", prism(), (Move((0.9, 0.6, 0.3), _TILT, (0.8,) * 3),)),),
        ),
        "ball": ("A globe, whose triangles share their corners.", (Item("Ball", ball(), (big,)),)),
        "back": (
            "A sheet seen from behind: both sides of a surface are seen.",
            (Item("Sheet", sheet(), (up,)), _POST),
        ),
        "unwelded": (
            "Each triangle has corners of its own.",
            (Item("Bracket", bracket().unwelded()), _POST),
        ),
        "zero-areas": (
            "Triangles without area between the others.",
            (Item("Bracket", zero_areas(bracket())), _POST),
        ),
        "needles": (
            "Triangles 13 times as long as wide, a pixel or two across.",
            (Item("Needles", needles(), (low,)),),
        ),
        "crossing": (
            "Two meshes that cross each other.",
            (_BRACKET, Item("Box", box(0.6, 0.4, 0.5), (Move((0.9, 0.5, 0.4), _TILT),), (1,))),
        ),
        "behind": (
            "A ground that reaches from far ahead to behind the camera.",
            (_BRACKET, Item("Ground", sheet(50), (Move((0, 0, -0.1)),), (1,))),
        ),
        "materials": (
            "One mesh with two materials.",
            (Item("Bracket", in_two(bracket()), (), (0, 3)), _POST),
        ),
    }
    return [KitScene(f"mesh-{name}", s, items) for name, (s, items) in of_mesh.items()]


def kit_scenes() -> tuple[KitScene, ...]:
    """Return the forty scenes, in the order of the table."""
    return (*_cameras(), *_transforms(), *_instances(), *_meshes())
