"""What registering does to Blender: it is quick, as it imports little."""

from __future__ import annotations

import json
import subprocess
import sys
import typing

import bpy
import pytest

REGISTER = """
import bpy, json, sys
for name in [n for n in sys.modules if n.split(".")[0] == "numpy"]:  # Blender starts without it
    del sys.modules[name]
before = set(sys.modules)
import reference_tracer
reference_tracer.register()
print("NEW", json.dumps(sorted(set(sys.modules) - before)))
"""


def test_little_is_imported_to_register():
    """Neither numpy nor what needs it: tracer, comparison, study, report, trimesh..."""
    done = subprocess.run([sys.executable, "-c", REGISTER], capture_output=True, text=True)
    [line] = [s for s in done.stdout.splitlines() if s.startswith("NEW")]
    new = set(json.loads(line.removeprefix("NEW")))
    own = {name for name in new if name.startswith("reference_tracer.")}
    assert "reference_tracer.blender.registration" in own, done.stderr
    light = {"methods", "tracer", "tracer.progress", "translations", "wording"}
    assert {n for n in own if not n.startswith("reference_tracer.blender")} == {
        f"reference_tracer.{name}" for name in light
    }
    assert not {n.split(".")[0] for n in new} & {"numpy", "trimesh", "matplotlib", "argparse"}


KINDS = "Operator", "Panel", "PropertyGroup", "AddonPreferences", "RenderEngine"


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_annotated_is_there_when_blender_asks(kind, addon):
    """Blender 4.3 registers no class with a name that is imported for type checkers alone."""
    base = getattr(bpy.types, kind)
    own = [cls for cls in base.__subclasses__() if cls.__module__.startswith("reference_tracer.")]
    assert own
    for cls in own:
        typing.get_type_hints(cls)
