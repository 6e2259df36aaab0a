"""One direction: only `addon/blender/` knows Blender; no import runs up a floor or in a circle."""

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

ADDON = Path(__file__).parent.parent / "addon"

# From the ground up. A module may import from its own floor and those below it.
FLOORS = {
    "arrays": 0,
    "certainty": 0,
    "manifest": 0,
    "projections": 0,
    "scene": 0,
    "translations": 0,
    "wording": 0,
    "methods": 1,
    "tracer": 1,
    "files": 1,
    "framing": 1,
    "camera_files": 1,
    "opened": 2,
    "certified": 2,
    "rendering": 2,
    "pictures": 3,
    "causes": 4,
    "diagnosis": 5,
    "comparison": 6,
    "study": 3,
    "derivation": 3,
    "visible": 3,
    "errors": 3,
    "report": 7,
    "api": 7,
    "blender": 8,
    "cli": 8,
    "__init__": 8,
}
BLENDERS_OWN = {"bl_math", "blf", "bmesh", "bpy", "bpy_extras", "gpu", "gpu_extras", "mathutils"}
# These may reach for Blender once they run, but not when they are imported.
LAZY = {"cli", "__init__"}


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


def name_of(file: Path) -> str:
    """The dotted path within addon of a file; that of a package, of its __init__.py."""
    parts = file.relative_to(ADDON).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {name_of(file): file for file in sorted(ADDON.rglob("*.py"))}


def imported(name: str, source: str, known: Mapping[str, object]) -> set[str]:
    """Which modules of addon a module names in its imports, wherever these stand."""
    is_package = name in FILES and FILES[name].name == "__init__.py"
    package = name.split(".") if name else []
    package = package if is_package else package[:-1]
    found = set()
    for statement, _ in imports(ast.parse(source)):
        if not isinstance(statement, ast.ImportFrom) or not statement.level:
            continue
        base = package[: len(package) + 1 - statement.level]
        base += statement.module.split(".") if statement.module else []
        for alias in statement.names:
            inner = ".".join((*base, alias.name))
            found.add(inner if inner in known else ".".join(base))
    return found & known.keys() - {name}


@cache  # once it is asked for: every process of the tests collects this file
def whole_graph() -> dict[str, set[str]]:
    """What each module of addon imports of it."""
    return {name: imported(name, file.read_text("utf-8"), FILES) for name, file in FILES.items()}


def reached(graph: Mapping[str, set[str]], start: set[str]) -> set[str]:
    """What is imported in the end, the packages that it stands in included."""
    found: set[str] = set()
    todo = list(start)
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += graph[name]
            todo += [name.rpartition(".")[0]] if name else []
    return found


def circle(graph: Mapping[str, set[str]]) -> list[str]:
    """Modules that import one another in a circle, the first of them last again; [] for none."""
    done: set[str] = set()

    def search(name: str, path: list[str]) -> list[str]:
        if name in path:
            return [*path[path.index(name) :], name]
        if name in done:
            return []
        done.add(name)
        for other in sorted(graph[name]):
            if found := search(other, [*path, name]):
                return found
        return []

    return next((found for name in graph if (found := search(name, []))), [])


def test_no_import_runs_in_a_circle():
    """Not within a floor either, and not by waiting inside a function."""
    assert not circle(whole_graph())


# Blender's rooms, each of which knows only those before it.
ROOMS = ("reading", "drawing", "jobs", "live", "ui")


def test_a_room_of_blenders_knows_only_those_before_it():
    """And what they share beneath them: the temporary scene, values, versions."""
    graph = whole_graph()
    for number, room in enumerate(ROOMS):
        own = {name for name in graph if name.startswith(f"blender.{room}.")}
        known = {
            other.split(".")[1] for name in own for other in graph[name] if "blender." in other
        }
        assert own and known.isdisjoint(ROOMS[number + 1 :]), room


OF_COMMANDS = {"print", "isatty", "exit", "exit_code", "SystemExit"}


def test_blenders_part_neither_prints_nor_ends_a_command():
    """What is printed, and the exit code, is the command line's; the console's log is `say`'s."""
    for file in (ADDON / "blender").rglob("*.py"):
        nodes = list(ast.walk(ast.parse(file.read_text(encoding="utf-8"))))
        named = {n.id for n in nodes if isinstance(n, ast.Name)}
        named |= {n.attr for n in nodes if isinstance(n, ast.Attribute)}
        assert named.isdisjoint(OF_COMMANDS), file


