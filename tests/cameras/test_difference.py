"""A camera that is off is measured in pixels, and what makes it of the scene's is named.

Each mistake is written here as a formula of its own on K, R and t, not by the faults' code.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import islice, product

import numpy as np
import pytest
from reference_tracer.camera_files import frame
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC
from reference_tracer.scene import Camera, ViewWindow
from reference_tracer_cameras.difference import CLOSE, difference

from ..sampled import sampled

WIDTH, HEIGHT = 640, 360


@pytest.fixture
def own():
    """A shifted camera, from above and beside, in a picture that is not square."""
    angle, tilt = 0.7, 1.1
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1.0]]
    )
    lean = np.array(
        [[1.0, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn @ lean
    matrix[:3, 3] = 2.0, -3.0, 1.5
    window = ViewWindow(-0.4 + 0.1, 0.4 + 0.1, -0.225 + 0.06, 0.225 + 0.06)
    return Camera(matrix, window, WIDTH, HEIGHT, clip_start=0.5, clip_end=40)


def with_k(camera, change):
    """The camera with its (fx, fy, cx, cy) changed."""
    k = frame.matrix_of(*change(*frame.intrinsics(camera)))
    return frame.pinhole(k, frame.camera_from_world(camera), (WIDTH, HEIGHT), "").camera


def with_world(camera, change):
    """The camera with its (4, 4) matrix from OpenCV's camera space changed."""
    cv = np.linalg.inv(frame.camera_from_world(camera))
    k = frame.matrix_of(*frame.intrinsics(camera))
    return frame.pinhole(k, np.linalg.inv(change(cv)), (WIDTH, HEIGHT), "").camera


def shift_left_out(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (fx, fy, WIDTH / 2, HEIGHT / 2))


def half_pixel(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (fx, fy, cx - 0.5, cy - 0.5))


def beside(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (fx, fy, cx + 30, cy - 12))


def longer(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (1.02 * fx, 1.02 * fy, cx, cy))


def oblong(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (1.02 * fx, fy, cx, cy))


def other_side(camera):
    """The sensor's width fitted to the picture's height: the shift is in its lengths, too."""
    by = HEIGHT / WIDTH
    return with_k(
        camera,
        lambda fx, fy, cx, cy: (by * fx, by * fy, cx, cy),
    )


def sign_of_shift(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (fx, fy, WIDTH - cx, HEIGHT - cy))


def transposed(camera):
    def change(cv):
        m = cv @ np.diag((1, -1, -1, 1))  # Blender's camera space
        m[:3, :3] = m[:3, :3].T
        return m @ np.diag((1, -1, -1, 1))

    return with_world(camera, change)


def inverted(camera):
    flip = np.diag((1, -1, -1, 1))
    return with_world(camera, lambda cv: np.linalg.inv(cv @ flip) @ flip)


def y_up(camera):
    return with_world(
        camera, lambda cv: np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]) @ cv
    )


def opencv_for_opengl(camera):
    """R of OpenCV is taken for that of OpenGL: y is down, and z forward."""
    return with_world(camera, lambda cv: cv @ np.diag((1, -1, -1, 1)))


def moved(camera):
    def change(cv):
        return cv + np.array([[0, 0, 0, 0.1], [0, 0, 0, 0], [0, 0, 0, -0.2], [0, 0, 0, 0]])

    return with_world(camera, change)


