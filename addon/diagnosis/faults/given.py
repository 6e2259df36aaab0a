"""Faults that only Blender can make, as it knows what the exported scene came from.

The scenes with them come as the case's variants; see `blender/variants.py`.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...causes.case import Case
from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import Example, Fault, Guess


@dataclass(frozen=True, eq=False)
class Given(Guess):
    """A scene made with the fault."""

    scene: Scene


def in_its_scene(case: Case, guess: Given) -> Case:
    """Return the case with the guess' scene."""
    return case.in_scene(guess.scene)


def _a_frame_later(case: Case, frame: Frame) -> Given | None:
    return None if case.next_frame is None else Given(case.next_frame)


def _given(
    name: str, sentence: str, why: str, advice: str, *examples: Example, witness: str
) -> Fault[Given]:
    @at_once
    def find(evidence: Evidence) -> list[Given]:
        own = (v for v in evidence.variants if v.fault == name)
        return [Given(v.scene, object=v.object, words=v.words) for v in own]

    return Fault(
        name, sentence, why, advice, in_its_scene, find, examples=examples, witness=witness
    )


GIVEN_FAULTS = (
    _given(
        "other_frame",
        "the picture is of another frame: {words}",
        "A script renders the frame at which the file was saved, or counts frames from 0.",
        "render the frame that the scene is at, or compare with --set frame=",
        Example("wrong_frame", "the scene a frame later", _a_frame_later),
        witness="KhronosGroup/glTF-Blender-Exporter#322",
    ),
    _given(
        "other_camera",
        "the picture is taken by another camera of the scene: {words}",
        "An exporter takes the first camera that it finds, or a marker on the timeline has made"
        " another one active.",
        "make that camera active, or compare with --camera",
        witness="GPUOpen-LibrariesAndSDKs/RadeonProRenderBlenderAddon#17",
    ),
    _given(
        "sensor_width_for_height",
        "the sensor's width is taken for its height, or the height for the width",
        "Blender uses the sensor's height with sensor fit Vertical only, not for every portrait.",
        "with sensor fit Vertical, the sensor's height spans the picture's height; else its width "
        "is what the lens is fitted to",
        witness="isaac-sim/IsaacSim#200",
    ),
    _given(
        "sensor_fit_setting",
        "the camera's sensor fit is another: {words}",
        "An exporter follows one rule for all cameras, and does not read the setting.",
        "take the sensor fit of the camera: it says which side of the sensor and the picture fit",
        witness="LuxCoreRender/BlendLuxCore#122",
    ),
    _given(
        "camera_scale",
        "the scale of the camera, or of its parents, is not removed",
        "`matrix_world` includes the scale of the camera and of its parents, which "
        "Blender itself ignores.",
        "divide each axis of the camera's matrix by its length: Blender's cameras have no scale",
        witness="JiayinCao/SORT#88",
    ),
    _given(
        "parent_left_out",
        "the parent's transform is left out: {words}",
        "An object's `location`, `rotation_euler` and `scale` are relative to its parent, and "
        "without its constraints.",
        "use matrix_world, which has the parent's transform and its inverse",
        witness="X-Plane/XPlane2Blender#127",
    ),
    _given(
        "parent_scale",
        "the parent's scale is left out: {words}",
        "The chain of parents is rebuilt from locations and rotations alone.",
        "use matrix_world: the parent's scale moves and scales what is parented to it",
        witness="Nusiq/mcblend#62",
    ),
    _given(
        "parent_inverse",
        "the parent's inverse is left out: {words}",
        "When an object is parented, Blender keeps it in place by a matrix that other "
        "programs lack (matrix_parent_inverse).",
        "world = parent's world @ matrix_parent_inverse @ matrix_basis",
        witness="NikolaiVChr/Blender-AC3D#5",
    ),
    _given(
        "delta_left_out",
        "the delta transform is left out: {words}",
        "Blender adds `delta_location`, `delta_rotation_euler` and `delta_scale` to an object's "
        "own.",
        "use matrix_world: it has the delta transform, the parent's and the constraints",
        witness="godotengine/godot-blender-exporter#163",
    ),
    _given(
        "camera_type",
        "the camera is taken for one of another type: {words}",
        "The renderer has one type of camera so far, or the exporter writes every camera"
        " as a perspective one.",
        "take the camera's type from the scene",
        witness="lunadigital/btoa#107",
    ),
    _given(
        "rest_pose",
        "{words} at rest pose: the armature or the shape keys are left out",
        "`object.data` is the mesh before its armature and its shape keys.",
        "export the evaluated mesh",
        witness="KhronosGroup/glTF-Blender-IO#2166",
    ),
    _given(
        "viewport_modifiers",
        "modifiers are as in the viewport, not as in a render: {words}",
        "`context.evaluated_depsgraph_get()` evaluates for the viewport, also in the "
        "background; only a render engine gets a depsgraph for a render.",
        "evaluate the depsgraph for a render",
        witness="xavier150/Blender-For-UnrealEngine-Addons#194",
    ),
    _given(
        "no_modifiers",
        "modifiers are left out: {words}",
        "`object.data` is the mesh before its modifiers.",
        "export the evaluated mesh, not the object's data",
        witness="lsalzman/iqm#15",
    ),
    _given(
        "subdivision",
        "subdivision at another level: {words}",
        "A subdivision has one level for the viewport and one for renders.",
        "use the render levels of the modifier",
        witness="Bforartists/Bforartists#3645",
    ),
    _given(
        "instance_transform",
        "the transform of instances is left out: {words}",
        "`object.matrix_world` is the same for all instances of an object: the matrix of each "
        "is in `depsgraph.object_instances`.",
        "each instance has a world matrix of its own, beside its object's",
        witness="KhronosGroup/glTF-Blender-IO#1981",
    ),
    _given(
        "instance_offset",
        "the offset of an instanced collection is left out: {words}",
        "A collection has a point that its instances put where the empty is (`instance_offset`).",
        "use the matrices of `depsgraph.object_instances`, which have it",
        witness="armory3d/armory#1415",
    ),
    _given(
        "hidden_shown",
        "'{object}' is shown, and the scene hides it: {words}",
        "Blender hides objects for the viewport, for renders, by the eye, and by "
        "collections; an exporter heeds one of these.",
        "leave out what is hidden in renders",
        witness="lunadigital/btoa#9",
    ),
    _given(
        "other_layer",
        "the picture is of another view layer: {words}",
        "Blender renders all view layers that are switched on; an exporter writes the active one.",
        "render the view layer that is compared",
        witness="aws-deadline/deadline-cloud-for-blender#92",
    ),
)
