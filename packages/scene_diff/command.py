"""`reftrace diff`: how the objects of two files of a scene differ."""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from reference_tracer.causes.case import WHOLE, Variant
from reference_tracer.cli.arguments import is_blend, refuse
from reference_tracer.cli.camera_options import UP, check_kind
from reference_tracer.cli.named import add_named
from reference_tracer.cli.opening import SOURCES, open_blend, open_file
from reference_tracer.cli.parser import AGREE, DIFFERENCES, EXIT_CODES_HELP, Parser
from reference_tracer.cli.running import meanwhile
from reference_tracer.framing import Choice
from reference_tracer.opened import mesh_formats
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.wording import count_of, show

from .differences import differences
from .geometry import shapes_of

SCHEMA = "reference_tracer.diff/1"


@dataclass(frozen=True, eq=False)
class Side:
    """One of the two scenes, with faults that Blender can make of it, and what its file lacks."""

    scene: Scene
    variants: tuple[Variant, ...] = ()
    remarks: Sequence[str] = ()


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(diff, "reftrace diff scene.blend export.glb", EXIT_CODES_HELP)
    parser.add_scene(f"what is right: {SOURCES}")
    parser.add_argument("other", type=Path, metavar="OTHER", help="what is held against it")
    add_named(parser, "--set", (UP,))
    parser.add_argument(
        "--json",
        type=parser.path_ending(".json"),
        metavar="FILE",
        help="also write what is found as JSON",
    )


def diff(given: Namespace) -> int:
    """Print how the second scene differs from the first; return whether it does."""
    paths = given.scene, given.other
    if not any(path.suffix.lower() in mesh_formats() for path in paths):
        refuse(given, ("up",), "is for meshes: in a scene Z is up")
    for path in paths:
        check_kind(path)
    first, second = (side(path, given.up) for path in paths)
    found = differences(first.scene, second.scene, first.variants)
    show(*first.remarks, *second.remarks)
    for difference in found:
        show(*difference.lines())
    counts = [count_of(len(shapes_of(s.scene)), "object") for s in (first, second)]
    how = count_of(len(found), "difference") if found else "the same"
    show(f"{counts[0]} and {counts[1]}: {how}")
    if given.json:
        content = {"schema": SCHEMA, "differences": [d.to_dict() for d in found]}
        folders.write_text(given.json, json.dumps(content, indent=1, ensure_ascii=False) + "\n")
    return DIFFERENCES if found else AGREE


def side(path: Path, up: str | None) -> Side:
    """Read a scene whole, also what its camera does not see.

    Raises
    ------
    SceneError, OSError
        If there is no such scene, or it cannot be read.
    """
    if is_blend(path):
        with open_blend(path) as blender, meanwhile(f"having Blender evaluate {path.name}"):
            from reference_tracer.blender.jobs.open_file import export_open_file
            from reference_tracer.blender.jobs.variants import variants

            context = blender.context
            made = tuple(variants(context.scene.name_full, context.view_layer.name, None))
            whole = next((v.scene for v in made if v.fault == WHOLE), None)
            scene = whole or export_open_file(context)[0]
        return Side(scene, tuple(v for v in made if v.fault != WHOLE))
    is_mesh = path.suffix.lower() in mesh_formats()
    opened = open_file(path, Choice(up=up) if is_mesh and up else Choice())
    if not opened.scene.instances:
        raise SceneError(f"'{path}' holds no object with triangles")
    return Side(opened.scene, remarks=opened.manifest.remarks())
