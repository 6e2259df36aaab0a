"""Whose surface each pixel of Blender's picture shows, though no colour says so."""

from __future__ import annotations

from reference_tracer.blender.temporary import leave_out
from reference_tracer.pictures.palette import By


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
