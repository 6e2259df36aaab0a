"""Faults of the camera, each by its own formula in K, R and t."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from .description import Description
from .making import Fault, Made, with_camera
from .renderer import Camera
from .scenes import placed
from .setup import camera_of, camera_through, posed, solids_of

# From Z up to Y up: (x, y, z) becomes (x, z, -y).
Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])

Z_TURN = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def moved(x: float, y: float) -> np.ndarray:
    """Return what moves the film's content by pixels to the right and down, (3, 3)."""
    return np.array([[1.0, 0, x], [0, 1, y], [0, 0, 1]])


def center(scene: Description) -> tuple[float, float]:
    """Return where the middle of the whole film lies in the picture, from its upper left corner."""
    width, height = scene.film.size
    x0, _, _, y1 = scene.film.cut
    return width / 2 - x0, height / 2 - (height - y1)


def magnified(scene: Description, x: float, y: float) -> np.ndarray:
    """Return what magnifies the film's content from the film's middle, (3, 3)."""
    u, v = center(scene)
    return moved(u, v) @ np.diag((x, y, 1.0)) @ moved(-u, -v)


def film(matrix: Callable[[Description], np.ndarray]) -> Callable:
    """Return what multiplies a matrix of film positions to K."""
    return with_camera(lambda scene, c: replace(c, k=matrix(scene) @ c.k))


def axes(*signs: float) -> Callable:
    """Return what multiplies camera space's x, y, z before K."""
    d = np.diag(signs)
    return with_camera(lambda _, c: replace(c, r=d @ c.r, t=d @ c.t))


def offset(x: float, y: float) -> Fault:
    """Return a picture with its content moved by pixels."""
    numbers = {"right": x, "down": y}
    return Fault("pixel_offset", f"{x:+g}, {y:+g} px", film(lambda _: moved(x, y)), numbers)


def focal(share: float) -> Fault:
    """Return a focal length that is longer by a share."""
    change = film(lambda s: s_focal(s, 1 + share))
    return Fault("focal_length", f"{100 * share:+g} %", change, {"share": share}, (1, 4, 5, 6))


def s_focal(scene: Description, ratio: float) -> np.ndarray:
    """Return what another focal length does: the principal point stays."""
    return s_focals(scene, ratio, ratio)


def s_focals(scene: Description, across: float, up: float) -> np.ndarray:
    """Return what one focal length across and another one up do."""
    u, v = camera_of(scene).k[:2, 2]
    return moved(u, v) @ np.diag((across, up, 1.0)) @ moved(-u, -v)


def angle(share: float) -> Fault:
    """Return an angle of view that is wider by a share."""

    def ratio(scene: Description) -> float:
        half = np.arctan(scene.lens.sensor_width / 2 / scene.lens.focal)
        return float(np.tan(half) / np.tan(half * (1 + share)))

    change = film(lambda s: s_focal(s, ratio(s)))
    return Fault("focal_length", f"angle {100 * share:+g} %", change, {"angle": share}, (1, 4, 5))


def sides(scene: Description) -> tuple[float, float]:
    """Return the lengths of the side that the sensor is fitted to, and of the other."""
    width, height = scene.film.size
    tall = height * scene.film.aspect_y / scene.film.aspect_x
    vertical = scene.lens.fit == "VERTICAL" or (scene.lens.fit == "AUTO" and width < tall)
    return (tall, width) if vertical else (width, tall)


def _sensor_fit(scene: Description) -> np.ndarray:
    own, other = sides(scene)
    return magnified(scene, other / own, other / own)


def _horizontal(scene: Description, camera: Camera) -> Camera:
    lens = replace(scene.lens, fit="HORIZONTAL")
    return camera_through(lens, scene.film, scene.eye.world(scene.frame))


def _shift(x: float, y: float) -> Callable:
    """Return what multiplies the shifts, as the picture has them."""

    def change(scene: Description, camera: Camera) -> Camera:
        (u, v), k = center(scene), camera.k.copy()
        k[:2, 2] = u + x * (k[0, 2] - u), v + y * (k[1, 2] - v)
        return replace(camera, k=k)

    return with_camera(change)


def _shift_unit(scene: Description, camera: Camera) -> Camera:
    """Return shifts in lengths of the picture's own sides."""
    (u, v), (width, height), k = center(scene), scene.film.size, camera.k.copy()
    k[:2, 2] = u - scene.lens.shift_x * width, v + scene.lens.shift_y * height
    return replace(camera, k=k)


def _square(scene: Description, camera: Camera) -> Camera:
    square = replace(scene.film, aspect_x=1.0, aspect_y=1.0)
    return camera_through(scene.lens, square, scene.eye.world(scene.frame))


