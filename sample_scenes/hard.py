"""What is hard for a tracer: edges on pixel centres, ten thousand instances, a far place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, hypot, pi, radians, sin
from random import Random

import bpy
from mathutils import Vector

from . import nodes, parts, solids

TREES = 10_000
WATER = 0.0  # metres
PIXEL = 1 / 64  # metres, in the technical view: exact in binary
FAR = Vector((10_000, -3_000, 500))


def technical_view() -> None:
    """An engineering drawing, 64 pixels a metre: edges exactly on pixel boundaries and centres."""
    scene = parts.start("Technical View", 640, 480, colours="SINGLE", sky="#1d3f72")
    parts.single_colour(scene, "#e3ecf7")
    eye = parts.camera((0, 0, 20), (0, 0, 0), ortho_scale=10)
    eye.rotation_euler = (0, 0, 0)  # exactly: a turn by pi / 2 would be 4e-8 off
    _bracket("Front", lambda x, y, z: (x, z, -y), (-2.25, -3, 0))
    _bracket("Top", lambda x, y, z: (x, y, z), (-2.25, 1.5, 0))
    _bracket("Side", lambda x, y, z: (y, z, x), (1.75 + PIXEL / 2, PIXEL / 2 - 3, 0))
    for solid in _bracket("Isometric", lambda x, y, z: (x, y, z), (2.375, 0.75, 0)):
        solid.rotation_mode = "ZYX"  # Z first
        solid.rotation_euler = (radians(-54.7356), 0, radians(45))
        solid.scale = (0.8125, 0.8125, 0.8125)
    parts.add("Sheet", _sheet(), "#e3ecf7", (0, 0, -4), tones=1)
    parts.text("Title", "BRACKET", (3.125, -3.375, -4), 0.25)


def _bracket(view: str, axes: Callable, at: Sequence[float]) -> list[bpy.types.Object]:
    """Add one view of a machined bracket and return its parts.

    `axes` permutes its coordinates, exactly; an object's rotation would round them.
    """

    def solid(
        name: str, mesh: bpy.types.Mesh, collection: bpy.types.Collection | None = None
    ) -> bpy.types.Object:
        for vertex in mesh.vertices:
            vertex.co = axes(*vertex.co)
        return parts.add(f"{view}: {name}", mesh, "#e3ecf7", at, tones=1, collection=collection)

    cutters = nodes.hidden_collection(f"{view}: Cutters")
    bores = [(1.375 * i, 0.625 * j, 0.1875, 2) for i in (-1, 1) for j in (-1, 1)]
    drills = [solid(f"Drill {k + 1}", _drill(*bore), cutters) for k, bore in enumerate(bores)]
    channel = solid("Channel", solids.shifted(solids.box(5, 0.5, 0.25), (0, 0, 0.125)), cutters)
    bore = solid("Bore", solids.lying(solids.cone(0.4375, 0.4375, 4, 48), (0, 2, 1.75)), cutters)
    base = solid("Base", solids.box(3.5, 2, 0.5))
    lug = solid("Lug", solids.shifted(solids.box(1.5, 0.5, 2), (0, 0, 0.5)))
    for part, tools in ((base, (*drills, channel)), (lug, (bore,))):
        for tool in tools:
            cut = part.modifiers.new(tool.name, "BOOLEAN")
            cut.operation, cut.object, cut.solver = "DIFFERENCE", tool, "EXACT"
    chamfer = lug.modifiers.new("Chamfer", "BEVEL")
    chamfer.width, chamfer.segments = 4 * PIXEL, 1
    fins = solid("Fins", solids.shifted(solids.box(7 * PIXEL, 0.75, 0.375), (0.953125, 0, 0.5)))
    row = fins.modifiers.new("Row", "ARRAY")
    row.count, row.use_relative_offset, row.use_constant_offset = 4, False, True
    row.constant_offset_displace = axes(13 * PIXEL, 0, 0)
    mirror = fins.modifiers.new("Mirror", "MIRROR")
    mirror.use_axis = [bool(along) for along in axes(1, 0, 0)]
    return [base, lug, fins, *drills, channel, bore]


def _drill(x: float, y: float, radius: float, height: float) -> bpy.types.Mesh:
    return solids.shifted(solids.cone(radius, radius, height, 32), (x, y, -1))


def _sheet() -> bpy.types.Mesh:
    """Return the sheet's lines, in pixels from the lower left corner: x, y, width, height.

    Integers lie on pixel boundaries, halves on pixel centres.
    """
    border = [(10, 10, 620, 2), (10, 468, 620, 2), (10, 12, 2, 456), (628, 12, 2, 456)]
    title = [(500, 12, 1, 48), (500, 60, 128, 1), (500, 36, 128, 1)]
    width = [(64, 262.5, 224, 1), (64, 256, 1, 14), (287, 256, 1, 14)]
    height = [(40.5, 48, 1, 160), (34, 48, 14, 1), (34, 207, 14, 1)]
    depth = [(40.5, 272, 1, 128), (34, 272, 14, 1), (34, 399, 14, 1)]
    middle = [(175.5, y + 12 * k, 1, 8) for y in (410, 214) for k in range(3)]
    lines = [*border, *title, *width, *height, *depth, *middle]
    points = [
        ((i - 320) * PIXEL, (j - 240) * PIXEL, 0)
        for x, y, w, h in lines
        for i, j in ((x, y), (x + w, y), (x + w, y + h), (x, y + h))
    ]
    return solids.polygons(points, [tuple(range(k, k + 4)) for k in range(0, len(points), 4)])


def forest() -> None:
    """Ten thousand instances of three low-poly trees by geometry nodes, on hills around a lake."""
    parts.start("Forest", 480, 270, sky="#f7e3c6")
    parts.camera((0, -46, 19), (0, 30, 1), lens=32, clip_end=500)
    side, step = 61, 4.0
    grid = [((i - 30) * step, (j - 12) * step) for j in range(side) for i in range(side)]
    corner = [j * side + i for j in range(side - 1) for i in range(side - 1)]
    hills = solids.polygons(
        [(x, y, _height(x, y)) for x, y in grid],
        [(c, c + 1, c + side + 1, c + side) for c in corner],
    )
    parts.add("Hills", hills, "#b5c689", tones=7)
    water = [(-130, -50, WATER), (130, -50, WATER), (130, 200, WATER), (-130, 200, WATER)]
    parts.add("Lake", solids.polygons(water, [(0, 1, 2, 3)]), "#8ecae6", tones=1)
    kinds = nodes.hidden_collection("Tree Kinds")
    _tree("Tree 1: Spruce", kinds, "#2d6a4f", [(0.95, 0.0, 1.6, 0.5), (0.7, 0.0, 1.5, 1.4)], 6)
    _tree("Tree 2: Larch", kinds, "#d08c34", [(0.8, 0.0, 2.9, 0.4)], 5)
    _tree("Tree 3: Poplar", kinds, "#74a057", [(0.3, 0.75, 0.9, 0.5), (0.75, 0.1, 1.5, 1.4)], 5)
    nodes.instances_on_points(_tree_points(), kinds)


def _height(x: float, y: float) -> float:
    """Return the terrain's height in metres: hills that rise with the distance from a lake."""
    bowl = 0.16 * max(hypot(x - 6, 0.8 * (y - 14)) - 17, -12)
    return (
        bowl * (0.35 + 0.006 * max(y, 0))
        + 2.2 * sin(x / 17 + 1) * cos(y / 23)
        + 0.9 * sin(x / 7 + y / 9)
    )


