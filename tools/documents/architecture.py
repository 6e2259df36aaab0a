"""ARCHITECTURE.md: the floors of the code, and four walks through it; made, and so never old.

A walk is a list of functions, each indented below the one that calls it. It is checked that they
are there, and that each names the next.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from itertools import takewhile
from pathlib import Path

from . import markers

ADDON = Path(__file__).resolve().parents[2] / "addon"

# By what begins them: "  " for each caller above, the file within addon/, and the function; or the
# class that is made, or the table that functions are taken from.
WALKS = {
    "F12, an animation, `blender -b -E REFERENCE_TRACER`": """
blender/engine.py ReferenceTracerEngine.render
  blender/engine.py ReferenceTracerEngine._trace
    blender/reading/export.py export
      blender/reading/camera.py export_camera
      blender/reading/meshes.py read_mesh
      blender/reading/visible.py visible
      blender/reading/export.py assemble
    blender/engine.py ReferenceTracerEngine._fill
      rendering.py steps
        rendering.py TRACERS
          rendering.py certified_tracer
            certified/sweep/sweep.py sweep
              certified/sweep/sweep.py Sweep.steps
                certified/sweep/sweep.py Sweep._instances
                  certified/sweep/sweep.py Sweep.enter
                certified/sweep/resolve.py Resolver.steps
        tracer/render.py steps
          tracer/render.py _steps
            tracer/render.py _Band.steps
              tracer/render.py _Band._write
    blender/engine.py ReferenceTracerEngine._show
""",
    "The button *Trace and Compare*": """
blender/ui/long_work.py LongWork.invoke
  blender/ui/long_work.py LongWork._run
    blender/ui/operators.py REFERENCE_TRACER_OT_compare.begin
      blender/jobs/compare.py compare_open_file
        blender/jobs/compare.py gather_case
          blender/jobs/compare.py _export
            blender/reading/export.py export
          blender/drawing/drawings.py Plan.drawn
            blender/drawing/drawings.py Plan._drawn
              blender/drawing/drawings.py turns
                blender/drawing/picture.py picture
        comparison/comparing.py compared
          comparison/comparing.py trace_and_compare
            rendering.py steps
            comparison/comparing.py compare
              causes/explain.py explain
                causes/explain.py find_causes
                  causes/explain.py CHECKS
              causes/counts.py count_pixels
          comparison/comparing.py diagnosed
            diagnosis/diagnosis.py diagnose
              diagnosis/guessing.py accounting
    blender/ui/operators.py REFERENCE_TRACER_OT_compare.show
      blender/ui/results.py keep_comparison
    blender/ui/operators.py REFERENCE_TRACER_OT_compare.finish
      comparison/comparison.py Comparison.verdict
blender/ui/long_work.py LongWork.modal
""",
    "The command `reftrace compare scene.blend`": """
cli/main.py main
  cli/main.py _run
    cli/main.py parser
      cli/main.py _add_options
        cli/commands/compare.py add
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
                report/lines.py describe
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
        blender/live/view.py Job
    blender/live/view.py LiveView._step
      blender/live/view.py Job.step
    blender/live/view.py LiveView._draw
""",
}


def steps(walk: str) -> Iterator[tuple[int, str, str]]:
    """Yield each step of a walk: how deep it stands, its file, its function."""
    for line in walk.strip().splitlines():
        file, function = line.split()
        yield (len(line) - len(line.lstrip())) // 2, file, function


@cache
def _functions(file: str) -> dict[str, tuple[ast.AST, str]]:
    """Return a file's functions, classes and tables, by their names; methods after a point.

    Each comes with what it says of itself: the first line of its docstring, or of the comment above
    it.
    """
    text = (ADDON / file).read_text(encoding="utf-8")
    lines = text.splitlines()
    found: dict[str, tuple[ast.AST, str]] = {}
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = node, _said(node)
        elif isinstance(node, ast.AnnAssign):
            above = takewhile(lambda s: s.startswith("# "), reversed(lines[: node.lineno - 1]))
            found[ast.unparse(node.target)] = node, "".join([*above][-1:]).removeprefix("# ")
        elif isinstance(node, ast.ClassDef):
            found[node.name] = node, _said(node)
            for own in node.body:
                if isinstance(own, ast.FunctionDef):
                    found[f"{node.name}.{own.name}"] = own, _said(own)
    return found


def _said(node: ast.FunctionDef | ast.ClassDef) -> str:
    return (ast.get_docstring(node) or "").split("\n")[0]


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
        node, said = _functions(file)[function]
        called = function.split(".")[-1]
        if above and called not in above[-1][1]:
            out.append(f"{above[-1][0]} does not name {called}")
        if not said:
            out.append(f"{function} does not say what it does")
        above.append((function, _names(node)))
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
    """Return the walks as Markdown."""
    parts = []
    for title, walk in WALKS.items():
        parts.append(f"### {title}\n")
        for depth, file, function in steps(walk):
            parts.append(f"{'  ' * depth}- [{function}](addon/{file})")
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
