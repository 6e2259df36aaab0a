"""The options that choose the scene, the frame and the camera of a file."""

from __future__ import annotations

import sys
from argparse import ArgumentTypeError, Namespace, _ArgumentGroup
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

from ..camera_files.convention import View
from ..camera_files.files import CONVENTIONS, is_seen_to_be, read
from ..camera_files.files import chosen as chosen_view
from ..files.file_kinds import check_is_file
from ..framing import ANGLE, SIZE, Choice
from ..opened import mesh_formats
from ..scene import SceneError
from ..wording import show
from .arguments import is_blend, refuse
from .named import Setting, add_named, one_of
from .parser import COUNT, FINITE, POSITIVE, Parser, number

_OF_BLEND = "scene_name", "view_layer", "frame"
_OF_FILE = "camera_convention", "camera_view"
# Of files that `--camera` takes for a camera's, whatever cameras a .blend has.
_ENDINGS = ".json", ".txt", ".xml", ".glb", ".gltf"

EVERYTHING = "all"  # of eye: a camera that sees all that is shown
LAST_FRAME = 1048574  # of Blender's; the first one is as far below 0
_DEGREES = number(float, lambda value: 0 < value < 180, "between 0 and 180 degrees")
_FRAME = number(
    int,
    lambda value: abs(value) <= LAST_FRAME,
    f"from {-LAST_FRAME} to {LAST_FRAME}, as Blender's frames are",
)


def _point(text: str) -> list[float]:
    """Read a point, three numbers with commas between them."""
    words = text.split(",")
    if len(words) != 3:
        raise ArgumentTypeError(f"{text} is not X,Y,Z")
    return [FINITE(word) for word in words]


def _eye(text: str) -> str | list[float]:
    return text if text == EVERYTHING else _point(text)


_SIZES = (
    Setting(
        "width", "PIXELS", COUNT, f"of the picture (default as height implies; {SIZE[0]} of a mesh)"
    ),
    Setting("height", "PIXELS", COUNT, f"likewise (default as width implies; {SIZE[1]} of a mesh)"),
)
_EYES = (
    Setting(
        "eye",
        "X,Y,Z",
        _eye,
        "a new camera; eye=all: one from the front, right and above that sees all",
    ),
    Setting("target", "X,Y,Z", _point, "the point that eye looks at (default the origin); Z is up"),
    Setting("angle", "DEGREES", _DEGREES, f"vertical angle of view of eye (default {ANGLE:g})"),
    Setting("ortho-scale", "METRES", POSITIVE, "eye is orthographic, its picture is so high"),
    Setting(
        "camera-convention",
        "NAME",
        one_of(*CONVENTIONS),
        f"of --camera's file, if it does not say: {', '.join(CONVENTIONS)}",
    ),
    Setting("camera-view", "NAME", str, "which of its cameras: the image's name or number"),
)
UP = Setting("up", "y|z", one_of("y", "z"), "axis of a mesh that is up (default: its format's)")
_PARTS = (
    UP,
    Setting("scene", "NAME", str, "the scene of a .blend", "scene_name"),
    Setting("view-layer", "NAME", str, "its view layer"),
    Setting("frame", "N", _FRAME, "its frame; simulations are stepped to it from the first one"),
)
CAMERA_OPTIONS = "camera", *(row.kept for row in (*_SIZES, *_EYES, *_PARTS))


def add_camera(parser: Parser, sizes: Sequence[Setting] = _SIZES) -> None:
    """Add the options that choose the scene, the camera and the size of the picture."""
    group = _add(parser, (*sizes, *_EYES, *_PARTS))

    def name_or_path(text: str) -> str:
        return str(parser.path(text)) if text.startswith("//") else text  # as Blender writes it

    group.add_argument(
        "--camera",
        type=name_or_path,
        metavar="CAMERA",
        help="one of a .blend or a .glb, by name, or of a file: K, R and t in JSON, "
        "transforms.json, COLMAP's folder... (default the scene's; one that frames a mesh)",
    )


def add_parts(parser: Parser) -> None:
    """Add the option for the scene and the frame, where no camera is needed."""
    _add(parser, _PARTS)


def _add(parser: Parser, rows: Sequence[Setting]) -> _ArgumentGroup:
    group = parser.add_argument_group("scene, frame and camera (default: as saved)")
    group.set_defaults(**dict.fromkeys(CAMERA_OPTIONS))
    add_named(group, "--set", rows)
    return group


