"""One direction: only `addon/blender/` knows Blender, and no import runs up a floor."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ADDON = Path(__file__).parent.parent / "addon"

# From the ground up. A module may import from its own floor and those below it.
FLOORS = {
    "scene": 0,
    "manifest": 0,
    "images": 0,
    "interrupts": 0,
    "tracer": 1,
    "scene_files": 1,
    "arguments": 1,
    "compare": 2,
    "study": 2,
    "explain": 2,
    "report": 3,
    "blender": 4,
    "opening": 4,
    "commands": 4,
    "cli": 4,
    "__init__": 4,
}
BLENDERS_OWN = {"bl_math", "blf", "bmesh", "bpy", "bpy_extras", "gpu", "gpu_extras", "mathutils"}
# These may reach for Blender once they run, but not when they are imported.
LAZY = {"cli", "commands", "opening", "__init__"}


def imports(node: ast.AST, in_function: bool = False) -> Iterator[tuple[ast.stmt, bool]]:
    """All imports below a node, and whether each waits inside a function."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child, in_function
        inside = in_function or isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from imports(child, inside)


def modules(statement: ast.Import | ast.ImportFrom, package: list[str]) -> list[str]:
    """What an import names: dotted paths within addon begin with a dot, others do not.

    `package` is the folder that the statement stands in, as a path within addon.
    """
    if isinstance(statement, ast.Import):
        return [alias.name for alias in statement.names]
    if statement.level == 0:
        return [statement.module]
    if statement.level > len(package) + 1:
        return ["..outside of addon"]
    base = package[: len(package) + 1 - statement.level]
    base += statement.module.split(".") if statement.module else []
    if base:
        return ["." + ".".join(base)]
    return ["." + alias.name for alias in statement.names]  # from .. import scene


def violations(path: str, source: str) -> list[str]:
    """What a module's imports break; `path` is that of its file within addon."""
    package = path.removesuffix(".py").split("/")[:-1]
    unit = path.removesuffix(".py").split("/")[0]
    if unit not in FLOORS:
        return [f"{path} stands on no floor: give it one in FLOORS"]
    found = []
    for statement, in_function in imports(ast.parse(source)):
        waits = unit in LAZY and in_function
        where = f"{path}:{statement.lineno}"
        for name in modules(statement, package):
            target = name.lstrip(".").split(".")[0]
            if not name.startswith("."):
                if target in {"addon", "reference_tracer"}:
                    found.append(f"{where} imports {name} by its absolute name")
                if target in BLENDERS_OWN and unit != "blender" and not waits:
                    found.append(f"{where} imports {name}, which only addon/blender may")
            elif target == "__version__":
                continue  # not a module
            elif target not in FLOORS:
                found.append(f"{where} imports {name}, which stands on no floor")
            elif FLOORS[target] > FLOORS[unit]:
                found.append(f"{where} imports {name} from a floor above its own")
            elif target == "blender" and unit != "blender" and not waits:
                found.append(f"{where} imports {name} before it is called")
    return found


def test_imports_keep_to_the_structure():
    files = sorted(ADDON.rglob("*.py"))
    assert files
    found = [
        violation
        for file in files
        for violation in violations(
            file.relative_to(ADDON).as_posix(), file.read_text(encoding="utf-8")
        )
    ]
    assert not found, "\n".join(found)


def test_only_one_function_of_the_command_line_opens_blender():
    functions = [
        node.name
        for path in (ADDON / "cli.py", ADDON / "opening.py", *(ADDON / "commands").glob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef)
        and any("bpy" in modules(statement, []) for statement, _ in imports(node))
    ]
    assert len(functions) == 1, functions


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("tracer/render.py", "import bpy"),
        ("tracer/render.py", "import numpy, bpy.types"),
        ("tracer/render.py", "def f():\n    from mathutils import Vector"),
        ("scene.py", "try:\n    import gpu\nexcept ImportError:\n    pass"),
        ("cli.py", "import bpy"),
        ("cli.py", "from .blender import export"),
        ("cli.py", "class Command:\n    from . import blender"),
        ("scene.py", "from .tracer import camera"),
        ("scene.py", "from . import images, tracer"),
        ("tracer/deep/er.py", "from ...compare.metrics import rmse"),
        ("tracer/camera.py", "def f():\n    from .. import compare"),
        ("report/page.py", "from ..cli import main"),
        ("tracer/camera.py", "from ...addon import scene"),
        ("tracer/camera.py", "from reference_tracer.scene import Scene"),
        ("blender/export.py", "import addon.scene"),
        ("tracer/camera.py", "from ..helpers import anything"),
        ("helpers.py", ""),
    ],
)
def test_a_violation_is_found(path: str, source: str):
    assert len(violations(path, source)) == 1


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("tracer/render.py", "import numpy\nfrom ..scene import Scene\nfrom . import camera"),
        ("blender/export.py", "import bpy\nfrom ..tracer import render\nfrom .camera import view"),
        ("cli.py", "from . import __version__"),
        ("cli.py", "def f():\n    import bpy\n    from .blender import export"),
        ("__init__.py", "def register():\n    from .blender import registration"),
    ],
)
def test_what_is_allowed_passes(path: str, source: str):
    assert violations(path, source) == []
