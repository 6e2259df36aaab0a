"""The front door: what `import reference_tracer` offers to a script.

Nothing here needs Blender, and all that it does the commands do by the same functions.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .camera_files.files import CONVENTIONS, chosen, read
from .camera_files.frame import part
from .causes.case import Case
from .comparison.comparing import compared
from .comparison.comparison import Comparison
from .comparison.verdict import Verdict as Verdict
from .derivation.candidates import LIMIT
from .derivation.derivation import derive
from .derivation.document import document_markdown
from .files.images import open_picture
from .files.scenes import Account
from .files.scenes import save_scene as save_scene
from .opened import file_manifest, only, open_scene
from .pictures.given import GivenPicture, Making, picture_of_array, picture_of_file
from .rendering import render as render
from .rendering import trace as trace
from .report.cameras import SceneCamera, write_cameras
from .report.lines import describe as describe
from .scene import Camera as Camera
from .scene import Instance as Instance
from .scene import Mesh as Mesh
from .scene import Plane as Plane
from .scene import Region as Region
from .scene import Scene
from .scene import SceneError as SceneError
from .scene import ViewWindow as ViewWindow
from .tracer.camera import Rays as Rays
from .tracer.camera import camera_rays as camera_rays
from .tracer.frame import Frame as Frame
from .tracer.progress import result_of
from .tracer.settings import Settings


def load_scene(path: str | Path) -> Scene:
    r"""Read a scene from a .npz, or from a mesh.

    That is .obj, .ply, .off, .stl, .glb, .gltf, .usd, .usda, .usdc or .usdz: see
    ``docs/commands.md`` for what is read of it, and what a library or Blender is needed for.

    A mesh has no camera: it is framed, at 960 x 540 pixels. A .blend is exported before, by
    ``reftrace export scene.blend --out scene.npz``.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Scene
        Camera, meshes, instances and colours; see ``docs/files.md`` for what they mean.

    Warns
    -----
    UserWarning
        For each thing that the file holds and the scene does not.

    Raises
    ------
    SceneError, OSError
        If there is no such scene, or it cannot be read; the message says what to do.

    Examples
    --------
    >>> from pathlib import Path
    >>> from reference_tracer import load_scene
    >>> _ = Path("triangle.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n")
    >>> scene = load_scene("triangle.obj")
    >>> scene.camera.width, scene.triangle_count
    (960, 1)
    """
    scene, manifest, _ = open_scene(Path(path))
    for remark in manifest.remarks():
        warnings.warn(f"{path}: {remark.strip()}", stacklevel=2)
    return scene


def compare(
    scene: str | Path | Scene,
    picture: str | Path | ArrayLike,
    *,
    camera: Camera | None = None,
    settings: Settings | None = None,
    renderer: str = "",
    filter_radius: float = 0.0,
    dither: float | None = None,
    kind: str = "",
    scale: float | None = None,
    self_check: bool = False,
    diagnose: bool = True,
) -> Comparison:
    """Trace a scene, compare it with a picture of it, and find what is wrong with that.

    Parameters
    ----------
    scene : str, Path or Scene
        A .npz or a mesh, as :func:`load_scene` reads it. What the file holds and the scene does not
        counts in the verdict; of a Scene, nothing is known to be missing.
    picture : str, Path or array
        A PNG or an EXR; or (h, w, 3 or 4), linear RGB or RGBA with alpha multiplied in, row 0 at
        the bottom. It shows the camera's whole view, or its region.
    camera : Camera, optional
        In place of the scene's own.
    settings : Settings, optional
        How it is traced; by default with proof.
    renderer : {'', 'rays', 'raster'}
        Whose rounding excuses a pixel: a ray tracer's in float32, or a rasteriser's with a depth
        buffer of 24 bits. By default what the file says, else rays.
    filter_radius : float
        How far the picture's filter reaches, in pixels; 0 for one sample at each pixel's centre.
    dither : float, optional
        Noise that was added on purpose, in levels of 8 bits.
    kind : {'', 'depth', 'distance', 'normals', 'positions', 'ids'}
        What the picture holds in place of colours, in world or camera space, as most pixels agree:
        see ``docs/data.md``. Its file may be a .npy or .npz, too, with the lowest row first; its
        array is (h, w) or (h, w, c).
    scale : float, optional
        Of depths, distances and positions: how many metres 1 is.
    self_check : bool
        Whether known faults are made on purpose, to see that they are found.
    diagnose : bool
        Whether to look for what accounts for unexplained pixels.

    Returns
    -------
    Comparison
        ``verdict``, ``counts``, ``metrics``, ``causes`` of each pixel, ``diagnosis``; ``to_dict()``
        is what ``comparison.json`` holds. ``describe`` has the sentences that the command prints.

    Raises
    ------
    SizeError, SceneError, OSError, ValueError
        If the picture has another size, or either side cannot be read or traced.

    Examples
    --------
    A picture with one wrong pixel:

    >>> from reference_tracer import compare, load_scene, render
    >>> color = render(load_scene("triangle.obj")).color.copy()  # as above
    >>> color[270, 480] = 1
    >>> result = compare("triangle.obj", color, diagnose=False)
    >>> str(result.verdict), result.counts.unexplained
    ('differences', 1)
    """
    making = Making(renderer, filter_radius, dither)
    if scale is not None and not kind:
        raise ValueError("scale is of depths, distances and positions: say which, by kind")
    if isinstance(scene, Scene):
        manifest = file_manifest(Path("scene"), scene, Account())
    else:
        scene, manifest, _ = open_scene(Path(scene))
    if camera is not None:
        scene, manifest = scene.seen_by(camera), replace(manifest, camera=camera.name)
    if kind:
        source = Path(picture) if isinstance(picture, (str, Path)) else np.asarray(picture)
        data: GivenPicture = only("data", "comparisons of data").given_data(kind, source, scale)
        shown = data.picture(scene, making)
    elif isinstance(picture, (str, Path)):
        shown = picture_of_file(open_picture(picture), scene.camera, making)
    else:
        shown = picture_of_array(picture, scene.camera, making)
    case = Case(scene, manifest, settings or Settings(), shown, curves=(), self_check=self_check)
    return result_of(compared(case, diagnose))


def inside(scene: Scene, points: ArrayLike) -> Any:
    r"""Say which points lie inside the closed meshes of a scene, exactly.

    Parameters
    ----------
    scene : Scene
    points : (n, 3) array
        World space, metres; taken as float64.

    Returns
    -------
    Inside
        `place`, (n,): 0 outside of all meshes, 1 inside of one at least, 2 on the surface of one;
        `winding`, (n,): how often all of them wind about each point. ``docs/every.md`` has more.

    Raises
    ------
    SceneError
        If a mesh is not closed; the message has its name, and the length of its boundary.

    Examples
    --------
    >>> from reference_tracer import inside, load_scene
    >>> corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    >>> faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    >>> _ = Path("closed.obj").write_text(corners + faces)
    >>> scene = load_scene("closed.obj")
    >>> found = inside(scene, scene.meshes[0].vertices * 0.9 + 0.1)
    >>> found.place.tolist(), found.winding.tolist()
    ([1, 0, 0, 0], [1, 0, 0, 0])
    """
    return only("rays", "points inside meshes").inside(scene, points)


def explain(scene: Scene, x: int, y: int, limit: int = LIMIT) -> str:
    """Derive what one pixel sees, step by step, in float32, float64 and exactly.

    Parameters
    ----------
    scene : Scene
    x, y : int
        The pixel of the traced picture; (0, 0) is its lower left.
    limit : int
        How many triangles are shown.

    Returns
    -------
    str
        The derivation, as Markdown.

    Raises
    ------
    SceneError
        If there is no such pixel.

    Examples
    --------
    >>> from reference_tracer import explain, load_scene
    >>> print(explain(load_scene("triangle.obj"), 480, 270).splitlines()[0])
    # The ray through pixel (480, 270)
    """
    return document_markdown(derive(scene, x, y, limit))


def read_camera(
    path: str | Path,
    view: str | int | None = None,
    *,
    convention: str | None = None,
    size: tuple[int, int] | None = None,
) -> Camera:
    r"""Read the camera of another program's file; ``docs/cameras.md`` has which.

    Parameters
    ----------
    path : str or Path
        A file, or a folder where a convention has several: ``camera.json``, ``transforms.json``, a
        folder of COLMAP's, a ``.glb`` with cameras, and so on.
    view : str or int, optional
        Which of several: the name or the number of its image.
    convention : str, optional
        What the file is; by default what its content says.
    size : (int, int), optional
        Width and height of the picture, for files that say none.

    Returns
    -------
    Camera
        In the file's own world, with Z up for glTF; ``scene.seen_by(camera)`` looks through it. It
        clips nothing where the file says no clip range.

    Raises
    ------
    SceneError, OSError
        If it cannot be read, has no such view, or a camera that is not modelled.

    Examples
    --------
    >>> from reference_tracer import load_scene, read_camera, write_camera
    >>> _ = Path("triangle.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n")
    >>> scene = load_scene("triangle.obj")
    >>> write_camera("transforms.json", scene.camera, "nerf")
    >>> camera = read_camera("transforms.json")
    >>> (camera.width, camera.height) == (scene.camera.width, scene.camera.height)
    True
    >>> seen = scene.seen_by(camera)
    """
    views = read(Path(path), convention, size or (None, None))
    return chosen(views, None if view is None else str(view)).camera


def write_camera(
    path: str | Path, camera: Camera, convention: str = "opencv", *, centers: str = "half"
) -> None:
    """Write a camera as another program reads it, read it again, and see that it is the same.

    Parameters
    ----------
    path : str or Path
        The file, or the folder where the convention has several files.
    camera : Camera
        Of the picture of its region.
    convention : str
        opencv, opengl, colmap, nerf, gltf, mitsuba, pytorch3d, open3d or bop.
    centers : {'half', 'integer'}
        Where the centre of the first pixel is: at (0.5, 0.5), or at (0, 0).

    Raises
    ------
    SceneError, OSError
        If the convention cannot say what the camera has, or the file cannot be written.
    """
    if convention not in CONVENTIONS:
        raise SceneError(f"'{convention}' is none of {', '.join(CONVENTIONS)}")
    own = SceneCamera.of(part(camera), camera.name)
    write_cameras(Path(path), [own], CONVENTIONS[convention], centers)
