"""What Blender is given: all that it can reach, and nothing that an extension must not do."""

from __future__ import annotations

import ast
import tomllib
from pathlib import Path

from .test_structure import ADDON, FILES, reached, whole_graph


def shipped() -> dict[str, Path]:
    """The modules that the manifest leaves in the extension's zip."""
    manifest = tomllib.loads((ADDON.parent / "blender_manifest.toml").read_text("utf-8"))
    out = [p for p in manifest["build"]["paths_exclude_pattern"] if p.startswith("/addon/")]
    assert out
    for pattern in out:
        assert (ADDON.parent / pattern[1:]).exists(), f"{pattern} leaves out nothing"
    return {
        name: file
        for name, file in FILES.items()
        if not f"/{file.relative_to(ADDON.parent).as_posix()}".startswith(tuple(out))
    }


def test_the_zip_holds_what_blender_can_reach_and_nothing_else():
    """Blender runs `register` of the package; nothing is imported by a name that is made up.

    But for what packages beside the add-on bring along.
    """
    assert "blender.registration" in whole_graph()[""]
    assert shipped().keys() == reached(whole_graph(), {""})
    named = [n for n, f in shipped().items() if "importlib" in f.read_text("utf-8")]
    assert named == ["camera_files.files", "opened"]


# A dotted name within a module, or a module: what an extension must not do.
FORBIDDEN = {"subprocess", "threading", "multiprocessing", "exec", "eval", "sys.path"}


def forbidden(source: str) -> set[str]:
    """Which forbidden names a module has."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            own = node.module if isinstance(node, ast.ImportFrom) and not node.level else ""
            names = [f"{own}.{a.name}" if own else a.name for a in node.names]
            found |= {n for n in names if n == "sys.path"} | {n.split(".")[0] for n in names}
        elif isinstance(node, ast.Name):
            found.add(node.id)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found.add(f"{node.value.id}.{node.attr}")
    return found & FORBIDDEN


def test_what_is_shipped_starts_and_runs_nothing():
    found = {n: forbidden(file.read_text("utf-8")) for n, file in shipped().items()}
    assert not {name: names for name, names in found.items() if names}


def asks_for_the_version(source: str) -> bool:
    """Whether a module reads Blender's version, other than as text or as that of its files."""
    return any(
        isinstance(node, ast.Attribute) and ast.unparse(node).endswith("app.version")
        for node in ast.walk(ast.parse(source))
    )


def test_one_module_knows_how_blenders_differ():
    asking = [n for n, file in FILES.items() if asks_for_the_version(file.read_text("utf-8"))]
    assert asking == ["blender.versions"]
    assert asks_for_the_version("from bpy import app\nif app.version < (5, 0, 0):\n    pass")
    assert not asks_for_the_version("print(bpy.app.version_string)")


def beside_the_code(source: str) -> list[str]:
    """The statements that do with the add-on's own folder anything but read, or name it."""
    if "__file__" not in source:
        return []
    tree, names, folder = ast.parse(source), {"__file__"}, "Path(__file__).parent"
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.value) == folder:
            names.add(ast.unparse(node.targets[0]))
    statements = [n for n in ast.walk(tree) if isinstance(n, ast.stmt) and not hasattr(n, "body")]
    uses = [n for n in statements if names & {x.id for x in ast.walk(n) if isinstance(x, ast.Name)}]
    said = [ast.unparse(n) for n in uses]
    return [s for s in said if not s.endswith(f"= {folder}") and ".read_text(" not in s]


# Who advises to install packages, and why nobody reads that in Blender.
NOT_IN_BLENDER = {
    "cli.opening": "said where there is no Blender",
    "files.exr": "of OpenImageIO, which Blender brings along",
}
# Who hands a folder of its own to others, and to whom.
HANDED_ON = {
    "blender.ui.menus": "Blender lists the presets in it, which are files of the zip",
    "blender.ui.samples": "Blender opens the scenes in it as new files, without their names",
}


def test_what_is_shipped_writes_nothing_beside_itself_and_advises_no_packages():
    sources = {n: file.read_text("utf-8") for n, file in shipped().items()}
    assert {n for n, text in sources.items() if beside_the_code(text)} == HANDED_ON.keys()
    assert {n for n, text in sources.items() if "pip install" in text} == NOT_IN_BLENDER.keys()
