"""What people make in Blender: a model among solids, a room, text and curves, geometry nodes."""

from __future__ import annotations

from collections.abc import Sequence
from colorsys import hsv_to_rgb
from math import atan2, cos, pi, radians, sin
from random import Random

import bpy

from . import nodes, parts, solids


def suzanne() -> None:
    """The demo: Suzanne, smoothed by a modifier, among a few solids."""
    parts.start("Suzanne", 960, 540, sky="#f8e3d0")
    parts.camera((0.5, -10.8, 2.9), (0.02, 0, 1.38), lens=47)
    parts.add("Floor", solids.cone(3.9, 3.9, 0.16, 128), "#e9b795", (0, -0.15, -0.16), tones=3)
    parts.add(
        "Sun", solids.cone(1.65, 1.65, 0.1, 128), "#f2846b", (-0.02, 3.0, 2.2), (90, 0, 0), tones=1
    )
    parts.add("Pedestal", solids.cone(1.0, 0.86, 0.7, 12), "#3d5a80")
    head = parts.add("Suzanne", solids.monkey(), "#f4b14a", (0, 0, 1.62), (-14, 0, 16), tones=7)
    for css, first, last in (
        ("#fbf3e4", 0, 32),
        ("#3a2e39", 32, 64),
    ):  # her eyes' whites, then their pupils
        head.data.materials.append(parts.material(css))
        for face in head.data.polygons[first:last]:
            face.material_index = len(head.data.materials) - 1
    smooth = head.modifiers.new("Subdivision", "SUBSURF")
    smooth.levels = smooth.render_levels = 2
    parts.add("Sphere", solids.icosphere(0.66, 4), "#98c1d9", (1.95, -0.9, 0.66), tones=9)
    parts.add("Torus", solids.torus(0.62, 0.22, 48, 24), "#a8478a", (-2.1, -1.0, 0.22), tones=8)
    parts.add("Cone", solids.cone(0.62, 0, 1.9, 48), "#5f9e8f", (-2.4, 0.9, 0), tones=7)
    parts.add("Cube", solids.box(1.0, 1.0, 1.0), "#d1495b", (2.4, 1.0, 0), (0, 0, 28))
    parts.add("Cube On Top", solids.box(0.55, 0.55, 0.55), "#f2cc8f", (2.35, 1.0, 1.0), (0, 0, 58))
    parts.add(
        "Icosahedron", solids.icosphere(0.36), "#5c6b8a", (0.95, -2.2, 0.3), (0, 0, 20), tones=7
    )
    parts.add("Tetrahedron", solids.cone(0.5, 0, 0.7, 3), "#f28482", (-0.95, -2.3, 0), (0, 0, 40))


def shifted_room() -> None:
    """An interior as architects draw it: a level camera, the lens shifted, verticals upright."""
    scene = parts.start("Shifted Room", 400, 600, sky="#bfe4f2")
    scene.render.pixel_aspect_y = 1.25
    eye = parts.camera((0.5, -5.6, 1.3), (0.5, 0, 1.3), lens=24)
    eye.data.sensor_fit = "VERTICAL"
    eye.data.sensor_height = 24
    eye.data.shift_x, eye.data.shift_y = -0.06, 0.11
    for k in range(10):
        boards = "#b98b62" if k % 2 else "#c69c72"
        parts.add(
            f"Floor Board {k + 1:02}",
            solids.box(0.34, 7, 0.1),
            boards,
            (-1.53 + 0.34 * k, -1.4, -0.1),
            tones=2,
        )
    parts.add("Back Wall", solids.box(3.4, 0.2, 4.4), "#efe3d0", (0, 2.2, 0))
    parts.add("Right Wall", solids.box(0.2, 7, 4.4), "#d9c8b0", (1.8, -1.4, 0), tones=3)
    parts.add("Ceiling", solids.box(3.4, 7, 0.1), "#f7f1e5", (0, -1.4, 4.4), tones=3)
    parts.add("Window Sill Wall", solids.box(0.2, 7, 0.9), "#e3d4bd", (-1.8, -1.4, 0))
    parts.add("Window Lintel", solids.box(0.2, 7, 0.8), "#e3d4bd", (-1.8, -1.4, 3.6))
    for k in range(5):
        pier = solids.box(0.2, 0.3, 2.7)
        parts.add(f"Window Pier {k + 1}", pier, "#e3d4bd", (-1.8, 1.95 - 1.3 * k, 0.9))
        parts.add(f"Beam {k + 1}", solids.box(3.4, 0.2, 0.22), "#8a6242", (0, 1.6 - 1.3 * k, 4.18))
    parts.add("Rug", solids.cone(1.05, 1.05, 0.03, 64), "#b5485a", (0.05, 0.2, 0), tones=2)
    parts.add("Rug Middle", solids.cone(0.7, 0.7, 0.04, 64), "#e9b872", (0.05, 0.2, 0), tones=2)
    _table((0.05, 0.2, 0), 0.75)
    _chair((0.95, 0.55, 0), -60)
    _chair((-0.75, -0.25, 0), 110)
    _shelf((1.45, 1.2, 0))
    for k, (css, x, z) in enumerate(
        (("#3f6c8f", -0.75, 2.0), ("#d9764a", 0.15, 2.3), ("#5f8f6b", 0.15, 1.6))
    ):
        parts.add(f"Frame {k + 1}", solids.box(0.7, 0.06, 0.56), "#4b3a30", (x, 2.08, z))
        parts.add(
            f"Picture {k + 1}", solids.box(0.58, 0.06, 0.44), css, (x, 2.06, z + 0.06), tones=3
        )
    parts.add("Lamp Cord", solids.box(0.02, 0.02, 1.5), "#333333", (0.05, 0.2, 2.9))
    parts.add("Lamp Shade", solids.cone(0.42, 0.1, 0.34, 32), "#f2b134", (0.05, 0.2, 2.6))


