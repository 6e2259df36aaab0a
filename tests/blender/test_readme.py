"""The README's commands run, as they stand there."""

import re
import shlex
import shutil
import sysconfig
from pathlib import Path

import trimesh

from .scenes import save

PROJECT = Path(__file__).parents[2]
EXAMPLE = PROJECT / "packages" / "conformance" / "examples" / "embreex_obj.py"


def test_its_commands_run(build, tmp_path, monkeypatch, reftrace):
    """In a folder with the files that they name; of forty scenes one does."""
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    commands = re.findall(r"^(reftrace .+?)(?: +#.*)?$", text, re.M)
    build.room(64, 36, lens=40)
    save(tmp_path / "scene.blend")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", sysconfig.get_path("scripts"), prepend=":")
    trimesh.creation.icosphere().export("mesh.obj")
    assert reftrace("trace", "scene.blend", "--out", "render.png").returncode == 0
    for command in commands:
        words = shlex.split(command)[1:]
        if words[0] == "conform":
            shutil.copy(EXAMPLE, "renderer.py")
            words += ["--only", "camera-plain", "--no-sandbox"]  # which hides a clone in /tmp
        done = reftrace(*words)
        assert done.returncode == 0, (command, done.stderr)
    assert len(commands) == 6
    for name in ("compared/page.html", "mesh.png", "pixel.html", "mine.py", "report/index.html"):
        assert Path(name).is_file(), name
