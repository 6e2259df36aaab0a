"""What registering does to Blender: it is quick, as it imports little."""

from __future__ import annotations

import json
import subprocess
import sys

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
    light = {"methods", "tracer", "tracer.progress", "wording"}
    assert {n for n in own if not n.startswith("reference_tracer.blender")} == {
        f"reference_tracer.{name}" for name in light
    }
    assert not {n.split(".")[0] for n in new} & {"numpy", "trimesh", "matplotlib", "argparse"}
