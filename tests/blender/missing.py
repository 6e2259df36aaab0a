"""A scene that is saved and opened again, and what is then said to be missing."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest
from reference_tracer.manifest import Effect

SIZE = 48, 32


def found(manifest) -> dict[str, tuple[str, str]]:
    """Return what is missing by what it is: its name, and what needs it."""
    missing = [u for u in manifest.unmodelled if u.effect is Effect.MISSING]
    lines = [line.strip() for line, warns in manifest.facts() if warns]
    for u in missing:
        assert u.line() in lines and u.bounds is None
    return {u.feature: (u.object, u.detail) for u in missing}


@pytest.fixture
def saved(build, tmp_path):
    """A scene that is made, saved and opened again."""

    def reopen(name: str = "scene") -> None:
        path = str(tmp_path / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)

    def begin() -> None:
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        build.scene(*SIZE)
        build.camera((0, 0, 12))

    begin()
    return SimpleNamespace(folder=tmp_path, reopen=reopen, begin=begin)
