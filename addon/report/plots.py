"""What all plots share: figures without Matplotlib's global state, their style, and their pixels.

Matplotlib is the extra `plots`. Without it there are no plots, and all else works.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..images import MissingLibraryError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

WIDTH, HEIGHT = 1920, 1080  # pixels: what a projector shows
DPI = 120
# Font sizes of a title, the labels and the numbers at the axes: legible from the back row, or as
# large as small multiples have room for.
LARGE, SMALL = (19.0, 16.0, 14.0), (14.0, 11.5, 10.5)
INK, GREY, FAINT = "#222222", "#707070", "#c8c8c8"


def new_figure(width: int = WIDTH, height: int = HEIGHT) -> Figure:
    """Return an empty white figure of so many pixels.

    Raises
    ------
    MissingLibraryError
        If Matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingLibraryError(
            "plots need the library Matplotlib: pip install 'reference_tracer[plots]'"
        ) from None
    return Figure((width / DPI, height / DPI), dpi=DPI, facecolor="white", layout="constrained")


def headline(figure: Figure, text: str, size: float = 17) -> None:
    """Write a figure's title, flush left."""
    figure.suptitle(text, fontsize=size, x=0.01, ha="left", color=INK)


def legend_below(figure: Figure, handles: Sequence[Line2D]) -> None:
    """Explain lines and marks in one row below all axes."""
    style = {"fontsize": 14, "frameon": False, "columnspacing": 1.4, "handletextpad": 0.4}
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), **style)


def plain_axes(
    axes: Axes, title: str, x: str, y: str, sizes: tuple[float, float, float] = LARGE
) -> None:
    """Give axes a title, labels, a faint grid and no frame; `sizes` are LARGE or SMALL."""
    of_title, of_labels, of_ticks = sizes
    axes.set_title(title, fontsize=of_title, color=INK, loc="left", pad=12)
    axes.set_xlabel(x, fontsize=of_labels, color=INK)
    axes.set_ylabel(y, fontsize=of_labels, color=INK)
    axes.tick_params(labelsize=of_ticks, color=FAINT, labelcolor=INK, which="both")
    axes.grid(True, color=FAINT, linewidth=0.6, alpha=0.6)
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(FAINT)


def log_ticks(axis: Axis, low: float, high: float) -> None:
    """Make an axis logarithmic between two limits, with about five to ten numbers."""
    from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    getattr(axis.axes, f"set_{axis.axis_name}lim")(low, high)
    ratio = high / low
    if ratio < 5:  # there may be no 1, 2 or 5 in between
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    else:
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if ratio < 500 else (1,), numticks=9))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_formatter(NullFormatter())


def pixels(figure: Figure) -> NDArray[np.uint8]:
    """Return a figure as a picture, (h, w, 4) sRGB with alpha, row 0 at the bottom."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[::-1].copy()
