"""Attacks beside what only one side has: hidden objects, and what is not modelled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reference_tracer.causes.case import Alternative
from reference_tracer.causes.checks.unmodelled import covered
from reference_tracer.manifest import Unmodelled

from .blocks import blocks_of_another, blocks_within
from .subject import Attacked, Subject, in_place, painted
from .surfaces import without_object


def _alternative(subject: Subject, number: int) -> Alternative:
    scene = subject.scene
    left = tuple(i for i in scene.instances if i.object != number)
    planes = tuple(p for p in scene.planes if p.object != number)
    scene = replace(scene, instances=left, planes=planes)
    return Alternative(subject.name(number), "hidden in the viewport", scene)


def another_is_gone(subject: Subject) -> Attacked | None:
    """Leave out one object, where a flag hides another."""
    if len(subject.seen) < 2:
        return None
    made = painted(subject, *without_object(subject, subject.seen[0]))
    other = _alternative(subject, subject.seen[1])
    return made._replace(case=replace(made.case, alternatives=(other,)))


def partly_gone(subject: Subject) -> Attacked | None:
    """Punch holes into an object that a flag hides: it is neither there nor gone."""
    if not subject.seen:
        return None
    number = subject.seen[0]
    where = blocks_within(subject.inside & (subject.object == number))
    made = painted(subject, *without_object(subject, number), where=where)
    other = _alternative(subject, number)
    return made._replace(case=replace(made.case, alternatives=(other,)))


def gone_and_moved(subject: Subject) -> Attacked | None:
    """Leave out an object that a flag hides, and damage another one besides: that is counted."""
    made = blocks_of_another(subject)
    if made is None or len(subject.seen) < 2:
        return None
    number = subject.seen[0]
    frame, instances = without_object(subject, number)
    gone = painted(subject, frame, instances).case.picture
    # What was hidden by the object that is gone may be what a block shows.
    kept = made.changed & (subject.object != number)
    wrong, right = made.case.picture, gone
    color = np.where(kept[..., None], wrong.color, right.color)
    owner = wrong.owners and np.where(kept, wrong.owners.pixels, right.owners.pixels)
    case = replace(
        subject.case,
        picture=in_place(gone, color, owner),
        alternatives=(_alternative(subject, number),),
    )
    return Attacked(case, subject.frame, kept)


def beside_the_box(subject: Subject) -> Attacked | None:
    """Blocks outside the box of something that the tracer does not model."""
    for number in reversed(subject.seen):
        points = subject.frame.positions(slice(None))[(subject.object == number).ravel()]
        box = np.stack((points.min(axis=0), points.max(axis=0)))
        outside = ~covered(subject.scene.camera, box)
        made = blocks_of_another(subject, outside)
        if made is not None:
            feature = Unmodelled(subject.name(number), "hair", "", box)
            manifest = replace(made.case.manifest, unmodelled=(feature,))
            return made._replace(case=replace(made.case, manifest=manifest))
    return None
