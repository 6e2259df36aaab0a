"""Builds and validates the extension with Blender's own tool: dist/reference_tracer-<version>.zip.

Run by a Python that has bpy. The tool is a script inside it; bpy itself is not imported.
"""

import argparse
import importlib.util
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent


class BuildError(Exception):
    """Something in the project's files keeps the extension from being built."""


def text_of(name: str) -> str:
    return (PROJECT / name).read_text(encoding="utf-8")


def checked_wheel(manifest: dict, package: str, constraints: str) -> Path:
    """The path of trimesh's wheel, once all files agree on the versions.

    Takes the manifest, and the texts of addon/__init__.py and constraints.txt.

    Raises
    ------
    BuildError
        Where two files name different versions.
    """
    [version] = re.findall(r'^__version__ = "(.*)"$', package, flags=re.MULTILINE)
    if manifest["version"] != version:
        raise BuildError(
            f"version {manifest['version']} in blender_manifest.toml, but "
            f"{version} in addon/__init__.py"
        )
    [pinned] = re.findall(r"^trimesh==(\S+)$", constraints, flags=re.MULTILINE)
    expected = [f"./wheels/trimesh-{pinned}-py3-none-any.whl"]
    if manifest["wheels"] != expected:
        raise BuildError(
            f"constraints.txt pins trimesh {pinned}, so blender_manifest.toml should have "
            f"wheels = {expected}, not {manifest['wheels']}"
        )
    return PROJECT / expected[0]


def fetch(wheel: Path) -> None:
    """Fetch a wheel by its file's name, unless it is there."""
    if wheel.exists():
        return
    name, version, _ = wheel.name.split("-", 2)
    run("-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:",
        "--dest", wheel.parent, f"{name}=={version}")  # fmt: skip


def blenders_scripts() -> Path:
    spec = importlib.util.find_spec("bpy")  # finds, does not import
    if spec is None or spec.origin is None:
        raise BuildError("no bpy in this Python; use the one in .venv: make extension")
    [scripts] = Path(spec.origin).parent.glob("[0-9]*/scripts")
    return scripts


def blenders_tool() -> Path:
    return blenders_scripts() / "addons_core/bl_pkg/cli/blender_ext.py"


def run(*arguments: object) -> None:
    subprocess.run([sys.executable, *map(str, arguments)], check=True)


def build(out: Path) -> Path:
    """Build the extension into the folder `out`; returns the path of the zip."""
    manifest = tomllib.loads(text_of("blender_manifest.toml"))
    fetch(checked_wheel(manifest, text_of("addon/__init__.py"), text_of("constraints.txt")))

    tool = blenders_tool()
    # Blender itself passes its list of tags, too; without it any tag would do.
    tags = f"--valid-tags={blenders_scripts() / 'modules/_bpy_internal/extensions/tags.py'}"
    out.mkdir(parents=True, exist_ok=True)
    package = out / f"{manifest['id']}-{manifest['version']}.zip"
    run(tool, "validate", tags, PROJECT)
    run(tool, "build", tags, "--source-dir", PROJECT, "--output-filepath", package)
    run(tool, "validate", tags, package)
    return package


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=PROJECT / "dist", help="folder of the zip")
    try:
        package = build(parser.parse_args().out)
    except BuildError as error:
        print(f"build_extension: {error}", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as error:
        return error.returncode  # the tool has said why
    with zipfile.ZipFile(package) as archive:
        print(*sorted(archive.namelist()), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