def rolled(camera):
    c, s = np.cos(0.01), np.sin(0.01)
    return with_world(
        camera, lambda cv: cv @ [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    )


def in_opencv(camera, change):
    """The camera with its [R | t] of OpenCV changed, (R, t, C) -> (R, t)."""
    pose = frame.camera_from_world(camera)
    r, t = change(pose[:3, :3], pose[:3, 3], camera.origin)
    k = frame.matrix_of(*frame.intrinsics(camera))
    return frame.pinhole(k, frame.pose(r, t), (WIDTH, HEIGHT), "").camera


def inverse_of_opencv(camera):
    return in_opencv(camera, lambda r, t, c: (r.T, c))


def transposed_in_opencv(camera):
    return in_opencv(camera, lambda r, t, c: (r.T, t))


def place_for_t(camera):
    return in_opencv(camera, lambda r, t, c: (r, c))


def t_for_place(camera):
    """A camera-to-world matrix of OpenCV's axes, with the t of world-to-camera."""
    return in_opencv(camera, lambda r, t, c: (r, -r @ t))


def left_handed(camera):
    """Y mirrored in the world, and in the camera's space: still a rotation."""
    flip = np.diag((1.0, -1, 1))
    return in_opencv(camera, lambda r, t, c: (flip @ r @ flip, -flip @ r @ flip @ flip @ c))


def x_forward(camera):
    """The world turned by a quarter about Z."""
    quarter = np.array([[0, -1.0, 0], [1, 0, 0], [0, 0, 1]])
    return in_opencv(camera, lambda r, t, c: (r @ quarter.T, t))


def sides_exchanged(camera):
    by = (WIDTH - HEIGHT) / 2
    return with_k(camera, lambda fx, fy, cx, cy: (fx, fy, cx - by, cy + by))


def divided(camera):
    return with_k(camera, lambda fx, fy, cx, cy: (fx / WIDTH, fy / HEIGHT, cx / WIDTH, cy / HEIGHT))


def mirrored(camera):
    return with_world(camera, lambda cv: cv @ np.diag((-1, 1, 1, 1)))


MISTAKES = {
    shift_left_out: ["shift_left_out"],
    half_pixel: ["pixel_offset"],
    longer: ["focal_length"],
    oblong: ["focal_lengths"],
    other_side: ["sensor_fit"],
    sign_of_shift: ["shift_sign"],
    transposed: ["matrix_transposed"],
    inverted: ["matrix_inverted"],
    y_up: ["y_up"],
    opencv_for_opengl: ["forward"],
    moved: ["camera_moved"],
    rolled: ["roll"],
    mirrored: ["mirrored_x"],
    inverse_of_opencv: ["matrix_inverted"],
    transposed_in_opencv: ["matrix_transposed"],
    place_for_t: ["place_for_translation"],
    t_for_place: ["place_for_translation"],
    left_handed: ["handedness"],
    x_forward: ["quarter_turn"],
    sides_exchanged: ["sides_exchanged"],
    divided: ["k_divided"],
    lambda c: longer(inverse_of_opencv(c)): ["matrix_inverted", "focal_length"],
    lambda c: opencv_for_opengl(inverse_of_opencv(c)): ["forward", "matrix_inverted"],
    lambda c: shift_left_out(half_pixel(c)): ["shift_left_out"],
    lambda c: half_pixel(shift_left_out(c)): ["shift_left_out", "pixel_offset"],
    lambda c: shift_left_out(y_up(c)): ["y_up", "shift_left_out"],
    lambda c: beside(longer(c)): ["focal_length", "pixel_offset"],
    lambda c: moved(rolled(oblong(half_pixel(c)))): [
        "camera_turned",
        "camera_moved",
        "focal_lengths",
        "pixel_offset",
    ],
}


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda m: m.__name__)
def test_a_mistake_is_named(mistake, own):
    found = difference(own, mistake(own))
    assert not found.agrees and found.largest > 0.5
    assert [step.fault.name for step in found.steps] == MISTAKES[mistake]


def test_every_way_of_a_mistake_is_told_apart_from_a_camera_that_is_moved(own):
    """A camera near the one of a mistake does not get its name."""
    for mistake in (inverse_of_opencv, transposed_in_opencv, place_for_t, left_handed, x_forward):
        matrix = mistake(own).world_from_camera.copy()
        matrix[:3, 3] += 0.01
        near = replace(mistake(own), world_from_camera=matrix)
        names = [step.fault.name for step in difference(own, near).steps]
        assert "camera_moved" in names, mistake.__name__


def test_what_two_mistakes_explain_both_are_said(own):
    """Of a camera on the world's origin the place says nothing: its matrix is inverted, or R is."""
    matrix = own.world_from_camera.copy()
    matrix[:3, 3] = 0
    there = replace(own, world_from_camera=matrix)
    found = difference(there, inverse_of_opencv(there))
    names = [[step.fault.name for step in steps] for steps in found.explanations]
    assert names == [["matrix_transposed"], ["matrix_inverted"]] and "or:" in found.lines()


