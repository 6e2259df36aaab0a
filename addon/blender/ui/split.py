"""Draws the other picture over the traced one, to the right of a line that can be dragged.

It is a gizmo of the Image Editor, so Blender itself has it hear the mouse, and forgets it with its
class. `gpu` is imported only where something is drawn: a server has no display.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import bpy

from . import results
from .long_work import Answer
from .shown import chosen

NEAR = 6  # pixels from the line in which it is caught, at a scale of 1
_RIM = ((3, (0.0, 0.0, 0.0, 1.0)), (1, (1.0, 1.0, 1.0, 1.0)))  # of the line: widths and colours

# What is transparent is grey: the traced picture would else show through. Blender centres an image
# by half pixels, so a screen's pixel may lie between two of it: the later one is shown, as Blender
# does.
_SHOWN = """
void main() {
  vec4 c = texelFetch(image, ivec2(floor(place + 0.001)), 0);
  color = vec4(c.rgb + 0.03 * (1.0 - c.a), 1.0);
}
"""


@cache
def _shader() -> Any:
    from ..live.layers import pixel_shader

    return pixel_shader(_SHOWN)


class Place(NamedTuple):
    """Where an image lies in a region, in its pixels, and where the line is."""

    left: float
    right: float
    bottom: float
    top: float
    line: float


def place_of(region: Any, share: float) -> Place:
    """Return where the editor's image lies in its region, with the line at a share of its width."""
    view = region.view2d
    u0, v0 = view.region_to_view(0, 0)
    u1, v1 = view.region_to_view(region.width, region.height)
    across = region.width / (u1 - u0)
    up = region.height / (v1 - v0)
    left = -u0 * across
    bottom = -v0 * up
    return Place(left, left + across, bottom, bottom + up, left + share * across)


class REFERENCE_TRACER_GT_split(bpy.types.Gizmo):
    bl_idname = "REFERENCE_TRACER_GT_split"

    def draw(self, context: Any) -> None:
        """Draw the other picture on the right of the line, and the line."""
        other = results.ours(results.BLENDER)
        if other is None:
            return
        import gpu
        from gpu_extras.batch import batch_for_shader
        from mathutils import Matrix

        region = context.region
        at = place_of(region, context.window_manager.reference_tracer.split)
        texture = gpu.texture.from_image(other)  # which Blender may have scaled down
        width, height = texture.width, texture.height
        column = (at.line - at.left) / (at.right - at.left) * width
        pos = [(x, y) for y in (at.bottom, at.top) for x in (at.line, at.right)]
        texel = [(x, y) for y in (0, height) for x in (column, width)]
        screen = Matrix.Diagonal((2 / region.width, 2 / region.height, 1, 1))
        screen.translation = (-1, -1, 0)
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_identity()
            gpu.matrix.load_projection_matrix(screen)
            shader = _shader()
            batch = batch_for_shader(shader, "TRI_STRIP", {"pos": pos, "at": texel})
            shader.uniform_sampler("image", texture)
            batch.draw(shader)
            plain = gpu.shader.from_builtin("UNIFORM_COLOR")
            for half, color in _RIM:
                ends = at.line - half, at.line + half
                pos = [(x, y) for y in (at.bottom, at.top) for x in ends]
                plain.uniform_float("color", color)
                batch_for_shader(plain, "TRI_STRIP", {"pos": pos}).draw(plain)

    def test_select(self, context: Any, location: Any) -> int:
        """Return 0 where the mouse catches the line, else -1."""
        at = place_of(context.region, context.window_manager.reference_tracer.split)
        near = NEAR * context.preferences.system.ui_scale
        is_near = abs(location[0] - at.line) <= near and at.bottom <= location[1] <= at.top
        return 0 if is_near else -1

    def invoke(self, context: Any, event: Any) -> Answer:
        self._before = context.window_manager.reference_tracer.split
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any, tweak: Any) -> Answer:
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
    bl_label = "Traced and Other Picture"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SHOW_MODAL_ALL"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        return chosen(context.space_data) == "BOTH"

    def setup(self, context: Any) -> None:
        gizmo = self.gizmos.new(REFERENCE_TRACER_GT_split.bl_idname)
        gizmo.use_draw_modal = True


register, unregister = bpy.utils.register_classes_factory(
    (REFERENCE_TRACER_GT_split, REFERENCE_TRACER_GGT_split)
)
