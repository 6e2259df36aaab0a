"""The camera of a scene: its view window, its region of pixels, its pose and clip range."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..projections import PERSPECTIVE, PROJECTIONS, Projection
from .checks import SceneError, finite, store

# Of a camera's axes: their inverse, two factors by the determinant, is below 2^602.
_LONGEST = 2.0**200


# Of a pixel on the view window: its inverse is finite, and where gradual underflow puts a ray, some
# 2^-1075 beside its place, is less than 2^-54 of a pixel beside it, far below the bounds' 2^-45.
_LEAST_PIXEL = 2.0**-1020


_MOST_PIXELS = 1 << 28  # along a side: the numbers of eight rows' pixels are int32


@dataclass(frozen=True)
class ViewWindow:
    """The bounds of the whole picture along the camera's right and up axes.

    On the plane at depth 1 (perspective), in metres (orthographic), or, of a panorama, in radians
    of longitude and latitude.
    """

    left: float
    right: float
    bottom: float
    top: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.right - self.left, self.top - self.bottom

    @property
    def centre(self) -> tuple[float, float]:
        """The point in its middle."""
        return (self.left + self.right) / 2, (self.bottom + self.top) / 2

    def moved(self, x: float, y: float) -> ViewWindow:
        """Return it moved to the right and up."""
        return ViewWindow(self.left + x, self.right + x, self.bottom + y, self.top + y)

    def scaled(self, x: float, y: float) -> ViewWindow:
        """Return it scaled about the axis; a negative factor mirrors it."""
        left, right = sorted((x * self.left, x * self.right))
        bottom, top = sorted((y * self.bottom, y * self.top))
        return ViewWindow(left, right, bottom, top)

    def about(self, centre: tuple[float, float], x: float = 1.0, y: float = 1.0) -> ViewWindow:
        """Return one about another centre, of its size times x and y."""
        (cx, cy), (width, height) = centre, self.size
        half_x, half_y = x * width / 2, y * height / 2
        return ViewWindow(cx - half_x, cx + half_x, cy - half_y, cy + half_y)


@dataclass(frozen=True)
class Region:
    """The pixels to trace, x0 <= x < x1 and y0 <= y < y1, row 0 of the picture at the bottom."""

    x0: int
    y0: int
    x1: int
    y1: int

    @property
    def width(self) -> int:
        """Columns, in pixels."""
        return self.x1 - self.x0

    @property
    def height(self) -> int:
        """Rows, in pixels."""
        return self.y1 - self.y0

    @property
    def halves(self) -> tuple[Region, Region]:
        """The lower and the upper half; of one row, the left and the right."""
        y, x = (self.y0 + self.y1) // 2, (self.x0 + self.x1) // 2
        if self.height > 1:
            return replace(self, y1=y), replace(self, y0=y)
        return replace(self, x1=x), replace(self, x0=x)


@dataclass(frozen=True, eq=False)
class Camera:
    """A view window in front of a frame of axes.

    `world_from_camera` is (4, 4): its columns are right, up, backward and the position. The axes
    carry no scale of the camera object, but may be mirrored or sheared, as Blender's own may.

    Raises
    ------
    SceneError
        If there is nothing to see through it: an empty picture, clip range or window.
    """

    world_from_camera: Floats
    window: ViewWindow
    width: int  # of the whole picture, in pixels
    height: int
    projection: Projection = PERSPECTIVE  # one of `projections.PROJECTIONS`
    clip_start: float = 0.1  # depths along the view axis, metres; hits outside are not seen
    clip_end: float = 1000.0
    region: Region = None  # type: ignore[assignment]  # by default, the whole picture
    name: str = "Camera"

    def __post_init__(self) -> None:
        store(
            self,
            "world_from_camera",
            finite(self.world_from_camera, (4, 4), f"The matrix of camera '{self.name}'"),
        )
        axes = self.world_from_camera[:3, :3]
        too_long = np.abs(axes).max() > _LONGEST
        if too_long or abs(np.linalg.det(axes)) < 1 / _LONGEST:
            wrong = "are too long" if too_long else "lie in a plane"
            raise SceneError(f"The axes of camera '{self.name}' {wrong}: clear its scale.")
        if self.region is None:
            store(self, "region", Region(0, 0, self.width, self.height))
        check_size(self.width, self.height)
        if self.projection not in PROJECTIONS.values():
            raise SceneError(f"Camera '{self.name}' must be one of: {', '.join(PROJECTIONS)}.")
        r = self.region
        if not (0 <= r.x0 < r.x1 <= self.width and 0 <= r.y0 < r.y1 <= self.height):
            raise SceneError(
                f"The render border holds no pixel (x {r.x0} to {r.x1}, y {r.y0} to {r.y1} of "
                f"{self.width} x {self.height}): enlarge it or switch it off."
            )
        self._check_clip_range()
        self._check_window()

    def _check_clip_range(self) -> None:
        if not self.clip_start < self.clip_end:
            raise SceneError(
                f"Camera '{self.name}' sees nothing: its clip start ({self.clip_start:g} m) is not "
                f"below its clip end ({self.clip_end:g} m)."
            )
        if not self.projection.sees_behind and not self.clip_start > 0:
            raise SceneError(
                f"Camera '{self.name}' has a clip start of {self.clip_start:g} m: what a "
                f"{self.projection.name} camera sees begins in front of it, so raise it above 0."
            )

    def _check_window(self) -> None:
        w = self.window
        reach = max(map(abs, (w.left, w.right, w.bottom, w.top)))
        with np.errstate(all="ignore"):
            farthest = np.abs(self.world_from_camera[:3]) @ (reach, reach, 1.0, 1.0)
            size = w.size
        known = np.isfinite([reach, *farthest, *size]).all() and reach <= self.projection.farthest
        if not (known and min(size) > 0):
            raise SceneError(
                f"Camera '{self.name}' has an empty or infinite view window ({w}): check its focal "
                "length, sensor size, orthographic scale, longitudes, latitudes and shift."
            )
        if (least := min(size[0] / self.width, size[1] / self.height)) < _LEAST_PIXEL:
            raise SceneError(
                f"Camera '{self.name}' has pixels of {least:g}, which float64 cannot tell apart "
                f"(below {_LEAST_PIXEL:g}): enlarge its sensor size or orthographic scale."
            )

    @property
    def origin(self) -> Floats:
        """Position in world space, (3,) float64, metres."""
        return self.world_from_camera[:3, 3]

    @property
    def right(self) -> Floats:
        """World-space direction of +X in the picture, (3,) float64."""
        return self.world_from_camera[:3, 0]

    @property
    def up(self) -> Floats:
        """World-space direction of +Y in the picture, (3,) float64."""
        return self.world_from_camera[:3, 1]

    @property
    def forward(self) -> Floats:
        """World-space viewing direction, (3,) float64."""
        return -self.world_from_camera[:3, 2]

    def divided(self, times: int) -> Camera:
        """Return it with each pixel divided so many times along its sides.

        By a power of two, the rays through the film stay the same, to the bit.
        """
        r = self.region
        region = Region(times * r.x0, times * r.y0, times * r.x1, times * r.y1)
        return replace(self, width=times * self.width, height=times * self.height, region=region)

    def to_dict(self) -> dict[str, object]:
        """Return the camera as files hold it, for JSON."""
        return {
            "world_from_camera": self.world_from_camera.tolist(),
            "window": vars(self.window),
            "width": self.width,
            "height": self.height,
            "projection": self.projection.name,
            "clip_start": self.clip_start,
            "clip_end": self.clip_end,
            "region": vars(self.region),
            "name": self.name,
        }


def check_size(width: int, height: int) -> None:
    """Raise a SceneError if a picture of this size has no pixel, part of one, or too many."""
    for name, value in (("width", width), ("height", height)):
        if not isinstance(value, (int, np.integer)):
            raise SceneError(f"The {name} of the picture is {value!r}; it must be an integer.")
    if width < 1 or height < 1:
        raise SceneError(
            f"The picture has {width} x {height} pixels: raise the resolution or its percentage, "
            "so that both are at least 1."
        )
    if max(width, height) > _MOST_PIXELS:
        raise SceneError(
            f"The picture has {width} x {height} pixels: lower the resolution, so that both are at "
            f"most {_MOST_PIXELS}."
        )