def _table(at: Sequence[float], height: float) -> None:
    x, y, _ = at
    parts.add("Table Top", solids.cone(0.62, 0.62, 0.05, 48), "#7a4e2d", (x, y, height))
    parts.add("Table Leg", solids.cone(0.3, 0.05, height, 24), "#6b4226", at)
    parts.add("Vase", solids.cone(0.05, 0.11, 0.26, 24), "#2f7f86", (x - 0.15, y, height + 0.05))
    parts.add("Bunch", solids.icosphere(0.19, 2), "#e2725b", (x - 0.15, y, height + 0.45))
    parts.add("Orange", solids.sphere(0.07, 24, 12), "#f39c36", (x + 0.22, y - 0.2, height + 0.12))


def _chair(at: Sequence[float], turn: float) -> None:
    """Add a chair, its parts parented to an empty."""
    seat = parts.link(bpy.data.objects.new("Chair", None), at, (0, 0, turn))
    legs = [
        (f"Chair Leg {k + 1}", solids.box(0.05, 0.05, 0.42), (0.18 * i, 0.18 * j, 0))
        for k, (i, j) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1)))
    ]
    rest = [
        ("Chair Seat", solids.box(0.44, 0.44, 0.06), (0, 0, 0.42)),
        ("Chair Back", solids.box(0.44, 0.05, 0.5), (0, 0.2, 0.48)),
    ]
    for name, mesh, place in (*legs, *rest):
        parts.add(name, mesh, "#35606e", place).parent = seat


def _shelf(at: Sequence[float]) -> None:
    """Add a bookshelf full of books against the right wall."""
    x, y, z = at
    dice = Random(3)
    for row in range(6):
        parts.add(
            f"Shelf {row + 1}",
            solids.box(0.34, 1.5, 0.05),
            "#8a6242",
            (x + 0.08, y, z + 0.1 + 0.45 * row),
        )
        along = y - 0.7
        while row < 5 and along < y + 0.66:
            wide, tall = dice.uniform(0.05, 0.11), dice.uniform(0.24, 0.36)
            css = dice.choice(("#c8553d", "#588b8b", "#f2c14e", "#4a5a8c", "#ead7c3", "#7d5ba6"))
            parts.add(
                f"Book {row + 1}.{along - y + 0.7:.2f}",
                solids.box(0.24, wide - 0.008, tall),
                css,
                (x + 0.08, along + wide / 2, z + 0.15 + 0.45 * row),
            )
            along += wide


def text_and_curves() -> None:
    """What Blender turns into triangles and is no mesh: text, a curve, a surface, metaballs."""
    parts.start("Text and Curves", 640, 360, colours="RANDOM", sky="#2b2d42")
    parts.camera((0, -11.6, 5.0), (0, 0, 0.75), lens=47)
    title = parts.text(
        "Ray Equation", "x = o + t d", (-2.95, 0.9, 2.0), 1.15, (90, 0, 0), depth=0.12
    )
    title.data.bevel_depth = 0.015
    _curve(
        "Ray",
        [(-3.7, 0.2, 0.25), (-1.9, -0.8, 1.6), (0.1, -0.6, 0.45), (2.0, 0.8, 1.3), (3.7, 0.2, 2.9)],
    )
    _torus_of_nurbs("NURBS Torus", (-2.2, -1.2, 0.75))
    family = bpy.data.metaballs.new("Metaball Family")
    family.resolution = family.render_resolution = 0.12
    for x, y, z, radius in (
        (0, 0, 0.5, 0.8),
        (0.75, -0.25, 0.75, 0.7),
        (1.25, 0, 0.3, 0.6),
        (0.5, -0.25, 1.25, 0.5),
    ):
        ball = family.elements.new()
        ball.co, ball.radius = (x, y, z), radius
    parts.link(bpy.data.objects.new("Metaball Family", family), (1.3, -1.0, 0.1))
    parts.add("Stage", solids.cone(3.5, 3.5, 0.15, 96), "#cccccc", (0, 0.2, -0.15), tones=1)


