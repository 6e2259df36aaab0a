"""A scene, an add-on's engine and a rendered file: pictures that no judge of ours drew."""

from __future__ import annotations

import bpy
import pytest
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.blender.versions import set_format

from .toy_engine import ToyEngine

OPS = bpy.ops.reference_tracer


@pytest.fixture
def toy(monkeypatch):
    """Register the engine; its faults are put back."""
    for name in ("offset", "left_out", "is_opaque"):
        monkeypatch.setattr(ToyEngine, name, getattr(ToyEngine, name))
    bpy.utils.register_class(ToyEngine)
    yield ToyEngine
    bpy.utils.unregister_class(ToyEngine)


@pytest.fixture
def solids(build):
    scene = build.scene(96, 54, "OBJECT")
    build.solids()
    for obj, rgb in zip(
        ("Floor", "Red", "Green", "Blue"),
        ((0.3, 0.3, 0.3), (0.8, 0.1, 0.1), (0.1, 0.7, 0.2), (0.1, 0.2, 0.9)),
        strict=True,
    ):
        bpy.data.objects[obj].color = (*rgb, 1)
    build.corner_camera(lens=40)
    return scene


def told():
    """Return the names of the faults that the latest comparison tells."""
    diagnosis = results.content(Kind.COMPARISON, bpy.context.scene).diagnosis
    return [t.fault.name for t in diagnosis.told] if diagnosis else []


@pytest.fixture
def rendered_png(solids, tmp_path):
    """Render by Workbench, flat, and save a PNG; returns its path."""
    solids.display.shading.light = "FLAT"
    solids.display.shading.show_specular_highlight = False
    solids.display.render_aa = "OFF"
    solids.render.film_transparent = True
    solids.render.engine = "BLENDER_WORKBENCH"
    solids.view_settings.view_transform = "Standard"
    set_format(solids.render, "PNG", "RGBA", "8")
    path = tmp_path / "rendered.png"
    solids.render.filepath = str(path)
    solids.reference_tracer.judge = "IMAGE"

    def run():
        bpy.ops.render.render(write_still=True)
        return path

    return run
