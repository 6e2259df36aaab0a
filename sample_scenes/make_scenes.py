"""Build the sample scenes.

With the bpy wheel: `python sample_scenes/make_scenes.py [NAME ...] [--out DIR]`;
with Blender itself: `blender -b -P sample_scenes/make_scenes.py -- [NAME ...] [--out DIR]`.

Build what is committed with Blender 4.2, the oldest that the add-on supports: an older Blender
can't be counted on to open what a newer one saved.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
if str(HERE.parent) not in sys.path:  # Blender doesn't put a script's folder there
    sys.path.insert(0, str(HERE.parent))

from sample_scenes import everyday, exercise, hard  # noqa: E402  (needs the path above)

SCENES = {build.__name__: build for build in (*exercise.SCENES, *everyday.SCENES, *hard.SCENES)}


def register_properties() -> None:
    """Register the add-on's own properties, unless they are: `infinite_plane` is one of them."""
    if hasattr(bpy.types.Object, "reference_tracer"):
        return
    if importlib.util.find_spec("reference_tracer") is None:
        # Not installed: the folder addon/ is that package.
        folder = HERE.parent / "addon"
        spec = importlib.util.spec_from_file_location(
            "reference_tracer", folder / "__init__.py", submodule_search_locations=[str(folder)]
        )
        sys.modules[spec.name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[spec.name])
    importlib.import_module("reference_tracer.blender.ui.properties").register()


def make(name: str, folder: Path) -> Path:
    """Build one scene in an emptied Blender and save it as `folder`/`name`.blend."""
    register_properties()
    SCENES[name]()
    bpy.context.view_layer.update()
    path = folder.resolve() / f"{name}.blend"
    path.unlink(missing_ok=True)  # or Blender keeps the old one as .blend1
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, copy=True)
    return path


def main(arguments: list[str]) -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="make_scenes.py", description="Build the sample scenes.")
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help=f"one of {', '.join(SCENES)}; all of them if none is given",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=HERE,
        help="folder for the .blend files (default: beside this script)",
    )
    options = parser.parse_args(arguments)
    unknown = [name for name in options.names if name not in SCENES]
    if unknown:
        parser.error(f"no scene is named {', '.join(unknown)}; there are {', '.join(SCENES)}")
    options.out.mkdir(parents=True, exist_ok=True)
    for name in options.names or SCENES:
        path = make(name, options.out)
        print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    given = sys.argv[1:]
    if bpy.app.binary_path:  # Blender itself, whose own arguments come first
        given = given[given.index("--") + 1 :] if "--" in given else []
    main(given)