def _tree(
    name: str, kinds: bpy.types.Collection, css: str, crowns: Sequence[Sequence[float]], sides: int
) -> None:
    """Add a tree: stacked crowns, each (radius, top radius, height, from) in metres, on a trunk."""
    points, faces = [], []
    for radius, top, height, foot in [(0.14, 0.1, 0.6, 0.0), *crowns]:
        first = len(points)
        rings = [(radius, foot), (top, foot + height)] if top else [(radius, foot)]
        points += [
            (r * cos(2 * pi * k / sides), r * sin(2 * pi * k / sides), z)
            for r, z in rings
            for k in range(sides)
        ]
        around = [(k, (k + 1) % sides) for k in range(sides)]
        if top:
            faces += [
                (first + a, first + b, first + sides + b, first + sides + a) for a, b in around
            ]
            faces.append(tuple(first + sides + k for k in range(sides)))
        else:
            points.append((0, 0, foot + height))
            faces += [(first + a, first + b, first + sides) for a, b in around]
        faces.append(tuple(first + k for k in reversed(range(sides))))
    parts.add(name, solids.polygons(points, faces), css, collection=kinds)


def _tree_points() -> bpy.types.Object:
    """Return an object whose vertices are the trees' places, with kind, size and turn."""
    dice = Random(1)
    points, kind, size, turn = [], [], [], []
    while len(points) < TREES:
        x, y = round(dice.uniform(-118, 118) * 64) / 64, round(dice.uniform(-44, 188) * 64) / 64
        z = round(_height(x, y) * 64) / 64  # few digits, so that the file stays small
        if z < WATER + 0.4 or hypot(x, y + 46) < 14:
            continue
        points.append((x, y, z - 0.1))
        kind.append(min(int(dice.triangular(0, 3, 0.4 + z / 12)), 2))
        size.append(round(dice.uniform(0.7, 1.5) * 64) / 64)
        turn.append(round(dice.uniform(0, 2 * pi) * 64) / 64)
    mesh = solids.polygons(points, [])
    for name, form, values in (
        ("kind", "INT", kind),
        ("size", "FLOAT", size),
        ("turn", "FLOAT", turn),
    ):
        mesh.attributes.new(name, form, "POINT").data.foreach_set("value", values)
    return parts.add("Trees", mesh, "#2d6a4f", tones=1)


