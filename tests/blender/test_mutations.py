"""A comparison that could not fail would prove nothing: faults on purpose, each one found."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.tracer.progress import result_of

from .exporters import moved

SCENES = ("exercise_perspective", "exercise_orthographic", "suzanne")


class Original:
    """What was gathered of a scene once, without what is known of its surfaces; and its frame."""

    def __init__(self, context) -> None:
        case = gather_case(context)
        picture = replace(case.picture, owners=None)
        self.case = replace(case, picture=picture, self_check=False, certificate=None)
        self.comparison = result_of(trace_and_compare(self.case))
        self.frame = self.comparison.frame
        index, scene = self.frame.instance_index, self.case.scene
        is_mesh = (index >= 0) & (index < len(scene.instances))
        seen, count = np.unique(index[is_mesh], return_counts=True)
        self.seen = seen[np.argsort(-count)].tolist()  # the largest first
        fit = context.scene.camera.data.sensor_fit
        wide = scene.camera.width >= scene.camera.height
        self.fits_width = wide if fit == "AUTO" else fit == "HORIZONTAL"

    def camera(self, **changes) -> Case:
        scene = self.case.scene
        return self.case.in_scene(scene.seen_by(replace(scene.camera, **changes)))

    def turned(self, change) -> Case:
        """Return the case with another matrix of the camera, which a function changes in place."""
        matrix = self.case.scene.camera.world_from_camera.copy()
        change(matrix)
        return self.camera(world_from_camera=matrix)

    def instances(self, instances) -> Case:
        return self.case.in_scene(replace(self.case.scene, instances=tuple(instances)))

    def shows(self, color) -> Case:
        picture = replace(self.case.picture, color=np.ascontiguousarray(color))
        return replace(self.case, picture=picture)


def transpose(matrix) -> None:
    matrix[:3, :3] = matrix[:3, :3].T.copy()


def mirror(matrix) -> None:
    matrix[:3, 0] *= -1


def swapped_sensor_fit(original):
    """The view window as if the lens were fitted to the picture's other side."""
    camera = original.case.scene.camera
    factor = camera.width / camera.height
    if not original.fits_width:
        factor = 1 / factor
    sides = {name: factor * side for name, side in vars(camera.window).items()}
    return original.camera(window=replace(camera.window, **sides))


def transposed_object(original):
    """The matrix of one object that is seen, and is turned."""
    instances = list(original.case.scene.instances)
    for index in original.seen:
        matrix = instances[index].world_from_object.copy()
        transpose(matrix)
        if not np.allclose(matrix, instances[index].world_from_object):
            instances[index] = replace(instances[index], world_from_object=matrix)
            return original.instances(instances)
    return None


def dropped_object(original):
    instances = original.case.scene.instances
    dropped = instances[original.seen[0]].object
    return original.instances(i for i in instances if i.object != dropped)


def one_wrong_color(original):
    """A single colour, off by a hundredth."""
    instances = list(original.case.scene.instances)
    first = original.seen[0]
    colors = instances[first].colors + np.float32(0.01)
    instances[first] = replace(instances[first], colors=colors)
    return original.instances(instances)


def one_wrong_pixel(original):
    """In the midst of one surface."""
    picture = original.case.picture.color.copy()
    index = original.frame.instance_index
    same = np.ones(index.shape, bool)
    for shift in np.ndindex(3, 3):
        same &= np.roll(index, np.subtract(shift, 1), (0, 1)) == index
    y, x = np.argwhere(same & (index >= 0))[0]
    picture[y, x, :3] = 1 - picture[y, x, :3]
    return original.shows(picture)


def nearer_clip_start(original):
    seen = original.frame.t[np.isfinite(original.frame.t)]
    return original.camera(clip_start=float(seen.min() + seen.max()) / 2)


MUTATIONS = {
    "half_pixel": lambda o: o.case.in_scene(moved(o.case.scene, 0.5, 0.5)),
    "tenth_of_a_pixel": lambda o: o.case.in_scene(moved(o.case.scene, 0.1, 0)),
    "mirrored_x": lambda o: o.turned(mirror),
    "swapped_sensor_fit": swapped_sensor_fit,
    "transposed_camera": lambda o: o.turned(transpose),
    "transposed_object": transposed_object,
    "dropped_object": dropped_object,
    "flipped_rows": lambda o: o.shows(o.case.picture.color[::-1]),
    "swapped_channels": lambda o: o.shows(o.case.picture.color[..., [2, 1, 0, 3]]),
    "one_wrong_color": one_wrong_color,
    "one_wrong_pixel": one_wrong_pixel,
    "nearer_clip_start": nearer_clip_start,
}
SHIFTED = pytest.param("shifted_room", marks=pytest.mark.torture)  # seconds; attacked every day


@pytest.mark.parametrize("name", [*SCENES, SHIFTED])
def test_every_fault_is_found_and_only_a_fault(name, opened):
    opened(name, 72)
    original = Original(bpy.context)
    assert original.comparison.verdict == "agree"
    mutated = {name: mutate(original) for name, mutate in MUTATIONS.items()}
    cases = {name: case for name, case in mutated.items() if case is not None}
    found = {name: result_of(trace_and_compare(case)).verdict for name, case in cases.items()}
    assert found == dict.fromkeys(found, "differences")
    assert len(found) >= len(MUTATIONS) - 1
