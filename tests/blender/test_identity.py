"""Whose surface each pixel of Blender's picture shows: by objects, instancers and stand-ins."""

from __future__ import annotations

import numpy as np
from reference_tracer.blender.temporary import leave_out
from reference_tracer.pictures.identity import NOTHING
from reference_tracer.pictures.palette import By


def shown(comparison) -> set[str]:
    """Return the names of what Blender shows, all of it known."""
    identity = comparison.identity
    counts = identity.shows()
    assert counts.not_known == 0
    assert counts.other_object <= 0.01 * identity.shown.size  # edges
    assert comparison.counts.unexplained == 0
    return {identity.names[i] for i in np.unique(identity.shown) if i != NOTHING}


def test_corners_that_carry_children(build, compare):
    """What is parented to them shows the parent's colour."""
    build.scene()
    parent = build.square("Parent", 2)
    child = build.cube("Child", 0.4)
    child.parent, parent.instance_type = parent, "VERTS"
    build.camera()
    assert shown(compare()) == {"Parent"}


def test_a_wrong_object_of_the_same_colour_is_found(build, compare, monkeypatch):
    """What is drawn for identity lacks an object, and no colour says so."""
    from reference_tracer.blender.drawing import drawings

    build.room(color_type="SINGLE", lens=40)
    real = drawings._owners

    def lacking(drawing, tmp, names):
        leave_out(tmp, [tmp.objects["Green"]])
        return real(drawing, tmp, names)

    monkeypatch.setattr(drawings, "_owners", lacking)
    found = compare(colors=By.VIEWPORT)
    shows = found.counts.unexplained_shows
    assert found.verdict == "differences"
    assert shows.other_object > 100 and shows.same_object == 0