def far_away() -> None:
    """10 km from the origin, blocks of 10 cm: steps of float32 are 1 mm there, 0.2 pixels."""
    parts.start("Far Away", 640, 360, colours="OBJECT", sky="#f4ede4")
    parts.camera(FAR + Vector((0.9, -3.9, 1.65)), FAR + Vector((0, 0, 0.52)), lens=42)

    def put(name: str, mesh: bpy.types.Mesh, css: str, *at: float, turn: float = 0) -> None:
        parts.add(name, mesh, css, FAR + Vector(at), (0, 0, turn), tones=1)

    put("Ground", solids.cone(1.3, 1.3, 0.06, 96), "#d8bfa6", 0, 0, -0.06)
    put("Tower", solids.cone(0.3, 0.22, 1.05, 24), "#fffaf0", 0, 0, 0)
    put("Roof", solids.cone(0.32, 0.0, 0.36, 24), "#9d3c3c", 0, 0, 1.05)
    for k in range(36):
        turn = 20 * k - 100
        put(
            f"Step {k + 1:02}",
            solids.box(0.16, 0.1, 0.1),
            ("#264653", "#e9c46a", "#4f8fa8")[k % 3],
            0.36 * cos(radians(turn)),
            0.36 * sin(radians(turn)),
            0.024 * k,
            turn=turn,
        )
    for k in range(20):
        x, y = 1.1 * cos(pi * k / 10), 1.1 * sin(pi * k / 10)
        if k % 2:
            put(f"Ball {k + 1:02}", solids.sphere(0.06, 16, 8), "#2a9d8f", x, y, 0.06)
        else:
            put(
                f"Block {k + 1:02}", solids.box(0.1, 0.1, 0.1), "#e76f51", x, y, 0, turn=18 * k + 30
            )


SCENES = (technical_view, forest, far_away)
