"""Draws over the pictures of a comparison: marks around what differs, and the other picture.

The other picture is on the right of a line that can be dragged. It is a gizmo of the Image Editor,
so Blender itself has it hear the mouse, and forgets it with its class. `gpu` is imported only where
something is drawn: a server has no display.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.types import Context, Event, Image, Region

from ..drawing.judges import label_of
from . import blocks, results
from .long_work import Answer
from .shown import chosen

NEAR = 6  # pixels from the line in which it is caught, at a scale of 1
# All below in pixels at a scale of 1.
_AROUND = 6  # between what differs and the mark around it
_WIDTH = 1.5  # of lines; their black rim is twice as wide
_LETTERS = 12
_WHITE = 1.0, 1.0, 1.0

# Transparent pixels are grey, on both sides. Blender centres an image by half pixels, so a screen's
# pixel may lie between two of it: the later one is shown, as Blender does.
_SHOWN = """
void main() {
  vec4 c = texelFetch(image, ivec2(floor(place + 0.001)), 0);
  color = vec4(c.rgb + 0.03 * (1.0 - c.a), 1.0);
}
"""


class Place(NamedTuple):
    """The place of an image in a region, in its pixels, and of the line."""

    left: float
    right: float
    bottom: float
    top: float
    line: float


def place_of(region: Region, share: float) -> Place:
    """Return where the editor's image lies in its region, with the line at a share of its width."""
    view = region.view2d
    u0, v0 = view.region_to_view(0, 0)
    u1, v1 = view.region_to_view(region.width, region.height)
    across = region.width / (u1 - u0)
    up = region.height / (v1 - v0)
    left = -u0 * across
    bottom = -v0 * up
    return Place(left, left + across, bottom, bottom + up, left + share * across)


def _draw_side(image: Image, at: Place, left: float, right: float) -> None:
    """Draw the part of an image that is between two places of the region."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    from ..live.layers import pixel_shader

    texture = gpu.texture.from_image(image)  # which Blender may have scaled down
    across = texture.width / (at.right - at.left)
    pos = [(x, y) for y in (at.bottom, at.top) for x in (left, right)]
    texel = [(across * (x - at.left), y) for y in (0, texture.height) for x in (left, right)]
    shader = pixel_shader(_SHOWN)
    batch = batch_for_shader(shader, "TRI_STRIP", {"pos": pos, "at": texel})
    shader.uniform_sampler("image", texture)
    batch.draw(shader)


def _draw_lines(ends: Sequence[tuple[float, float]], color: Sequence[float], scale: float) -> None:
    """Draw lines between each two ends, in a colour on a black rim, so they are seen on any."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": [(*end, 0.0) for end in ends]})
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    gpu.state.blend_set("ALPHA")  # the rims of lines are smooth
    for width, shown in ((2 * _WIDTH, (0.0, 0.0, 0.0)), (_WIDTH, color)):
        shader.uniform_float("lineWidth", width * scale)
        shader.uniform_float("color", (*shown, 1.0))
        batch.draw(shader)
    gpu.state.blend_set("NONE")


def _draw_marks(context: Context, at: Place, scale: float) -> None:
    """Draw a frame around each region that differs, in the colour of its cause."""
    import numpy as np

    from ...causes.explain import BY_NUMBER
    from ...files.images import curve

    found = results.of_comparison(context)
    for region in found.regions:
        height, width = found.content.causes.cause.shape
        across = (at.right - at.left) / width
        up = (at.top - at.bottom) / height
        left = at.left + across * region.left - _AROUND * scale
        right = at.left + across * (region.left + region.width) + _AROUND * scale
        bottom = at.bottom + up * region.bottom - _AROUND * scale
        top = at.bottom + up * (region.top + 1) + _AROUND * scale
        corners = (left, bottom), (right, bottom), (right, top), (left, top)
        ends = [end for k in range(4) for end in (corners[k], corners[k - 1])]
        color = BY_NUMBER[region.cause].color or _WHITE
        _draw_lines(ends, curve(np.array(color)).tolist(), scale)


def _draw_names(context: Context, at: Place, scale: float) -> None:
    """Name the picture on each side of the line."""
    import blf

    from ..live.layers import draw_outlined

    comparison = results.comparison(context)
    other = label_of(comparison.case.picture.source) if comparison else "Other"
    size = _LETTERS * scale
    y = min(at.top, context.region.height - 3 * size) - 2 * size
    blf.size(0, size)
    left = iface_("Traced")
    places = {left: at.line - size - blf.dimensions(0, left)[0], iface_(other): at.line + size}
    draw_outlined([(text, x, y) for text, x in places.items()])


class REFERENCE_TRACER_GT_split(bpy.types.Gizmo):
    bl_idname = "REFERENCE_TRACER_GT_split"

    def draw(self, context: Any) -> None:
        """Draw the marks; before them both pictures and the line, if both are shown."""
        import gpu
        from mathutils import Matrix

        region = context.region
        at = place_of(region, context.window_manager.reference_tracer.split)
        scale = context.preferences.system.ui_scale
        screen = Matrix.Diagonal((2 / region.width, 2 / region.height, 1, 1))
        screen.translation = (-1, -1, 0)
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_identity()
            gpu.matrix.load_projection_matrix(screen)
            other = blocks.ours(blocks.BLENDER)
            if other and chosen(context.space_data) == "BOTH":
                _draw_side(blocks.ours(blocks.TRACED), at, at.left, at.line)
                _draw_side(other, at, at.line, at.right)
                _draw_lines([(at.line, at.bottom), (at.line, at.top)], _WHITE, scale)
                _draw_names(context, at, scale)
            _draw_marks(context, at, scale)

    def test_select(self, context: Any, location: Any) -> int:
        """Return 0 where the mouse catches the line, else -1."""
        if chosen(context.space_data) != "BOTH":
            return -1
        at = place_of(context.region, context.window_manager.reference_tracer.split)
        near = NEAR * context.preferences.system.ui_scale
        is_near = abs(location[0] - at.line) <= near and at.bottom <= location[1] <= at.top
        return 0 if is_near else -1

    def invoke(self, context: Any, event: Event) -> Answer:
        self._before = context.window_manager.reference_tracer.split
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Event, tweak: Any) -> Answer:
        """Follow the mouse."""
        at = place_of(context.region, 0)
        share = (event.mouse_region_x - at.left) / (at.right - at.left)
        context.window_manager.reference_tracer.split = share
        return {"RUNNING_MODAL"}

    def exit(self, context: Any, cancel: bool | None) -> None:
        """Put the line back if it is let go by Esc."""
        if cancel:
            context.window_manager.reference_tracer.split = self._before


class REFERENCE_TRACER_GGT_split(bpy.types.GizmoGroup):
    bl_idname = "REFERENCE_TRACER_GGT_split"
    bl_label = "Marks and Other Picture"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SHOW_MODAL_ALL"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        return chosen(context.space_data) is not None

    def setup(self, context: Context) -> None:
        gizmo = self.gizmos.new(REFERENCE_TRACER_GT_split.bl_idname)
        gizmo.use_draw_modal = True


register, unregister = bpy.utils.register_classes_factory(
    (REFERENCE_TRACER_GT_split, REFERENCE_TRACER_GGT_split)
)
