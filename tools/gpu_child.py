"""In a Blender without a window: what draws here, and how well all sample scenes agree with it.

`gpu.py` runs it: in a Blender with the extension, or in the bpy module. A line that begins with ROW
has what it found as JSON.
"""

import importlib
import json
import sys
import traceback
from pathlib import Path

import bpy
import gpu
import numpy as np

SCENES = Path(__file__).resolve().parents[1] / "sample_scenes"
OURS = "bl_ext.user_default.reference_tracer.addon" if bpy.app.binary_path else "reference_tracer"


def ours(name):
    """A module of the add-on."""
    return importlib.import_module(f"{OURS}.{name}")


def compared(path):
    """Compare a sample scene with Workbench's picture, by the proven method; draw it once more.

    Returns the counts, and in how many pixels the two drawings differ.
    """
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    compare = ours("blender.jobs.compare")
    chosen = {"judge": "WORKBENCH", "settings": ours("tracer.settings").Settings()}
    work = compare.compare_open_file(bpy.context, diagnose=False, **chosen)
    found = ours("tracer.progress").result_of(work)
    again = compare.gather_case(bpy.context, **chosen).picture
    differs = ours("pictures.storage").differing(found.picture, again.color)
    return found.counts, int(np.count_nonzero(differs))


def row(names):
    gpu.init()
    if not bpy.app.binary_path:
        ours("blender.registration").register()
    judge = ours("blender.drawing.judges").WORKBENCH
    snapping = ours("blender.drawing.rasteriser").snapping_of(judge)
    found = {name: compared(SCENES / f"{name}.blend") for name in names}
    return {
        "blender": bpy.app.version_string,
        "backend": gpu.platform.backend_type_get(),
        "device": gpu.platform.renderer_get(),
        "driver": gpu.platform.version_get(),
        "snapping": snapping,
        "pixels": sum(counts.total for counts, _ in found.values()),
        "differ": sum(counts.differ for counts, _ in found.values()),
        "unsteady": {name: again for name, (_, again) in found.items()},
        "unexplained": {name: counts.unexplained for name, (counts, _) in found.items()},
    }


try:
    print("ROW", json.dumps(row(sys.argv[sys.argv.index("--") + 1 :])), flush=True)
except Exception:  # Blender would go on, and say nothing of it by its exit code
    traceback.print_exc()
    sys.exit(1)
