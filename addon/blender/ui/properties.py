"""What the user sets: stored in the .blend on the scene and its objects, or of the moment.

`properties.toml` has their names, texts and limits, and those of the operators' properties. Results
are not stored here: see `results.py`.
"""

# mypy: disable-error-code="valid-type"

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

from ...methods import RECORDS, Method
from ..drawing import judges
from . import results

if TYPE_CHECKING:
    from ...tracer.settings import Settings

SAID, SCENARIOS = (
    tomllib.loads(path.read_text(encoding="utf-8"))
    for path in (
        Path(__file__).with_suffix(".toml"),
        Path(__file__).parents[2] / "study" / "scenarios" / "sweeps.toml",
    )
)
_SCENE, _LAYER, _OBJECT, _WINDOW = (SAID[of] for of in ("scene", "layer", "object", "window"))

METHOD_ITEMS = tuple(
    (m.value, r.label, r.description, r.number) for m, r in reversed(RECORDS.items())
)
PRECISIONS, SHADINGS, COLORS, PASS_ITEMS, SOURCES = (
    tuple(map(tuple, SAID[items]))
    for items in ("precisions", "shadings", "colors", "passes", "sources")
)
JUDGE_ITEMS = (
    (judges.AUTO, "Automatic", judges.AUTO_IS, 0),
    *((j.name.upper(), j.label, j.description, j.number) for j in judges.choices().values()),
)
SHOW_ITEMS = (
    *map(tuple, SAID["shows"]),
    *((name.upper(), *said, 4 + number) for name, *said, number in COLORS),
)
SWEEPS, MAPS = (
    tuple((s["name"], s["title"], s["explanation"].rstrip(".")) for s in SCENARIOS[kind])
    for kind in ("scenario", "map")
)


def _redraw(owner: Any, context: Any) -> None:
    results.redraw(context)  # the 3D views in Rendered mode


class ReferenceTracerScene(bpy.types.PropertyGroup):
    """How to trace and compare this scene."""

    method: EnumProperty(items=METHOD_ITEMS, update=_redraw, **_SCENE["method"])
    precision: EnumProperty(items=PRECISIONS, update=_redraw, **_SCENE["precision"])
    samples: IntProperty(update=_redraw, **_SCENE["samples"])
    color: EnumProperty(items=COLORS, update=_redraw, **_SCENE["color"])
    show: EnumProperty(items=SHOW_ITEMS, update=_redraw, **_SCENE["show"])
    judge: EnumProperty(items=JUDGE_ITEMS, **_SCENE["judge"])
    shading: EnumProperty(items=SHADINGS, **_SCENE["shading"])
    identity: BoolProperty(**_SCENE["identity"])
    self_check: BoolProperty(**_SCENE["self_check"])

    def settings(self) -> Settings:
        """Return what the tracer is to use; a precision that is greyed out does not count."""
        from ...tracer.settings import Precision, Settings

        precision = self.precision if self.has_precision else Precision.FLOAT64
        return Settings(self.method, precision, self.samples, color=self.color)

    @property
    def has_precision(self) -> bool:
        """Whether the method leaves a choice of the precision."""
        return Method(self.method).is_plain


def _tell_the_compositor(layer: ReferenceTracerLayer, _: object) -> None:
    for each in layer.id_data.view_layers:
        each.update_render_passes()


class ReferenceTracerLayer(bpy.types.PropertyGroup):
    """What is rendered of a view layer."""

    passes: EnumProperty(
        items=PASS_ITEMS, options={"ENUM_FLAG"}, update=_tell_the_compositor, **_LAYER["passes"]
    )


class ReferenceTracerObject(bpy.types.PropertyGroup):
    """What an object is to the tracer."""

    infinite_plane: BoolProperty(**_OBJECT["infinite_plane"])


class ReferenceTracerWindow(bpy.types.PropertyGroup):
    """What the panels show at the moment, and what a click of the inspector does; not stored."""

    precision: EnumProperty(items=PRECISIONS, options={"SKIP_SAVE"}, **_WINDOW["precision"])
    scenario: EnumProperty(items=SWEEPS, options={"SKIP_SAVE"}, **_WINDOW["scenario"])
    draw_ray: BoolProperty(options={"SKIP_SAVE"}, **_WINDOW["draw_ray"])


# Where each is: the type of Blender's, and the name there.
POINTERS = (
    (bpy.types.Scene, "reference_tracer", ReferenceTracerScene),
    (bpy.types.ViewLayer, "reference_tracer", ReferenceTracerLayer),
    (bpy.types.Object, "reference_tracer", ReferenceTracerObject),
    (bpy.types.WindowManager, "reference_tracer", ReferenceTracerWindow),
)


def register() -> None:
    """Register the property groups."""
    for owner, name, group in POINTERS:
        bpy.utils.register_class(group)
        setattr(owner, name, PointerProperty(type=group))


def unregister() -> None:
    """Undo :func:`register`."""
    for owner, name, group in reversed(POINTERS):
        delattr(owner, name)
        bpy.utils.unregister_class(group)
