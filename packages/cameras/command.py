"""`reftrace camera`: writes a scene's camera as other programs read it, or checks one of theirs."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from reference_tracer.camera_files.convention import CENTERS, HALF, View
from reference_tracer.camera_files.files import CONVENTIONS, chosen, number_of, read
from reference_tracer.camera_files.frame import part
from reference_tracer.camera_files.opencv import OPENCV
from reference_tracer.cli.arguments import check_frames, is_blend, refuse
from reference_tracer.cli.camera_options import LAST_FRAME, add_camera, choice_from
from reference_tracer.cli.opening import SOURCES, open_blend, open_file
from reference_tracer.cli.parser import AGREE, DIFFERENCES, Parser
from reference_tracer.comparison.animation import frames_named
from reference_tracer.report.cameras import SceneCamera, write_cameras
from reference_tracer.scene import Camera, Region, SceneError
from reference_tracer.wording import show

from .difference import CameraDifference, difference
from .trajectory import TrajectoryDifference, trajectory_difference

_HELP = "that of a camera.json of this command, transforms.json, a folder of COLMAP's, and so on"


def check(given: Namespace) -> None:
    """Raise SceneError if options contradict one another."""
    if (given.out is None) == (given.check is None):
        raise SceneError("--out FILE writes the camera, --check FILE compares another: name one")
    if given.check is not None:
        refuse(given, ("centers", "frames"), "is for --out")
    else:
        refuse(given, ("view",), "is for --check")
    if given.frames is not None:
        check_frames(given, ())


def add(parser: Parser) -> None:
    """Add the command's options."""
    examples = (
        "reftrace camera scene.blend --out camera.json\n"
        "  reftrace camera scene.blend --check transforms.json"
    )
    parser.runs(camera, examples, _CODES)
    parser.add_scene(SOURCES)
    parser.add_argument(
        "--out", type=parser.path, metavar="FILE", help="the file to write, or folder"
    )
    parser.add_argument(
        "--convention",
        choices=CONVENTIONS,
        help="how it is written (default opencv: K, R, t in JSON), or how that of --check is read "
        "(default as its content says)",
    )
    parser.add_argument(
        "--centers",
        choices=CENTERS,
        help="where the centre of the first pixel is: half, at (0.5, 0.5), or integer, at (0, 0), "
        "and the file then says so (default half)",
    )
    parser.add_argument(
        "--frames", metavar="FRAMES", help="all these frames: 1-250, 1-250:5, 7, or all"
    )
    parser.add_argument(
        "--check",
        type=parser.path,
        metavar="FILE",
        help=f"say how far off a camera is: {_HELP}",
    )
    parser.add_argument(
        "--view",
        metavar="NAME",
        help="with --check: the one camera of the file by the name or number of its image (default "
        "all, each at the frame of its number)",
    )
    add_camera(parser)


_CODES = """exit codes:
  0  done; with --check, the cameras agree
  2  with --check, they differ
  4  the input is wrong or cannot be read
  130  interrupted by Ctrl-C (129, 143: by SIGHUP, SIGTERM)"""


def camera(given: Namespace) -> int:
    """Write the scene's camera, or check another."""
    check(given)
    with _scene(given) as at:
        return _written(given, at) if given.out else _checked(given, at)


# The scene's cameras at these frames, or at what --frames names.
_At = Callable[[Sequence[int] | None], list[SceneCamera]]


@contextmanager
def _scene(given: Namespace) -> Iterator[_At]:
    """Open the scene, and give what asks it for its camera."""
    choice = choice_from(given, given.scene)
    if not is_blend(given.scene):
        camera = part(open_file(given.scene, choice).scene.camera)
        yield lambda frames: [SceneCamera.of(camera, "0001.png")] * len(frames or [1])
        return
    with open_blend(given.scene, choice) as blender:
        from reference_tracer.blender.jobs.animation import frames_of
        from reference_tracer.blender.jobs.cameras import cameras

        def at(frames: Sequence[int] | None) -> list[SceneCamera]:
            if frames is None and given.frames:
                frames = frames_named(given.frames) or frames_of(blender.context.scene)
            return list(cameras(frames))

        yield at


