"""For tests of renderers and exporters: a picture is what a scene's camera sees, or the test fails.

Nothing is stored to compare with, and no tolerance is tuned: the reference is computed, and a pixel
may differ by what is proven to come of rounding.
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from numpy.typing import ArrayLike
from reference_tracer.api import compare
from reference_tracer.comparison.comparison import Comparison
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.report import comparison as comparison_report
from reference_tracer.report import page as comparison_page
from reference_tracer.report.junit import wrong_in
from reference_tracer.report.lines import describe
from reference_tracer.scene import Camera, Scene
from reference_tracer.tracer.progress import result_of


def assert_sees(
    scene: str | Path | Scene,
    picture: str | Path | ArrayLike,
    *,
    camera: Camera | None = None,
    renderer: str = "",
    filter_radius: float = 0.0,
    kind: str = "",
    scale: float | None = None,
    accepted: Collection[Verdict] = (Verdict.AGREE,),
    page: str | Path | None = None,
) -> Comparison:
    """Check that a picture is what a scene's camera sees.

    Parameters
    ----------
    scene : str, Path or Scene
        A .npz or a mesh, as :func:`reference_tracer.load_scene` reads it.
    picture : str, Path or array
        A PNG or an EXR; or (h, w, 3 or 4), linear RGB or RGBA with alpha multiplied in, row 0 at
        the bottom. Each object is drawn flat, in the scene's colour for it. With a `kind`, data.
    camera : Camera, optional
        In place of the scene's own.
    renderer : {'', 'rays', 'raster'}
        Whose rounding may excuse a pixel: a ray tracer's in float32, or a rasteriser's with a depth
        buffer of 24 bits. By default what the file says, else rays.
    filter_radius : float
        How far the picture's filter reaches, in pixels; 0 for one sample at each pixel's centre.
    kind : {'', 'depth', 'distance', 'normals', 'positions', 'ids'}
        What the picture holds in place of colours: see ``docs/data.md``.
    scale : float, optional
        Of depths, distances and positions: how many metres 1 is.
    accepted : collection of Verdict
        With these the test passes.
    page : str or Path, optional
        Folder in which the page of a failure is left.

    Returns
    -------
    Comparison
        As :func:`reference_tracer.compare` has it.

    Raises
    ------
    AssertionError
        If it is not; the message has the verdict, the causes and what is wrong.
    SizeError, SceneError, OSError, ValueError
        If the picture has another size, or either side cannot be read or traced.
    """
    __tracebackhide__ = True
    found = compare(
        scene,
        picture,
        camera=camera,
        renderer=renderer,
        filter_radius=filter_radius,
        kind=kind,
        scale=scale,
    )
    if found.verdict not in accepted:
        raise AssertionError(_message(found, page))
    return found


def _message(found: Comparison, page: str | Path | None) -> str:
    said = [f"the picture is not what the camera sees: {wrong_in(found)}", *describe(found)]
    if page is not None:
        result_of(comparison_report.write(page, found))
        said.append(f"its page: {Path(page, comparison_page.NAME)}")
    return "\n".join(said)