@pytest.mark.parametrize(
    "axes", [np.eye(3), [[1, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [1, 0, 0], [0, 1, 0]]]
)
def test_half_a_pixel_is_no_other_mistake_of_a_camera_along_an_axis(axes, own):
    """From above, the front or the side, a mistake of the matrix may change nothing."""
    matrix = np.eye(4)
    matrix[:3, :3] = axes
    matrix[:3, 3] = matrix[:3, 2] * 5
    there = replace(own, world_from_camera=matrix, window=ViewWindow(-0.4, 0.4, -0.225, 0.225))
    found = difference(there, half_pixel(there))
    assert [step.fault.name for step in found.steps] == ["pixel_offset"]


def test_the_numbers_are_those_of_the_mistake(own):
    (step,) = difference(own, longer(own)).steps
    assert step.guess.values == pytest.approx((2.0,))
    (step,) = difference(own, half_pixel(own)).steps
    # A principal point half a pixel less in both: rays half a pixel to the right, and lower.
    assert step.guess.values == pytest.approx((0.5, -0.5))
    lines = difference(own, half_pixel(own)).lines()
    assert any(
        "pass the pixels' corners" in line and "(+0.500, -0.500) px" in line for line in lines
    )
    assert lines[-1] == "  its principal point is off by (-0.500, -0.500) px, rows down"
    assert difference(own, half_pixel(own)).largest == pytest.approx(np.hypot(0.5, 0.5))


def test_no_distance_is_said_of_points_behind_the_camera(own):
    found = difference(own, opencv_for_opengl(own))
    line = found.lines()[0]
    assert "points lie behind the camera" in line and line.endswith(", half of them there")
    assert found.largest == np.inf


def test_another_unit_of_length_is_asked_for(own):
    """The place in millimetres; of a camera that is only moved, nothing is said of units."""

    def millimetres(cv):
        return np.vstack((np.hstack((cv[:3, :3], 1000 * cv[:3, 3:])), cv[3:]))

    found = difference(own, with_world(own, millimetres))
    assert [step.fault.name for step in found.steps] == ["camera_moved"]
    assert found.lines()[-1].endswith("the scene's times 1000: another unit of length?")
    assert difference(own, moved(own)).unit is None
    assert difference(own, longer(own)).unit is None


def test_what_rounding_moves_agrees_and_ten_times_that_does_not(own):
    def off(by):
        return with_k(own, lambda fx, fy, cx, cy: (fx, fy, cx + by, cy))

    assert difference(own, off(CLOSE / 2)).agrees
    found = difference(own, off(10 * CLOSE))
    assert not found.agrees and found.steps[0].fault.name == "pixel_offset"


@pytest.mark.parametrize("angle", [1e-7, 1e-3, np.pi / 2, np.pi - 1e-6, np.pi])
def test_any_turn_is_read_off(angle, own):
    """Also half a turn, of which the rotation's matrix is symmetric."""
    axis = np.array((0.6, -0.64, 0.48))
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    r = np.eye(4)
    r[:3, :3] += np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    other = with_world(own, lambda cv: cv @ r)
    found = difference(own, other)
    assert found.agrees or [s.fault.name for s in found.steps] == ["camera_turned"]
    assert found.agrees == (angle < 1e-6)


def test_a_camera_that_no_known_mistake_makes_gets_no_name(own):
    """A skew is none of the faults: it is measured, and nothing is said to be the reason."""
    k = frame.matrix_of(*frame.intrinsics(own))
    k[0, 1] = 40
    other = frame.pinhole(k, frame.camera_from_world(own), (WIDTH, HEIGHT), "").camera
    found = difference(own, other)
    assert not found.agrees and found.steps == ()
    assert "no known fault" in found.lines()[-1]


def cameras_of_all_kinds():
    matrix = np.eye(4)
    matrix[:3, 3] = 1, 2, 4
    plain = Camera(matrix, ViewWindow(-0.4, 0.4, -0.3, 0.3), 64, 48)
    parallel = replace(plain, projection=ORTHOGRAPHIC, window=ViewWindow(-4, 4, -3, 3))
    around = replace(plain, projection=EQUIRECTANGULAR, window=ViewWindow(-1, 1, -0.5, 0.5))
    mirrored = replace(plain, world_from_camera=matrix * (-1, 1, 1, 1))
    back = replace(plain, world_from_camera=matrix * (-1, 1, -1, 1))
    behind = replace(parallel, clip_start=-5, clip_end=-1)
    endless = replace(plain, clip_end=np.inf)
    return plain, parallel, around, mirrored, back, behind, endless


@sampled(2)
def test_cameras_of_all_kinds_are_compared(every):
    cameras = cameras_of_all_kinds()
    for first, second in islice(product(cameras, repeat=2), 0, None, every):
        # Some differ in what they clip alone.
        same = all(
            getattr(first, n) == getattr(second, n) for n in ("projection", "window")
        ) and np.array_equal(first.world_from_camera, second.world_from_camera)
        found = difference(first, second)
        assert found.agrees == same and found.lines()