def _torus_of_nurbs(name: str, at: Sequence[float]) -> None:
    """Add a NURBS surface: only an operator can make one with two directions."""
    bpy.ops.surface.primitive_nurbs_surface_torus_add(location=at)
    torus = bpy.context.view_layer.objects.active
    torus.rotation_euler = (0.75, 0.3, 0)
    torus.name = torus.data.name = name
    torus.scale = (0.85, 0.85, 0.85)


def _curve(name: str, points: Sequence[Sequence[float]]) -> None:
    """Add a round Bézier curve through these points."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions, curve.bevel_depth, curve.bevel_resolution, curve.use_fill_caps = (
        "3D",
        0.07,
        4,
        True,
    )
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(points) - 1)
    for knot, point in zip(spline.bezier_points, points, strict=True):
        knot.co, knot.handle_left_type, knot.handle_right_type = point, "AUTO", "AUTO"
    parts.link(bpy.data.objects.new(name, curve))


def geometry_nodes() -> None:
    """Instances by nodes and by a collection, some mirrored; realised geometry; colour attributes.

    The lanterns have no colour attribute: Blender 4.2 then shows the object's colour, here that of
    the empties, and 5.0 and 5.2 the material's.
    """
    parts.start("Geometry Nodes", 640, 360, colours="VERTEX", sky="#22223b")
    parts.camera((0, -11.5, 5.6), (0, 0.6, 0.35), lens=48)
    nodes.ripple(_rainbow("Ripple", 40, 0.17))
    sources = nodes.hidden_collection("Sources")
    gem = parts.add("Gem", solids.cone(0.17, 0.0, 0.5, 5), "#ffe8b6", collection=sources)
    crown = parts.add(
        "Crown Of Instances", solids.polygons([(0, 0, 0)], []), "#ffe8b6", (0, 0, 0.25), tones=1
    )
    nodes.crown(crown, gem, radius=2.1)
    nodes.realised_crown(_rainbow("Realised Crown", 1, 0.3), gem, radius=1.1)
    _lanterns(nodes.hidden_collection("Lantern"))


def _lanterns(lantern: bpy.types.Collection) -> None:
    """Add empties that instance a collection, each in its own colour, half of them mirrored."""
    parts.add("Post", solids.cone(0.12, 0.05, 1.5, 8), "#c9ada7", collection=lantern)
    parts.add("Arm", solids.box(0.55, 0.06, 0.06), "#c9ada7", (0.25, 0, 1.4), collection=lantern)
    parts.add("Lamp", solids.icosphere(0.2), "#ffd166", (0.48, 0, 1.2), collection=lantern)
    for k, css in enumerate(("#ef476f", "#ffd166", "#06d6a0", "#118ab2", "#f78c6b", "#c77dff")):
        round_the_back = radians(168 - 31.2 * k)
        at = (4.4 * cos(round_the_back), 3.9 * sin(round_the_back), 0)
        empty = parts.link(bpy.data.objects.new(f"Lantern {k + 1}", None), at)
        empty.instance_type, empty.instance_collection = "COLLECTION", lantern
        empty.color = (*parts.rgb(css), 1.0)
        empty.scale.x = 1 if k < 3 else -1


def _rainbow(name: str, count: int, size: float) -> bpy.types.Object:
    """Add a square grid whose colour attribute has the colour circle about its middle."""
    obj = parts.add(name, solids.tiles(count, size, "#ffffff", "#ffffff"), "#ffffff", tones=1)
    colours = obj.data.color_attributes.new("Colour", "FLOAT_COLOR", "POINT")
    for vertex, item in zip(obj.data.vertices, colours.data, strict=True):
        hue = atan2(vertex.co.y, vertex.co.x) / (2 * pi) + 0.5
        item.color = (*hsv_to_rgb(hue, 0.8, min(0.12 + 0.11 * vertex.co.length, 1.0)), 1.0)
    obj.data.color_attributes.active_color = colours
    return obj


SCENES = (suzanne, shifted_room, text_and_curves, geometry_nodes)