# Formats that Blender imports and `reftrace` does not read.
_OF_OTHERS = frozenset(".3ds .abc .bvh .collada .dae .dxf .fbx .svg .vrml .wrl .x3d".split())


def check_kind(path: Path) -> None:
    """Raise a SceneError if there is no such file, or it is of a kind that is not read.

    A .blend is not read: it may be open in the Blender that runs this.
    """
    suffix = path.suffix.lower()
    if suffix == ".blend":
        return
    check_is_file(path)
    if suffix == ".npz" or suffix in mesh_formats():
        return
    do = ""
    if not suffix:
        do = ": its name has no such end; rename it"
    elif suffix in _OF_OTHERS:
        do = ": import it into Blender, and save a .blend"
    elif suffix.startswith(".blend"):
        do = ": a backup of Blender's is a .blend once it is renamed"
    raise SceneError(f"'{path}' is none of .blend, .npz, {', '.join(mesh_formats())}{do}")


def choice_from(given: Namespace, path: Path, of_frames: bool = False) -> Choice:
    """Return what the options choose of a file; of frames, each may have a camera of its own.

    Raises
    ------
    SceneError
        If the file is of no kind that is read, or an option has no effect for it, or beside the
        others.
    """
    check_kind(path)
    is_mesh = path.suffix.lower() in mesh_formats()
    _refuse_without_camera(given, is_mesh)
    if is_mesh:
        refuse(given, _OF_BLEND, f"is for a .blend: '{path}' has no such thing")
    else:
        refuse(given, ("up",), "is for meshes: in a scene Z is up")
        if not is_blend(path):
            why = f"is for a .blend or a mesh: '{path}' has its own camera and its own picture"
            refuse(given, CAMERA_OPTIONS, why)
    known = [field.name for field in fields(Choice) if field.name in given]
    chosen = {name: getattr(given, name) for name in known}
    if given.eye == EVERYTHING:
        chosen |= {"eye": None, "frame_all": True}
    if views := _views(given, path if is_mesh else None, of_frames):
        for note in dict.fromkeys(note for view in views for note in view.notes):
            show(f"{given.camera}: {note}", file=sys.stderr)
        chosen["camera"] = None
        if len(views) > 1:
            chosen["views"] = views
        else:
            chosen["seen_by"] = views[0]
    return Choice(**chosen)


def _views(given: Namespace, mesh: Path | None, of_frames: bool) -> list[View]:
    """Return the camera of a file that is named, or those of its frames.

    There is none if no file is named, but a camera of a .blend.
    """
    if given.camera is None:
        refuse(given, _OF_FILE, "is for a file of --camera")
        return []
    file, which = Path(given.camera), given.camera_view
    size = given.width, given.height
    is_file = file.suffix.lower() in _ENDINGS or (file.is_dir() and is_seen_to_be(file))
    if not (is_file or given.camera_convention or which):
        if mesh is None:
            return []
        file, which = mesh, given.camera
        if mesh.suffix.lower() not in (".glb", ".gltf"):
            kinds = ", ".join(_ENDINGS)
            raise SceneError(
                f"--camera {which} is no file of cameras ({kinds}; `reftrace camera` writes that "
                f"of a .blend), and '{mesh}' has no cameras"
            )
        if given.up == "z":
            raise SceneError("--set up=z is for the meshes alone: a camera of glTF has Y up")
    views = read(file, given.camera_convention, size)
    if which is not None or not of_frames:
        views = [chosen_view(views, which)]
    for view in views:
        own = view.camera.width, view.camera.height
        if any(asked not in (None, has) for asked, has in zip(size, own, strict=True)):
            raise SceneError(
                f"width and height are for files that say no size: '{file}' has "
                f"{own[0]} x {own[1]}, and so has the picture: leave them out"
            )
    return views


def _refuse_without_camera(given: Namespace, is_mesh: bool) -> None:
    """Refuse options of a new camera where none is made."""
    if given.camera is not None:
        refuse(given, ("eye",), "is for a new camera, and --camera names one")
    if given.ortho_scale is not None:
        refuse(given, ("angle",), "is for a camera that is not orthographic: ortho-scale")
    if given.eye in (None, EVERYTHING):
        refuse(given, ("target", "ortho_scale"), "is for a camera that eye=X,Y,Z places")
    if given.eye is None and not is_mesh:
        refuse(given, ("angle",), "is for a new camera: eye=X,Y,Z or eye=all")
