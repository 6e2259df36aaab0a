"""Cases from their parts, as the tests have them."""

from __future__ import annotations

from dataclasses import replace

from reference_tracer.causes import explain as causes
from reference_tracer.causes.case import Case
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.picture import Picture, Source
from reference_tracer.tracer.settings import Settings

MANIFEST = Manifest("a.blend", "Scene", "ViewLayer", 1, "RENDER", "Camera")
WORKBENCH = Source("workbench", "5.2.3")


def case_of(scene, picture, unmodelled=(), settings=None, objects=(), **known) -> Case:
    """Return the case of a scene and a picture of it, an array or a Picture."""
    manifest = replace(MANIFEST, unmodelled=tuple(unmodelled), objects=tuple(objects))
    if not isinstance(picture, Picture):
        picture = Picture(picture, WORKBENCH)
    return Case(scene, manifest, settings or Settings(), picture, **known)


def find_causes(
    scene, frame, picture, unmodelled=(), sample_radius=0.0, filter_radius=0.0, **known
):
    """Return the work of finding the causes of what was traced already."""
    case = case_of(scene, picture, unmodelled, **known)
    radii = {"sample_radius": sample_radius, "filter_radius": filter_radius}
    return causes.find_causes(replace(case, picture=replace(case.picture, **radii)), frame)
