"""`blender -b` and `blender --command` of a whole Blender: files, exit codes, faults."""

import json
import re
import shutil
import subprocess
import sys

import pytest

from .conftest import PROJECT

pytestmark = pytest.mark.gui

SCENE = "/project/sample_scenes/exercise_perspective.blend"

# Each makes the scene one that cannot be traced, and what the error names: one that is refused, and
# one that is our own. tests/blender/test_engine_faults.py has them all in one process.
FAULTS = {
    "panoramic": ("C.scene.camera.data.type = 'PANO'", "fisheye"),
    "broken_exporter": (
        "from bl_ext.user_default.reference_tracer.addon.blender.reading import export as e; "
        "e.export = None",
        "failed",
    ),
}


@pytest.fixture
def folder(blender, request):
    """Give an empty folder of the test's own, with its name inside the root folder."""
    path = blender.out / "".join(c if c.isalnum() else "_" for c in request.node.name)
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir()
    return path, f"/project/out/gui/{path.name}"


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_stops_the_render(blender, folder, fault):
    path, inside = folder
    code, named = FAULTS[fault]
    done = blender.run(
        "-b",
        SCENE,
        "--python-exit-code",
        "9",
        "--python-expr",
        f"import bpy; C, D = bpy.context, bpy.data; {code}",
        "-E",
        "REFERENCE_TRACER",
        "-o",
        f"{inside}/out_####",
        "-F",
        "PNG",
        "-f",
        "1",
    )
    assert done.returncode not in (0, 9), done.stdout + done.stderr
    assert named in done.stdout + done.stderr
    assert list(path.iterdir()) == []


@pytest.mark.parametrize("camera", ["", "--set eye=3,-9,4 ortho-scale=7 frame=2 width=160"])
def test_command(camera, blender, folder):
    path, inside = folder
    command = "--command", "reference_tracer", "compare", "--out", inside
    done = blender.run(SCENE, *command, *camera.split())
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verdict: agree" in done.stdout
    assert not any(word in done.stdout for word in ("Saved", "Read blend", "Fra:", "Blender quit"))
    assert {"page.html", "frame.npz"} < {p.name for p in path.iterdir()}
    found = json.loads((path / "comparison.json").read_text())
    assert found["blender"]["source"] == "workbench" and found["pixels"]["unexplained"] == 0


def test_sigterm_ends_a_command_as_ctrl_c_does(blender, folder):
    """Sent once its handler is there, from a thread beside the work."""
    path, inside = folder
    code = (
        "import os, signal, threading, time\n"
        "def later():\n"
        "    while signal.getsignal(signal.SIGTERM) == signal.SIG_DFL: time.sleep(0.01)\n"
        "    os.kill(os.getpid(), signal.SIGTERM)\n"
        "threading.Thread(target=later, daemon=True).start()\n"
    )
    command = "--command", "reference_tracer", "extremes", "--out", inside
    done = blender.run("--python-expr", code, *command)
    assert done.returncode == 143, done.stdout + done.stderr
    assert "reference_tracer: terminated" in done.stderr and "Traceback" not in done.stderr
    assert not [p.name for p in path.iterdir() if p.name.startswith(".reftrace-")]


@pytest.mark.torture
def test_both_backends_are_asked(blender):
    """In 4.3, and without a driver, there is no Vulkan: that is said."""
    shim = PROJECT / "tests" / "farms" / "bin" / "blender"
    command = [sys.executable, PROJECT / "tools" / "gpu.py", "--blender", shim, "exercise_triangle"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert re.search(r"\| OPENGL .*\| 0 +\|$", done.stdout, re.M), done.stdout + done.stderr
    assert "VULKAN" in done.stdout + done.stderr
