"""`reftrace export`: writes a .blend as a scene that needs no Blender."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from ...files.scenes import save_scene
from ...framing import Choice
from ...report import folders
from ...scene import SceneError
from ...wording import count_of, show
from ..arguments import is_blend
from ..camera_options import add_camera, choice_from
from ..opening import open_file
from ..parser import AGREE, Parser


@dataclass(frozen=True)
class ExportOptions:
    """The options of `reftrace export`."""

    scene: Path
    out: Path
    choice: Choice

    @classmethod
    def parsed(cls, given: Namespace) -> ExportOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        if not is_blend(given.scene):
            raise SceneError(f"'{given.scene}' is not a .blend: only those are exported")
        return cls(given.scene, given.out, choice_from(given, given.scene))


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        lambda given: export(ExportOptions.parsed(given)),
        "reftrace export scene.blend --out scene.npz",
    )
    parser.add_scene("scene.blend")
    parser.add_argument(
        "--out",
        required=True,
        type=parser.path_ending(".npz"),
        metavar="SCENE.npz",
        help="the file to write",
    )
    add_camera(parser)


def export(options: ExportOptions) -> int:
    """Export, and write the scene."""
    with folders.made_for_file(options.out):
        opened = open_file(options.scene, options.choice)
        show(*opened.manifest.lines())
        with folders.replacing_file(options.out) as new:
            save_scene(new, opened.scene, opened.manifest)
    show(f"{count_of(opened.scene.triangle_count, 'triangle')}: {options.out}")
    return AGREE
