"""What the stories in a window import is there: here it takes seconds, in a window minutes."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

GUI = Path(__file__).parents[1] / "gui"


def named_in(statement):
    """Yield what code imports late, or asks the installed extension for, as lines of imports."""
    modules = {}
    for node in ast.walk(statement):
        match node:
            case ast.Import() | ast.ImportFrom():
                yield ast.unparse(node)
            case ast.Assign(
                targets=[ast.Name(name)],
                value=ast.Call(func=ast.Name("module"), args=[ast.Constant(of)]),
            ):
                modules[name] = of
    for node in ast.walk(statement):
        match node:
            case ast.Call(func=ast.Name("module"), args=[ast.Constant(of)]):
                yield f"import reference_tracer.{of}"
            case ast.Attribute(
                value=ast.Call(func=ast.Name("module"), args=[ast.Constant(of)]), attr=attr
            ):
                yield f"from reference_tracer.{of} import {attr}"
            case ast.Attribute(value=ast.Name(name), attr=attr) if name in modules:
                yield f"from reference_tracer.{modules[name]} import {attr}"


def test_all_that_stories_import_is_there():
    paths = [*GUI.glob("*stories.py"), *(GUI / f"{n}.py" for n in ("story", "viewport", "hands"))]
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in paths)
    parts = [part for tree in trees for part in tree.body]
    lines = sorted({line for part in parts for line in named_in(part)})
    assert any("import LiveView" in line for line in lines)
    lines = ["import sys", f"sys.path.insert(0, {str(GUI)!r})", "import play", *lines]
    code = [sys.executable, "-c", "\n".join(lines)]
    done = subprocess.run(code, capture_output=True, text=True)
    assert not done.returncode, done.stderr[-1000:]
