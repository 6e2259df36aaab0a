"""Pictures with a fault, and what the diagnosis tells of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.guessing import ALL_EDGES
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of

from ..cases import case_of

BY_NAME = {fault.name: fault for fault in FAULTS}


def within(before, steps):
    """Return a comparison, diagnosed in so many steps of work."""
    work = diagnose(before.case, before.frame, before.causes, steps=steps)
    return replace(before, diagnosis=result_of(work))


def diagnosis_of(scene, color, **known):
    """Return the comparison of a scene with a picture of unknown make, diagnosed."""
    case = case_of(scene, Picture(color), curves=(), **known)
    before = result_of(trace_and_compare(case))
    found = within(before, np.inf)
    assert found.verdict == before.verdict
    return found


def pictured(scene, name, guess):
    """Return the picture that a fault makes of a scene."""
    frame = render(scene)
    fault = BY_NAME[name]
    of_picture = (example.make for example in fault.examples if example.make)
    make = next(of_picture, fault.assume)
    wrong = make(case_of(scene, frame.color), guess)
    if wrong.scene is scene:
        return wrong.picture.color
    return render(wrong.scene).color


def names(found):
    """Return what is told."""
    return [told.fault.name for told in found.diagnosis.told] if found.diagnosis else []


def told(scene, color, *names, **known):
    """Return what is told of a picture, if only some faults are looked for: of nearly all of it."""
    said = said_of(scene, color, *names, **known)
    assert all(t.settled >= 0.97 * t.unexplained for t in [*said.values()][:1])
    return said


def said_of(scene, color, *names, **known):
    """Return what is told of a picture, if only some faults are looked for: also of a part."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=(), **known)))
    assert found.counts.unexplained > 10
    faults = [BY_NAME[name] for name in names] or FAULTS
    said = result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf)).told
    return {t.fault.name: t for t in said}


def fitted(scene, color, name):
    """Return the numbers of a fault that fit a picture, with what encloses them."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    evidence = Evidence(found.case, found.frame, found.causes)
    if evidence.unexplained.sum() < 25:
        return None
    fault = BY_NAME[name]
    guesses = [g for g in result_of(fault.find(evidence)) if g.low]
    gains = [result_of(evidence.score(fault.assume(found.case, g))).gain for g in guesses]
    best = guesses[int(np.argmax(gains))]
    return result_of(fault.refine(replace(evidence, size=ALL_EDGES), best))
