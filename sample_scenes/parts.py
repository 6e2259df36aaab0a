"""What the sample scenes are built from: the scene itself, colours, cameras, objects.

In come names, places in metres and colours as in CSS; out come objects in the current scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import radians

import bpy
from mathutils import Vector

LIGHT = Vector((-0.2, -0.5, 0.85)).normalized()  # where the painted tones seem to be lit from
SHADOW = "#2a2a5e"  # what a tone is mixed with as it turns away from LIGHT


def rgb(css: str) -> tuple[float, float, float]:
    """Return '#rrggbb' as linear red, green, blue, which is what Blender stores."""
    srgb = (int(css[i : i + 2], 16) / 255 for i in (1, 3, 5))
    red, green, blue = (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in srgb)
    return red, green, blue


def mixed(css: str, other: str, amount: float) -> str:
    """Return the colour that lies `amount` (0 to 1) of the way from `css` to `other`."""
    pairs = ((int(css[i : i + 2], 16), int(other[i : i + 2], 16)) for i in (1, 3, 5))
    return "#" + "".join(f"{round(a + (b - a) * amount):02x}" for a, b in pairs)


def material(css: str) -> bpy.types.Material:
    """Return the material with this viewport colour, made the first time it is asked for."""
    found = bpy.data.materials.get(css) or bpy.data.materials.new(css)
    found.diffuse_color = (*rgb(css), 1.0)
    return found


def start(
    name: str, width: int, height: int, colours: str = "MATERIAL", sky: str = "#e9ecf2"
) -> bpy.types.Scene:
    """Empty Blender and return its one scene: Workbench, flat light, colour type `colours`."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.name = name
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.filepath = "//"
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = rgb(sky)
    for space in (area.spaces.active for screen in bpy.data.screens for area in screen.areas):
        if space.type == "VIEW_3D":
            space.region_3d.view_perspective = "CAMERA"
        if space.type == "PROPERTIES":
            space.context = "RENDER"  # where the extension's panel is
        if (
            space.type == "FILE_BROWSER"
        ):  # it came up in the user's own folder, which is nobody's business
            space.params.directory = (
                b"/" * 1000
            )  # the whole of it, since a shorter name leaves the rest in the file
            space.params.directory = b"//"
    for shading in _shadings(scene):
        shading.light = "FLAT"
        shading.color_type = colours
        shading.background_type = "WORLD"
    return scene


def single_colour(scene: bpy.types.Scene, css: str) -> None:
    """Set the one colour of the colour type SINGLE."""
    for shading in _shadings(scene):
        shading.single_color = rgb(css)


def _shadings(scene: bpy.types.Scene) -> list:
    """Return the shading of the Workbench render and of all 3D views."""
    spaces = [area.spaces.active for screen in bpy.data.screens for area in screen.areas]
    return [scene.display.shading, *(space.shading for space in spaces if space.type == "VIEW_3D")]


def camera(
    location: Sequence[float],
    target: Sequence[float],
    lens: float = 50.0,
    ortho_scale: float = 0.0,
    clip_end: float = 100.0,
) -> bpy.types.Object:
    """Add the scene's camera, looking at `target`; orthographic where `ortho_scale` is given."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    data.clip_end = clip_end
    if ortho_scale:
        data.type = "ORTHO"
        data.ortho_scale = ortho_scale
    eye = bpy.data.objects.new("Camera", data)
    eye.location = location
    eye.rotation_euler = (Vector(target) - Vector(location)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(eye)
    bpy.context.scene.camera = eye
    return eye


def link(
    obj: bpy.types.Object,
    location: Sequence[float] = (0, 0, 0),
    turn: Sequence[float] = (0, 0, 0),
    collection: bpy.types.Collection | None = None,
) -> bpy.types.Object:
    """Put an object into the scene or a collection, turned by `turn` degrees about X, Y, Z."""
    if obj.data:
        obj.data.name = obj.name
    obj.location = location
    obj.rotation_euler = [radians(angle) for angle in turn]
    (collection or bpy.context.scene.collection).objects.link(obj)
    return obj


def add(
    name: str,
    mesh: bpy.types.Mesh,
    css: str,
    location: Sequence[float] = (0, 0, 0),
    turn: Sequence[float] = (0, 0, 0),
    tones: int = 5,
    collection: bpy.types.Collection | None = None,
) -> bpy.types.Object:
    """Add a mesh in one colour: as the object's colour, and as the tones of its faces."""
    obj = link(bpy.data.objects.new(name, mesh), location, turn, collection)
    obj.color = (*rgb(css), 1.0)
    paint(obj, css, tones)
    return obj


def paint(obj: bpy.types.Object, css: str, tones: int = 5) -> None:
    """Give each face one of `tones` materials by how far it is turned from LIGHT."""
    turned = obj.matrix_basis.to_3x3()
    dots = [(turned @ face.normal).dot(LIGHT) for face in obj.data.polygons]
    steps = (
        [round(min(max((dot + 0.4) / 1.3, 0.0), 1.0) * (tones - 1)) for dot in dots]
        if tones > 1
        else [0] * len(dots)
    )
    used = sorted(set(steps))
    for step in used:
        shade = 1 - step / (tones - 1) if tones > 1 else 0.0
        obj.data.materials.append(material(mixed(css, SHADOW, 0.5 * shade)))
    obj.data.polygons.foreach_set("material_index", [used.index(step) for step in steps])


def text(
    name: str,
    body: str,
    location: Sequence[float],
    size: float,
    turn: Sequence[float] = (0, 0, 0),
    depth: float = 0.0,
) -> bpy.types.Object:
    """Add a text in Blender's own font, `depth` metres thick on either side."""
    curve = bpy.data.curves.new(name, "FONT")
    curve.body, curve.size, curve.extrude = body, size, depth
    return link(bpy.data.objects.new(name, curve), location, turn)
