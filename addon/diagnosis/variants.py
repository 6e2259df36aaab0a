"""The variants of a case in a diagnosis: scenes that Blender made with a fault, or whole.

A fault that is put right is put right in them, too, so that the next one may be among them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..causes.case import MOST_VARIANTS, WHOLE, Variant
from ..causes.explain import explain
from ..rendering import frame_of
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.progress import Progress, Work
from .evidence import Evidence
from .faults.given import Given
from .trial import Trial

ASKING = "asking Blender for scenes with a fault"


def with_variants(evidence: Evidence) -> Work[Evidence]:
    """Return the evidence with the case's variants, and with the objects outside the view.

    What no ray hits is not exported, but a faulty camera may have seen it.
    """
    case = evidence.case
    variants: list[Variant] = []
    yield _asking(1)  # before Blender evaluates the first, in which it hears nothing
    for variant in case.variants():
        variants.append(replace(variant, scene=_as_in(case.scene, variant.scene)))
        yield _asking(len(variants) + 1)
    others = tuple(v for v in variants if v.fault != WHOLE)
    for whole in (v.scene for v in variants if v.fault == WHOLE):
        if len(whole.instances) > len(case.scene.instances):
            scene = replace(
                case.scene,
                meshes=whole.meshes,
                instances=whole.instances,
                objects=whole.objects,
            )
            case = case.in_scene(scene)
            frame = yield from frame_of(scene, case.settings, case.tracer)
            if _look_alike(frame, evidence.frame):  # then each pixel's cause is what it was
                return Evidence(case, frame, evidence.causes, others)
            found = yield from explain(case, frame)
            return Evidence(found.case, found.frame, found.causes, others)
    return replace(evidence, variants=others)


def _asking(number: int) -> Progress:
    return Progress(None, f"{number}/{MOST_VARIANTS}: {ASKING}")


def _look_alike(first: Frame, second: Frame) -> bool:
    """Return whether two frames are equal but for the numbering of instances."""
    return all(
        np.array_equal(getattr(first, name), getattr(second, name))
        for name in ("color", "t", "triangle_index")
    )


def carried(evidence: Evidence, trial: Trial) -> Evidence:
    """Return the evidence with a fault put right, also in the variants."""
    variants = []
    for variant in evidence.variants:
        scene, guess = variant.scene, trial.guess
        if isinstance(guess, Given):  # of two such faults, one may be the camera's
            other = guess.scene.camera is not evidence.case.scene.camera
            scene = scene.seen_by(guess.scene.camera) if other else scene
        elif case := trial.fault.assume(evidence.case.in_scene(scene), guess):
            scene = case.scene
        variants.append(replace(variant, scene=scene))
    of_object = evidence.of_object or bool(trial.guess.object)
    return in_its_colors(replace(trial.evidence, variants=tuple(variants), of_object=of_object))


def in_its_colors(evidence: Evidence) -> Evidence:
    """Return the evidence with the transform of colours that was found put right.

    What else is wrong is looked for as if the colours were right.
    """
    made_by, case = evidence.causes.made_by, evidence.case
    picture = replace(case.picture, transform=made_by or case.picture.transform)
    return replace(evidence, case=replace(case, picture=picture), known={}) if made_by else evidence


def _as_in(own: Scene, other: Scene) -> Scene:
    """Return another scene with the background and the objects' colours of a case's own."""
    colors = {own.objects[i.object]: i.colors for i in own.instances}
    instances = [
        replace(i, colors=colors.get(other.objects[i.object], i.colors)) for i in other.instances
    ]
    return replace(other, instances=tuple(instances), background=own.background)