def _written(given: Namespace, at: _At) -> int:
    convention = CONVENTIONS[given.convention or OPENCV.name]
    show(write_cameras(given.out, at(None), convention, given.centers or HALF))
    show(f"written to {given.out}, as {convention.title}")
    return AGREE


def _checked(given: Namespace, at: _At) -> int:
    """Compare each camera of a file with the scene's; the exit code is that of the worst."""
    (own,) = at(None)
    size = own.view.camera.width, own.view.camera.height
    views = read(given.check, given.convention, size)
    if given.view is not None or len(views) == 1:
        views, scene = [chosen(views, given.view)], [own]
    else:
        numbers = [number_of(view) for view in views]
        frames = [number for number in numbers if number is not None]
        if len({*frames}) != len(views):
            raise SceneError(f"'{given.check}': its images have no numbers of their own: --view")
        if is_blend(given.scene) and (far := [n for n in frames if abs(n) > LAST_FRAME]):
            raise SceneError(f"'{given.check}': Blender has no frame {far[0]}: --view")
        by_frame = dict(zip(sorted(frames), at(sorted(frames)), strict=True))
        scene = [by_frame[number] for number in frames]
    cameras = [one.view.camera for one in scene]
    others = [_of_size(v.camera, own) for v, own in zip(views, cameras, strict=True)]
    names = [view.name or given.check.name for view in views]
    found: CameraDifference | TrajectoryDifference
    if len(views) == 1:
        found = difference(cameras[0], others[0])
    else:
        found = trajectory_difference(names, cameras, others)
    wrong = [_other_than_points(v, own) for v, own in zip(views, cameras, strict=True)]
    notes = [_notes(v, one.view) for v, one in zip(views, scene, strict=True)]
    for line in found.lines():
        show(f"{given.check.name if len(views) > 1 else names[0]}: {line}")
    show(*_shared(names, wrong), *_shared(names, notes))
    return AGREE if found.agrees and not any(wrong) else DIFFERENCES


def _shared(names: Sequence[str], lines: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield each line once, with the name of the one camera that has it, or how many have it."""
    have: dict[str, list[str]] = {}
    for name, own in zip(names, lines, strict=True):
        for line in own:
            have.setdefault(line, []).append(name)
    for line, of in have.items():
        yield f"{of[0] if len(of) == 1 else f'{len(of)} of {len(names)} cameras'}: {line}"


def _of_size(camera: Camera, like: Camera) -> Camera:
    """Return a camera of the same window, with as many pixels as another."""
    whole = Region(0, 0, like.width, like.height)
    return replace(camera, width=like.width, height=like.height, region=whole)


def _other_than_points(view: View, own: Camera) -> list[str]:
    """Return how a file's camera differs from the scene's `own` but in where points are seen."""
    out = []
    other = view.camera
    if (other.width, other.height) != (own.width, own.height):
        out.append(
            f"differ: its picture has {other.width} x {other.height} pixels, the scene's "
            f"{own.width} x {own.height}, in which distances are"
        )
    ends = other.clip_start, other.clip_end, own.clip_start, own.clip_end
    if view.is_clipped and not np.allclose(ends[:2], ends[2:], rtol=1e-5, atol=0):
        says = "differ: its clip range is {:.6g} to {:.6g} m, the scene's {:.6g} to {:.6g} m"
        out.append(says.format(*ends))
    return out


def _notes(view: View, scenes: View) -> list[str]:
    """Return what of a file is not applied, and that it is of another frame than the scene's."""
    frames = view.frame, scenes.frame
    if None in frames or frames[0] == frames[1]:
        return [*view.notes]
    other = f"it is the camera of frame {view.frame}, and the scene is at {scenes.frame}"
    return [*view.notes, other]