def roll(degrees: float) -> Fault:
    """Return a camera turned about the axis that it looks along."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    change = with_camera(lambda _, cam: replace(cam, r=turn @ cam.r, t=turn @ cam.t))
    return Fault("roll", f"{degrees:+g} degrees", change, {"degrees": degrees})


def pose(change: Callable[[np.ndarray], np.ndarray]) -> Callable:
    """Return what changes Blender's matrix of the camera, (4, 4) without scale."""

    def changed(_: Description, camera: Camera) -> Camera:
        own = np.eye(4)
        own[:3, :3] = np.linalg.inv(camera.r) @ np.diag((1.0, -1.0, -1.0))
        own[:3, 3] = camera.center
        return posed(camera, change(own))

    return with_camera(changed)


def stand(right: float, up: float, forward: float) -> Fault:
    """Return a camera moved along its own axes."""

    def change(matrix: np.ndarray) -> np.ndarray:
        matrix = matrix.copy()
        matrix[:3, 3] += matrix[:3, :3] @ (right, up, -forward)
        return matrix

    numbers = {"right": right, "up": up, "forward": forward}
    return Fault("camera_moved", f"{right:+g}, {up:+g}, {forward:+g} m", pose(change), numbers)


def turned(pan: float, tilt: float) -> Fault:
    """Return a camera turned to the right, then upwards, by degrees."""
    change = pose(lambda matrix: matrix @ placed((0, 0, 0), (tilt, -pan, 0)))
    numbers = {"pan": pan, "tilt": tilt}
    return Fault("camera_turned", f"{pan:+g}, {tilt:+g} degrees", change, numbers)


def elsewhere(by: Sequence[float], angles: Sequence[float], *only: int) -> Fault:
    """Return a camera moved along its own axes by metres, then turned about them by degrees."""
    change = pose(lambda matrix: matrix @ placed(by, angles))
    label = f"{tuple(by)} m, {tuple(angles)} degrees"
    return Fault("camera_placed", label, change, {"by": by, "angles": angles}, only)


def _last_pixel(scene: Description) -> np.ndarray:
    """Return what spans the film from the first pixel's centre to the last one's."""
    width, height = scene.film.size
    return magnified(scene, (width - 1) / width, (height - 1) / height)


def _transposed(matrix: np.ndarray) -> np.ndarray:
    matrix = matrix.copy()
    matrix[:3, :3] = matrix[:3, :3].T
    return matrix


def _scaled(scene: Description, camera: Camera) -> Camera:
    """Return the matrix with the scale of the camera and its parents left in."""
    scale = np.linalg.norm(scene.eye.world(scene.frame)[:3, :3], axis=0)
    return replace(camera, r=camera.r / scale[:, None], t=camera.t / scale)


def _without_parent(scene: Description, camera: Camera) -> Camera:
    return camera_through(scene.lens, scene.film, scene.eye.basis(scene.frame))


def _perspective(scene: Description, camera: Camera) -> Camera:
    lens = replace(scene.lens, parallel=False)
    return camera_through(lens, scene.film, scene.eye.world(scene.frame))


def _depth(scene: Description, camera: Camera) -> float:
    """Return how deep the second object lies, a third before its middle."""
    return float(np.quantile(camera.depths(solids_of(scene)[1].vertices), 0.35))


def clip(start: float | None = None, end: float | None = None) -> Callable:
    """Return other clip distances; 0: through the second object."""

    def change(scene: Description, camera: Camera) -> Camera:
        through = _depth(scene, camera)
        near = camera.near if start is None else start or through
        far = camera.far if end is None else end or through
        return replace(camera, near=near, far=far)

    return with_camera(change)


def _other_camera(scene: Description, made: Made) -> Made | None:
    if not scene.others:
        return None
    _, lens, where = scene.others[0]
    through = camera_through(lens, scene.film, where.world(scene.frame))
    return replace(made, camera=through)


def frame(by: float) -> Fault:
    """Return the scene some frames later."""

    def change(scene: Description, made: Made) -> Made:
        then = scene.frame + by
        return replace(made, camera=camera_of(scene, then), solids=tuple(solids_of(scene, then)))

    return Fault("other_frame", f"{by:+g}", change, {"frames": by}, (4,))


def _whole_film(scene: Description, camera: Camera) -> Camera:
    """Return the whole film in the pixels of the border's part."""
    whole = camera_through(
        scene.lens, replace(scene.film, border=None), scene.eye.world(scene.frame)
    )
    share = camera.width / whole.width, camera.height / whole.height, 1.0
    return replace(whole, k=np.diag(share) @ whole.k, width=camera.width, height=camera.height)


def _from_above(scene: Description, camera: Camera) -> Camera:
    """Return the border with its rows counted from the top."""
    x0, x1, y0, y1 = scene.film.cut
    height = scene.film.size[1]
    other = replace(scene.film, border=(x0, x1, height - y1, height - y0))
    return camera_through(scene.lens, other, scene.eye.world(scene.frame))


