"""One process is one Blender: the add-on is registered once; each test begins with an empty file.

`build` makes small scenes, `export` and `compare` do to them what the add-on's buttons do.
"""

from __future__ import annotations

import contextlib
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import reference_tracer
from reference_tracer.blender import registration
from reference_tracer.blender.drawing import drawings
from reference_tracer.blender.evaluating import export_for_render
from reference_tracer.blender.jobs import compare as compare_module
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.blender.reading.export import export as export_depsgraph
from reference_tracer.blender.temporary import temporary_scene
from reference_tracer.cli.main import main
from reference_tracer.comparison.comparing import compared
from reference_tracer.tracer.progress import result_of

from .live import kept  # noqa: F401  # a fixture
from .missing import saved  # noqa: F401  # a fixture
from .scenes import Build

SAMPLES = Path(__file__).resolve().parents[2] / "sample_scenes"


@pytest.fixture(scope="session", autouse=True)
def addon():
    reference_tracer.register()
    yield
    reference_tracer.unregister()


@pytest.fixture(scope="session")
def start_up_file(addon, tmp_path_factory) -> str:
    """An empty file with one workspace: read in half the time of Blender's, which has eleven."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.data.batch_remove([w for w in bpy.data.workspaces if w.name != "Layout"])
    path = str(tmp_path_factory.mktemp("empty") / "empty.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    return path


@pytest.fixture(autouse=True)
def empty_file(start_up_file):
    bpy.ops.wm.read_homefile(filepath=start_up_file)


@pytest.fixture
def build() -> Build:
    return Build()


def _export_viewport():
    return export_depsgraph(bpy.context.evaluated_depsgraph_get())


def _export_render():
    with temporary_scene(bpy.context.scene, bpy.context.view_layer.name) as copy:
        return export_for_render(copy)


@pytest.fixture
def export() -> SimpleNamespace:
    """The open scene as the viewport and as a render has it: (Scene, Manifest)."""
    return SimpleNamespace(
        viewport=_export_viewport,
        render=_export_render,
        modes={"VIEWPORT": _export_viewport, "RENDER": _export_render},
    )


@pytest.fixture
def shown_otherwise(monkeypatch):
    """Have Blender's picture of each comparison go through a function."""

    def change(changed):
        real = compare_module._picture
        picture = lambda pixels, **options: real(changed(pixels), **options)  # noqa: E731
        monkeypatch.setattr(compare_module, "_picture", picture)

    return change


@pytest.fixture
def drawn_otherwise(monkeypatch):
    """Have Blender draw each picture of a changed scene, as a wrong exporter's would be of one."""

    @contextlib.contextmanager
    def changed(change, back):
        real = drawings.picture

        def picture(*args):
            change()
            try:
                return (yield from real(*args))
            finally:
                back()

        with monkeypatch.context() as patched:
            patched.setattr(drawings, "picture", picture)
            yield

    return changed


@pytest.fixture
def compare():
    """Trace the open scene and compare it, as the button does."""

    def run(**choices: Any):
        return result_of(compared(gather_case(bpy.context, **choices)))

    return run


@pytest.fixture
def entries():
    """Return a manifest's entries by name, which must be unique."""

    def by_name(manifest: Any) -> dict:
        out = {entry.name: entry for entry in manifest.objects}
        assert len(out) == len(manifest.objects)
        return out

    return by_name


@pytest.fixture
def opened():
    """Open a sample scene, its picture made at most so wide, and so high."""

    def run(name: str, width: int | None = None) -> Any:
        bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{name}.blend"), load_ui=False)
        scene = bpy.context.scene
        if width:
            longer = max(scene.render.resolution_x, scene.render.resolution_y)
            scene.render.resolution_percentage = max(1, 100 * width // longer)
        return scene

    return run


def read_multilayer(path: Any) -> dict[str, dict[str, np.ndarray]]:
    """Return the passes of each view layer, (h, w, channels) with row 0 at the bottom.

    One part of the EXR holds all of them up to 4.5, and one each from 5.0 on.
    """
    import OpenEXR

    found: dict[str, dict[str, dict[str, np.ndarray]]] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            for name, channel in part.channels.items():
                layer, kind, letter = name.rsplit(".", 2)
                pixels = np.array(channel.pixels[::-1])
                found.setdefault(layer, {}).setdefault(kind, {})[letter] = pixels
    return {
        layer: {
            kind: np.stack([c[k] for k in sorted(c, key="RGBAXYZV".index)], axis=-1)
            for kind, c in kinds.items()
        }
        for layer, kinds in found.items()
    }


def set_multilayer(scene: Any, path: Any) -> None:
    """Have renders written as a multilayer EXR of 32 bits, without compression."""
    image = scene.render.image_settings
    if hasattr(image, "media_type"):  # from 5.0 on
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "NONE"
    scene.render.filepath = str(path)


@pytest.fixture
def rendered(tmp_path):
    """Press F12 with the engine that the scene has; gives the passes by view layer and name."""

    def run(engine: str = "REFERENCE_TRACER") -> dict[str, dict[str, np.ndarray]]:
        scene = bpy.context.scene
        scene.render.engine = engine
        set_multilayer(scene, tmp_path / "rendered.exr")
        assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
        return read_multilayer(tmp_path / "rendered.exr")

    return run


@pytest.fixture
def multilayer() -> SimpleNamespace:
    return SimpleNamespace(read=read_multilayer, set=set_multilayer)


@pytest.fixture
def workbench(tmp_path):
    """Blender's own Workbench picture of the open scene by its own settings, but 32-bit EXR."""

    def run(**display: Any) -> np.ndarray:
        scene = bpy.context.scene
        for name, value in display.items():
            setattr(
                scene.display.shading if hasattr(scene.display.shading, name) else scene.display,
                name,
                value,
            )
        scene.render.engine = "BLENDER_WORKBENCH"
        scene.view_settings.view_transform = "Raw"
        image = scene.render.image_settings
        with contextlib.suppress(AttributeError):  # from 5.0 on
            image.media_type = "IMAGE"
        image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGBA", "32"
        scene.render.filepath = str(tmp_path / "workbench.exr")
        bpy.ops.render.render(write_still=True)
        loaded = bpy.data.images.load(scene.render.filepath, check_existing=False)
        width, height = loaded.size
        pixels = np.array(loaded.pixels[:], np.float32).reshape(height, width, 4)
        bpy.data.images.remove(loaded)
        return pixels

    return run


@pytest.fixture
def reftrace(addon, capfd):
    """A command in this process, which has Blender already; what Blender prints is heard, too."""

    def run(*argv: object) -> subprocess.CompletedProcess:
        registration.unregister()  # the command registers by itself, in a process of its own
        capfd.readouterr()
        try:
            code = main([*map(str, argv)])
        finally:
            registration.register()
        return subprocess.CompletedProcess(argv, code, *capfd.readouterr())

    return run
