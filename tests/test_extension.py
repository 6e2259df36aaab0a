"""The extension as users get it: built by Blender's own tool, then installed from its zip."""

import os
import runpy
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

pytestmark = [pytest.mark.blender, pytest.mark.slow]

PROJECT = Path(__file__).parent.parent
BUILD_SCRIPT = PROJECT / "tools" / "build_extension.py"
MANIFEST = tomllib.loads((PROJECT / "blender_manifest.toml").read_text(encoding="utf-8"))
LEFT_OUT = MANIFEST["build"]["paths_exclude_pattern"]

# Runs in a Blender of its own: installs the zip, uses it, and takes it out again.
INSTALL = """
import sys
from pathlib import Path
import bpy

bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
module = "bl_ext.user_default.reference_tracer"
assert module in bpy.context.preferences.addons.keys(), "not enabled"
assert module + ".addon" in sys.modules, "the shim did not load the code"
bpy.context.scene.render.engine = "REFERENCE_TRACER"

def held():
    folder = Path(sys.modules[module].__file__).parent
    files = [p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts]
    return {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in files}

before = held()
assert len(before) > 100
bpy.ops.mesh.primitive_cube_add()
bpy.ops.reference_tracer.frame_all()
bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 16
bpy.ops.reference_tracer.trade(width=16, samples=1)
bpy.ops.reference_tracer.compare()
bpy.ops.reference_tracer.open_page(open_browser=False)
assert held() == before, "it wrote into its own folder"

bpy.ops.preferences.addon_disable(module=module)
try:
    bpy.context.scene.render.engine = "REFERENCE_TRACER"
except TypeError:
    print("installed, enabled and disabled", flush=True)
"""


def left_out(file: Path) -> bool:
    """Whether the manifest leaves a file of the add-on out of the zip."""
    path = "/" + file.relative_to(PROJECT).as_posix()
    return any(path == p or (p.endswith("/") and path.startswith(p)) for p in LEFT_OUT)


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("dist")
    # The script validates, too, and ends with an error if Blender's tool objects.
    built = subprocess.run(
        [sys.executable, BUILD_SCRIPT, "--out", out], capture_output=True, text=True
    )
    assert built.returncode == 0, built.stdout + built.stderr
    [package] = out.iterdir()
    return package


def test_zip_holds_the_extension_and_nothing_else(package: Path):
    names = set(zipfile.ZipFile(package).namelist())
    code = {
        file.relative_to(PROJECT).as_posix()
        for file in (PROJECT / "addon").rglob("*")
        if file.is_file() and "__pycache__" not in file.parts and not left_out(file)
    }
    top = {"__init__.py", "blender_manifest.toml", "LICENSE", "README.md", "CHANGELOG.md"}
    scenes = {f"sample_scenes/{p.name}" for p in (PROJECT / "sample_scenes").glob("*.blend")}
    scenes.remove("sample_scenes/forest.blend")
    assert code and code | scenes <= names
    [wheel] = names - code - top - scenes
    assert package.stat().st_size < 3e6
    assert wheel.startswith("wheels/trimesh-") and wheel.endswith(".whl")
    assert {"__init__.py", "blender_manifest.toml", "LICENSE"} <= names


def test_installs_works_and_leaves_its_folder_as_it_is(package: Path, tmp_path: Path):
    installed = subprocess.run(
        [sys.executable, "-c", INSTALL, package],
        env=os.environ | {"BLENDER_USER_RESOURCES": str(tmp_path)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    said = installed.stdout + installed.stderr
    assert installed.returncode == 0, said
    assert "installed, enabled and disabled" in installed.stdout, said
    assert "Traceback" not in said, said


@pytest.mark.parametrize(
    ("manifest", "complaint"),
    [
        ({"version": "9.9.9", "wheels": []}, "version 9.9.9"),
        ({"version": "1.2.3", "wheels": ["./wheels/trimesh-1.0-py3-none-any.whl"]}, "pins trimesh"),
    ],
)
def test_build_refuses_versions_that_differ(manifest: dict, complaint: str):
    script = runpy.run_path(str(BUILD_SCRIPT))
    with pytest.raises(script["BuildError"], match=complaint):
        script["checked_wheel"](manifest, '__version__ = "1.2.3"', "trimesh==2.0")
