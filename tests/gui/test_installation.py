"""The zip in a whole Blender: in the window, and from an address on this machine.

The commands are those of docs/button.md, word for word. `conftest.py` installs it from disk for all
tests, by that of them.
"""

import re
import shutil
import subprocess

import pytest

from .conftest import PROJECT, WHOLE_BLENDER, documented

pytestmark = pytest.mark.gui

ADDRESS = "http://127.0.0.1:8000"
# The folder becomes a repository of extensions, which this machine serves; it reaches no other.
SERVE = """
ip link set lo up
cd {folder}
blender --command extension server-generate --repo-dir .
python3 -m http.server --bind 127.0.0.1 8000 &
until (: </dev/tcp/127.0.0.1/8000) 2>/dev/null; do sleep 0.1; done
"""
SCENE = "exercise_triangle"
USE = "blender {scene} --command reference_tracer compare --out {folder}/compared"


def test_it_is_installed_from_an_address_as_the_document_says(blender):
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    out = blender.out / "installation"
    shutil.rmtree(out, ignore_errors=True)
    (out / "user").mkdir(parents=True)  # else it has the repositories of all earlier runs, too
    shutil.copy(package, out)
    folder = f"/project/out/gui/{out.name}"
    scene = "/project/sample_scenes/exercise_triangle.blend"
    script = "\n".join(
        ["set -e", SERVE, f"cd {folder}", *documented()[1:], "blender -c extension list", USE]
    )
    script = script.replace("ADDRESS", ADDRESS).format(folder=folder, scene=scene)
    user = f"BLENDER_USER_RESOURCES={folder}/user"
    command = [WHOLE_BLENDER, "run", "env", user, "bash", "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"reference_tracer.*\[installed\]", done.stdout), done.stdout
    assert "Reference Tracer.001" not in done.stdout
    assert "verdict: agree" in done.stdout and "Traceback" not in done.stdout + done.stderr
    assert (out / "compared" / "page.html").exists()


def test_it_is_installed_by_a_script_as_the_readme_says(blender):
    """The next Blender has it, too."""
    out = blender.out / "by_script"
    shutil.rmtree(out, ignore_errors=True)
    (out / "user").mkdir(parents=True)
    [package] = (PROJECT / "dist").glob("reference_tracer-*.zip")
    shutil.copy(package, out)
    readme = (PROJECT / "README.md").read_text("utf-8")
    [command] = re.findall(r"^blender -b .+$", readme, re.M)
    folder, scene = f"/project/out/gui/{out.name}", "/project/sample_scenes/exercise_triangle.blend"
    script = "\n".join(["set -e", f"cd {folder}", command, USE.format(folder=folder, scene=scene)])
    user = f"BLENDER_USER_RESOURCES={folder}/user"
    done = subprocess.run(
        [WHOLE_BLENDER, "run", "env", user, "bash", "-c", script], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verdict: agree" in done.stdout


@pytest.mark.story("from_disk")
def test_it_goes_and_comes_in_an_open_window(noted):
    assert noted["gone"] == {"panel": False, "scene": False, "images": 0, "modules": []}
    assert noted["installed"] == noted["again"] == ["FINISHED"]  # the second time, over itself
    assert noted["verdict"] == "agree"
    assert noted["written"] == [f"{SCENE}/compare/comparison.json"]  # as the Preferences say