def _shift_times_aspect(scene: Description, camera: Camera) -> Camera:
    """Return the shift up, times the picture's width by its height."""
    (_, v), (fitted, other), k = center(scene), sides(scene), camera.k.copy()
    k[1, 2] = v + (k[1, 2] - v) * other / fitted
    return replace(camera, k=k)


PERCENTAGE = film(lambda s: np.diag((100 / s.film.percentage, 100 / s.film.percentage, 1.0)))

CAMERA_FAULTS = (
    *(offset(*o) for o in ((0.5, 0.5), (0.25, -0.4), (3, -2), (-17, 9))),
    Fault("principal_point", "(w - 1)/2, (h - 1)/2", film(lambda _: moved(-0.5, -0.5))),
    *(focal(share) for share in (0.03, -0.01, 0.4)),
    angle(0.05),
    Fault("sensor_fit", "the same length on the other side", film(_sensor_fit)),
    Fault("sensor_fit", "horizontal", with_camera(_horizontal), only=(3,)),
    Fault(
        "sensor_width_for_height",
        "",
        film(lambda s: s_focal(s, s.lens.sensor_height / s.lens.sensor_width)),
        only=(3,),
    ),
    Fault("shift_sign", "both", _shift(-1, -1), only=(3,)),
    Fault("shift_sign", "y", _shift(1, -1), only=(3,)),
    Fault("shift_unit", "own sides", with_camera(_shift_unit), only=(3,)),
    Fault("shift_left_out", "both", _shift(0, 0), only=(3,)),
    Fault("shift_left_out", "up", _shift(1, 0), only=(3,)),
    Fault("shift_unit", "up, times the aspect", with_camera(_shift_times_aspect), only=(3,)),
    Fault("pixel_aspect_left_out", "", with_camera(_square), only=(3,)),
    Fault("resolution_percentage", "from the upper left", PERCENTAGE, only=(3,)),
    roll(1.5),
    roll(-0.2),
    roll(90.0),
    stand(0.05, -0.02, 0.04),
    stand(-0.3, 0.2, 0.5),
    turned(0.5, 0.3),
    turned(-3.0, 2.0),
    turned(12.0, 0.0),
    elsewhere((0.06, -0.04, 0.05), (0.6, -0.9, 0.4), 1, 2, 3, 4, 5, 6, 7),
    elsewhere((-0.4, 0.25, 0.5), (2.0, 3.0, -1.5), 1, 2, 3, 4, 5, 6, 7),
    elsewhere((0.4, 0.22, -0.26), (-4.0, 6.8, 0.8), 1, 3, 4, 5, 7),
    Fault("camera_moved", "in a room", pose(lambda m: placed((0.1, -0.15, 0.05)) @ m), only=(7,)),
    Fault("last_pixel", "", film(_last_pixel)),
    Fault("focal_lengths", "+3, -2 %", film(lambda s: s_focals(s, 1.03, 0.98)), only=(1, 4, 5, 6)),
    Fault("shift_length", "taken for millimetres", _shift(1 / 36, 1 / 36), only=(3,)),
    Fault("mirrored_x", "", axes(-1, 1, 1)),
    Fault("mirrored_y", "", axes(1, -1, 1)),
    Fault("matrix_transposed", "", pose(_transposed)),
    Fault("matrix_inverted", "", pose(np.linalg.inv)),
    Fault("y_up", "the camera turned", pose(lambda m: Y_UP @ m)),
    Fault("y_up", "the scene turned", pose(lambda m: Y_UP.T @ m)),
    Fault("quarter_turn", "half a turn about X", pose(lambda m: np.diag((1.0, -1, -1, 1)) @ m)),
    Fault("quarter_turn", "about Z", pose(lambda m: Z_TURN @ m)),
    Fault("forward", "z", axes(1, 1, -1)),
    Fault("forward", "y and z", axes(1, -1, -1)),
    Fault("camera_scale", "", with_camera(_scaled), only=(4,)),
    Fault("parent_left_out", "", with_camera(_without_parent), only=(4,)),
    Fault("ortho_scale", "the height", film(_sensor_fit), only=(2,)),
    Fault("ortho_scale", "half the width", film(lambda s: magnified(s, 0.5, 0.5)), only=(2,)),
    Fault("ortho_scale", "twice the width", film(lambda s: magnified(s, 2, 2)), only=(2,)),
    Fault("camera_type", "", with_camera(_perspective), only=(2,)),
    Fault("clip_start", "through the second object", clip(start=0)),
    Fault("clip_start", "0.1 m", clip(start=0.1), only=(6,)),
    Fault("clip_end", "through the second object", clip(end=0)),
    Fault("clip_end", "100 m", clip(end=100.0), only=(6,)),
    Fault("other_camera", "", _other_camera, only=(1, 2, 4, 6, 7)),
    *(frame(by) for by in (1, 0.5, -3)),
    Fault("border", "rows from above", with_camera(_from_above), only=(6,)),
    Fault("border", "the whole view in the border's pixels", with_camera(_whole_film), only=(6,)),
)
