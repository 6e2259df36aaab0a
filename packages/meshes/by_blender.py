"""Has Blender read what no other library applies: its importer, in a process of its own.

So a damaged file that Blender does not survive ends that process alone, and the scene that a user
has open in this one stays as it is.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from reference_tracer.files.checked_json import Content
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.files.scenes import load_account, load_scene
from reference_tracer.scene import SceneError
from reference_tracer_processes.running import Limits, ProgramError, run

from .contents import Contents, Placed
from .gltf_extensions import present

_LIMITS = Limits(seconds=600.0, memory=1 << 36)
_IMPORTS = sys.executable, "-m", "reference_tracer.blender.importing"


def imported(path: Path, needs: str) -> Contents:
    """Return what Blender shows of a file, with Z up.

    Parameters
    ----------
    path : Path
    needs : str
        What takes Blender, for the message where it is not installed: ".usd files take".

    Raises
    ------
    MissingLibraryError
        If Blender is not there as a module.
    SceneError
        If it cannot import the file.
    """
    if find_spec("bpy") is None:
        raise MissingLibraryError(
            f'{needs} Blender as a module: pip install "reference_tracer[blender]"'
        )
    with tempfile.TemporaryDirectory(prefix="reftrace-import-") as name:
        out = Path(name, "scene.npz")
        words = [*_IMPORTS, str(path), str(out)]
        with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as errors:
            try:
                run(words, Path(name), _LIMITS, (None, said, errors), boxed=False)
            except ProgramError as error:
                errors.seek(0)
                lines = errors.read().decode("utf-8", "replace").splitlines()
                own = [line.rpartition("SceneError: ")[2] for line in lines if "Error: " in line]
                raise SceneError(own[-1][:300] if own else error.message) from error
        scene, account = load_scene(out), load_account(out)
    objects, meshes = scene.objects, scene.meshes
    placed = [
        Placed(meshes[i.mesh], i.world_from_object, objects[i.object]) for i in scene.instances
    ]
    return Contents(tuple(placed), account.notes, (), account.lacks)


def read_gltf(content: Content, buffers: Sequence[bytes]) -> Contents:
    """Return what Blender shows of a glTF, given as its JSON without buffers, and these.

    Raises what :func:`imported` raises.
    """
    with tempfile.TemporaryDirectory(prefix="reftrace-gltf-") as name:
        files = [{"uri": f"{k}.bin", "byteLength": len(data)} for k, data in enumerate(buffers)]
        for k, data in enumerate(buffers):
            Path(name, f"{k}.bin").write_bytes(data)
        used = sorted({*present(content), *content.get("extensionsRequired", [])})
        content = content | {"buffers": files, "extensionsUsed": used}
        path = Path(name, "file.gltf")
        path.write_text(json.dumps(content), "utf-8")
        return imported(path, "its skins, morph targets, instances, or packed numbers take")
