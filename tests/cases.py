"""Cases from their parts, as the tests have them, and the causes that are found in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from reference_tracer.causes import explain as causes
from reference_tracer.causes.case import Case
from reference_tracer.causes.explain import AGREE, DEPTH_TIE, EDGE, NOT_DECIDABLE, UNEXPLAINED
from reference_tracer.manifest import Manifest
from reference_tracer.pictures.identity import Owners
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.source import Source
from reference_tracer.pictures.storage import differing
from reference_tracer.rendering import render
from reference_tracer.scene import ViewWindow
from reference_tracer.tracer.camera import pixel_size
from reference_tracer.tracer.progress import Progress, result_of
from reference_tracer.tracer.settings import Settings

MANIFEST = Manifest("a.blend", "Scene", "ViewLayer", 1, "RENDER", "Camera")
WORKBENCH = Source("workbench", "5.2.3")


def case_of(scene, picture, unmodelled=(), settings=None, objects=(), **known) -> Case:
    """Return the case of a scene and a picture of it, an array or a Picture."""
    manifest = replace(MANIFEST, unmodelled=tuple(unmodelled), objects=tuple(objects))
    if not isinstance(picture, Picture):
        picture = Picture(picture, WORKBENCH)
    return Case(scene, manifest, settings or Settings(), picture, **known)


def owners_of(names, frame, owners=None) -> Owners:
    """Return the owners of a picture that shows what a frame does; each instance's by its name."""
    found = Owners.of(names, frame.instance_index, names if owners is None else owners)
    return replace(found, pixels=found.instances[frame.instance_index])


def showing(picture, where, owner) -> Picture:
    """Return a picture that shows other owners in a mask."""
    owners = picture.owners
    return replace(
        picture, owners=owners and replace(owners, pixels=np.where(where, owner, owners.pixels))
    )


def find_causes(
    scene, frame, picture, unmodelled=(), sample_radius=0.0, filter_radius=0.0, **known
):
    """Return the work of finding the causes of what was traced already."""
    case = case_of(scene, picture, unmodelled, **known)
    radii = {"sample_radius": sample_radius, "filter_radius": filter_radius}
    picture = replace(case.picture, sampling=replace(case.picture.sampling, **radii))
    return causes.find_causes(replace(case, picture=picture), frame)


def explained(scene, picture, unmodelled=(), settings=None, sample_radius=0.0):
    """Return the causes of the pixels of a picture, having checked what holds for every one."""
    settings = settings or Settings()
    frame = render(scene, settings)
    found = result_of(find_causes(scene, frame, picture, unmodelled, sample_radius))
    differs = differing(frame.color, picture)
    assert ((found.cause == AGREE) <= ~differs).all()
    assert ((found.cause == AGREE) | differs | (found.cause == NOT_DECIDABLE)).all()
    measured = np.isin(found.cause, (EDGE, DEPTH_TIE))
    assert (found.figure <= found.allowed)[measured].all()
    assert np.isnan(found.figure[np.isin(found.cause, (AGREE, UNEXPLAINED))]).all()
    return found


def shifted(camera, dx, dy):
    """Return the camera with its picture moved by (dx, dy) pixels."""
    (w, h), v = pixel_size(camera), camera.window
    window = ViewWindow(v.left + dx * w, v.right + dx * w, v.bottom + dy * h, v.top + dy * h)
    return replace(camera, window=window)


def rising(work):
    """Run work whose share never falls; return its shares, and its result."""
    events = []
    found = result_of(work, events.append)
    shares = [e.share for e in events if isinstance(e, Progress) and e.share is not None]
    assert (np.diff(shares) > -1e-12).all()  # but for the rounding of a sum
    assert 0 <= shares[0] and shares[-1] <= 1 + 1e-12
    return shares, found


def count(found, cause) -> int:
    """Return how many pixels have a cause."""
    return int((found.cause == cause).sum())
