"""ARCHITECTURE.md: the floors of the code, and four walks through it; made, and so never old.

A walk is a list of functions, each indented below the one that calls it. It is checked that they
are there, and that each names the next.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from . import markers

ADDON = Path(__file__).resolve().parents[2] / "addon"

# By what begins them: "  " for each caller above, the file within addon/, the function.
WALKS = {
    "F12, an animation, `blender -b -E REFERENCE_TRACER`": """
blender/engine.py ReferenceTracerEngine.render
  blender/engine.py ReferenceTracerEngine._trace
    blender/reading/export.py export
    blender/engine.py ReferenceTracerEngine._fill
      rendering.py steps
        tracer/render.py steps
          tracer/render.py _steps
    blender/engine.py ReferenceTracerEngine._show
rendering.py certified_tracer
  certified/sweep/sweep.py sweep
""",
    "The button *Trace and Compare*": """
blender/ui/operators.py REFERENCE_TRACER_OT_compare.begin
  blender/jobs/compare.py compare_open_file
    blender/jobs/compare.py gather_case
      blender/jobs/compare.py _exported
        blender/engine.py export_for_judge
      blender/drawing/picture.py picture
    comparison/comparing.py compared
      comparison/comparing.py trace_and_compare
        comparison/comparing.py compare
          causes/explain.py explain
            causes/explain.py find_causes
          causes/counts.py count_pixels
      comparison/comparing.py diagnosed
        diagnosis/diagnosis.py diagnose
          diagnosis/guessing.py accounting
blender/ui/operators.py REFERENCE_TRACER_OT_compare._show
  blender/ui/results.py keep_comparison
blender/ui/operators.py REFERENCE_TRACER_OT_compare.finish
  comparison/comparison.py Comparison.verdict
""",
    "The command `reftrace compare scene.blend`": """
cli/main.py main
  cli/main.py _run
cli/commands/compare.py compare
  cli/commands/compare.py _with_blender
    cli/opening.py open_blend
    blender/jobs/compare.py compare_open_file
      blender/jobs/compare.py gather_case
      report/comparison.py written
        comparison/comparing.py compared
        report/comparison.py write
          report/page/__init__.py write
    cli/commands/compare.py _told_comparison
      comparison/comparison.py Comparison.lines
      cli/commands/compare.py _told
        comparison/verdict.py Verdict.exit_code
""",
    "The 3D view in *Rendered* mode": """
blender/engine.py ReferenceTracerEngine.view_update
  blender/live/view.py LiveView.update
    blender/live/scene.py ViewScene.update
blender/engine.py ReferenceTracerEngine.view_draw
  blender/live/view.py LiveView.draw
    blender/live/view.py LiveView._aim
      blender/live/camera.py camera_of
      blender/live/view.py LiveView._begin
        blender/live/view.py Job.__init__
    blender/live/view.py LiveView._step
      blender/live/view.py Job.step
    blender/live/view.py LiveView._draw
""",
}
CLASSES = {"Job.__init__": "Job"}  # what a caller writes, where it is not the function's name


def steps(walk: str) -> Iterator[tuple[int, str, str]]:
    """Yield each step of a walk: how deep it stands, its file, its function."""
    for line in walk.strip().splitlines():
        file, function = line.split()
        yield (len(line) - len(line.lstrip())) // 2, file, function


@cache
def _functions(file: str) -> dict[str, ast.AST]:
    """Return the functions of a file by their names, those of classes after a point."""
    tree = ast.parse((ADDON / file).read_text(encoding="utf-8"))
    found: dict[str, ast.AST] = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.ClassDef):
            for own in node.body:
                if isinstance(own, ast.FunctionDef):
                    found[f"{node.name}.{own.name}"] = own
    return found


def _names(node: ast.AST) -> set[str]:
    """Return all names, also what follows a point, in a function."""
    found = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
    return found | {n.attr for n in ast.walk(node) if isinstance(n, ast.Attribute)}


def faults(walk: str) -> list[str]:
    """Return what is not so in a walk, in words."""
    out, above = [], []
    for depth, file, function in steps(walk):
        if not (ADDON / file).is_file() or function not in _functions(file):
            out.append(f"{file} has no {function}")
            continue
        del above[depth:]
        called = CLASSES.get(function, function.split(".")[-1])
        if above and called not in above[-1][1]:
            out.append(f"{above[-1][0]} does not name {called}")
        above.append((function, _names(_functions(file)[function])))
    return out


def _floors() -> dict[str, int]:
    """Return the floor of each unit, as the test has it that holds imports to them."""
    test = ADDON.parent / "tests" / "test_structure.py"
    for node in ast.parse(test.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "FLOORS":
            return dict(ast.literal_eval(node.value))
    raise ValueError(f"{test} has no FLOORS")


def refreshed(text: str) -> str:
    """Return the page's text with its floors and walks as they are."""
    return markers.refreshed(text, lambda command: "", {"floors": floors(), "walks": walks()})


def walks() -> str:
    """Return the walks as Markdown, each with what its functions say of themselves."""
    parts = []
    for title, walk in WALKS.items():
        parts.append(f"### {title}\n")
        for depth, file, function in steps(walk):
            said = (ast.get_docstring(_functions(file)[function]) or "").split("\n")[0]
            link = f"[{function.split('.')[-1]}](addon/{file})"
            parts.append(f"{'  ' * depth}- {link} · {said}".rstrip(" ·"))
        parts.append("")
    return "\n".join(parts).strip()


def floors() -> str:
    """Return the floors as a table, the highest first: a unit's first sentence says what it is."""
    of = _floors()
    rows = ["| floor | what stands there | what it is |", "|---|---|---|"]
    for name in sorted(of, key=lambda name: (-of[name], name)):
        path = ADDON / name
        file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
        said = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
        shown = name if path.is_dir() else f"{name}.py"
        rows.append(f"| {of[name]} | `{shown}` | {said.splitlines()[0]} |")
    return "\n".join(rows)