def test_the_tracer_knows_the_scene_and_nothing_of_blender():
    start = {name for name in whole_graph() if name.split(".")[0] == "tracer"}
    assert start
    # The package itself imports Blender's part once it is registered there.
    units = {name.split(".")[0] for name in reached(whole_graph() | {"": set()}, start)}
    assert units <= {
        "",
        "arrays",
        "certainty",
        "files",
        "manifest",
        "methods",
        "projections",
        "scene",
        "tracer",
        "wording",
    }


def test_imports_keep_to_the_structure():
    assert FILES
    found = [
        violation
        for file in FILES.values()
        for violation in violations(
            file.relative_to(ADDON).as_posix(), file.read_text(encoding="utf-8")
        )
    ]
    assert not found, "\n".join(found)


def test_only_one_function_of_the_command_line_opens_blender():
    functions = [
        node.name
        for path in (ADDON / "cli").rglob("*.py")
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
        ("cli/main.py", "import bpy"),
        ("cli/main.py", "from ..blender import export"),
        ("cli/main.py", "class Command:\n    from .. import blender"),
        ("scene.py", "from .tracer import camera"),
        ("scene.py", "from . import arrays, tracer"),
        ("tracer/deep/er.py", "from ...pictures.metrics import rmse"),
        ("tracer/camera.py", "def f():\n    from .. import causes"),
        ("report/page.py", "from ..cli import main"),
        ("tracer/camera.py", "from ...addon import scene"),
        ("tracer/camera.py", "from reference_tracer.scene import Scene"),
        ("blender/reading/export.py", "import addon.scene"),
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
        (
            "blender/reading/export.py",
            "import bpy\nfrom ...tracer import render\nfrom .camera import view",
        ),
        ("cli/main.py", "from .. import __version__"),
        ("cli/main.py", "def f():\n    import bpy\n    from ..blender import export"),
        ("__init__.py", "def register():\n    from .blender import registration"),
    ],
)
def test_what_is_allowed_passes(path: str, source: str):
    assert violations(path, source) == []


PROOF = ADDON / "certified"


def is_empty(file: Path) -> bool:
    """Whether a file holds nothing but a docstring."""
    module = ast.parse(file.read_text(encoding="utf-8"))
    return len(module.body) == (ast.get_docstring(module) is not None)


def needed_by(file: Path) -> set[Path]:
    """The files of the add-on that a module imports, itself and through others.

    But what it names in annotations alone, and packages that hold no code.
    """
    found, waiting = set(), [file]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found.add(file)
        tree = ast.parse(file.read_text(encoding="utf-8"))
        tree.body = [n for n in tree.body if "TYPE_CHECKING" not in ast.dump(n)[:60]]
        package = list(file.parent.relative_to(ADDON).parts)
        for statement, _ in imports(tree):
            if isinstance(statement, ast.ImportFrom):
                names = modules(statement, package)
                names += [f"{n}.{alias.name}" for n in names for alias in statement.names]
                for path in (ADDON.joinpath(*name.split(".")) for name in names):
                    holds = path / "__init__.py", path.with_suffix(".py")
                    waiting += [p for p in holds if p.exists() and not is_empty(p)]
    return found


# What a newcomer reads who came for plane and triangle.
EXERCISE = "camera", "plane", "triangle", "nearest", "render"


def test_the_exercise_knows_nothing_of_the_proof():
    """Not through others either, nor late."""
    for name in EXERCISE:
        needed = needed_by(ADDON / "tracer" / f"{name}.py")
        assert not any(PROOF in file.parents for file in needed), name
        assert ADDON / "rendering.py" not in needed


def test_the_exercise_is_found_in_ten_files():
    """From the loop over a picture to plane and triangle, each names the next."""
    own = {ADDON / "tracer" / f"{name}.py" for name in EXERCISE}
    named = {FILES[name] for file in own for name in whole_graph()[name_of(file)]}
    named.add(FILES["tracer.triangle"])  # of the methods, by their names
    assert own - {ADDON / "tracer" / "render.py"} <= named


def test_a_package_with_code_is_needed_too():
    assert ADDON / "projections" / "__init__.py" in needed_by(ADDON / "scene" / "camera.py")


@pytest.mark.slow
def test_the_definition_does_without_the_sweep():
    for file in PROOF.glob("*.py"):
        assert not any("sweep" in path.parts for path in needed_by(file)), file
