"""A comparison that could not fail would prove nothing: faults on purpose, each one found."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.picture import Picture
from reference_tracer.tracer.progress import result_of

SCENES = ("exercise_perspective", "exercise_orthographic", "suzanne")


def with_camera(gathered, **changes):
    return replace(gathered.scene, camera=replace(gathered.scene.camera, **changes))


def half_pixel(gathered):
    """Rays through the pixels' corners, not their centres."""
    window, camera = gathered.scene.camera.window, gathered.scene.camera
    x = 0.5 * (window.right - window.left) / camera.width
    y = 0.5 * (window.top - window.bottom) / camera.height
    return with_camera(
        gathered,
        window=replace(
            window,
            left=window.left + x,
            right=window.right + x,
            bottom=window.bottom + y,
            top=window.top + y,
        ),
    ), gathered.picture


def tenth_of_a_pixel(gathered):
    window, camera = gathered.scene.camera.window, gathered.scene.camera
    x = 0.1 * (window.right - window.left) / camera.width
    return with_camera(
        gathered, window=replace(window, left=window.left + x, right=window.right + x)
    ), gathered.picture


def mirrored_x(gathered):
    matrix = gathered.scene.camera.world_from_camera.copy()
    matrix[:3, 0] *= -1
    return with_camera(gathered, world_from_camera=matrix), gathered.picture


def swapped_sensor_fit(gathered):
    """The view window as if the lens were fitted to the picture's other side."""
    camera = gathered.scene.camera
    fitted = camera.width if gathered.fit == "HORIZONTAL" else camera.height
    other = camera.height if gathered.fit == "HORIZONTAL" else camera.width
    w = camera.window
    factor = fitted / other
    return with_camera(
        gathered,
        window=replace(
            w,
            left=w.left * factor,
            right=w.right * factor,
            bottom=w.bottom * factor,
            top=w.top * factor,
        ),
    ), gathered.picture


def transposed_camera(gathered):
    matrix = gathered.scene.camera.world_from_camera.copy()
    matrix[:3, :3] = matrix[:3, :3].T
    return with_camera(gathered, world_from_camera=matrix), gathered.picture


def transposed_object(gathered):
    """The matrix of one object that is seen, and is turned."""
    instances = list(gathered.scene.instances)
    for index in gathered.seen:
        matrix = instances[index].world_from_object.copy()
        if not np.allclose(matrix[:3, :3], matrix[:3, :3].T):
            matrix[:3, :3] = matrix[:3, :3].T
            instances[index] = replace(instances[index], world_from_object=matrix)
            return replace(gathered.scene, instances=tuple(instances)), gathered.picture
    return None


def dropped_object(gathered):
    dropped = gathered.scene.instances[gathered.seen[0]].object
    return replace(
        gathered.scene, instances=tuple(i for i in gathered.scene.instances if i.object != dropped)
    ), gathered.picture


def flipped_rows(gathered):
    return gathered.scene, np.ascontiguousarray(gathered.picture[::-1])


def swapped_channels(gathered):
    return gathered.scene, np.ascontiguousarray(gathered.picture[..., [2, 1, 0, 3]])


def one_wrong_color(gathered):
    """A single colour, off by a hundredth."""
    instances = list(gathered.scene.instances)
    index = gathered.seen[0]
    instances[index] = replace(instances[index], colors=instances[index].colors + np.float32(0.01))
    return replace(gathered.scene, instances=tuple(instances)), gathered.picture


def one_wrong_pixel(gathered):
    """In the midst of one surface."""
    picture = gathered.picture.copy()
    index = gathered.frame.instance_index
    same = np.ones(index.shape, bool)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            same &= np.roll(index, (dy, dx), (0, 1)) == index
    y, x = np.argwhere(same & (index >= 0))[0]
    picture[y, x, :3] = 1 - picture[y, x, :3]
    return gathered.scene, picture


def nearer_clip_start(gathered):
    nearest = float(gathered.frame.t.min())
    farthest = float(gathered.frame.t[np.isfinite(gathered.frame.t)].max())
    return with_camera(gathered, clip_start=(nearest + farthest) / 2), gathered.picture


MUTATIONS = (
    half_pixel,
    tenth_of_a_pixel,
    mirrored_x,
    swapped_sensor_fit,
    transposed_camera,
    transposed_object,
    dropped_object,
    flipped_rows,
    swapped_channels,
    one_wrong_color,
    one_wrong_pixel,
    nearer_clip_start,
)


class Original:
    """What was gathered of a scene once, and its true comparison."""

    def __init__(self, context) -> None:
        self.case = gather_case(context)
        self.scene, self.picture = self.case.scene, self.case.picture.color
        self.comparison = self.compared(self.scene, self.picture)
        self.frame = self.comparison.frame
        index = self.frame.instance_index
        seen, count = np.unique(
            index[(index >= 0) & (index < len(self.scene.instances))], return_counts=True
        )
        self.seen = [int(i) for i in seen[np.argsort(-count)]]  # the largest first
        data = context.scene.camera.data
        wide = self.scene.camera.width >= self.scene.camera.height
        self.fit = (
            data.sensor_fit if data.sensor_fit != "AUTO" else ("HORIZONTAL" if wide else "VERTICAL")
        )

    def compared(self, scene, color):
        """Compare without what is known of whose surfaces Blender shows."""
        source = self.case.picture.source
        case = replace(self.case, scene=scene, picture=Picture(color, source), self_check=False)
        return result_of(trace_and_compare(replace(case, certificate=None)))


SHIFTED = pytest.param("shifted_room", marks=pytest.mark.torture)  # seconds; attacked every day


@pytest.mark.parametrize("name", [*SCENES, SHIFTED])
def test_every_fault_is_found_and_only_a_fault(name, opened):
    opened(name, 72)
    original = Original(bpy.context)
    assert original.comparison.verdict == "agree"
    found = {}
    for mutate in MUTATIONS:
        mutated = mutate(original)
        if mutated is not None:
            found[mutate.__name__] = original.compared(*mutated).verdict
    assert found == dict.fromkeys(found, "differences")
    assert len(found) >= len(MUTATIONS) - 1
